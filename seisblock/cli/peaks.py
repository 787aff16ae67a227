"""PGA and PGV in place of a record, in ``criteria`` and ``rock``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from seisblock.cli.option_checks import RECORD_OPTIONS, reject_with
from seisblock.cli.options import Source
from seisblock.cli.output import OutputOptions
from seisblock.cli.scenario_records import resolve_pgv
from seisblock.cli.write_results import figure_of, write_results
from seisblock.core.errors import ParameterError
from seisblock.core.units import GAL, KINE

if TYPE_CHECKING:
    from seisblock.output.json.schema import Document
    from seisblock.studies.scenario.peaks import PeakAssessment


def parse_peaks(source: Source, params: dict[str, Any], without_effect: Sequence[str]) -> tuple[float, float] | None:
    """Return PGA, m/s^2, and PGV, m/s, of a call without RECORD and take their options out of the parameters; None without them.

    Parameters
    ----------
    source : Source
    params : dict
        ``pga``, ``pgv``, ``frequency``.
    without_effect : sequence of str
        Options of the command that need a record.

    Raises
    ------
    ParameterError
        If one of both peaks is missing, or there is a record, too.
    """
    peaks = {name: params.pop(name) for name in ("pga", "pgv", "frequency")}
    if all(value is None for value in peaks.values()):
        return None
    if source.record:
        raise ParameterError("RECORD and --pga exclude each other: give only one of them; --target-pga scales a record")
    pgv = resolve_pgv(peaks)
    if peaks["pga"] is None or pgv is None:
        raise ParameterError("without RECORD: give --pga with --pgv, or --pga with --frequency")
    reject_with("--pga", [*RECORD_OPTIONS, *without_effect])
    return peaks["pga"] * GAL, pgv * KINE


def write_peaks(result: PeakAssessment, document: Document, output: OutputOptions) -> None:
    """Print the answer for a pair of peaks and write its files."""
    from seisblock.report.text import peaks as text_output

    write_results(
        document,
        output,
        tables=lambda: text_output.tables(result, gal=output.gal),
        csv=lambda: text_output.csv_columns(result),
        figure=figure_of("criteria:peaks_figure", result, gal=output.gal),
    )

"""``seisblock fetch``: records of an earthquake or a station from FDSN data centers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import click

from seisblock.cli.command import Command, argument, option
from seisblock.cli.console import info, print_result, print_tables, warning
from seisblock.cli.options import check_callback
from seisblock.cli.verbosity import quiet_output
from seisblock.core import checks

_positive, _non_negative = check_callback(checks.positive), check_callback(checks.non_negative)


def _split(ctx: click.Context, param: click.Parameter, value: tuple[str, ...]) -> tuple[str, ...]:
    """Split repeated and comma-separated codes."""
    del ctx, param
    return tuple(part.strip().upper() for text in value for part in text.split(",") if part.strip())


@click.command(
    cls=Command,
    examples=(
        "seisblock fetch ci38457511 --data-center SCEDC --within 50",
        "seisblock fetch --station CI.MIKB --time 2019-07-06T03:19:53 --data-center SCEDC",
        "seisblock map ci38457511 --block gravestone --mu 0.5",
    ),
)
@argument("event", required=False, metavar="[EVENT]", section="Record", help="Event id at the event center, or a QuakeML file.")
@option(
    "--station",
    "stations",
    multiple=True,
    callback=_split,
    metavar="NET.STA",
    section="Record",
    help="Network and station code, wildcards allowed; may be repeated. [default: all within --within]",
)
@option("--time", metavar="UTC", section="Record", help="Time of interest instead of EVENT, as 2019-07-06T03:19:53; requires --station.")
@option(
    "--within",
    "radius_km",
    type=float,
    callback=_positive,
    metavar="KM",
    default=100.0,
    show_default=True,
    section="Record",
    help="Largest epicentral distance of stations, km.",
)
@option(
    "--before",
    "before_s",
    type=float,
    callback=_non_negative,
    default=30.0,
    show_default=True,
    metavar="S",
    section="Record",
    help="Beginning of the window before the origin time or --time, s.",
)
@option(
    "--duration",
    "duration_s",
    type=float,
    callback=_positive,
    default=300.0,
    show_default=True,
    metavar="S",
    section="Record",
    help="Length of the window, s.",
)
@option(
    "--channel",
    "channels",
    multiple=True,
    callback=_split,
    metavar="CODE",
    section="Record",
    help="Channel codes with wildcards in the order of preference; one sensor of each station is taken. "
    "[default: HN?, EN?, BN?, HG?, EG?, LN?: accelerometers]",
)
@option("--location", metavar="CODE", section="Record", help="Location code of the sensor, -- for the empty one. [default: the first]")
@option(
    "--data-center",
    default="EARTHSCOPE",
    show_default=True,
    metavar="NAME|URL",
    section="Record",
    help="Data center of stations and waveforms: a name known to ObsPy (SCEDC, NCEDC, GEONET, INGV, KOERI, ...) or an address.",
)
@option(
    "--event-center", default="USGS", show_default=True, metavar="NAME|URL", section="Record", help="Data center that issued the event id."
)
@option(
    "--retries",
    section="Record",
    type=click.IntRange(0, 20),
    metavar="N",
    default=3,
    show_default=True,
    help="Retries of a request that fails temporarily, with pauses of 1, 2, 4, ... s.",
)
@option(
    "--directory",
    "-o",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="DIR",
    section="Output",
    help="Folder of the files. [default: named after the event, or after station and time]",
)
@option("--json", "as_json", is_flag=True, section="Output", help="Print one JSON document on stdout, SI units.")
@option("--quiet", is_flag=True, section="Output", help="Print only errors on stderr.")
def fetch(retries: int, directory: Path | None, as_json: bool, quiet: bool, **request_values: Any) -> None:
    """Download of records from an FDSN data center into a folder that map and RECORD accept directly.

    The folder holds miniSEED and StationXML of each station, and the QuakeML of the event. Run the same command again to resume an
    interrupted download.

    Files of other agencies are downloaded by hand and need no conversion. K-NET and KiK-net: www.kyoshin.bosai.go.jp, after a
    registration; the archive of an event (.tar, .knt.tar.gz, .kik.tar.gz). JMA: www.data.jma.go.jp/eqev/data/kyoshin/jishin, without
    login; the CSV of a station. CESMD: www.strongmotioncenter.org, with an e-mail address; processed data (V2 or COSMOS), the zip file.
    """
    from seisblock.cli.progress import progress
    from seisblock.readers.fdsn import DEFAULT_CHANNELS
    from seisblock.report.text import fetch as text_output
    from seisblock.studies import fetch as study

    request = study.FetchRequest(**request_values | {"channels": request_values["channels"] or DEFAULT_CHANNELS})
    target = directory or Path(_folder_name(request))
    with quiet_output(quiet):
        with progress("stations") as advance:
            downloads = study.fetch(request, target, retries=retries, progress=advance)
        if as_json:
            from seisblock.output.json.encode import to_json
            from seisblock.report.json.fetch import document

            print_result(to_json(document(request, downloads, target)))
        else:
            print_tables(text_output.tables(downloads, target))
        failed = [download for download in downloads if download.status == study.FAILED]
        if failed:
            warning(
                "{count} of {total} stations failed: run the same command again to resume the download",
                count=len(failed),
                total=len(downloads),
            )
        study.require_any(downloads)
        info("wrote {path}", path=target)


def _folder_name(request: Any) -> str:
    """Return the default name of the folder: of the event, or of the first station and the time."""
    parts = [Path(request.event).stem] if request.event is not None else [request.stations[0], request.time]
    return re.sub(r"[^\w.-]+", "", "_".join(parts))

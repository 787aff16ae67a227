"""Cost of a report: one body after loading, and the command for one body and for three."""

import resource
import subprocess
import sys
from dataclasses import replace

import pytest

from seisblock.output.io.atomic import write_records
from seisblock.readers import read
from seisblock.report.html.report import report
from seisblock.studies.report.models import body_models
from seisblock.studies.report.responses import collect_responses
from tests.report.long_record import record

THREE = ("gravestone", "chozusha", "24cmx72cm")


def cpu_of_children():
    """Return the processor time of all children that have ended, s: other work on the machine is none of theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.mark.slow
def test_report_of_one_body(benchmark):
    """The bundled record of 60 s and a gravestone: models, versions and three drawings."""
    record, stone = read("synthetic_jma.csv"), body_models("gravestone")
    page = benchmark.pedantic(lambda: report(collect_responses(record, [stone])), rounds=3, warmup_rounds=1)
    assert page.count("data:image/svg+xml") == 3


@pytest.mark.slow
@pytest.mark.parametrize("bodies", [THREE[:1], THREE], ids=["one", "three"])
@pytest.mark.benchmark(timer=cpu_of_children)
def test_report_command(benchmark, bodies, tmp_path):
    """The whole command on 300 s of three components, processor time: below 5 s for one body and 10 s for three on one core of 2024."""
    if benchmark.disabled and len(bodies) > 1:
        pytest.skip("only its time differs from that for one body")
    (path,) = write_records(tmp_path, [replace(record(), source="long")])
    items = [word for body in bodies for word in ("--body", body)]
    words = [sys.executable, "-m", "seisblock", "report", str(path), *items, "--mu", "0.3", "-o", str(tmp_path / "page.html")]
    benchmark.pedantic(lambda: subprocess.run(words, check=True, capture_output=True), rounds=3, warmup_rounds=1)
    assert (tmp_path / "page.html").read_text(encoding="utf-8").count("<h2 id=") == 2 + len(bodies)

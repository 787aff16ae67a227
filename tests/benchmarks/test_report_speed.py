"""What a report costs when everything is loaded: its figures take most of it."""

import pytest

from seisblock.bodies.subjects import subject
from seisblock.present.pages.report import report
from seisblock.readers import read
from seisblock.studies.assessment import assess


@pytest.mark.slow
def test_report_of_one_body(benchmark):
    """The bundled record of 60 s and a gravestone: models, versions and three drawings."""
    record, stone = read("synthetic_jma.csv"), subject("gravestone")
    page = benchmark.pedantic(lambda: report(assess(record, [stone])), rounds=3, warmup_rounds=1)
    assert page.count("data:image/svg+xml") == 3

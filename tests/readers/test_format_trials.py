"""The table of trials in the documentation is that of the program."""

from __future__ import annotations

import pytest

from tests.pages import ROOT
from tests.readers.format_trials import VARIANTS, run_trials, table


@pytest.mark.slow
def test_table_of_trials_is_current(tmp_path):
    """``python -m tests.readers.format_trials`` prints it anew; no variant is read wrongly."""
    lines, wrong = table(tmp_path)
    page = (ROOT / "docs" / "developers" / "record_checks.md").read_text(encoding="utf-8").splitlines()
    assert [line for line in page if line.startswith("|")] == lines
    assert not set(wrong) & set(VARIANTS)


def test_archives_and_variants_of_a_format_are_read_alike(tmp_path):
    """Every variant of a K-NET file, and every archive with it."""
    outcomes = run_trials("knet", tmp_path)
    assert {outcome for (group, _), outcome in outcomes.items() if group != "damage"} == {"right"}

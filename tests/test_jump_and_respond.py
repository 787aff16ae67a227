"""The page that compares the jump of the paper with the full response holds computed values and their consequences."""

import pytest

from tests.jump_and_respond import PAGE, page_table, rows


@pytest.fixture(scope="module")
def by_step():
    """Rows by the number of their step and their component."""
    return {(row[0].split()[0], row[1]): row[2:] for row in rows()}


def test_page_table_equals_program(by_step):
    """Every number of the page, as printed."""
    lines = [tuple(cell.strip() for cell in line.strip("| ").split(" | ")) for line in page_table().splitlines()[2:]]
    assert {(name.split()[0], component): cells for name, component, *cells in (map(str, line) for line in lines)} == {
        key: list(cells) for key, cells in by_step.items()
    }


@pytest.mark.parametrize("component", ["NS", "EW"])
def test_page_statements_hold(by_step, component):
    """Both begin alike; feet that hold keep it in place without restitution; bare feet never rock; restitution throws it."""
    cells = {step: by_step[step, component] for step in "12345678"}
    assert cells["1"][0] == cells["2"][0] == cells["3"][0] == cells["4"][0]
    assert float(cells["3"][1]) > float(cells["1"][1])
    assert cells["3"][2:] == ("0.00", "0.0", "+0.0")
    assert float(cells["4"][2]) > 10.0 * float(cells["1"][2])
    assert cells["8"][:2] == ("-", "0.00") and float(cells["8"][3]) > 80.0
    assert float(cells["2"][3]) > 60.0


def test_page_text_repeats_table_numbers(by_step):
    """Those that the text repeats."""
    text = " ".join(PAGE.read_text(encoding="utf-8").split())
    assert f"{float(by_step['3', 'EW'][1]):.0f} degrees instead of {float(by_step['1', 'EW'][1]):.1f} in EW" in text
    for step in ("2", "8"):
        slid = [f"{float(by_step[step, component][3]) / 100:.2f} m" for component in ("NS", "EW")]
        assert f"by {slid[0]} and {slid[1]}" in text

"""Make the notebooks of docs/notebooks again: ``python -m tests.make_notebooks``; cells are separated by blank lines."""

from __future__ import annotations

import json
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "docs" / "notebooks"

FIRST_PROBABILITY = """\
# A first probability

Would a gravestone have overturned at Hanmer Springs in the 2016 Kaikoura earthquake, had the shaking been twice as strong? The
record is bundled. Run the
cells from top to bottom; the last one needs pandas.

import seisblock

record = seisblock.records.scale_to_pga(seisblock.read("hanmer_springs_2016"), 5.2)  # m/s²
stone = seisblock.load_block("gravestone")
record

The probability counts samples of stone and motion that overturn in either horizontal direction.

seisblock.assess(stone, record, mu=0.6, runs=100)

One run illustrates it. The object shows itself with its outcome and its figure.

response = seisblock.solve_respond(stone, seisblock.motion_of(record, "280"), mu=0.6)
response

**Your own data.** A file of an agency: `seisblock.read("record.csv")`. A stream of ObsPy: `seisblock.Record.from_obspy(stream,
inventory)`. An array:

import numpy as np

time = np.arange(0.0, 10.0, 0.01)
own = seisblock.Record.from_arrays({"NS": 4.0 * np.sin(2 * np.pi * 1.5 * time)}, dt=0.01)  # m/s²
shelf = seisblock.Block(width=0.45, height=1.80)
seisblock.assess(shelf, own, mu=0.4, runs=50)

How does the probability grow with the shaking?

levels = [3.0, 4.0, 5.0, 6.0, 7.0]
shares = [seisblock.assess(stone, seisblock.records.scale_to_pga(record, pga), mu=0.6, runs=40).overturning_probability for pga in levels]
shares

import matplotlib.pyplot as plt

plt.plot(levels, shares, "o-")
plt.xlabel("PGA (m/s²)")
plt.ylabel("overturning probability (1)")
plt.ylim(0, 1);

The time history as a table:

response.to_dataframe().head()
"""

SURVEY = """\
# A survey of gravestones

From a table of stones to an overturning rate, and from fallen stones to the shaking. The bundled stones stand for your own sheet
(CSV or .xlsx, English or
Japanese headings).

import seisblock
from seisblock import survey

stones = seisblock.read_cemetery("aoyama.csv")
stones

The rate at 300 gal and 1.5 Hz, by the criterion of Furukawa and others (2009):

survey.overturning_rate(stones, 3.0, 1.5)

and its curve:

import matplotlib.pyplot as plt

for frequency in (1.0, 1.5, 2.0):
    points = survey.rate_curve(stones, [0.5 * k for k in range(2, 20)], [frequency])
    plt.plot([100 * p.pga_m_s2 for p in points], [p.rate for p in points], label=f"{frequency:g} Hz")
plt.xlabel("PGA (gal)")
plt.ylabel("overturning rate (1)")
plt.legend();

Forty of these hundred stones fell. How strong was the shaking?

survey.estimate_shaking(survey.counted_survey(stones, fallen=40, stones=100))
"""

NOTEBOOKS = {"first_probability.ipynb": FIRST_PROBABILITY, "survey.ipynb": SURVEY}


def is_code(text: str) -> bool:
    """Return True for a part that is a program, False for prose."""
    try:
        compile(text, "<cell>", "exec")
    except SyntaxError:
        return False
    return not text.startswith("#")


def notebook(text: str) -> str:
    """Return a notebook without outputs: neighbouring parts of one kind are one cell."""
    cells: list[tuple[bool, str]] = []
    for part in text.strip().split("\n\n"):
        kind = is_code(part)
        if cells and cells[-1][0] == kind:
            cells[-1] = (kind, f"{cells[-1][1]}\n\n{part}")
        else:
            cells.append((kind, part))
    entries = []
    for index, (code, source) in enumerate(cells):
        entry = {
            "cell_type": "code" if code else "markdown",
            "id": f"cell-{index}",
            "metadata": {},
            "source": source.splitlines(keepends=True),
        }
        entries.append(entry | ({"execution_count": None, "outputs": []} if code else {}))
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    document = {
        "cells": entries,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"


if __name__ == "__main__":
    for name, text in NOTEBOOKS.items():
        (FOLDER / name).write_text(notebook(text), encoding="utf-8")
        print(name)

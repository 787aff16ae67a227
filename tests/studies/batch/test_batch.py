"""Rows of a batch equal the results of the single commands; a row without a result has the reason."""

import csv
import math
from pathlib import Path

import pytest

import seisblock
from seisblock.core.errors import KindError, ParameterError
from seisblock.models.respond.options import RespondOptions
from seisblock.studies.fragility.run import run_fragility
from tests.studies.batch.conftest import document, run, write_record


def table(path):
    """Return the rows of a CSV file."""
    with Path(path).open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def equals_document(cell, value):
    """Return whether a cell of the table equals the value of a document to the last digit."""
    if value is None or value == "":
        return cell == ""
    if isinstance(value, bool):
        return cell == str(value)
    return cell == value if isinstance(value, str) else float(cell) == value


SINGLE = {
    "respond": ("", "--width {width} --height {height} --mu {mu} {inset} --runs 0"),
    "rock": ("", "--width {width} --height {height} {inset} --perturb 2"),
    "slide": ("", "--mu {mu}"),
}
SLENDER = {"width": "20cm", "height": "1m", "mu": "0.6", "inset": ""}
SQUAT = {"width": "80cm", "height": "1.2m", "mu": "0.25", "inset": "--inset 5%"}


@pytest.mark.parametrize("solver", SINGLE)
def test_batch_rows_equal_single_commands(folder, solver):
    """Every scalar of every row, bit by bit."""
    assert run(f"batch records --bodies bodies.csv --solver {solver} --out t.csv").exit_code == 0
    rows = {(row["record"], row["component"], row["body"]): row for row in table("t.csv")}
    assert len(rows) == 4 * 2 * 3
    for name, sizes in (("slender", SLENDER), ("squat", SQUAT)):
        for record in ("r1.csv", "r3.csv"):
            results = document(f"{solver} records/{record} " + SINGLE[solver][1].format(**sizes))["results"]
            for result in results:
                row = rows[record, result["component"], name]
                scalars = {k: v for k, v in result.items() if not isinstance(v, (list, dict)) and k in row}
                invalid = {k: (row[k], v) for k, v in scalars.items() if not equals_document(row[k], v)}
                assert len(scalars) > 10
                assert not invalid


@pytest.mark.parametrize("solver", SINGLE)
def test_batch_all_azimuths_gives_worst_per_row(folder, solver):
    """A row for each record and body: the worst azimuth and its scalars as the single command has them, and in how many it falls."""
    line = f"batch records/r1.csv records/r3.csv --bodies bodies.csv --solver {solver} --component all-azimuths --out t.csv"
    assert run(line).exit_code == 0
    rows = {(row["record"], row["body"]): row for row in table("t.csv")}
    assert len(rows) == len(table("t.csv")) == 2 * 3
    single = SINGLE[solver][1].format(**SLENDER).replace("--runs 0", "--runs 5")
    answer = document(f"{solver} records/r3.csv {single} --component all-azimuths")
    (result,) = answer["results"]
    row = rows["r3.csv", "slender"]
    assert row["directions"] == "36"
    if solver == "slide":
        scalars = {k: v for k, v in result.items() if not isinstance(v, (list, dict)) and k in row}
        assert not {k: (row[k], v) for k, v in scalars.items() if not equals_document(row[k], v)}
        assert row["component"] == result["component"]
    else:  # the command ranks azimuths by the probability of samples, which the batch does not have
        (worst,) = [direction for direction in result["directions"] if direction["azimuth_deg"] == float(row["component"])]
        assert float(row["max_rotation_ratio"]) == pytest.approx(worst["max_rotation_ratio"], rel=1e-6)
        assert int(row["directions_overturned"]) == sum(direction["overturned"] for direction in result["directions"])


def test_batch_all_azimuths_rejects_conflicting_options(folder):
    """Beside a component, with a solver that looks in none, or with an option of one direction: one sentence each."""
    block = seisblock.Block(0.2, 1.0)
    for components, solver, options, reason in (
        (["all-azimuths", "NS"], "rock", {}, "give no other component"),
        ("all-azimuths", "stack", {}, "stack does not support all azimuths"),
        ("all-azimuths", "rock", {"initial": (0.1, 0.0)}, "has no option `initial`"),
    ):
        with pytest.raises(ParameterError, match=reason):
            seisblock.run_batch("records", "lantern" if solver == "stack" else [block], solver, components=components, **options)
    (folder / "one.csv").write_text("time,NS (gal)\n0.00,1\n0.01,200\n0.02,-100\n0.03,5\n")
    (failure,) = seisblock.run_batch("one.csv", [block], "rock", components="all-azimuths").failures
    assert failure["component"] == "all-azimuths" and "two horizontal" in failure["failure"]


def test_batch_of_jump_uplift_and_stack_equals_commands(folder):
    """Jump, uplift and stack, against their commands."""
    write_record(folder / "strong.csv", 9, samples=800, peak=6.0)
    for solver, body, single in (
        ("jump", "chozusha", "--block chozusha"),
        ("uplift", "u.csv", "--width 1 --height 2 --mass 900 --frequency-vertical 6 --damping 0.1"),
        ("uplift", "machine", "--body machine"),
    ):
        (folder / "u.csv").write_text("name,width,height,mass,frequency_vertical,damping\nu,1,2,900,6,0.1\n")
        assert run(f"batch strong.csv --bodies {body} --solver {solver} --out of_{body}.csv").exit_code == 0
        results = document(f"{solver} strong.csv {single}")["results"]
        rows = table(f"of_{body}.csv")
        assert len(rows) == 2
        for row in rows:
            result = next(item for item in results if item["component"] == row["component"])
            scalars = {k: v for k, v in result.items() if not isinstance(v, (list, dict)) and k in row}
            assert {k for k, v in scalars.items() if not equals_document(row[k], v)} == set()
    stones = seisblock.run_batch("strong.csv", "lantern", "stack", components="NS", points=2, step=3e-4)
    separate = seisblock.solve_stack(
        seisblock.load_pile("lantern"), seisblock.motion_of(seisblock.read("strong.csv"), "NS"), points=2, step=3e-4
    )
    assert stones["overturned_any"] == [separate.outcome.overturned_any]
    assert stones["ground_work_j"] == [separate.outcome.ground_work_j]


def test_batch_probability_equals_single_study(folder):
    """Perturbed runs under the same seed."""
    batch = seisblock.run_batch("records/r2.csv", {"a": seisblock.Block(0.2, 1.0)}, "respond", mu=0.6, runs=30, seed=4)
    motion = seisblock.motion_of(seisblock.read("records/r2.csv"), "EW")
    single = seisblock.uncertainty.respond_probability(seisblock.Block(0.2, 1.0), motion, options=RespondOptions(mu=0.6), runs=30, seed=4)
    row = batch.rows[batch["component"].index("EW")]
    assert (row["probability_overturned"], row["probability_moved"]) == (single.overturned, single.moved)
    assert (row["probability_low"], row["probability_high"]) == single.interval
    rocking = seisblock.run_batch("records/r2.csv", [seisblock.Block(0.2, 1.0)], "rock", components="EW", runs=30, seed=4)
    expected = seisblock.uncertainty.perturb(seisblock.Block(0.2, 1.0), motion, 30, seed=4)
    assert rocking["probability_overturned"] == [expected.probability]


def test_batch_failure_is_a_row_with_reason(folder):
    """A file that is none, a component that is not there, a body that cannot be, each by itself; the rest is answered."""
    (folder / "records" / "broken.csv").write_text("time,NS (gal)\n0.00,1\n0.01,what\n")
    bodies = {"good": seisblock.Block(0.2, 1.0), "slope": seisblock.Block(0.3, 0.9)}
    batch = seisblock.run_batch(["records", "gone.csv"], bodies, "rock", components=["EW", "37X"])
    by_reason = {row["failure"]: row for row in batch.failures}
    assert len(batch.failures) == 2 + 4
    assert any("gone.csv" in reason and "no such file" in reason for reason in by_reason)
    assert any("line 3" in reason for reason in by_reason)
    assert sum("37X" in row["failure"] for row in batch.failures) == 4
    assert len(batch) == 4 * 2 + 6
    assert all(row["rocks"] is not None for row in batch.rows if not row.get("failure"))


def test_batch_unsuitable_body_fails_its_rows_only(folder):
    """Friction is missing for one of three."""
    (folder / "b.csv").write_text("name,width,height,mu\na,0.2,1,0.5\nb,0.2,1,\n")
    batch = seisblock.run_batch("records/r0.csv", "b.csv", "respond", components="NS")
    assert [bool(row.get("failure")) for row in batch.rows] == [False, True]
    assert "friction required" in batch.rows[1]["failure"]
    with pytest.raises(ParameterError, match="none of the bodies"):
        seisblock.run_batch("records/r0.csv", [body for body in seisblock.bodies.read_bodies("b.csv") if body.name == "b"], "respond")


def test_batch_takes_a_bundled_kind_beside_sizes(folder):
    """The kind gives the friction, and an unknown one has no effect."""
    (folder / "b.csv").write_text("name,kind,width,height,mu\na,bookcase,0.2,1,\nb,piano,0.2,1,0.5\n")
    batch = seisblock.run_batch("records/r0.csv", "b.csv", "respond", components="NS")
    shelf, piano = batch.rows
    assert shelf["mu"] == 0.4 and piano["mu"] == 0.5
    assert "kinds without effect: 'piano'" in str(batch.notes[0])


def test_batch_names_bodies_narrower_across_the_motion(folder):
    """A shelf 90 cm wide and 30 cm deep stood in every record without a word, while `scenario` let it fall over its depth."""
    (folder / "b.csv").write_text("name,width,depth,height,mu\nshelf,0.9,0.3,1.8,0.5\nstand,0.3,0.3,1,0.5\n")
    note = "shelf (1 of 2 bodies): depth smaller than the width"
    for components, named in (("NS", True), ("all-azimuths", False)):
        notes = seisblock.run_batch("records/r0.csv", "b.csv", "rock", components=components).notes
        assert any(str(text).startswith(note) for text in notes) is named
    shelf = {"shelf": seisblock.Block(0.3, 1.8, depth=0.2)}
    study = run_fragility(["records/r0.csv", "records/r1.csv"], shelf, "rock", steps=30, bootstrap=10)
    assert any(str(text).startswith("shelf (1 of 1 bodies): depth smaller") for text in study.notes)


def test_batch_processes_records_and_rotates_components(folder):
    """A batch processes records and computes directions that are no components."""
    preparation = seisblock.records.Preparation(scale=1.5, window=(2.0, 9.0))
    batch = seisblock.run_batch("records/r1.csv", [seisblock.Block(0.2, 1.0)], "rock", components="37", preparation=preparation)
    motion = seisblock.motion_of(preparation.apply(seisblock.read("records/r1.csv")), "37")
    assert batch["max_rotation_rad"] == [
        seisblock.solve_rock(seisblock.Block(0.2, 1.0).block_toward(37.0), motion).outcome.max_rotation_rad
    ]


def test_batch_result_converts_to_dataframe(folder):
    """The table in pandas: missing cells are missing, types are kept."""
    frame = seisblock.run_batch(["records/r0.csv", "gone.csv"], [0.02, 0.5], "slide").to_pandas()
    assert len(frame) == 5
    assert str(frame["slips"].dtype) == "boolean"
    assert frame["slips"].isna().sum() == 1
    assert str(frame["slip_count"].dtype) == "Int64"
    assert frame.loc[frame["body"] == "body 1", "slips"].all()
    assert math.isnan(frame["max_slip_m"].iloc[-1])


def test_batch_rejects_invalid_arguments(folder):
    """One sentence each."""
    block = seisblock.Block(0.2, 1.0)
    with pytest.raises(ParameterError, match="unknown solver 'fly'"):
        seisblock.run_batch("records", [block], "fly")
    with pytest.raises(KindError, match="slide requires SlidingBase"):
        seisblock.run_batch("records", [block], "slide")
    with pytest.raises(ParameterError, match="the name 'a'"):
        seisblock.run_batch("records", [seisblock.Block(0.2, 1.0, name="a"), seisblock.Block(0.3, 1.0, name="a")], "rock")
    with pytest.raises(ParameterError, match="does not support samples"):
        seisblock.run_batch("records", [0.2], "slide", runs=3)
    with pytest.raises(KindError, match="bodies required"):
        seisblock.run_batch("records", 3.5j, "rock")
    with pytest.raises(ParameterError, match="at least one"):
        seisblock.run_batch("records", [], "rock")


def test_all_azimuths_of_a_scan_solve_its_block_of_the_worst_azimuth(folder):
    """A scan of the table of bodies has a result in its worst azimuth, with the width of its block there."""
    (folder / "scans.csv").write_text("name,body,mu\nboulder,boulder,0.5\n", encoding="utf-8")
    answer = run("batch records/r1.csv --bodies scans.csv --solver respond --component all-azimuths --out scans_out.csv --quiet")
    assert answer.exit_code == 0, answer.stderr
    (row,) = table(folder / "scans_out.csv")
    assert row["outcome"] and float(row["width_m"]) > 0.0

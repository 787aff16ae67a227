"""Lists of bodies as people keep them: spreadsheets in two languages, units where they like, and slips of the pen."""

import shutil

import pytest

from seisblock.app.forms import scenario_object
from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.factory import load_block
from seisblock.bodies.kinds import of_kind
from seisblock.bodies.table import read_bodies
from seisblock.core.errors import BodyError
from seisblock.core.registry import get_solver
from seisblock.core.units import SUN
from seisblock.samples import sample_path
from seisblock.studies.batch.task import build_solver_bodies
from seisblock.studies.report.models import body_models


def write_table(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "bodies.csv"
    path.write_bytes(text.encode(encoding))
    return path


def read_table(tmp_path, text, encoding="utf-8"):
    """Return the bodies of a table."""
    return {body.name: dict(body.parameters) for body in read_bodies(write_table(tmp_path, text, encoding))}


def test_body_table_accepts_units_in_headings_or_cells(tmp_path):
    """A cell's own unit counts, then that of its column, then metres and kilograms."""
    text = "# the museum\nname,width (cm),height,mass_t,inset,slope (deg)\na,12,40cm,0.5,5%,\nb,8sun,1.6,900kg,1cm,3\n"
    assert read_table(tmp_path, text.replace("slope (deg)", "slope_deg (deg)")) == {
        "a": {"width": 0.12, "height": 0.4, "mass": 500.0, "inset": EdgeWear(share=0.05)},
        "b": {"width": pytest.approx(8 * SUN), "height": 1.6, "mass": 900.0, "inset": EdgeWear(length_m=0.01), "slope_deg": 3.0},
    }


def test_cell_in_quotes_may_have_several_lines(tmp_path):
    """Its first line lost the cells to the right, without a word, and the others became bodies."""
    text = '台帳\nname,kind,width (cm),height\n"a\n\n# ""old""","statue\n",12,40cm\n# note\nb,,24,1.6\n'
    assert read_table(tmp_path, text) == {
        'a # "old"': {"kind": "statue", "width": 0.12, "height": 0.4},
        "b": {"width": 0.24, "height": 1.6},
    }
    with pytest.raises(BodyError, match="line 9: width"):
        read_table(tmp_path, text + "c,,-1,1\n")


@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
def test_comma_in_a_title_or_a_note_is_no_separator(tmp_path, separator):
    """The title decided: the header of a table of an Excel with another separator was one unknown column."""
    rows = [["name", "kind", "width (cm)", "height"], ['"vase, blue"', "statue", "12", "40cm"]]
    text = "Inventory, 2024\n" + "".join(f"{separator.join(row)}\n" for row in rows)
    expected = {"vase, blue": {"kind": "statue", "width": 0.12, "height": 0.4}}
    assert read_table(tmp_path, text) == read_table(tmp_path, f"sep={separator}\n{text}") == expected


def test_stated_separator_decides(tmp_path):
    """Commas in the title and in every row: the separator was counted although the first line states it."""
    text = 'Inventory, room 1, 2024\nname;width;height\n"vase, blue, small, old";12cm;40cm\n'
    assert read_table(tmp_path, f"sep=;\n{text}") == {"vase, blue, small, old": {"width": 0.12, "height": 0.4}}


@pytest.mark.parametrize("name", ["展示台（大）.toml", "台２.toml", "台2.toml"])
def test_file_of_a_body_may_have_full_width_letters(tmp_path, monkeypatch, name):
    """Cells are normalised: the file was not found, nor was an upload of the app with a friction typed in under a JMA intensity."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(sample_path("bookcase.toml"), name)
    (spec,) = read_bodies(write_table(tmp_path, f"name,body,mu\ncase,{name},0.3\n"))
    assert spec.error is None and spec.description["name"] == load_block("bookcase").name
    (app_spec,) = read_bodies(scenario_object(["--block", name, "--mu", "0.3"], tmp_path)[1])
    assert (app_spec.error, dict(app_spec.parameters)) == (None, {"mu": 0.3})


@pytest.mark.parametrize("heading", ["μ", "\u00b5", "摩擦係数 μ", "Friction coefficient"])
def test_friction_has_the_symbol_of_the_answers(tmp_path, heading):
    """``scenario`` ignored the column μ, as the program itself calls it, and assumed 0.2 to 0.7; ``batch`` refused it."""
    target = read_table(tmp_path, f"name,width (cm),height (cm),{heading}\ncase,45,180,0.3\n")
    assert target == {"case": {"width": 0.45, "height": 1.8, "mu": 0.3}}


@pytest.mark.parametrize("cell", ["0.5-0.7", "0.5 \u2013 0.7", "０．５～０．７", "0.5\u301c0.7", "0.5 to 0.7", "0.5から0.7"])
def test_friction_may_be_a_range(tmp_path, cell):
    """A range was refused, also by commands that do not use it; samples are drawn from it, around its middle."""
    (tmp_path / "t.csv").write_text(f"name,width (cm),height (cm),mu\ncase,45,180,{cell}\n", encoding="utf-8")
    specs = read_bodies(tmp_path / "t.csv")
    for solver in ("respond", "rigid3d"):
        (body,) = build_solver_bodies(get_solver(solver), specs, {})
        assert body.options.mu == pytest.approx(0.6) and body.body.ranges.mu == (0.5, 0.7)
    assert get_solver("slide").ignored_columns(specs[0].parameters) == ["width", "height", "mu_range"]


def test_reversed_range_of_friction_is_an_error(tmp_path):
    with pytest.raises(BodyError, match=r"the range of mu runs from 0\.7 to 0\.5"):
        read_table(tmp_path, "name,width (cm),height (cm),mu\ncase,45,180,0.7-0.5\n")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp932", "utf-16"])
def test_body_table_accepts_japanese(tmp_path, encoding):
    """Names, full-width digits and encodings as spreadsheets in Japan write them."""
    target = read_table(tmp_path, "名前,幅(cm),高さ,静摩擦係数,接触面\n仏像,４５,160cm,0.5,\n灯籠,30,1.8,,wood/stone\n", encoding)
    assert target == {"仏像": {"width": 0.45, "height": 1.6, "mu": 0.5}, "灯籠": {"width": 0.3, "height": 1.8, "surface": "wood/stone"}}


def test_body_table_rows_may_name_bodies_or_files(tmp_path):
    """A bundled body or a file, beside bodies named by themselves."""
    (tmp_path / "b.csv").write_text("name,body,mu,side\npavilion,chozusha,0.3,long\n")
    row, single = read_bodies([tmp_path / "b.csv", "gravestone"])
    assert (row.description["kind"], row.parameters, single.name) == ("two-layer", {"mu": 0.3, "side": "long"}, "gravestone")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "contains no bodies"),
        ("name,width\n", "contains no bodies"),
        ("name,width,colour\na,1,red\n", "line 1: unknown column 'colour'"),
        ("width,height\n1,2\n", "line 1: a column 'name' is required"),
        ("name,width,幅\na,1,2\n", "two columns mean width"),
        ("name,width (gal)\na,1\n", "gal"),
        ("name,mu (cm)\na,1\n", "unit 'cm' of column 'mu .cm.' is not known; known: none"),
        ("name,width\na,wide\n", "line 2"),
        ("name,width\n,1\n", "line 2: the name of a body is empty"),
        ("name,width\na,1,2,3\n", "line 2: expected 2 cells"),
        ("name,width\na,250\nb,300\nc,1\n", r"line 2: .*\(1 more invalid row: line 3\)"),
        ("name,width\na,-0.25\n", "line 2: width must be positive, found -0.25 m"),
        ("name,width,mu\na,0.25,-0.3\n", "line 2: mu must be zero or more, found -0.3"),
        ("name,mu\na,nan\n", "line 2"),
        ("name,body\na,gone\n", "line 2: .*gone"),
    ],
)
def test_body_table_error_names_its_line(tmp_path, text, says):
    """One sentence, with the file."""
    with pytest.raises(BodyError, match=says) as error:
        read_table(tmp_path, text)
    assert "bodies.csv" in str(error.value)


def test_body_table_rejects_other_files(tmp_path):
    """A directory, a picture, a file that is not there, nothing at all."""
    (tmp_path / "dir.csv").mkdir()
    (tmp_path / "image.csv").write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0")
    with pytest.raises(BodyError, match=r"is a folder: give a table of bodies \(.csv, .xlsx\), a TOML file .*, or a bundled body"):
        read_bodies(tmp_path)
    for name in ("dir.csv", "image.csv", "gone.csv"):
        with pytest.raises(BodyError, match=name):
            read_bodies(tmp_path / name)
    with pytest.raises(BodyError, match="body required"):
        read_bodies([])


def test_body_table_kind_sets_edge_wear(tmp_path):
    """As `--kind` does for one body, in both languages of the heading; beside a file, or misspelt, it is refused with its line."""
    path = tmp_path / "stones.csv"
    path.write_text("名前,幅,高さ,種類,mu\n墓,0.24,0.72,gravestone,0.6\n棚,0.3,1.8,furniture,0.6\n")
    grave, shelf = (get_solver("respond").build_body(listed, {}).body for listed in read_bodies(path))
    assert (grave.inset, grave.ranges.inset_m) == (of_kind(Block(0.24, 0.72), "gravestone").inset, (0.0, pytest.approx(0.024)))
    assert (shelf.inset, shelf.ranges) == (0.0, None)
    assert body_models("24cmx72cm", kind="gravestone").block.inset == grave.inset
    for row, says in (("a,,,statue,0.5,lantern", "or `body`, not both"), ("a,0.2,0.6,grave,0.5,", "unknown kind of body 'grave'")):
        path.write_text(f"name,width,height,kind,mu,body\n{row}\n")
        (listed,) = read_bodies(path)
        with pytest.raises(BodyError, match=rf"line 2: .*{says}"):
            get_solver("respond").build_body(listed, {})

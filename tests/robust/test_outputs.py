"""No file of the user is lost: valid places of outputs, and the state after a failed write."""

import contextlib
import csv
import errno
import os
import signal
import stat
import subprocess
import sys
import threading
import time

import pytest
from click.testing import CliRunner

from seisblock.cli import COMMANDS, main
from seisblock.cli.types import OutputFile
from seisblock.core.errors import OutputError
from seisblock.core.io.checkpoint import Checkpoint
from seisblock.output.io.atomic import atomic_write, read_table, write_table, write_text
from seisblock.samples import sample_path

pytestmark = pytest.mark.slow

PROGRAM = [sys.executable, "-m", "seisblock"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A directory of the user's, with a record in it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.csv").write_bytes(sample_path("elcentro_1940_ns").read_bytes())
    return tmp_path


def run(*words):
    """Run a command in this process."""
    return CliRunner().invoke(main, [str(word) for word in words])


OVER_THE_RECORD = (
    ("slide", "in.csv", "--mu", "0.2", "--csv", "in.csv"),
    ("slide", "in.csv", "--mu", "0.2", "--csv", "./in.csv"),
    ("slide", "in.csv", "--mu", "0.2", "--csv", "link.csv"),
    ("slide", "in.csv", "--mu", "0.2", "--csv", "hard.csv"),
    ("measure", "in.csv", "--csv", "in.csv"),
    ("rock", "in.csv", "--width", "24cm", "--height", "80cm", "--csv", "in.csv"),
)


@pytest.mark.parametrize("words", OVER_THE_RECORD, ids=" ".join)
def test_output_never_overwrites_record(words, folder):
    """R1: the record that is read is never replaced, by whatever name."""
    before = (folder / "in.csv").read_bytes()
    (folder / "link.csv").symlink_to("in.csv")
    os.link(folder / "in.csv", folder / "hard.csv")
    result = run(*words)
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr
    assert (folder / "in.csv").read_bytes() == before


def test_output_never_overwrites_other_components(folder):
    """R1: nor are the other components of a K-NET set, which were not named."""
    for suffix in ("NS", "EW", "UD"):
        (folder / f"x.{suffix}").write_bytes(sample_path(f"synthetic_knet.{suffix}").read_bytes())
    before = (folder / "x.NS").read_bytes()
    assert run("slide", "x.EW", "--mu", "0.2", "--csv", "x.NS").exit_code == 3
    assert (folder / "x.NS").read_bytes() == before


def test_output_never_overwrites_body_or_cemetery(folder):
    """R1: files of bodies and cemeteries are read, too."""
    for name in ("gravestone.toml", "aoyama.csv"):
        (folder / name).write_bytes(sample_path(name).read_bytes())
    holding = {name: (folder / name).read_bytes() for name in ("gravestone.toml", "aoyama.csv")}
    assert run("rock", "in.csv", "--block", "gravestone.toml", "--csv", "gravestone.toml").exit_code == 3
    assert run("overturn-rate", "--cemetery", "aoyama.csv", "--csv", "aoyama.csv").exit_code == 3
    assert run("report", "in.csv", "-o", "in.csv").exit_code == 3
    assert {name: (folder / name).read_bytes() for name in holding} == holding


@pytest.mark.parametrize("command", ["batch", "fragility"])
def test_output_never_overwrites_list_of_records(command, folder):
    """R1: the file that names the records is read, too; under another name it is the same file."""
    (folder / "again.csv").write_bytes((folder / "in.csv").read_bytes())
    (folder / "list.txt").write_text("in.csv\nagain.csv\n")
    os.link(folder / "list.txt", folder / "out.csv")
    curves = {"batch": ("--force", "--out"), "fragility": ("--csv",)}[command]
    result = run(command, "@list.txt", "--bodies", "gravestone", "--solver", "rock", *curves, "out.csv")
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr
    assert (folder / "list.txt").read_text() == "in.csv\nagain.csv\n"


@pytest.mark.parametrize("link", [os.link, os.symlink])
def test_checkpoint_never_overwrites_record(link, folder):
    """R1: what a batch keeps beside its table goes where an output may go."""
    link("in.csv", "out.csv.journal")
    before = (folder / "in.csv").read_bytes()
    result = run("batch", "in.csv", "--bodies", "gravestone", "--solver", "rock", "--force", "--out", "out.csv")
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr
    assert (folder / "in.csv").read_bytes() == before


def test_outputs_of_one_name_are_rejected(folder):
    """R1: --csv and --plot of one name are refused before either is written."""
    result = run("slide", "in.csv", "--mu", "0.2", "--csv", "a.png", "--plot", "./a.png")
    assert result.exit_code == 3 and "the same file" in result.stderr
    assert not (folder / "a.png").exists()


def test_read_only_output_is_rejected(folder):
    """R3: whoever made it read-only meant it, also for root."""
    remaining = folder / "kept.csv"
    remaining.write_text("mine")
    remaining.chmod(0o444)
    result = run("slide", "in.csv", "--mu", "0.2", "--csv", "kept.csv")
    assert result.exit_code == 3 and "read-only" in result.stderr
    assert remaining.read_text() == "mine"


def test_output_through_link_keeps_link(folder):
    """R3: the link stays a link, what it leads to is written."""
    (folder / "real.csv").write_text("old")
    (folder / "name.csv").symlink_to("real.csv")
    assert run("slide", "in.csv", "--mu", "0.2", "--csv", "name.csv").exit_code == 0
    assert (folder / "name.csv").is_symlink() and (folder / "real.csv").read_text().startswith("component,")


def test_output_to_fifo_is_written_through(folder):
    """R3: a FIFO stays one, and its reader gets the file."""
    pipe = folder / "pipe.csv"
    os.mkfifo(pipe)
    got = []
    reader = threading.Thread(target=lambda: got.append(pipe.read_text()))
    reader.start()
    assert run("slide", "in.csv", "--mu", "0.2", "--csv", "pipe.csv").exit_code == 0
    reader.join(10)
    assert stat.S_ISFIFO(pipe.stat().st_mode) and got[0].startswith("component,")


def test_output_to_device_is_written_through(tmp_path):
    """R3: /dev/null is a device afterwards, and /dev/full is said to be full."""
    write_text("/dev/null", "gone")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)  # noqa: PTH116
    with pytest.raises(OutputError, match="No space left"):
        write_text("/dev/full", "too much")


def test_full_disk_keeps_existing_file(tmp_path):
    """The write fails half way: the old file stands, nothing lies beside it, and the reason is said."""
    target = tmp_path / "out.csv"
    target.write_text("old")

    def failing():
        with atomic_write(target) as temporary:
            temporary.write_text("half")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.raises(OutputError, match=r"No space left on device; .* is unchanged"):
        failing()
    assert target.read_text() == "old" and [path.name for path in tmp_path.iterdir()] == ["out.csv"]


HOSTILE = ["=cmd|' /C calc'!A0", "@SUM(A1)", "+cmd|x", "'=1", "-x", "'tis", "plain", "=1,2"]


def test_csv_escapes_spreadsheet_formulas(tmp_path):
    """Names from files are texts in every table, and are read back as they were."""
    path = tmp_path / "out.csv"
    write_table(path, ["name", "value"], ([name, -0.5] for name in HOSTILE))
    with path.open(newline="") as stream:
        _, *cells = csv.reader(stream)
    assert [name for name, _ in cells] == ["'" + HOSTILE[0], "'@SUM(A1)", "'+cmd|x", "''=1", "-x", "'tis", "plain", "'=1,2"]
    assert [row["name"] for row in read_table(path, {"name": str, "value": float})] == HOSTILE
    assert {value for _, value in cells} == {"-0.5"}


def test_overlong_name_gives_one_error(folder):
    """R16: a name of over 255 bytes is refused by the disk, in one line."""
    result = run("slide", "in.csv", "--mu", "0.2", "--csv", "x" * 300 + ".csv")
    assert result.exit_code == 3 and "too long" in result.stderr and "Traceback" not in result.output


@pytest.mark.parametrize(
    "words",
    [("slide", "in.csv", "--mu", "0.2", "--csv"), ("stack", "in.csv", "--plot"), ("report", "in.csv", "-o"), ("infer", "--cemetery")],
    ids=" ".join,
)
def test_circular_link_gives_one_error(words, folder):
    """The disk finds no file behind it, however often it looks: a traceback with Python before 3.13."""
    (folder / "loop.png").symlink_to("loop.png")
    result = run(*words, "loop.png")
    assert result.exit_code == 3 and "loop.png" in result.stderr and not isinstance(result.exception, RuntimeError)


def box(kind, size):
    """Return a box of an MP4."""
    return (size + 8).to_bytes(4, "big") + kind + bytes(size)


FULL = box(b"ftyp", 12) + box(b"mdat", 50) + box(b"moov", 30)


@pytest.mark.parametrize(("content", "good"), [(b"", False), (FULL[:-10], False), (FULL[:78], False), (FULL, True)])
def test_incomplete_animation_keeps_existing_file(content, good, tmp_path, monkeypatch):
    """R2: an encoder that runs out of disk and says nothing leaves the old film alone."""
    from PIL import Image

    from seisblock.output.animation import render

    encoder = tmp_path / "ffmpeg"
    encoder.write_text(
        f"#!{sys.executable}\nimport sys, pathlib\nsys.stdin.buffer.read()\npathlib.Path(sys.argv[-1]).write_bytes({content!r})\n"
    )
    encoder.chmod(0o755)
    monkeypatch.setattr("shutil.which", lambda name: str(encoder))
    film = tmp_path / "film.mp4"
    film.write_bytes(b"old")
    frames = [Image.new("RGB", (4, 4)) for _ in range(2)]
    with contextlib.nullcontext() if good else pytest.raises(OutputError, match="incomplete file"):
        render.write_frames(frames, film)
    assert film.read_bytes() == (content if good else b"old")


def test_animation_on_full_disk_states_reason(tmp_path, monkeypatch):
    """R2: of all that ffmpeg tells, its last line is about something else."""
    from PIL import Image

    from seisblock.output.animation import render

    encoder = tmp_path / "ffmpeg"
    encoder.write_text(
        "#!/bin/sh\ncat > /dev/null\necho 'Error muxing: No space left on device' >&2\necho 'Nothing was written' >&2\nexit 1\n"
    )
    encoder.chmod(0o755)
    monkeypatch.setattr("shutil.which", lambda name: str(encoder))
    film = tmp_path / "film.mp4"
    film.write_bytes(b"old")
    with pytest.raises(OutputError, match=r"No space left on device; .* is unchanged"):
        render.write_frames([Image.new("RGB", (4, 4))] * 2, film)
    assert film.read_bytes() == b"old"


@contextlib.contextmanager
def no_file_over(size):
    """Let the system write no file larger than so many bytes."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_figure_on_full_disk_gives_one_error(suffix, tmp_path):
    """In the middle of whatever matplotlib does: the .pdf ended in a traceback of its compression."""
    from matplotlib.figure import Figure

    from seisblock.output.figures.style import save

    target = tmp_path / f"out{suffix}"
    target.write_bytes(b"old")
    figure = Figure()
    figure.add_subplot().plot(range(1000))
    with no_file_over(2000), pytest.raises(OutputError, match="is unchanged"):
        save(figure, target)
    assert [path.name for path in tmp_path.iterdir()] == [target.name] and target.read_bytes() == b"old"


def test_failed_batch_start_leaves_no_checkpoint(tmp_path):
    """An empty one stood in the way of the next run."""
    path = tmp_path / "out.csv.journal"
    with no_file_over(20), pytest.raises(OutputError, match="cannot write"):
        Checkpoint.begin(path, {"seisblock": "x" * 100})
    assert not path.exists()


def test_checkpoint_on_full_disk_has_whole_lines(tmp_path):
    """A full disk in the middle of a line leaves those before, and the next line stands by itself."""
    path, purpose = tmp_path / "kept.jsonl", {"seisblock": "batch"}
    checkpoint = Checkpoint.open(path, purpose)
    checkpoint.append(("a", "1"), [{"x": 1}])
    before = path.read_bytes()
    with no_file_over(len(before) + 10), pytest.raises(OutputError, match="cannot write"):
        checkpoint.append(("b", "2"), [{"x": 2}])
    assert path.read_bytes() == before
    path.write_bytes(before + b"0123")
    resumed = Checkpoint.open(path, purpose)
    resumed.append(("c", "3"), [{"x": 3}])
    assert list(Checkpoint.open(path, purpose).places) == [("a", "1"), ("c", "3")]


def test_sigterm_cleans_up(folder):
    """R16: SIGTERM while frames are drawn keeps the old animation, leaves no temporary file and exits with 143."""
    film = folder / "film.gif"
    film.write_bytes(b"old")
    command = [*PROGRAM, "jump", "--component", "EW", "--animate", "film.gif", "--slow", "40", "--quiet"]
    with subprocess.Popen(command, cwd=folder, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
        until = time.monotonic() + 600
        while not any(path.name.startswith(".seisblock") for path in folder.iterdir()):
            assert process.poll() is None and time.monotonic() < until
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=600)
    assert process.returncode == 143
    assert sorted(path.name for path in folder.iterdir()) == ["film.gif", "in.csv"] and film.read_bytes() == b"old"


SHELL = {"full": ">/dev/full", "closed": ">&-"}


@pytest.mark.parametrize("end", SHELL)
@pytest.mark.parametrize("command", ["cite", "samples", "measure elcentro_1940_ns --json"])
def test_full_or_closed_stdout_gives_at_most_one_error(command, end, tmp_path):
    """R10: a full or a closed stdout is one sentence at most, never a traceback."""
    line = f"{sys.executable} -m seisblock {command} {SHELL[end]}"
    result = subprocess.run(["bash", "-c", line], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "Traceback" not in result.stderr and "Exception ignored" not in result.stderr
    if end == "full":
        assert result.returncode == 3 and "No space left" in result.stderr
    else:
        assert result.returncode == 0


def test_latin_1_stdout_replaces_characters(tmp_path):
    """R16: a terminal that cannot write Greek shows a sign in its place."""
    environment = {**os.environ, "PYTHONIOENCODING": "latin-1"}
    result = subprocess.run([*PROGRAM, "measure"], cwd=tmp_path, env=environment, capture_output=True, check=False)
    assert result.returncode == 0 and b"Traceback" not in result.stderr


def test_ascii_stdout_replaces_characters(tmp_path):
    """A Python bound to the C locale prints a placeholder for Japanese letters of a station."""
    narrow = {"PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C"}
    environment = {**{name: value for name, value in os.environ.items() if name != "PYTHONIOENCODING"}, **narrow}
    result = subprocess.run([*PROGRAM, "measure", "synthetic_jma"], cwd=tmp_path, env=environment, capture_output=True, check=False)
    assert result.returncode == 0 and b"Traceback" not in result.stderr
    assert b"SYN ???? SYNTHETIC" in result.stdout and result.stdout.isascii()


def test_non_utf_8_file_name_is_read(tmp_path):
    """R16: a file name of other bytes is read like any other."""
    name = os.path.join(os.fsencode(tmp_path), b"\xb6\xe8.csv")  # noqa: PTH118
    with contextlib.suppress(OSError), open(name, "wb") as file:  # noqa: PTH123
        file.write(sample_path("elcentro_1940_ns").read_bytes())
    result = subprocess.run([*map(os.fsencode, PROGRAM), b"measure", name], capture_output=True, check=False)
    assert result.returncode == 0 and b"Traceback" not in result.stderr


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_batch_over_non_utf_8_names(suffix, folder):
    """R16: the bytes are spelt out in the table, and kept in its journal as they are."""
    if suffix == ".parquet":
        pytest.importorskip("pyarrow")
    result = run("batch", "in.csv", "\udcff.csv", "--bodies", "gravestone", "--solver", "rock", "--out", f"out{suffix}")
    assert result.exit_code == 0 and "UnicodeEncodeError" not in result.output, result.output
    table = (folder / f"out{suffix}").read_bytes()
    assert b"\\udcff.csv" in table
    Checkpoint.begin(folder / "a.journal", {"seisblock": "batch"}).append(("\udcff.csv", "gone"), [{"record": "\udcff"}])
    repeat = Checkpoint.resume(folder / "a.journal", {"seisblock": "batch"})
    assert repeat.rows(("\udcff.csv", "gone")) == [{"record": "\udcff"}]


@pytest.mark.parametrize("words", ["--csv out.csv --json > out.csv", "--plot out.png >> out.png", "--json >> in.csv"])
def test_stdout_file_is_neither_output_nor_input(words, folder):
    """The file of stdout is rejected as an output and as an input."""
    before = (folder / "in.csv").read_bytes()
    result = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m seisblock slide in.csv --mu 0.2 --quiet {words}"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 3 and "stdout" in result.stderr
    assert (folder / "in.csv").read_bytes() == before


def test_process_substitution_is_written_through(folder):
    """A shell's process substitution is a name such as /dev/fd/63; so is /dev/stdout where it is a pipe."""
    line = f"{sys.executable} -m seisblock slide in.csv --mu 0.2 --quiet --json --csv >(cat > got.csv) > got.json; wait $!"
    result = subprocess.run(["bash", "-c", line], cwd=folder, capture_output=True, text=True, check=False)
    assert result.returncode == 0 and (folder / "got.json").read_text().startswith("{")
    assert (folder / "got.csv").read_text().startswith("component,")


REFUSED = {
    "an unknown figure": (["--plot", "out.xyz"], "must end in .png, .svg or .pdf"),
    "an unknown film": (["--animate", "out.avi"], "must end in .gif, .mp4 or .html"),
    "a film without ffmpeg": (["--animate", "out.mp4"], "ffmpeg not found"),
    "a folder that is not there": (["--csv", "nowhere/out.csv"], "the folder nowhere does not exist"),
    "two files of one name": (["--csv", "a.png", "--plot", "./a.png"], "the same file"),
    "a table that says it is a workbook": (["--csv", "out.xlsx"], "cannot write CSV to out.xlsx: the name must end in .csv or .txt"),
    "a table that says it is a picture": (["--csv", "out.PNG"], "the name must end in .csv or .txt"),
    "a table that says it is compressed": (["--csv", "out.csv.gz"], "the name must end in .csv or .txt"),
    "a size of no figure": (["--size", "18x12"], "require --plot"),
    "dots of no figure": (["--dpi", "100"], "require --plot"),
    "a slow motion of no film": (["--slow", "4"], "--slow requires --animate"),
}


@pytest.mark.parametrize("quantity", REFUSED)
def test_output_path_is_checked_before_solving(quantity, folder, monkeypatch):
    """The first thing that a command does; the record need not even be there."""
    words, says = REFUSED[quantity]
    monkeypatch.setattr("shutil.which", lambda name: None)
    monkeypatch.setattr("seisblock.output.io.atomic.find_spec", lambda name: None)
    result = run("stack", "not_there.csv", *words)
    assert result.exit_code == 3 and says in " ".join(result.stderr.split())
    assert sorted(path.name for path in folder.iterdir()) == ["in.csv"]


OTHER_NAMES = (
    ("report not_there.csv -o page.pdf", "cannot write HTML to page.pdf: the name must end in .html or .htm"),
    ("validate --quick --html page.xlsx", "the name must end in .html or .htm"),
    ("map not_there.csv --html page.png", "the name must end in .html or .htm"),
    ("map not_there.csv --geojson points.shp", "cannot write GeoJSON to points.shp: the name must end in .geojson or .json"),
    ("measure not_there.csv --csv rows.json", "the name must end in .csv or .txt"),
    ("overturn-rate --cemetery aoyama.csv --csv rows.tsv", "the name must end in .csv or .txt"),
)


@pytest.mark.parametrize(("line", "says"), OTHER_NAMES)
def test_output_suffix_of_other_format_is_rejected(line, says, folder):
    """A suffix that contradicts the content is rejected; files without or with an own suffix are written."""
    result = run(*line.split())
    assert result.exit_code == 3 and says in " ".join(result.stderr.split()), result.output
    assert sorted(path.name for path in folder.iterdir()) == ["in.csv"]


@pytest.mark.parametrize("name", ["rows", "rows.txt", "rows.CSV", "rows.run1", "v1.2"])
def test_output_with_unknown_suffix_is_accepted(name, folder):
    """Whoever names a table without a suffix, or with one of their own, gets it."""
    assert run("overturn-rate", "--cemetery", "aoyama.csv", "--csv", name).exit_code == 0
    assert (folder / name).read_text().startswith("pga_m_s2,")


def test_unwritable_output_is_rejected_with_the_command_line(folder):
    """Of each option for a file to write, before the command reads, imports or computes anything."""
    checked = set()
    for name in COMMANDS:
        for option in main.get_command(None, name).params:
            if isinstance(option.type, OutputFile):
                result = run(name, option.opts[-1], f"nowhere/file{'.csv' if option.opts[-1] == '--stones' else '.html'}")
                reason = "must end in" if option.opts[-1] == "--geojson" else "the folder nowhere does not exist"
                assert result.exit_code == 3 and reason in result.stderr, (name, option.opts, result.stderr)
                checked.add(f"{name} {option.opts[-1]}")
    assert {"report --output", "validate --html", "scenario --xlsx", "batch --out", "stack --resume", "infer --stones"} <= checked


def test_stale_temporary_files_are_removed(tmp_path):
    """SIGKILL in the middle of a write leaves a hidden file: the next output there takes it away, but none that a living run holds."""
    fcntl = pytest.importorskip("fcntl")
    script = (
        "import os, signal, sys\nfrom seisblock.output.io.atomic import atomic_write\n"
        "with atomic_write(sys.argv[1]) as path:\n    path.write_text('half')\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    killed = subprocess.run([sys.executable, "-c", script, str(tmp_path / "a.txt")], check=False)
    assert killed.returncode == -signal.SIGKILL and len(list(tmp_path.glob(".seisblock-*"))) == 1
    (young,) = tmp_path.glob(".seisblock-*")
    write_text(tmp_path / "b.txt", "whole")
    assert young.exists()  # it might be a moment old
    living = tmp_path / ".seisblock-living.txt"
    with living.open("w") as stream:
        fcntl.flock(stream, fcntl.LOCK_EX)
        for path in (young, living):
            os.utime(path, (0, 0))
        write_text(tmp_path / "b.txt", "whole")
        assert not young.exists() and living.exists()
    assert sorted(path.name for path in tmp_path.iterdir()) == [living.name, "b.txt"]

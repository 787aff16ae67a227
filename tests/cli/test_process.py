"""The command line is polite: quiet pipes, clean interruptions, no colour where none is wanted, a light start."""

import json
import os
import pty
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

from seisblock import samples
from seisblock.cli import COMMANDS, main
from tests.bodies.meshes import box, write_stl
from tests.brief_record import brief_record
from tests.lengths import all_but_slow
from tests.readers import data_center

HEAVY = ("numba", "obspy", "scipy", "matplotlib", "PIL", "pandas")
SEISBLOCK = f"{shlex.quote(sys.executable)} -m seisblock"


def shell(line, cwd, **environment):
    """Run a line in bash, with pipefail."""
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", line], cwd=cwd, env={**os.environ, **environment}, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("lines", [[["--help"]], [["--version"]], [[name, "--help"] for name in COMMANDS]], ids=["list", "version", "each"])
def test_help_imports_no_large_package(lines):
    """Neither the list of commands nor the help of any command loads a large package; the list does not even load rich and numpy."""
    # in one process, as a package that the first command loads would stay loaded
    script = f"""
import sys
from seisblock.cli import main
for words in {lines!r}:
    try:
        main(words)
    except SystemExit as end:
        assert not end.code
    print(*words, *sys.modules, file=sys.stderr)
"""
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    loaded = {line.partition(" ")[0]: set(line.split()) for line in result.stderr.splitlines()}
    assert len(loaded) == len(lines)
    heavy = HEAVY if len(lines) > 1 else (*HEAVY, "rich", "numpy")
    assert {name: found for name, modules in loaded.items() if (found := modules.intersection(heavy))} == {}


def test_uplift_loads_no_scipy():
    """To load SciPy's linear algebra would take a third of the time of a warm command."""
    script = """
import sys
from seisblock.cli import main
main(["uplift", "sine:100gal@2Hz,1s", "--json"], standalone_mode=False)
assert "scipy.linalg" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", script], capture_output=True, check=True)


def test_start_time_is_at_most_twice_python_with_click():
    """The list of commands takes twice the processor time of a Python that loads click alone (the best of five in turn, on any machine)."""

    def spent(*words):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, *words], capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    ours, minimum = zip(*((spent("-m", "seisblock", "--help"), spent("-c", "import click")) for _ in range(5)), strict=True)
    assert min(ours) < 4.0 * min(minimum)


@pytest.mark.parametrize(
    "line",
    all_but_slow(["jump --json", "validate --paper Housner1963", "measure --json", "samples", "cite --bibtex"], {"jump --json", "samples"}),
)
def test_broken_pipe_leaves_stderr_empty(line, tmp_path):
    """`| head -1` leaves stderr without a word about pipes and a traceback least of all."""
    result = shell(f"{SEISBLOCK} {line} --quiet | head -1" if "cite" not in line else f"{SEISBLOCK} {line} | head -1", tmp_path)
    assert result.stderr == ""
    assert len(result.stdout.splitlines()) == 1
    assert result.returncode in (0, 141)


def run_interrupted(words, cwd, wait):
    """Start a command in its own group, send SIGINT after `wait`, return exit code and stderr."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-m", "seisblock", *words]
    with subprocess.Popen(command, cwd=cwd, stdout=pipe, stderr=pipe, text=True, start_new_session=True) as process:
        wait(process)
        process.send_signal(signal.SIGINT)
        try:
            _, message = process.communicate(timeout=600)
        finally:
            process.kill()
        return process.returncode, message


def test_sigint_exits_130_and_leaves_no_partial_file(tmp_path):
    """Ctrl-C while frames are drawn keeps the old file, leaves no temporary file and prints one line."""
    film = tmp_path / "film.gif"
    film.write_bytes(b"old")

    def drawing(process):
        until = time.monotonic() + 600
        while not any(path.name.startswith(".seisblock") for path in tmp_path.iterdir()):
            assert process.poll() is None and time.monotonic() < until
            time.sleep(0.02)
        time.sleep(0.3)

    code, message = run_interrupted(["jump", "--component", "EW", "--animate", film.name, "--slow", "40", "--quiet"], tmp_path, drawing)
    assert code == 130
    assert message.strip() == "seisblock: interrupted; no partially written file remains"
    assert [path.name for path in tmp_path.iterdir()] == ["film.gif"] and film.read_bytes() == b"old"


def on_a_terminal(words, cwd, **environment):
    """Return everything a command writes to a terminal of 80 columns, escape sequences included."""
    leader, follower = pty.openpty()
    inherited = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
    environment = {**inherited, "TERM": "xterm-256color", "COLUMNS": "80", **environment}
    with subprocess.Popen(
        [sys.executable, "-m", "seisblock", *words], cwd=cwd, stdin=follower, stdout=follower, stderr=follower, env=environment
    ) as process:
        os.close(follower)
        pieces = []
        while True:
            try:
                piece = os.read(leader, 65536)
            except OSError:  # the terminal is closed when the program ends
                break
            if not piece:
                break
            pieces.append(piece)
        process.wait()
    os.close(leader)
    return b"".join(pieces).decode()


@pytest.mark.slow
def test_colours_appear_on_terminal_without_no_color_only(tmp_path):
    """A terminal gets colours, a terminal with NO_COLOR and a pipe get none, in errors too."""
    assert "\x1b[3" in on_a_terminal(["jump", "nowhere.csv"], tmp_path)
    for words in (["jump", "nowhere.csv"], ["jump", "--component", "EW", "--window", "25:28"]):
        plain = on_a_terminal(words, tmp_path, NO_COLOR="1")
        assert "\x1b[3" not in plain.replace("\x1b[3m", "") and "\x1b[9" not in plain
    assert "\x1b" not in shell(f"{SEISBLOCK} jump --window 25:28 2>&1", tmp_path).stdout


def test_progress_bar_appears_on_terminal_for_long_work_only(tmp_path, monkeypatch):
    """Work of more than a second shows how much is done; shorter work, --quiet and pipes show nothing."""
    script = (
        "import sys, time\nfrom seisblock.cli.progress import progress\n"
        "with progress('drawing') as tell:\n"
        "    for i in range(int(sys.argv[2])):\n        time.sleep(float(sys.argv[1]))\n        tell(i + 1, int(sys.argv[2]))\n"
    )

    def shown(*words):
        """Return what a terminal shows, until the bar has been seen."""
        leader, follower = pty.openpty()
        with subprocess.Popen([sys.executable, "-c", script, *words], stderr=follower, env={**os.environ, "TERM": "xterm"}) as process:
            os.close(follower)
            text = b""
            while b"drawing" not in text:
                try:
                    piece = os.read(leader, 65536)
                except OSError:
                    break
                if not piece:
                    break
                text += piece
            if text:
                process.kill()
            process.wait()
        os.close(leader)
        return text.decode(errors="replace")

    assert "drawing" in shown("0.1", "6000")
    assert shown("0.001", "15") == ""
    assert subprocess.run([sys.executable, "-c", script, "0.1", "15"], capture_output=True, text=True, check=True).stderr == ""


@pytest.fixture(scope="module")
def brief_samples(tmp_path_factory):
    """Bundled files, with the default record cut to its strong part, and a scan of eight vertices in place of the boulder."""
    folder = tmp_path_factory.mktemp("samples") / "bundled"
    shutil.copytree(samples.sample_directory(), folder)
    scan, boulder = write_stl(folder.parent / "slab.stl", *box(0.3, 0.4, 0.9)), folder / "boulder.toml"
    boulder.unlink()
    assert CliRunner().invoke(main, ["body", str(scan), "--name", "boulder", "--out", str(boulder)]).exit_code == 0
    (folder / samples.DEFAULT_SAMPLE).write_bytes(brief_record())
    return folder


@pytest.fixture
def workshop(tmp_path, brief_samples, monkeypatch, request, computed_once):
    """A directory with the record that the examples name; it and the bundled one are brief, for how long they are is not the point.

    The evidence and the items of papers rest on the bundled record as it is.
    """
    (tmp_path / "record.csv").write_bytes(brief_record())
    shutil.copy(samples.sample_directory() / "aoyama.csv", tmp_path / "cemetery.csv")
    (tmp_path / "stations.csv").write_text("station,pga (gal),frequency (Hz),rate\nAAA,300,1.2,0.2\nBBB,600,2.0,0.5\n", encoding="utf-8")
    if getattr(request.node, "callspec", None) is None or request.node.callspec.params.get("name") not in {"paper", "validate"}:
        for module in ("samples", "bodies.toml"):
            monkeypatch.setattr(f"seisblock.{module}.sample_directory", lambda: brief_samples)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def centers(monkeypatch):
    """The data centers that examples name, played on the loopback address; they know the event and the station of the examples."""
    from obspy import UTCDateTime
    from obspy.clients.fdsn.header import URL_MAPPINGS

    monkeypatch.setattr(data_center, "EVENT_ID", "ci38457511")
    monkeypatch.setattr(data_center, "NETWORK", "CI")
    monkeypatch.setattr(data_center, "STATIONS", {"MIKB": (35.0, 139.1), "MID": (35.3, 139.0)})
    monkeypatch.setattr(data_center, "START", UTCDateTime(2019, 7, 6, 3, 19, 40))
    with data_center.data_center() as server:
        for expected in ("USGS", "SCEDC"):
            monkeypatch.setitem(URL_MAPPINGS, expected, server.url)
        yield server


def examples(name):
    """Return the lines at the end of a command's help."""
    text = CliRunner().invoke(main, [name, "--help"] if name else ["--help"]).stdout
    lines = [line.strip() for line in text.split("Examples:")[1].splitlines()]
    return [line for line in lines if line]


@pytest.mark.slow
@pytest.mark.usefixtures("few_runs")
@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_help_examples_run(name, workshop, monkeypatch, request):
    """At least two lines at the end of each help can be pasted as they stand, and run; the page is not served, nor a server asked."""
    monkeypatch.setattr("seisblock.app.server.serve", lambda listener, *rest: listener.close())
    if name == "fetch":
        request.getfixturevalue("centers")
    # examples are to run, not to be precise
    monkeypatch.setattr("seisblock.studies.gravestone_criterion.PGAS", (4.0, 8.0, 12.0))
    lines = examples(name)
    assert len(lines) >= 2
    for line in lines:
        assert "seisblock" in line
        if any(sign in line for sign in "|>$"):
            function = f'seisblock() {{ {SEISBLOCK} "$@"; }}\n'
            result = shell(function + line, workshop)
            assert result.returncode == 0, (line, result.stderr)
        else:
            # every case of the papers is a test of its own
            brief = ["--quick"] if name == "validate" else ["--runs", "50"] if "--twist" in line else []
            result = CliRunner().invoke(main, [*shlex.split(line)[1:], *brief])
            assert result.exit_code == 0, (line, result.output)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_groups_every_option(name):
    """No option but --help is left outside the groups record, body, solver and output."""
    import click

    command = main.get_command(click.Context(main), name)
    groups = {getattr(parameter, "section", None) for parameter in command.params if isinstance(parameter, click.Option)}
    assert groups <= {"Record", "Site", "Body", "Solver", "Output"}


def test_plot_to_stdout_writes_png_only(tmp_path):
    """`--plot -` writes a .png to stdout without a table around it."""
    command = [sys.executable, "-m", "seisblock", "jump", "--component", "EW", "--plot", "-", "--quiet"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, check=True)
    assert result.stdout.startswith(b"\x89PNG") and result.stdout.endswith(b"IEND\xaeB`\x82") and result.stderr == b""
    assert list(tmp_path.iterdir()) == []


def test_main_is_repeatable_in_one_process(tmp_path):
    """Called again and again in one process, the answer is the same and nothing is left behind."""
    first, second = (CliRunner().invoke(main, ["jump", "--json"]).stdout for _ in range(2))
    assert first == second and json.loads(first)["schema"] == "seisblock/jump/2"


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("slide", "bare.csv", "--mu", "0.2"), "give the sampling interval with --dt, for example 0.01 s"),
        (("uplift", "--width", "1", "--height", "2"), "give --frequency-vertical in Hz, or --mass and --stiffness kx,ky,kz in N/m"),
    ],
)
def test_library_parameter_names_become_options_in_errors(tmp_path, monkeypatch, words, text):
    """Parameter names of library messages are printed as options by the command line, in any language."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bare.csv").write_text("NS (gal)\n" + "1\n2\n" * 50, encoding="utf-8")
    from seisblock.core.errors import InputError
    from seisblock.readers import read

    assert text in CliRunner().invoke(main, words).stderr
    told_in_japanese = CliRunner().invoke(main, ["--lang", "ja", *words]).stderr
    assert "`" not in told_in_japanese and "--" in told_in_japanese
    with pytest.raises(InputError, match="give the sampling interval with `dt`"):
        read(tmp_path / "bare.csv")


def test_help_is_the_same_without_docstrings():
    """``python -OO`` removes docstrings; descriptions of commands, of a registered solver and of the program stay."""
    texts = []
    for flags in ([], ["-OO"]):
        script = "import sys; from click.testing import CliRunner; from seisblock.cli import main; " + (
            "[print(CliRunner().invoke(main, [*words, '--help']).stdout) for words in ([], ['respond'], ['rigid3d'])]"
        )
        texts.append(subprocess.run([sys.executable, *flags, "-c", script], capture_output=True, text=True, check=True).stdout)
    assert texts[0] == texts[1]
    assert "Full response" in texts[0]

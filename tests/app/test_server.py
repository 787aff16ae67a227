"""Server of the local page without a browser: safety, languages, escaping, errors."""

import asyncio
import functools
import gc
import json
import os
import re
import signal
import socket
import subprocess
import sys
from typing import ClassVar

import httpx
import pytest
from click.testing import CliRunner
from openpyxl import load_workbook
from starlette.testclient import TestClient

from seisblock.app import server, uploads, views
from seisblock.app.jobs import Job, JobState
from seisblock.cli import app as command
from seisblock.cli import main
from seisblock.core.errors import OutputError, ParameterError
from seisblock.core.i18n import use_locale
from seisblock.output.io.atomic import write_table
from seisblock.output.io.workbook import convert_csv, write_workbook
from seisblock.samples import sample_path

IDS = [
    *("record-input", "object-select", "width-input", "height-input", "mu-input", "run", "cancel"),
    *("tab-object", "tab-survey", "tab-collection", "tab-event"),
]


@pytest.fixture
def client(tmp_path):
    """Client of the page without lifespan: no worker is started."""
    return TestClient(server.create_app(tmp_path, "en"), base_url=f"http://{server.HOST}")


def tab_address(client):
    return re.search(r"/t/[\w-]+", client.get("/").text)[0]


def test_page_has_the_elements_of_its_contract_in_both_languages(client):
    for language, word in (("en", "Ground motion"), ("ja", "地震動")):
        text = client.get("/", params={"lang": language}).text
        assert f'<html lang="{language}">' in text and word in text
        assert [name for name in IDS if f'data-testid="{name}"' not in text] == []


def test_page_loads_nothing_from_outside(client):
    text = client.get("/").text
    assert re.findall(r'(?:src|href)="(?!/)', text) == []
    assert "default-src 'none'" in client.get("/").headers["content-security-policy"]


@pytest.mark.parametrize(("host", "status"), [("evil.example", 400), ("127.0.0.1.evil.example:8765", 400), ("localhost:8765", 200)])
def test_foreign_host_header_is_refused(client, host, status):
    assert client.get("/", headers={"Host": host}).status_code == status


def test_request_of_a_foreign_origin_is_refused(client):
    address = tab_address(client) + "/cancel/object"
    assert client.post(address, headers={"Origin": "http://evil.example"}).status_code == 403
    assert client.post(address, headers={"Sec-Fetch-Site": "cross-site"}).status_code == 403
    assert client.post(address, headers={"Origin": f"http://{server.HOST}"}).status_code == 200


@pytest.mark.parametrize(("size", "status"), [(uploads.MAX_UPLOAD_BYTES, 200), (200_000_000, 413)])
def test_declared_length_of_200_mb_is_refused_before_the_body_is_read(client, size, status):
    headers = {"Content-Type": "application/x-www-form-urlencoded", "Content-Length": str(size)}
    response = client.post(tab_address(client) + "/record", content=b"source=upload", headers=headers)
    assert response.status_code == status
    assert ("at most 200 MB" in response.text) == (status == 413)


def test_body_limit_hands_on_no_chunk_above_it_and_answers_after_the_rest():
    """A browser that still sends reads no answer."""
    chunks = iter([b"12345", b"67890", b"1", b""])
    handed_on, answers = [], []

    async def receive():
        chunk = next(chunks)
        return {"type": "http.request", "body": chunk, "more_body": bool(chunk)}

    async def read_all(scope, receive, send):
        with pytest.raises(uploads.UploadTooLargeError):
            while True:
                handed_on.append((await receive())["body"])
        await send({"type": "http.response.start", "status": 413})

    async def send(message):
        answers.append((message["status"], list(chunks)))

    asyncio.run(uploads.BodyLimit(read_all, limit=9)({"type": "http", "headers": []}, receive, send))
    assert handed_on == [b"12345"]
    assert answers == [(413, [])]


def test_errors_of_input_are_sentences_and_an_unknown_address_leads_to_a_new_page(client):
    address = tab_address(client)
    response = client.post(address + "/record", data={"source": "motion", "motion": "--csv=x"})
    assert 'data-testid="error"' in response.text and "is not an analytic motion" in response.text
    for path in ("/t/unknown/alive", address + "/files/object/secret", address + "/report"):
        assert client.get(path, follow_redirects=False).headers["location"] == "/", path


def test_intensity_stands_for_a_record(client):
    text = client.post(tab_address(client) + "/record", data={"source": "intensity", "intensity": "6+"}).text
    assert 'data-testid="record-summary"' in text and "6 upper" in text


@pytest.mark.parametrize("data", [{"source": "intensity", "intensity": "6+"}, {"source": "motion", "motion": "sine:300gal@1.5Hz,10s"}])
def test_another_record_removes_the_result_of_the_previous_one(client, data):
    text = client.post(tab_address(client) + "/record", data=data).text
    assert '<div id="object-slot" hx-swap-oob="innerHTML">' in text


def finished_job(tmp_path, document, stderr="", line=("measure",)):
    job = Job(line, {"--plot": "figure.png"}, tmp_path, tmp_path, "en", JobState.DONE)
    (tmp_path / "stdout.txt").write_text(json.dumps(document), encoding="utf-8")
    (tmp_path / "stderr.txt").write_text(stderr, encoding="utf-8")
    return job


class FakeTab:
    token, locale, intensity, columns, record = "t", "en", "", (), ("a.csv",)
    serials = dict.fromkeys(views.KINDS, 1)
    sheets: ClassVar = {"survey": "a.csv"}


def test_record_summary_escapes_names_and_leaves_out_lines_on_output_files(tmp_path):
    hostile = "<script>alert(1)</script>"
    record = {
        "station": hostile, "station_name": hostile, "source": hostile, "start": None, "local_start": None, "earthquake": None,
        "dt_s": 0.01, "samples": 100, "epicentral_distance_km": None, "checks": {"proved": ["count"], "assumed": []},
    }  # fmt: skip
    document = {"record": record, "results": [{"component": hostile, "pga_m_s2": 1.0, "pgv_m_s": 0.1, "jma_intensity": 5.46}]}
    job = finished_job(tmp_path, document, f"warning: {hostile}\nwrote {tmp_path}/figure.png\n")
    text = views.record_summary(FakeTab, job)
    assert "<script" not in text and "&lt;script&gt;" in text
    assert "wrote" not in text and "sample count" in text
    # 5.5 would be of the next class
    assert "5.46 (5+)" in text


def test_record_summary_has_the_earthquake_in_the_clock_of_the_record(tmp_path):
    """It stood there as 2016-04-15T16:25:05+00:00, beside a record that begins at 01:25:15 JST."""
    earthquake = {"latitude_deg": 32.8, "longitude_deg": 130.8, "depth_km": 12.0, "magnitude": 7.3, "name": None}
    record = {
        "station": "KMM", "station_name": "", "source": "a.EW", "start": None, "local_start": "2016-04-16 01:25:15 JST",
        "earthquake": {**earthquake, "origin_time": "2016-04-15T16:25:05.4+00:00"}, "dt_s": 0.01, "samples": 100,
        "epicentral_distance_km": 12.0, "checks": {"proved": [], "assumed": []},
    }  # fmt: skip
    text = views.record_summary(FakeTab, finished_job(tmp_path, {"record": record, "results": []}))
    assert "epicentral distance 12 km, 2016-04-16 01:25:05 JST" in text


def test_object_result_shows_the_probability_of_the_object(tmp_path):
    """The object falls under either horizontal: more often than under the worse one alone, which was shown."""
    base = {"interval": [0.1, 0.2], "runs": 200, "moved_probability": 0.5, "models": [], "least_factor": None, "greatest_factor": None,
            "predictable_until_s": None, "class": "may overturn"}  # fmt: skip
    rows = [{"assessment": {**base, "overturning_probability": p, "direction": d}} for p, d in ((0.145, "NS"), (0.155, "EW"))]
    document = {"parameters": {}, "results": rows, "object": {**base, "overturning_probability": 0.175, "direction": "EW"}}
    text = views.object_result(FakeTab, finished_job(tmp_path, document, line=("respond", "a.csv", "--block", "statue")))
    assert 'data-value="0.175">17.5' in text and "worst direction EW" in text and "rigid block" not in text
    job = finished_job(tmp_path, {**document, "parameters": {"block": {"stone_count": 2}}}, line=("respond", "a.csv", "--block", "statue"))
    assert "2 stones as one rigid block, object: may overturn" in views.object_result(FakeTab, job)
    assert "seisblock respond a.csv --block statue" in text


def test_survey_without_bounds_and_collection_show_their_documents_in_japanese(tmp_path):
    tab = FakeTab()
    stone = {"id": "<b>", "width_m": 0.24, "height_m": 0.72, "probability": 0.82, "overturns": True, "observed": False, "agrees": False}
    estimate = {
        "fallen": 1, "standing": 3, "pga_m_s2": None, "pga_interval_m_s2": [None, 4.0], "pgv_m_s": None, "pgv_interval_m_s": [None, 0.5],
        "jma_intensity": None, "jma_classes": [None, "5-"], "jma_class_by_rule": None, "each_stone": [stone],
        "contingency": {"both": 0, "computed_only": 1, "observed_only": 0, "neither": 0},
    }  # fmt: skip
    # as JMA reports it, and `infer`: rounded to two decimals, truncated to one (was 6.1)
    assert "6.0 (" in views.survey_result(
        tab, finished_job(tmp_path, {"results": [{**estimate, "jma_intensity": 6.08, "jma_classes": ["6-", "6+"]}]}, line=("infer",))
    )
    risk = {"body": "vase", "class": "may overturn", "overturning_probability": 0.3, "interval": [0.2, 0.4], "moved_probability": 0.5,
            "failure": None, "advice": ["Keep people, exits and fragile objects 1.8 m away until then."]}  # fmt: skip
    with use_locale("ja"):
        survey = views.survey_result(tab, finished_job(tmp_path, {"results": [estimate]}, line=("infer", "--cemetery", "a.csv")))
        job = finished_job(tmp_path, {"results": [risk]}, line=("scenario", "--jma", "6+"))
        job.outputs = {"--csv": "table.csv"}
        (tmp_path / "table.csv").write_text("\ufeffadvice,reason\n1.8 m 離してください。,\n", encoding="utf-8")
        collection = views.collection_result(tab, job)
    assert "25 %（4 基中 1 基）".replace(" ", "\N{NO-BREAK SPACE}", 1) in survey and "&lt;b&gt;" in survey
    assert "1.8" in collection and "Keep people" not in collection and 'data-testid="secure-0"' in collection


@pytest.mark.parametrize(
    ("stderr", "sentence"),
    [
        ("note\nseisblock: a.csv: no numbers\n", "a.csv: no numbers"),
        ("Usage: x\n\nError: Invalid value for '--mu': 'x' is not a number\n", "Invalid value for '--mu': 'x' is not a number"),
        ("", "the computation ended without a message"),
    ],
)
def test_error_of_a_job_is_the_sentence_of_the_command(tmp_path, stderr, sentence):
    assert finished_job(tmp_path, {}, stderr).error.startswith(sentence)


def test_command_without_the_extra_says_what_to_install(monkeypatch):
    monkeypatch.setattr(command, "find_spec", lambda name: None)
    result = CliRunner().invoke(main, ["app"])
    assert result.exit_code == 3 and "pip install 'seisblock[app]'" in result.output


def test_bind_listens_on_this_computer_only_and_names_a_used_port():
    with socket.socket() as listener:
        listener.bind((server.HOST, 0))
        listener.listen()
        port = listener.getsockname()[1]
        with pytest.raises(ParameterError, match=f"port {port} is in use"):
            server.bind(port)
    with server.bind(None) as free:
        assert free.getsockname()[0] == server.HOST


def test_workbook_holds_numbers_and_texts_of_the_table_and_no_formula(tmp_path):
    """The names 007, 1e3 and 1_0 of an inventory are no numbers, the apostrophe of the CSV is gone, and so are control characters."""
    names = ["=1+1", "墓石", "007", "1e3", "1_0", "'=像", "a\x0bb", "12", "nan"]
    write_table(tmp_path / "table.csv", ["body", "share"], [[name, 0.25 if name == "=1+1" else ""] for name in names], bom=True)
    convert_csv(tmp_path / "table.csv", tmp_path / "table.xlsx")
    sheet = load_workbook(tmp_path / "table.xlsx").active
    values = [[cell.value for cell in row] for row in sheet.rows]
    expected = ["=1+1", "墓石", "007", "1e3", "1_0", "'=像", "ab", 12, "nan"]
    assert values == [["body", "share"], ["=1+1", 0.25], *([name, None] for name in expected[1:])]
    assert sheet["A2"].data_type == "s"


def test_workbook_that_cannot_be_written_is_one_error(tmp_path, monkeypatch):
    """In a folder without permission, errors of lxml followed the sentence on the terminal."""
    ignored = []
    monkeypatch.setattr(sys, "unraisablehook", ignored.append)
    with pytest.raises(OutputError):
        write_workbook(tmp_path / "missing" / "table.xlsx", ["body", "share"], [["a", 0.25], ["b", None]])
    gc.collect()
    assert ignored == []


@pytest.mark.slow
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 0), (signal.SIGTERM, 143), (signal.SIGHUP, 0)])
def test_uploads_are_in_a_private_temporary_folder_that_is_gone_at_the_end(tmp_path, number, code):
    line = [sys.executable, "-m", "seisblock", "app", "--no-browser", "--lang", "en"]
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    # as from a terminal: below nohup the signal of a closed one is ignored
    default = functools.partial(signal.signal, number, signal.default_int_handler if number is signal.SIGINT else signal.SIG_DFL)
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True, env=environment, preexec_fn=default) as process:
        address = next(word for text in process.stderr for word in text.split() if word.startswith("http"))
        with httpx.Client(base_url=address, timeout=60.0) as remote:
            tab = tab_address(remote)
            remote.post(f"{tab}/record", data={"source": "upload"}, files={"upload": ("../note.csv", b"1,2\n" * 10)}).raise_for_status()
        (upload,) = tmp_path.glob("seisblock-app-*/*/files/*")
        assert upload.name == "note.csv" and upload.parents[2].stat().st_mode & 0o077 == 0
        process.send_signal(number)
        try:
            assert process.wait(30) == code
        finally:
            process.kill()
    assert list(tmp_path.glob("seisblock-app-*")) == []


def upload(client, address, kind, *files, **fields):
    """Post files of a form without a worker; return the response."""
    names = {"record": "upload", "event": "archive"}
    return client.post(f"{address}/{kind}", data=fields, files=[(names.get(kind, "sheet"), file) for file in files])


@pytest.fixture
def lines(monkeypatch):
    """Command lines that the page would run."""
    started = []

    def start(self, slots):
        started.append(self.arguments)
        self.state = JobState.DONE

    monkeypatch.setattr(Job, "start", start)
    return started


def test_file_of_one_tab_does_not_replace_a_file_of_the_same_name_of_another(client, tmp_path, lines):
    address = tab_address(client)
    sheet = b"height (cm),width (cm),fallen\n72,24,1\n60,30,0\n"
    upload(client, address, "record", ("data.csv", b"1"), source="upload")
    upload(client, address, "survey", ("DATA.csv", sheet))
    upload(client, address, "collection", ("object.csv", b"3"))
    assert [line[-1] for line in lines] == ["data.csv", "DATA_2.csv", "object_2.csv"]
    assert {path.name for path in tmp_path.glob("*/files/*.csv")} == {"data.csv", "DATA_2.csv", "object_2.csv"}
    assert (next(tmp_path.glob("*/files/data.csv"))).read_bytes() == b"1"


def test_record_named_like_the_folder_of_the_event_leaves_room_for_it(client, lines):
    address = tab_address(client)
    upload(client, address, "record", ("event", b"1"), source="upload")
    assert upload(client, address, "event", ("a.tar", b"2"), **{"event-object": "gravestone"}).status_code == 200
    assert [line[1] for line in lines] == ["event_2", "event"]


def test_components_of_a_station_that_are_dropped_one_after_another_are_one_record(client, lines):
    address = tab_address(client)
    for name in ("AOM0081604160125.NS", "AOM0081604160125.EW", "AOM0091604160125.NS"):
        upload(client, address, "record", (name, sample_path(f"synthetic_knet.{name[-2:]}").read_bytes()), source="upload")
    assert lines == [
        ("measure", "AOM0081604160125.NS"),
        ("measure", "AOM0081604160125.NS", "AOM0081604160125.EW"),
        ("measure", "AOM0091604160125.NS"),
    ]


def test_unit_of_a_record_is_given_with_its_files_or_afterwards(client, lines):
    address = tab_address(client)
    upload(client, address, "record", ("a.csv", b"1"), source="upload", units="gal")
    client.post(address + "/record", data={"source": "options", "units": "g", "station": "", "dt": "0.02"})
    assert lines == [("measure", "a.csv", "--units", "gal"), ("measure", "a.csv", "--units", "g", "--dt", "0.02")]
    client.post(address + "/record", data={"source": "motion", "motion": "pulse:300gal@1.5Hz"})
    assert client.post(address + "/record", data={"source": "options", "units": "gal"}).status_code == 204


def test_rejected_motion_keeps_the_files_of_the_record(client, tmp_path, lines):
    address = tab_address(client)
    upload(client, address, "record", ("data.csv", b"1"), source="upload")
    client.post(address + "/record", data={"source": "motion", "motion": "nonsense"})
    assert len(list(tmp_path.glob("*/files/data.csv"))) == 1


def test_long_japanese_name_is_shortened_to_what_file_systems_take(client, lines):
    response = upload(client, tab_address(client), "record", ("記" * 110 + ".csv", b"1"), source="upload")
    assert response.status_code == 200 and len(lines[0][1].encode()) <= uploads.MAX_NAME_BYTES and lines[0][1].endswith("記.csv")


def test_error_of_a_sheet_names_the_file_without_the_temporary_folder(client, tmp_path, lines):
    """The error of an empty sheet began with the path of the folder of uploads."""
    text = upload(client, tab_address(client), "survey", ("墓石.csv", b"")).text
    assert 'data-testid="error"' in text and "墓石.csv" in text and str(tmp_path) not in text


def test_survey_under_the_record_of_the_first_tab_requires_one(client, lines):
    address = tab_address(client)
    client.post(address + "/record", data={"source": "intensity", "intensity": "6+"})
    response = upload(client, address, "survey", ("s.csv", b"height (cm),width (cm)\n72,24\n"), under="record")
    assert "no record in the first tab" in response.text and lines == []


def test_too_many_files_are_an_error_of_the_page(client):
    response = upload(client, tab_address(client), "record", *[(f"{n}.txt", b"") for n in range(uploads.MAX_FILES + 1)], source="upload")
    assert response.status_code == 400 and 'data-testid="error"' in response.text and response.headers["hx-retarget"] == "#error"


def test_page_that_is_loaded_again_has_its_record_object_and_results(client, lines):
    address = tab_address(client)
    client.post(address + "/record", data={"source": "motion", "motion": "ｓｉｎｅ：300gal@1.5Hz,10s"})
    client.post(address + "/object", data={"object": "sizes:block", "width": "３３", "height": "99", "mu": "0.7", "floor": "0.5"})
    assert lines[-1] == (
        "respond", "sine:300gal@1.5Hz,10s", "--width", "33cm", "--height", "99cm", "--mu", "0.7", "--floor", "T=0.5,height=0.5",
    )  # fmt: skip
    text = client.get(address + "/").text
    assert 'value="sine:300gal@1.5Hz,10s"' in text and 'value="33"' in text and 'value="0.5"' in text
    assert f"{address}/jobs/record/1" in text and f"{address}/jobs/object/1" in text
    # the other language computes again, because figures and tables have texts
    text = client.get(address + "/", params={"lang": "ja"}).text
    assert '<html lang="ja">' in text and f"{address}/jobs/object/2" in text and lines[-1] == lines[1]


def test_scan_of_an_object_becomes_a_body_first(client, monkeypatch):
    started = []
    monkeypatch.setattr(Job, "start", lambda self, slots: started.append(self))
    data = {"object": "file", "mu": "0.6", "scan-unit": "mm", "scan-up": "y"}
    client.post(tab_address(client) + "/object", data=data, files=[("body-file", ("岩.stl", b"solid"))])
    assert started[0].command.splitlines() == [
        "seisblock body '岩.stl' --unit mm --up y --out '岩.toml'",
        "seisblock respond --block '岩.toml' --mu 0.6",
    ]


def test_slider_of_the_floor_shows_its_number_as_text(client):
    response = client.get(tab_address(client) + "/floor", params={"floor": "<b>0.5"})
    assert response.text == "&lt;b&gt;0.5"

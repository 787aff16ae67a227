"""The local page in a headless Chromium."""

import functools
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from openpyxl import Workbook
from PIL import Image

from seisblock.samples import sample_path
from tests.bodies.meshes import box, write_stl

BROWSER = next((path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None)
DRIVER = shutil.which("chromedriver")

pytest.importorskip("selenium")

from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

pytestmark = [
    pytest.mark.browser,
    pytest.mark.slow,
    pytest.mark.skipif(not (BROWSER and DRIVER), reason="needs Chromium and chromedriver of the system"),
]

WAIT_S = 300.0
"""Time that an element may take, s; the first run compiles kernels."""

SEISBLOCK = [sys.executable, "-m", "tests.app.brief_server"]
"""The program, which takes few records and runs of a scenario."""

SET = [str(sample_path(f"synthetic_knet.{component}")) for component in ("NS", "EW", "UD")]


@pytest.fixture(scope="module")
def address():
    """Address of a running `seisblock app`."""
    line = [*SEISBLOCK, "app", "--no-browser", "--lang", "en"]
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True) as process:
        yield next(word for text in process.stderr for word in text.split() if word.startswith("http"))
        process.terminate()


@pytest.fixture(scope="module")
def browser():
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,1000"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER)) as driver:
        yield driver


def find(browser, name):
    """Return an element by its test id as soon as it is there."""
    end = time.monotonic() + WAIT_S
    while time.monotonic() < end:
        if elements := browser.find_elements("css selector", f"[data-testid={name}]"):
            return elements[0]
        time.sleep(0.1)
    raise AssertionError(f"no element {name}: {browser.find_element('css selector', 'body').text}")


def wait_until_gone(browser, name):
    """Return as soon as there is no element of this test id."""
    end = time.monotonic() + 10.0
    while browser.find_elements("css selector", f"[data-testid={name}]") and time.monotonic() < end:
        time.sleep(0.1)


def fill(browser, **values):
    for name, value in values.items():
        element = find(browser, f"{name}-input")
        element.clear()
        element.send_keys(value)


@functools.cache
def run_command(*arguments):
    """Return the document of a command, run once."""
    result = subprocess.run([*SEISBLOCK, *arguments, "--json"], capture_output=True, text=True, check=True)
    return json.loads(result.stdout)


@pytest.mark.parametrize("language", ["en", "ja"])
def test_object_under_a_set_of_files_has_the_probability_of_the_command(browser, address, language):
    browser.get(f"{address}?lang={language}")
    find(browser, "record-input").send_keys("\n".join(SET))
    assert "SYN001" in find(browser, "record-summary").text
    fill(browser, width="45", height="180", mu="0.3")
    find(browser, "run").click()
    output = find(browser, "probability")
    document = run_command("respond", SET[0], "--width", "45cm", "--height", "180cm", "--mu", "0.3")
    expected = document["object"]["overturning_probability"]
    assert float(output.get_attribute("data-value")) == expected
    assert output.text.replace("\N{NO-BREAK SPACE}", " ") == f"{100 * expected:g} %"
    assert find(browser, "figure").get_property("naturalWidth") > 500
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
    # another record removes the result of this one
    find(browser, "record-input").send_keys(SET[0])
    wait_until_gone(browser, "probability")
    assert not browser.find_elements("css selector", "[data-testid=probability]")
    assert find(browser, "run").is_enabled()


def test_files_dropped_on_the_text_of_a_box_are_taken(browser, address):
    browser.get(address)
    box = browser.find_element("css selector", ".panel-object .drop span").rect
    data = {"items": [], "files": SET, "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        place = {"x": box["x"] + 0.5 * box["width"], "y": box["y"] + box["height"] - 8}
        browser.execute_cdp_cmd("Input.dispatchDragEvent", {"type": kind, "data": data, **place})
    assert "synthetic_knet.UD" in find(browser, "record-summary").text
    assert len(browser.window_handles) == 1


def test_reload_way_back_and_other_language_keep_record_object_and_result(browser, address):
    browser.get(address)
    Select(find(browser, "sample-select")).select_by_value("synthetic_knet.EW")
    find(browser, "record-summary")
    fill(browser, width="33", height="99", mu="0.7")
    find(browser, "run").click()
    probability = find(browser, "probability").text
    browser.refresh()
    assert find(browser, "probability").text == probability and "SYN001" in find(browser, "record-summary").text
    browser.find_element("css selector", ".languages a:not([aria-current])").click()
    wait_until_gone(browser, "probability")
    assert find(browser, "probability").text == probability and "転倒" in find(browser, "verdict").text
    browser.get("about:blank")
    browser.back()
    assert find(browser, "probability").text == probability
    assert find(browser, "width-input").get_attribute("value") == "33"
    assert find(browser, "sample-select").get_attribute("value") == "synthetic_knet.EW"


def test_wrong_file_gives_the_sentence_of_the_program_and_the_next_file_replaces_it(browser, address, tmp_path):
    path = Path(tmp_path, "notes.csv")
    path.write_text("no numbers here\n")
    browser.get(address)
    find(browser, "record-input").send_keys(str(path))
    text = find(browser, "error").text
    assert "notes.csv" in text and "Traceback" not in text
    find(browser, "record-input").send_keys(SET[0])
    assert "SYN001" in find(browser, "record-summary").text


def test_cancel_ends_a_run_and_another_one_can_start(browser, address):
    browser.get(address)
    fill(browser, width="45", height="180", mu="0.3")
    find(browser, "run").click()
    find(browser, "progress")
    find(browser, "cancel").click()
    wait_until_gone(browser, "progress")
    assert not browser.find_elements("css selector", "[data-testid=progress], [data-testid=probability]")
    assert find(browser, "run").is_enabled() and not find(browser, "cancel").is_enabled()
    find(browser, "run").click()
    find(browser, "probability")


def test_two_tabs_do_not_disturb_each_other(browser, address):
    first = browser.current_window_handle
    browser.get(address)
    fill(browser, width="30", height="240", mu="0.5")
    find(browser, "run").click()
    browser.switch_to.new_window("tab")
    browser.get(address)
    fill(browser, width="200", height="100", mu="0.5")
    find(browser, "run").click()
    stocky = float(find(browser, "probability").get_attribute("data-value"))
    browser.close()
    browser.switch_to.window(first)
    assert float(find(browser, "probability").get_attribute("data-value")) > 0.9 and stocky == 0.0


def test_record_of_100_s_shows_progress_is_cancelled_and_computed_again(browser, address):
    browser.get(address)
    element = find(browser, "motion-input")
    element.send_keys("sine:300gal@1.5Hz,100s\t")
    assert "100" in find(browser, "record-summary").text
    fill(browser, width="60", height="60", mu="0.3")
    find(browser, "run").click()
    assert find(browser, "progress").is_displayed()
    find(browser, "cancel").click()
    wait_until_gone(browser, "progress")
    find(browser, "run").click()
    assert find(browser, "verdict").text


def test_file_of_200_mb_is_refused_and_the_page_stays(browser, address, tmp_path):
    path = tmp_path / "large.csv"
    with path.open("wb") as stream:
        stream.truncate(200_000_000)
    browser.get(address)
    find(browser, "record-input").send_keys(str(path))
    assert "200 MB" in find(browser, "error").text
    find(browser, "record-input").send_keys(SET[0])
    assert "SYN001" in find(browser, "record-summary").text
    assert not browser.find_elements("css selector", "[data-testid=error]")


def test_sheet_of_gravestones_is_computed_as_soon_as_it_is_dropped(browser, address, tmp_path):
    path = tmp_path / "<img src=x onerror=document.title='hit'>.csv"
    path.write_text("番号,高さ(cm),幅(cm),転倒\n<script>document.title='hit'</script>,72,24,1\nB,60,30,0\nC,80,25,1\n", encoding="utf-8")
    browser.get(f"{address}?lang=ja")
    find(browser, "tab-survey").click()
    find(browser, "survey-input").send_keys(str(path))
    assert "67" in find(browser, "survey-result").text
    rows = find(browser, "survey-table").text.splitlines()
    assert rows[1].startswith("<script>") and len(rows) == 4
    assert browser.title == "seisblock"


def test_list_of_objects_is_computed_as_soon_as_it_is_dropped(browser, address, tmp_path):
    path = tmp_path / "objects.csv"
    path.write_text("name,width (cm),depth (cm),height (cm),kind\nvase,15,15,40,statue\nchest,100,60,40,furniture\n")
    browser.get(address)
    find(browser, "tab-collection").click()
    find(browser, "collection-input").send_keys(str(path))
    rows = find(browser, "collection-table").text.splitlines()
    results = run_command("scenario", "--jma", "6+", "--bodies", str(path))["results"]
    assert [row.split()[0] for row in rows[1:]] == [result["body"] for result in results]
    assert rows[1].startswith("vase likely overturns")


def test_collection_from_a_workbook_goes_on_after_a_bad_row_and_finds_measures_in_japanese(browser, address, tmp_path):
    path = tmp_path / "list.xlsx"
    book = Workbook()
    for row in (["収蔵品台帳"], ["名称", "幅(cm)", "高さ(cm)", "場所"], ["壺", 15, 60, "第1室"], ["像", "不明", 90, "第2室"]):
        book.active.append(row)
    book.save(path)
    browser.get(f"{address}?lang=ja")
    find(browser, "tab-collection").click()
    find(browser, "collection-input").send_keys(str(path))
    rows = find(browser, "collection-table").text.splitlines()
    assert rows[1].startswith("壺") and any("4 行目" in row for row in rows)
    find(browser, "secure-0").click()
    text = find(browser, "secure-result").text
    assert text.startswith("壺") and "固定具" in text and "目標に届かず" in text and "not reached" not in text


@pytest.mark.parametrize("kind", ["archive", "folder"])
def test_stations_of_an_archive_or_a_folder_are_mapped(browser, address, kind, tmp_path):
    browser.get(address)
    find(browser, "tab-event").click()
    if kind == "archive":
        find(browser, "event-input").send_keys(str(sample_path("synthetic_knet.knt.tar.gz")))
    else:
        for path in SET:
            shutil.copy(path, tmp_path)
        find(browser, "event-folder-input").send_keys(str(tmp_path))
    assert "1 station" in find(browser, "event-result").text


def test_object_from_a_file_and_its_scan_is_computed(browser, address, tmp_path):
    scan = write_stl(tmp_path / "slab.stl", *box(0.3, 0.4, 0.9))
    subprocess.run([sys.executable, "-m", "seisblock", "body", scan, "--out", tmp_path / "slab.toml"], check=True)
    browser.get(address)
    find(browser, "motion-input").send_keys("pulse:500gal@1.5Hz\t")
    find(browser, "record-summary")
    Select(find(browser, "object-select")).select_by_value("file")
    find(browser, "body-input").send_keys(f"{tmp_path / 'slab.toml'}\n{scan}")
    fill(browser, mu="0.6")
    find(browser, "run").click()
    assert find(browser, "probability").get_attribute("data-value")
    assert "slab" in browser.find_element("css selector", "body").text


def test_names_in_headers_and_files_run_no_script(browser, address, tmp_path):
    script = "<img/src=x/onerror=document.title=1>"
    path = tmp_path / f"it's {Path(SET[0]).name}"
    path.write_bytes(Path(SET[0]).read_bytes().replace(b"SYN001", script.encode()))
    browser.get(address)
    find(browser, "record-input").send_keys(str(path))
    assert script in find(browser, "record-summary").text
    fill(browser, width="45", height="180", mu="0.3")
    find(browser, "run").click()
    find(browser, "probability")
    assert browser.title == "seisblock" and not browser.find_elements("css selector", "img[src=x]")


def test_keyboard_reaches_tabs_and_fields_in_order_with_a_visible_focus(browser, address):
    browser.get(address)
    focused = []
    for _ in range(40):
        ActionChains(browser).send_keys(Keys.TAB).perform()  # a file input would take it for a path
        element = browser.switch_to.active_element
        marked = browser.execute_script(
            "const e = document.activeElement, l = e.matches('.hidden-input') ? e.nextElementSibling : e;"
            "return getComputedStyle(l).outlineStyle",
        )
        assert marked != "none", element.get_attribute("outerHTML")[:200]
        focused.append(element.get_attribute("data-testid") or element.get_attribute("id"))
        if focused[-1] == "run":
            break
    order = ["show-object", "record-input", "sample-select", "object-select", "width-input", "height-input", "mu-input", "run"]
    assert [name for name in focused if name in order] == order
    # arrow keys change the tab
    browser.execute_script("document.getElementById('show-object').focus()")
    browser.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
    assert find(browser, "survey-input").is_displayed() and not find(browser, "record-input").is_displayed()


@pytest.mark.parametrize("width", [390, 768, 1920])
def test_page_fits_its_window(browser, address, width):
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    )
    try:
        browser.get(address)
        for tab in ("object", "survey", "collection", "event"):
            find(browser, f"tab-{tab}").click()
            assert browser.execute_script("return document.documentElement.scrollWidth") <= width
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_figure_of_two_directions_scrolls_on_a_phone_at_the_size_of_one(browser, address):
    """A figure of 2560 pixels was shrunk to 364, its letters to 3 pixels."""
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 900, "deviceScaleFactor": 2, "mobile": True})
    try:
        browser.get(address)
        Select(find(browser, "sample-select")).select_by_value("synthetic_knet.EW")
        find(browser, "record-summary")
        fill(browser, width="45", height="180", mu="0.3")
        find(browser, "run").click()
        figure = find(browser, "figure")
        browser.execute_async_script("arguments[0].decode().then(arguments[1])", figure)
        shown = browser.execute_script("return arguments[0].closest('figure').scrollWidth", figure)
        assert figure.get_property("naturalWidth") == 2560 and 2 * 340 < shown < 2 * 390
        assert browser.execute_script("return document.documentElement.scrollWidth") <= 390
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_screenshots_of_the_guide_are_small_and_drawn_by_their_script(tmp_path):
    script = Path(__file__).parents[2] / "docs" / "figures" / "app.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True)
    for name in ("app_en.png", "app_ja.png"):
        guide = script.parents[1] / "_static" / name
        with Image.open(guide) as shown, Image.open(tmp_path / name) as drawn:
            assert guide.stat().st_size < 150_000 and shown.width == drawn.width
            assert abs(shown.height - drawn.height) < 0.1 * shown.height

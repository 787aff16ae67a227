"""Screenshots of ``seisblock app`` for the pages on it: ``python docs/figures/app.py`` (Chromium, chromedriver, Selenium)."""

from __future__ import annotations

import base64
import io
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from PIL import Image

from seisblock.samples import sample_path

TARGET = Path(__file__).parents[1] / "_static"
WIDTH = 900
COLOURS = 64
WAIT_S = 300.0
FIELDS = {"width-input": "45", "height-input": "180", "mu-input": "0.3"}


def find(browser: Any, name: str) -> Any:
    """Return an element by its test id as soon as it is there."""
    end = time.monotonic() + WAIT_S
    while time.monotonic() < end:
        if elements := browser.find_elements("css selector", f"[data-testid={name}]"):
            return elements[0]
        time.sleep(0.1)
    raise RuntimeError(f"no element {name}")


def screenshot(browser: Any, address: str, language: str, path: Path) -> None:
    """Compute one object under a record of three files and save the page."""
    browser.get(f"{address}?lang={language}")
    find(browser, "record-input").send_keys("\n".join(str(sample_path(f"synthetic_knet.{code}")) for code in ("NS", "EW", "UD")))
    find(browser, "record-summary")
    for name, value in FIELDS.items():
        find(browser, name).send_keys(value)
    find(browser, "run").click()
    end = time.monotonic() + WAIT_S
    while not find(browser, "figure").get_property("complete") and time.monotonic() < end:
        time.sleep(0.1)
    size = browser.execute_cdp_cmd("Page.getLayoutMetrics", {})["cssContentSize"]
    clip = {"x": 0, "y": 0, "width": WIDTH, "height": size["height"], "scale": 1}
    data = browser.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})["data"]
    image = Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")
    image.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(path, optimize=True)


def main(target: Path = TARGET) -> None:
    """Save a screenshot in each language."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = next(path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name)))
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"):
        options.add_argument(argument)
    service = webdriver.ChromeService(shutil.which("chromedriver"))
    line = [sys.executable, "-m", "seisblock", "app", "--no-browser", "--lang", "en"]
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True) as server, webdriver.Chrome(options=options, service=service) as browser:
        assert server.stderr is not None
        address = next(word for text in server.stderr for word in text.split() if word.startswith("http"))
        metrics = {"width": WIDTH, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        try:
            for language in ("en", "ja"):
                screenshot(browser, address, language, target / f"app_{language}.png")
        finally:
            server.terminate()


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))

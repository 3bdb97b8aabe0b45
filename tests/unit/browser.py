# SPDX-License-Identifier: GPL-2.0-or-later
"""A headless Chromium for tests of pages, with WebGL in software; skips where something is missing."""
import io
import json
import os
import shutil
import time
from contextlib import contextmanager

import matplotlib.image
import pytest

FLAGS = ("--headless=new", "--no-sandbox", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-quic", "--hide-scrollbars", "--use-gl=angle",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing")


@contextmanager
def chromium(folder):
    """A selenium driver with its scratch files in a folder."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="selenium is missing (package python3-selenium)")
    from selenium.webdriver.chrome.service import Service

    browser, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not browser or not driver:
        pytest.skip("Chromium or its driver is missing (packages chromium, chromium-driver)")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    opened = webdriver.Chrome(service=Service(driver, env={**os.environ, "TMPDIR": str(folder)}), options=options)
    try:
        yield opened
    finally:
        opened.quit()


def resize(driver, width, height, phone=False):
    """Set the size of the page in pixels; phone: with touch and the layout of phones."""
    metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)


def wait(condition, seconds=60):
    """Wait until a condition holds; fails when it does not."""
    end = time.monotonic() + seconds
    while not (value := condition()):
        assert time.monotonic() < end, f"not within {seconds} s"
        time.sleep(0.05)
    return value


def picture(driver):
    """Screenshot (rows, columns, 3) in 0..1."""
    return matplotlib.image.imread(io.BytesIO(driver.get_screenshot_as_png()))[..., :3]


def errors(driver):
    """Error lines of the console; reading empties it."""
    return [json.dumps(line) for line in driver.get_log("browser") if line["level"] == "SEVERE"]

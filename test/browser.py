"""A real browser without a window for tests of pages, or the reason why there is none."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
DRIVER = shutil.which("chromedriver")
QUIET = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-dev-shm-usage", "--hide-scrollbars",
)  # fmt: skip


def why_no_browser() -> str:
    """Return what is missing for a test with a browser; empty when nothing is."""
    if BROWSER is None or DRIVER is None:
        return "no chromium with chromedriver (Debian: apt install chromium chromium-driver)"
    if find_spec("selenium") is None:
        return "selenium is not installed (pip install selenium)"
    return ""


@contextmanager
def browser(width: int, height: int = 900, *, offline: bool = True) -> Iterator:
    """Yield a driver of a browser whose page is ``width`` pixels wide, without the network.

    A page that is served by this machine needs ``offline=False``.
    """
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for argument in (*QUIET, f"--window-size={max(width, 600)},{height}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    try:
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500}
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        driver.execute_cdp_cmd("Network.enable", {})
        speed = 0 if offline else -1  # -1: as fast as it goes
        network = {
            "offline": offline,
            "latency": 0,
            "downloadThroughput": speed,
            "uploadThroughput": speed,
        }
        driver.execute_cdp_cmd("Network.emulateNetworkConditions", network)
        yield driver
    finally:
        driver.quit()

"""The live page in a real browser: drawn, said, as wide as a telephone, and back after a break."""

import math

import pytest
from browser import browser, why_no_browser

from dualfoot_ros.core import FEET
from dualfoot_ros.nodes.page.live_state import HEIGHT, PERSON, LiveState
from dualfoot_ros.nodes.page.page_document import live_page
from dualfoot_ros.nodes.page.page_server import PageServer
from dualfoot_ros.nodes.page.trail import Place

pytestmark = pytest.mark.skipif(bool(why_no_browser()), reason=why_no_browser())
DESK, PHONE = 1100, 390
CONNECTION = "Failed to load resource"  # what the browser itself says of a server that is gone


def walking():
    """Return the state of a walk on a circle, up a floor."""
    state = LiveState()
    for k in range(200):
        angle = 0.02 * k
        at = Place(0.5 * k, 8 * math.cos(angle), 8 * math.sin(angle), 0.015 * k)
        state.add((PERSON, HEIGHT), at)
        state.add((FEET[k % 2],), at)
    here = {"t": 99.5, "x": at.x, "y": at.y, "z": at.z, "heading": 318.0}
    std = {"major": 0.21, "minor": 0.1, "angle": 20.0, "height_std": 0.11, "heading_std": 2.4}
    foot = {"state": "tracking", "rate": 100.0, "received": 9900, "lost": 100, "battery": 62.0}
    state.show(
        person={**here, "speed": 1.23, **std},
        left=here,
        right=None,
        feet={"left": foot, "right": {**foot, "state": "STALE", "battery": None}},
        warnings=[{"node": "fusion", "text": "DEGRADED: the right foot is STALE"}],
        silent=None,
        phase="walking",
        method="idc",
        trust={
            "text": "position within 0.5 m (95 %), within 3 m for 80 m or 65 s more",
            "trusted": True,
            "radius": 0.5,
            "limit": 3.0,
            "way_left": 80.0,
            "time_left": 65.0,
            "heading_known": True,
        },
        step={"foot": "left", "length": 0.7, "width": 0.12, "duration": 0.5, "height": 0.0},
        filter={"pairs": 100.0, "nis": 0.9},
    )
    return state


@pytest.fixture(scope="module")
def server():
    made = PageServer("127.0.0.1", 0, walking(), live_page())
    yield made
    made.close()


def shown(driver, condition, said):
    """Wait until the page shows something."""
    from selenium.webdriver.support.ui import WebDriverWait

    WebDriverWait(driver, 120).until(lambda _: condition(), said)


def text(driver, selector):
    return driver.find_element("css selector", selector).text


def errors(driver):
    logged = [entry["message"] for entry in driver.get_log("browser")]
    return [message for message in logged if CONNECTION not in message]


@pytest.mark.parametrize("width", [DESK, PHONE])
def test_the_walk_is_drawn_and_said_and_no_wider_than_the_screen(server, width):
    with browser(width, offline=False) as driver:
        driver.get(server.url)
        shown(driver, lambda: text(driver, "#link") == "walking", "a walk")
        drawn = {
            f.get_attribute("data-plot"): int(f.get_attribute("data-drawn"))
            for f in driver.find_elements("css selector", "figure.plot")
        }
        assert drawn["map"] > 200 and drawn["height"] > 100
        assert text(driver, "#walked") == "31.8 m"
        assert text(driver, "#speed") == "1.2 m/s"
        assert text(driver, "#trusted") == "80 m, 1:05"
        assert text(driver, "#heading") == "318° ± 2.4°"
        assert "tracking 100 Hz 100 (1.0 %) 62 %" in " ".join(text(driver, "tr#left").split())
        assert "STALE" in text(driver, "tr#right")
        assert "the right foot is STALE" in text(driver, "#words .warning")
        assert "120 steps a minute" in text(driver, "#step")
        wide = driver.execute_script("return document.documentElement.scrollWidth")
        assert wide <= width
        loaded = "return performance.getEntriesByType('resource').map((e) => e.name)"
        assert all(name.startswith(server.url) for name in driver.execute_script(loaded))
        assert errors(driver) == []


def test_a_part_that_a_person_looks_at_stays_in_view_while_the_walk_goes_on(server):
    with browser(DESK, offline=False) as driver:
        driver.get(server.url)
        shown(driver, lambda: text(driver, "#link") == "walking", "a walk")
        figure = driver.find_element("css selector", "figure.plot[data-plot=map]")

        def view():
            return figure.get_attribute("data-view")

        def drawn():
            return int(driver.execute_script("return document.documentElement.dataset.shown"))

        whole = view()
        button = figure.find_element("css selector", ".tools button")
        driver.execute_script("arguments[0].click()", button)
        near, then = view(), drawn()
        assert near != whole
        shown(driver, lambda: drawn() > then + 2, "further messages")
        assert view() == near
        assert errors(driver) == []


def test_the_page_says_that_the_program_has_ended_and_goes_on_when_it_is_back():
    first = PageServer("127.0.0.1", 0, walking(), live_page())
    port = first.server_address[1]
    with browser(PHONE, offline=False) as driver:
        driver.get(first.url)
        shown(driver, lambda: text(driver, "#link") == "walking", "a walk")
        first.close()
        shown(driver, lambda: text(driver, "#link") == "not connected", "the end")
        assert "does not answer" in text(driver, "#words")
        state = LiveState()
        state.show(silent="topic '/odometry' has no publisher; start fusion", warnings=[])
        again = PageServer("127.0.0.1", port, state, live_page())
        try:
            shown(driver, lambda: text(driver, "#link") == "nothing arrives", "the way back")
            assert "Nothing arrives: topic '/odometry' has no publisher" in text(driver, "#words")
            assert "m" not in text(driver, "#walked")
        finally:
            again.close()
        assert errors(driver) == []

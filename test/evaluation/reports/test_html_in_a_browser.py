"""``report.html`` in a real browser: no error, every plot drawn, linked, and printed."""

import base64
from dataclasses import replace

import numpy as np
import pytest
from browser import browser, why_no_browser

from dualfoot_ros.evaluation import evaluate
from dualfoot_ros.evaluation.exports import GeoOrigin
from dualfoot_ros.evaluation.reports.html import write_comparison_page, write_walk_page

from ..walks import perfect, rectangle
from .entries import entries_of, rows_of

pytestmark = pytest.mark.skipif(bool(why_no_browser()), reason=why_no_browser())
DESK, PHONE = 1100, 390


BAND_OUTSIDE = """
const figure = document.querySelector("[data-plot='0.map']");
const shown = figure.querySelector("clipPath rect"), bands = figure.querySelectorAll("ellipse");
const low = Number(shown.getAttribute("y")), high = low + Number(shown.getAttribute("height"));
return Array.from(bands, (each) => [Number(each.getAttribute("cy")),
  Number(each.getAttribute("rx"))]).filter(([y, r]) => y - r < low || y + r > high).length;
"""


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    """Return the path of the report of a walk with truth."""
    track, truth = perfect(rectangle())
    rng = np.random.default_rng(3)
    track.left.position[:] += np.cumsum(
        rng.normal(scale=0.004, size=track.left.position.shape), axis=0
    )
    wide = np.diag([1.0, 1.0, 0.0])  # a band that is wider than the margin
    left, right = (
        replace(foot, position_covariance=foot.position_covariance + wide)
        for foot in (track.left, track.right)
    )
    track = replace(track, left=left, right=right)
    run = evaluate(track, truth=truth)
    folder = tmp_path_factory.mktemp("report")
    return write_walk_page(folder, {"zupt": run}, "a walk", origin=GeoOrigin(48.0, 11.0, 30.0))


def errors(driver):
    return [entry["message"] for entry in driver.get_log("browser")]


def plots(driver):
    return driver.find_elements("css selector", "figure.plot")


@pytest.mark.parametrize("width", [DESK, PHONE])
def test_every_plot_is_drawn_without_an_error_and_the_page_is_no_wider_than_the_screen(
    report, width
):
    with browser(width) as driver:
        driver.get(report.as_uri())
        drawn = {
            f.get_attribute("data-plot"): f.get_attribute("data-drawn") for f in plots(driver)
        }
        assert len(drawn) == 8
        assert all(int(count) > 0 for count in drawn.values()), drawn
        assert errors(driver) == []
        wide = driver.execute_script("return document.documentElement.scrollWidth")
        assert wide <= width
        assert len(driver.find_elements("css selector", "svg .north")) == 1
        outside = driver.execute_script(BAND_OUTSIDE)
        assert outside == 0
        loaded = driver.execute_script("return performance.getEntriesByType('resource').length")
        assert loaded == 0


def test_pointing_at_one_plot_marks_the_same_moment_in_all_of_them(report):
    from selenium.webdriver import ActionChains

    with browser(DESK) as driver:
        driver.get(report.as_uri())
        height = driver.find_element("css selector", "[data-plot='0.height_time'] svg")
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", height)
        ActionChains(driver).move_to_element_with_offset(height, 40, 0).perform()
        rows = {f.get_attribute("data-cursor") for f in plots(driver)}
        assert len(rows) == 1 and None not in rows
        told = driver.find_element("css selector", "[data-plot='0.map'] .readout").text
        assert "time (s)" in told and "walked (m)" in told
        assert errors(driver) == []


def test_zoom_and_drag_change_what_is_shown_and_a_double_click_shows_everything(report):
    from selenium.webdriver import ActionChains

    def view(name):
        own = driver.find_element("css selector", f"[data-plot='0.{name}']")
        return [float(v) for v in own.get_attribute("data-view").split()]

    with browser(DESK) as driver:
        driver.get(report.as_uri())
        before, other = view("map"), view("apart")
        figure = driver.find_element("css selector", "[data-plot='0.map']")
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", figure)
        figure.find_element("css selector", ".tools button").click()
        near = view("map")
        assert near[1] - near[0] == pytest.approx((before[1] - before[0]) / 2, rel=0.01)
        svg = figure.find_element("css selector", "svg")
        ActionChains(driver).drag_and_drop_by_offset(svg, 60, 30).perform()
        moved = view("map")
        assert moved[0] < near[0] and moved[2] > near[2]
        assert moved[1] - moved[0] == pytest.approx(near[1] - near[0], rel=0.01)
        svg = figure.find_element("css selector", "svg")
        ActionChains(driver).double_click(svg).perform()
        assert view("map") == before
        time = driver.find_element("css selector", "[data-plot='0.height_time'] .tools button")
        driver.execute_script("arguments[0].click()", time)
        assert view("apart")[:2] == view("height_time")[:2] != other[:2]
        assert errors(driver) == []


def test_a_name_in_the_legend_hides_its_line(report):
    with browser(DESK) as driver:
        driver.get(report.as_uri())
        figure = driver.find_element("css selector", "[data-plot='0.map']")
        before = int(figure.get_attribute("data-drawn"))
        driver.execute_script(
            "arguments[0].click()", figure.find_element("css selector", ".legend button")
        )
        assert int(figure.get_attribute("data-drawn")) < before


def test_the_page_prints_to_pdf_with_several_pages(report):
    with browser(DESK) as driver:
        driver.get(report.as_uri())
        printed = base64.b64decode(driver.print_page())
        assert printed.startswith(b"%PDF")
        assert printed.count(b"/Type /Page\n") + printed.count(b"/Type/Page\n") >= 2
        assert errors(driver) == []


def test_a_comparison_draws_every_track_of_every_recording(tmp_path):
    entries = entries_of()
    path = write_comparison_page(tmp_path, entries, rows_of(entries), {"far": "no samples"})
    with browser(PHONE) as driver:
        driver.get(path.as_uri())
        assert [f.get_attribute("data-plot") for f in plots(driver)] == ["map0", "map1"]
        assert all(int(f.get_attribute("data-drawn")) > 0 for f in plots(driver))
        assert "no samples" in driver.find_element("tag name", "body").text
        assert errors(driver) == []

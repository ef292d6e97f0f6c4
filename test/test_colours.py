"""The feet have the same two colours in every picture: reports, live page, RViz, Foxglove."""

import json
import re
from pathlib import Path

import pytest
import yaml

from dualfoot_ros.evaluation.reports.plots import FOOT

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "dualfoot_ros" / "nodes" / "page"


def named_colours(text):
    """Return (foot, colour) of everything that names a foot and then a colour in one rule."""
    return re.findall(r"(left|right)[^{}#,]*[:{][^#}]{0,20}(#[0-9a-fA-F]{6})", text)


@pytest.mark.parametrize("name", ["live.js", "live.css"])
def test_the_live_page_has_the_colours_of_the_reports(name):
    found = named_colours((PAGE / name).read_text(encoding="utf-8"))
    assert {foot for foot, _ in found} == set(FOOT)
    assert all(colour.upper() == FOOT[foot] for foot, colour in found)


def test_the_paths_in_rviz_have_the_colours_of_the_reports():
    shown = yaml.safe_load((ROOT / "config/rviz/dualfoot.rviz").read_text(encoding="utf-8"))
    displays = {each["Name"]: each for each in shown["Visualization Manager"]["Displays"]}
    for foot, colour in FOOT.items():
        numbers = map(int, displays[f"Path of the {foot} foot"]["Color"].split(";"))
        assert "#{:02X}{:02X}{:02X}".format(*numbers) == colour


def test_the_markers_for_rviz_have_the_colours_of_the_reports():
    markers = pytest.importorskip("dualfoot_ros.nodes.results.rviz_markers")
    for foot, parts in markers.COLOURS.items():
        assert "#{:02X}{:02X}{:02X}".format(*(round(255 * part) for part in parts)) == FOOT[foot]


def test_foxglove_shows_topics_of_a_foot_in_the_colours_of_the_reports():
    layout = json.loads((ROOT / "config/foxglove/dualfoot.json").read_text(encoding="utf-8"))
    lines = [
        line
        for panel in layout["configById"].values()
        for line in panel.get("paths", [])
        if isinstance(line, dict) and re.match(r"/?(left|right)/", line.get("value", ""))
    ]
    assert lines
    for line in lines:
        assert line["color"].upper() == FOOT[re.search("left|right", line["value"])[0]]

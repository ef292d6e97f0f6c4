"""The live page: one self-contained HTML document, which asks its own server for the numbers."""

from __future__ import annotations

from importlib.resources import files

from ...core import FEET
from ...evaluation.reports.html import asset, document, figure, section

POLICY = (
    "default-src 'none'; connect-src 'self'; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; img-src data:"
)
TITLE = "dualfoot live"
TILES = {
    "walked": "walked",
    "time": "time",
    "height": "height since the start",
    "speed": "speed",
    "radius": "position within (95 %)",
    "trusted": "to be trusted for",
    "std": "&sigma; of position and height",
    "heading": "heading, and its &sigma;",
}
FEET_HEADER = ("foot", "state", "rate", "lost", "battery")


def live_page() -> str:
    """Return the page."""
    body = [
        '<header class="live"><h1>' + TITLE + "</h1>"
        '<p id="link" class="pill wait" role="status">connecting</p></header>',
        '<ul class="words" id="words"></ul>',
        '<div class="tiles">' + "".join(map(_tile, TILES)) + "</div>",
        section("Feet", _feet_table()),
        section("Track", figure("map"), figure("height")),
        '<p class="soft">Drag to move, the buttons, Ctrl + wheel or two fingers to zoom; a '
        "double-click shows the whole walk again. The page only reads.</p>",
        '<p class="soft" id="about"></p>',
    ]
    scripts = [asset("charts.js"), _own("live.js")]
    return document(TITLE, body, scripts, style=_own("live.css"), policy=POLICY)


def _own(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _tile(name: str) -> str:
    return f'<div class="tile"><b id="{name}">&ndash;</b><span>{TILES[name]}</span></div>'


def _feet_table() -> str:
    head = "".join(f"<th>{name}</th>" for name in FEET_HEADER)
    rows = "".join(
        f'<tr id="{foot}"><td>{foot}</td><td><span class="pill wait">&ndash;</span></td>'
        "<td>&ndash;</td><td>&ndash;</td><td>&ndash;</td></tr>"
        for foot in FEET
    )
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
    return f'<div class="wide">{table}</div><p class="soft" id="step"></p>'

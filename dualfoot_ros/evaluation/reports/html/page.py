"""One self-contained HTML page: no network, no other file, opens from a USB stick.

The plots are drawn by a script of our own (``charts.js``, about 20 kB).  A plotting library in
the file would be 200 times as large (plotly: 4 MB), and none draws confidence ellipses or strips
of stances without the same amount of code around it.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.resources import files
from typing import Any

from ...plain import plain
from .words import Sentence, Tone

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
"""Nothing may be loaded: a page that needed the network would show it at once."""

HOW_TO_MOVE = (
    "Plots: drag to move, the buttons, Ctrl + wheel or two fingers to zoom, double-click for "
    "everything; names in the legends hide a line."
)


def page(title: str, about: str, body: Iterable[str], data: Mapping[str, Any]) -> str:
    """Return a whole page; ``body`` is HTML, ``data`` has the tables and charts of its plots."""
    return document(
        title,
        [
            f'<header><h1>{escape(title)}</h1><p class="soft">{escape(about)}</p></header>',
            *body,
            f'<p class="soft no-print">{HOW_TO_MOVE}</p>',
            f'<script type="application/json" id="data">{script_data(data)}</script>',
        ],
        [asset("charts.js"), asset("report.js")],
    )


def document(
    title: str,
    body: Iterable[str],
    scripts: Iterable[str],
    *,
    style: str = "",
    policy: str = POLICY,
) -> str:
    """Return a page of HTML parts, with the style of all pages and ``style``, and ``scripts``."""
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            "<head>",
            '<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
            '<link rel="icon" href="data:,">',
            f"<title>{escape(title)}</title>",
            f"<style>\n{asset('report.css')}{style}</style>",
            "</head>",
            "<body>",
            *body,
            *(f"<script>\n{script}</script>" for script in scripts),
            "</body>",
            "</html>",
            "",
        ]
    )


def asset(name: str) -> str:
    """Return the text of a file beside this module."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def script_data(data: Mapping[str, Any]) -> str:
    """Return JSON that cannot end the script element that it stands in."""
    text = json.dumps(plain(data), allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def section(title: str, *parts: str) -> str:
    """Return a section with a heading."""
    return f"<section>\n<h2>{escape(title)}</h2>\n" + "\n".join(parts) + "\n</section>"


def words(sentences: Sequence[Sentence]) -> str:
    """Return sentences as a list; warnings and good news stand out."""
    items = (
        f"<li>{escape(s.text)}</li>"
        if s.tone is Tone.PLAIN
        else f'<li class="{s.tone.value}">{escape(s.text)}</li>'
        for s in sentences
    )
    return '<ul class="words">\n' + "\n".join(items) + "\n</ul>"


def tiles(figures: Mapping[str, str]) -> str:
    """Return the main figures as tiles: name -> value."""
    made = (
        f'<div class="tile"><b>{escape(value)}</b><span>{escape(name)}</span></div>'
        for name, value in figures.items()
    )
    return '<div class="tiles">' + "".join(made) + "</div>"


def figure(name: str) -> str:
    """Return the place of the plot ``name``."""
    return f'<figure class="plot" data-plot="{escape(name)}"></figure>'


def html_table(
    header: Sequence[str], parts: Iterable[Iterable[Sequence[str]]], *, text_columns: int = 1
) -> str:
    """Return a table; ``parts`` are groups of rows with a line between them."""
    rows: list[str] = []
    for part in parts:
        for number, row in enumerate(part):
            style = ' class="part"' if number == 0 and rows else ""
            rows.append(f"<tr{style}>{_cells('td', row, text_columns)}</tr>")
    head = f"<thead><tr>{_cells('th', header, text_columns)}</tr></thead>"
    body = "<tbody>" + "\n".join(rows) + "</tbody>"
    return f'<div class="wide"><table>{head}{body}</table></div>'


def _cells(tag: str, row: Sequence[str], text_columns: int) -> str:
    return "".join(
        f"<{tag}{' class=text' if k < text_columns else ''}>{_breakable(cell)}</{tag}>"
        for k, cell in enumerate(row)
    )


def _breakable(cell: str) -> str:
    """Return a cell that a narrow screen may break within a name."""
    return escape(str(cell)).replace("_", "_<wbr>")


def folded(title: str, content: str) -> str:
    """Return content that opens with a click."""
    return f"<details><summary>{escape(title)}</summary>\n{content}\n</details>"

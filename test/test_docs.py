"""The documentation: lines, links, and what the pages name exists."""

import argparse
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from dualfoot_ros.cli.main import VERBS, main, parser_of
from dualfoot_ros.core import GROUPS, METHODS, TrackerConfig, all_specs
from dualfoot_ros.settings import node_parameter_names, preset_names

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
KINDS = ("tutorials", "how_to", "reference", "explanation")
PAGES = sorted(DOCS.rglob("*.md"))
TOP = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "bags" / "README.md"]
ALL = [*PAGES, *TOP]
COLUMNS = 99
TWO_SCREENS = 80  # lines
SUFFIXES = "py|md|yaml|rst|toml|c|h"
# Files that a reader is told to write, or gets.
OWN_FILES = {
    *(
        "mine.yaml",
        "both.yaml",
        "gait.yaml",
        "noise.yaml",
        "pivot.yaml",
        "markers.yaml",
        "reference.yaml",
    ),
    *("L.yaml", "R.yaml", "pyproject.toml", "height_method.py"),
}
HIDDEN = (".git", ".venv")
NAMES = {path.name for path in ROOT.rglob("*") if path.relative_to(ROOT).parts[0] not in HIDDEN}

pages = pytest.mark.parametrize("page", ALL, ids=lambda page: str(page.relative_to(ROOT)))


def text_of(page: Path) -> str:
    """Return the text of a page."""
    return page.read_text(encoding="utf-8")


def fences(page: Path, language: str = r"\w*") -> list[str]:
    """Return the fenced blocks of a page in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", text_of(page), re.M | re.S)


def links(page: Path) -> Iterator[tuple[str, str]]:
    """Yield file and anchor of every relative link of a page."""
    for target in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
        if "://" not in target:
            file, _, anchor = target.partition("#")
            yield file, anchor


def anchors(page: Path) -> set[str]:
    """Return the anchors of the headings of a page, as GitHub makes them."""
    titles = re.findall(r"^#+ (.*)$", text_of(page), re.M)
    plain = (re.sub(r"[^\w\- ]", "", title.lower()) for title in titles)
    return {title.replace(" ", "-") for title in plain}


def named_files(page: Path) -> set[str]:
    """Return everything in a page that looks like the path of a file of the project."""
    text = re.sub(r"\w+://\S+|\{[^}]*\}", " ", text_of(page))
    found = set(re.findall(rf"(?<![\w*/.-])[\w./-]+\.(?:{SUFFIXES})\b(?!\w)", text))
    return {name for name in found if not name.startswith("dualfoot_ros.")}


def exists(name: str, page: Path) -> bool:
    """Return whether a named file is there: from the root, the package or the page."""
    if "/" not in name:
        return name in NAMES or name in OWN_FILES
    rooms = re.findall(r"relative to `(dualfoot_ros/\w+/)`", text_of(page))
    folders = [ROOT, ROOT / "dualfoot_ros", page.parent, *(ROOT / room for room in rooms)]
    return any((folder / name).exists() for folder in folders)


def options_of(parser: argparse.ArgumentParser) -> set[str]:
    """Return the long options of a parser and of its subcommands."""
    found: set[str] = set()
    for action in parser._actions:
        found |= {option for option in action.option_strings if option.startswith("--")}
        if isinstance(action, argparse._SubParsersAction):
            for inner in action.choices.values():
                found |= options_of(inner)
    return found - {"--help"}


def commands(page: Path) -> Iterator[tuple[str, str]]:
    """Yield verb and arguments of every ``dualfoot`` command in the blocks of a page."""
    for block in fences(page):
        for line in block.replace("\\\n", " ").splitlines():
            match = re.match(r"(?:\$ )?dualfoot (\w+)(.*)", line)
            if match:
                yield match[1], match[2].partition(" # ")[0]


@pages
def test_lines_are_short_but_in_tables_and_urls(page):
    long = [
        number
        for number, line in enumerate(text_of(page).splitlines(), start=1)
        if len(line) > COLUMNS and not line.startswith("|") and "://" not in line
    ]
    assert long == []


@pages
def test_every_relative_link_leads_to_a_file_and_a_heading(page):
    for file, anchor in links(page):
        target = (page.parent / file).resolve() if file else page
        assert target.exists(), file
        assert not anchor or anchor in anchors(target), f"{file}#{anchor}"


@pages
def test_every_file_that_is_named_exists(page):
    assert [name for name in sorted(named_files(page)) if not exists(name, page)] == []


def test_every_page_is_of_one_kind_and_in_the_index():
    linked = {(DOCS / file).resolve() for file, _ in links(DOCS / "README.md")}
    others = [page for page in PAGES if page != DOCS / "README.md"]
    assert {page.parent.name for page in others} == set(KINDS)
    assert [str(page) for page in others if page not in linked] == []


def test_the_readme_shows_what_it_is_before_its_first_table():
    lines = text_of(ROOT / "README.md").splitlines()
    first = next(number for number, line in enumerate(lines) if line.startswith("|"))
    before = "\n".join(lines[:first])
    assert first <= TWO_SCREENS
    assert "make demo" in before and "dualfoot evaluate" in before and "![" in before


@pages
def test_python_blocks_compile_and_import_names_that_exist(page):
    for block in fences(page, "python"):
        compile(block, str(page), "exec")
        for module, names in re.findall(r"^from (dualfoot_ros[\w.]*) import (.+)$", block, re.M):
            for name in names.split(","):
                assert hasattr(import_module(module), name.strip()), f"{module}.{name}"


@pages
def test_commands_use_verbs_and_options_that_exist(page):
    for verb, arguments in commands(page):
        if verb == "VERB":
            continue
        assert verb in VERBS, verb
        known = {*options_of(parser_of(verb)), "--help"}
        used = set(re.findall(r"(?<!\S)--[\w-]+", arguments))
        assert used <= known, f"{verb}: {used - known}"


@pytest.mark.parametrize("verb", VERBS)
def test_the_command_line_page_has_every_option_of_every_verb_and_no_other(verb):
    text = text_of(DOCS / "reference" / "command_line.md")
    (section,) = re.findall(rf"^## {verb}\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    shown = set(re.findall(r"--[a-z][\w-]*", re.sub(r"\(as of `\w+`\)", "", section)))
    shown |= {"--output"} if "`-o`" in section or "-o " in section else set()
    assert shown == options_of(parser_of(verb))


PERSON_FILES = ("tum", "csv", "geojson", "kml", "gpx", "position", "radius_95_m")


@pages
def test_parameters_that_are_named_exist(page):
    specs = {spec.name for spec in all_specs()} | node_parameter_names()
    groups = {*GROUPS, *METHODS, *(name.partition(".")[0] for name in specs if "." in name)}
    named = re.findall(r"(?<![\w./-])([a-z]\w+)\.([a-z]\w*)(?![\w.(/*])", text_of(page))
    suffixes = set(SUFFIXES.split("|"))
    wrong = [
        f"{group}.{key}"
        for group, key in named
        if group in groups and key not in suffixes and f"{group}.{key}" not in specs
        if not (group == "person" and key in PERSON_FILES)
    ]
    assert wrong == []


def test_the_readme_gives_the_defaults_that_are_declared():
    table = text_of(ROOT / "README.md").partition("| parameter | default |")[2].split("\n\n")[0]
    rows = re.findall(r"^\| `([\w.]+)` \| `?([\w.]+)", table, re.M)
    defaults = TrackerConfig().to_mapping()
    assert len(rows) >= 6
    for name, shown in rows:
        default = defaults[name]
        number = isinstance(default, int | float)
        assert (float(shown) if number else shown) == default, name


def test_every_method_and_preset_has_its_row():
    text = text_of(DOCS / "reference" / "methods.md")
    rows = "\n".join(re.findall(r"^\|.*$", text, re.M))
    missing = [name for name in (*METHODS.own, *preset_names()) if f"`{name}`" not in rows]
    assert missing == ["default"]  # which is no system of a paper


def test_the_example_of_a_method_runs_as_its_page_says(tmp_path):
    page = DOCS / "how_to" / "add_a_method.md"
    (module,), (project,) = fences(page, "python"), fences(page, "toml")
    (tmp_path / "height_method.py").write_text(module)
    info = tmp_path / "height_method-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: height_method\nVersion: 1.0\n")
    (point,) = re.findall(r'^(same_height) = "(.*)"$', project, re.M)
    assert '"dualfoot_ros.methods"' in project
    (info / "entry_points.txt").write_text(f"[dualfoot_ros.methods]\n{' = '.join(point)}\n")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), str(ROOT)])}
    walk = ["--route", "L", "--standing", "4", "--rate", "60", "--seed", "1"]
    assert main(["simulate", "-o", str(tmp_path / "walk"), *walk]) == 0
    evaluated = next(line for verb, line in commands(page) if verb == "evaluate").split()
    done = subprocess.run(
        [sys.executable, "-m", "dualfoot_ros", "evaluate", *evaluated],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "method same_height" in done.stdout

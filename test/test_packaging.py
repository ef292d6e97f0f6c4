"""The package as others install it: with colcon, with pip, on a stock ROS 2 and without one."""

import ast
import os
import re
import shutil
import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from unittest.mock import patch
from xml.etree import ElementTree

import pytest
import yaml

import dualfoot_ros

ROOT = Path(__file__).resolve().parents[1]
EXECUTABLES = {"bringup", "fusion", "imu_adapter", "live_page", "replay", "time_sync"}


@pytest.fixture(scope="module")
def setup_arguments():
    """Return what setup.py hands to setuptools."""
    pytest.importorskip("setuptools")
    with patch("setuptools.setup") as setup:
        before = Path.cwd()
        os.chdir(ROOT)
        try:
            exec(compile((ROOT / "setup.py").read_text(), "setup.py", "exec"), {})
        finally:
            os.chdir(before)
    return setup.call_args.kwargs


@pytest.fixture(scope="module")
def manifest():
    """Return the root of package.xml."""
    return ElementTree.parse(ROOT / "package.xml").getroot()


def test_version_and_licence_agree_everywhere(setup_arguments, manifest):
    version = manifest.findtext("version")
    assert setup_arguments["version"] == version == dualfoot_ros.__version__
    assert manifest.findtext("license") == setup_arguments["license"] == "Apache-2.0"
    assert "Apache License" in (ROOT / "LICENSE").read_text()


def changes():
    """Return (title, underline, entries) of each release of the changelog, the newest first."""
    lines = (ROOT / "CHANGELOG.rst").read_text(encoding="utf-8").splitlines()
    starts = [n - 1 for n, line in enumerate(lines) if re.fullmatch(r"-{3,}", line)]
    ends = [*starts[1:], len(lines)]
    return [(lines[a], lines[a + 1], lines[a + 2 : b]) for a, b in zip(starts, ends, strict=True)]


def test_the_changelog_has_the_form_of_rep_132_and_begins_with_this_version(manifest):
    version = manifest.findtext("version")
    releases = changes()
    forms = [re.fullmatch(r"(\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)", r[0]) for r in releases]
    assert all(forms)
    numbers = [tuple(map(int, form[1].split("."))) for form in forms]
    assert numbers == sorted(set(numbers), reverse=True)
    assert forms[0][1] == version
    dates = [form[2] for form in forms]
    assert dates == sorted(dates, reverse=True)
    for title, underline, entries in releases:
        assert len(underline) == len(title)
        assert [line for line in entries if line and not re.match(r"\* \S|  +\S", line)] == []
    title = (ROOT / "CHANGELOG.rst").read_text(encoding="utf-8").splitlines()[1]
    assert title == "Changelog for package dualfoot_ros"


def test_manifest_is_format_3_and_ament_python(manifest):
    assert manifest.get("format") == "3"
    assert manifest.findtext("export/build_type") == "ament_python"


def test_only_the_extra_ros_pulls_the_wheels(setup_arguments):
    required = [*setup_arguments["install_requires"]]
    for name, extra in setup_arguments["extras_require"].items():
        required += extra if name != "ros" else []
    assert not [each for each in required if each.startswith("ros-") or "rclpy" in each]
    assert "ros-jazzy-rclpy[fastrtps]" in setup_arguments["extras_require"]["ros"]


def test_colcon_test_finds_pytest(setup_arguments):
    assert "pytest" in setup_arguments["extras_require"]["test"]


ROS_PACKAGES = {"rclpy", "std_srvs", "launch", "launch_ros", "ament_index_python"}
KEYS = {"serial": "python3-serial", "yaml": "python3-yaml"}
OPTIONAL = {"bleak", "distributed"}  # of extras; a sentence says so where one is missing
BAGS = {"rosbags", "rosbag2_py"}  # one of them: the first from pip, the second with ROS
DISTRIBUTIONS = {"serial": "pyserial", "yaml": "PyYAML"}


@cache
def imported(pattern):
    """Return the outermost names of everything that files import from outside."""
    names = set()
    for path in ROOT.glob(pattern):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                names.add(node.module.partition(".")[0])
    return names - set(sys.stdlib_module_names) - {"dualfoot_ros"}


def is_ros(name):
    return name.endswith(("_msgs", "_interfaces")) or name in ROS_PACKAGES


def test_every_import_is_declared_for_ros(manifest):
    declared = {each.text for each in manifest.iter("exec_depend")}
    names = (imported("dualfoot_ros/**/*.py") | imported("launch/*.py")) - OPTIONAL
    others = names - BAGS
    wanted = {name if is_ros(name) else KEYS.get(name, f"python3-{name}") for name in others}
    wanted |= {"rosbag2_py", "rosbag2_storage_mcap"}
    assert wanted <= declared
    assert declared <= wanted | {"rcl_interfaces"}


def test_the_page_on_installing_names_every_package_of_the_manifest(manifest):
    page = (ROOT / "docs" / "how_to" / "install.md").read_text(encoding="utf-8")
    needed = {d.text for d in manifest.iter("exec_depend") if d.text.startswith("python3-")}
    lists = re.findall(r"sudo apt install ((?:.*\\\n)*.*)", page)
    complete = [words for text in lists if needed <= (words := set(text.split()))]
    assert len(complete) == 2  # with ROS, and with packages of Debian only


def test_no_package_of_the_manifest_comes_from_pip(manifest):
    assert [d.text for d in manifest.iter() if (d.text or "").endswith("-pip")] == []


def test_every_import_outside_of_ros_is_declared_for_pip(setup_arguments):
    required = {re.split(r"[<>=\[]", each)[0] for each in setup_arguments["install_requires"]}
    names = {name for name in imported("dualfoot_ros/**/*.py") if not is_ros(name)} - OPTIONAL
    names -= {"rosbag2_py"}
    assert {DISTRIBUTIONS.get(name, name) for name in names} == required


def test_the_citation_names_this_version(manifest):

    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == manifest.findtext("version")
    assert f"{citation['version']} ({citation['date-released']})" == changes()[0][0]
    assert citation["license"] == manifest.findtext("license")
    papers = (ROOT / "docs" / "reference" / "notation.md").read_text(encoding="utf-8")
    assert all(f"doi {paper['doi']}" in papers for paper in citation["references"])


def test_every_page_of_the_documentation_is_in_the_site():

    nav = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))["nav"]
    listed = set(re.findall(r"[\w/]+\.md", str(nav)))
    pages = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")}
    assert listed == pages


def test_every_console_script_is_a_function_that_exists(setup_arguments):
    pytest.importorskip("rclpy")
    scripts = dict(re.split(r" = ", each) for each in scripts_of(setup_arguments))
    assert EXECUTABLES | {"dualfoot"} == set(scripts)
    for target in scripts.values():
        module, _, name = target.partition(":")
        assert callable(getattr(import_module(module), name))


def scripts_of(setup_arguments):
    return setup_arguments["entry_points"]["console_scripts"]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Install a copy as colcon does, and return the prefix."""
    pytest.importorskip("setuptools")
    source = tmp_path_factory.mktemp("source") / "dualfoot_ros"
    ignored = shutil.ignore_patterns(".*", "__pycache__", "build", "install", "log", "*.egg-info")
    shutil.copytree(ROOT, source, ignore=ignored)
    prefix = tmp_path_factory.mktemp("prefix")
    record = ["--single-version-externally-managed", "--record", str(prefix / "record.txt")]
    done = subprocess.run(
        [sys.executable, "setup.py", "install", "--prefix", str(prefix), *record],
        cwd=source,
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return prefix


def test_installed_executables_are_where_ros2_run_looks(installed):
    found = {path.name for path in (installed / "lib" / "dualfoot_ros").iterdir()}
    assert found >= EXECUTABLES
    assert not (installed / "bin").exists()


def test_installed_share_has_marker_manifest_presets_and_launch_file(installed):
    share = installed / "share"
    assert (share / "ament_index/resource_index/packages/dualfoot_ros").is_file()
    assert (share / "dualfoot_ros/package.xml").is_file()
    for folder in ("config", "config/nodes", "config/rviz", "config/foxglove", "launch"):
        names = {path.name for path in (ROOT / folder).iterdir() if path.is_file()}
        assert {
            p.name for p in (share / "dualfoot_ros" / folder).iterdir() if p.is_file()
        } == names


def run_installed(installed, *command, **variables):
    (site,) = installed.rglob("site-packages")
    env = {**os.environ, "PYTHONPATH": str(site), **variables}
    return subprocess.run(
        command, cwd=installed, env=env, check=False, capture_output=True, text=True
    )


def test_an_installed_executable_runs(installed):
    pytest.importorskip("rclpy")
    done = run_installed(installed, str(installed / "lib/dualfoot_ros/fusion"), "--help")
    assert done.returncode == 0, done.stderr
    assert "left|right/odometry" in done.stdout


def test_the_installed_pages_have_their_scripts_and_styles_without_ros(installed):
    names = "from dualfoot_ros.nodes.page.page_document import live_page"
    code = f"import sys; {names}; print('EventSource' in live_page(), 'rclpy' in sys.modules)"
    done = run_installed(installed, sys.executable, "-c", code)
    assert done.stdout.split() == ["True", "False"], done.stderr


@pytest.mark.parametrize("prefix", ["", "share of nothing", "here"])
def test_presets_are_found_with_and_without_the_ament_index(installed, prefix):
    ament = {"AMENT_PREFIX_PATH": str(installed) if prefix == "here" else prefix}
    names = "from dualfoot_ros.settings.presets import *"
    code = f"{names}; print(preset_names(), find_config('liu2023'))"
    done = run_installed(installed, sys.executable, "-c", code, **ament)
    assert done.returncode == 0, done.stderr
    assert "'default'" in done.stdout and "liu2023.yaml" in done.stdout
    assert str(installed) in done.stdout
    assert ("/share/" in done.stdout) == (prefix == "here")


def test_make_names_its_targets_without_an_environment():
    make = shutil.which("make")
    if make is None:
        pytest.skip("make is not installed")
    done = subprocess.run([make, "-C", str(ROOT)], check=False, capture_output=True, text=True)
    assert done.returncode == 0
    for target in ("demo", "test", "bags", "docs", "dist", "clean"):
        assert f"make {target} " in done.stdout


def test_a_python_that_does_not_fit_is_refused_in_a_sentence(tmp_path):
    script = ROOT / "scripts" / "make_venv"
    env = {**os.environ, "PYTHON": "/no/such/python"}
    done = subprocess.run(
        [script, tmp_path / "venv"], env=env, check=False, capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "PYTHON=/no/such/python is not a Python 3.11 or 3.12" in done.stderr
    assert not (tmp_path / "venv").exists()


def test_a_python_without_venv_names_the_package_to_install(tmp_path):
    fake = tmp_path / "python3.12"
    fake.write_text(
        "#!/bin/sh\n"
        'case "$2" in\n'
        "*ensurepip*) exit 1 ;;\n"
        f"*executable*) echo {fake} ;;\n"
        "*%d.%d*) echo 3.12 ;;\n"
        "esac\n"
    )
    fake.chmod(0o755)
    env = {**os.environ, "PYTHON": str(fake)}
    script = ROOT / "scripts" / "make_venv"
    done = subprocess.run(
        [script, tmp_path / "venv"], env=env, check=False, capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "apt install python3.12-venv" in done.stderr


def run_get_browser(folder, *programs):
    """Run scripts/get_browser where there are only these programs; each only says its name."""
    for name in programs:
        path = folder / name
        path.write_text(f"#!/bin/sh\necho {name} $*\n")
        path.chmod(0o755)
    return subprocess.run(
        ["/bin/sh", ROOT / "scripts" / "get_browser"],
        env={"PATH": str(folder)},
        check=False,
        capture_output=True,
        text=True,
    )


def test_a_browser_that_is_there_is_not_installed_again(tmp_path):
    done = run_get_browser(tmp_path, "chromium", "chromedriver", "apt-get")
    assert (done.returncode, done.stdout) == (0, "")


def test_where_no_browser_can_be_installed_a_sentence_says_what_to_do(tmp_path):
    done = run_get_browser(tmp_path, "chromium")
    assert done.returncode == 1
    assert "install chromium and chromedriver" in done.stderr
    done = run_get_browser(tmp_path, "apt-get", "id")  # whose answer is no number of root
    assert done.returncode == 1
    assert "only root can install" in done.stderr

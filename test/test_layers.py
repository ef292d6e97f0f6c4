"""The layers of the package, by walking its imports: data only flows downwards."""

import ast
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "dualfoot_ros"
MODULES = sorted(PACKAGE.rglob("*.py"))
TOP = "modules at the top of the package"
BELOW = {
    "core": set(),
    "timing": {"core"},
    "drivers": {"core", "timing"},
    "settings": {"core", "timing", "drivers"},
    "recording": {"core", "timing", "settings"},
    "simulation": {"core", "timing", "settings"},
    "inspection": {"core", "timing", "settings", "recording"},
    "evaluation": {"core", "timing", "settings", "recording", "simulation", "inspection"},
    "calibration": {"core", "timing", "settings", "recording", "inspection", "evaluation"},
    TOP: set(),
}
ALL = {"nodes", "cli"}
ROS = {
    "action_msgs",
    "ament_index_python",
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "launch",
    "launch_ros",
    "nav_msgs",
    "rcl_interfaces",
    "rclpy",
    "rosgraph_msgs",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "tf2_msgs",
    "tf2_ros",
}
HEAVY = {"bleak", "matplotlib", "numba", "rosbags", "serial", *ROS}
CLOCK_OR_LOG = {"datetime", "logging", "time"}
FILES = {"io", "os", "pathlib", "shutil", "socket", "subprocess", "tempfile"}
COMPILER = {"engine.py", "__main__.py"}  # of core/kernel: where compiled code is kept
# The ament index tells where an installed package keeps its presets; it is no part of rclpy.
PRESETS = {("presets.py", "ament_index_python")}


def imported(path: Path, *, top_level_only: bool = False) -> Iterator[str]:
    """Yield the absolute name of everything ``path`` imports."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    here = ["dualfoot_ros", *path.relative_to(PACKAGE).with_suffix("").parts]
    nodes: Iterable[ast.AST] = at_import_time(tree) if top_level_only else ast.walk(tree)
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = here[: -node.level] if node.level else []
            name = ".".join([*base, *([node.module] if node.module else [])])
            yield name
            yield from (f"{name}.{alias.name}" for alias in node.names)


def at_import_time(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements that run when the module is imported: none inside of functions."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
            continue
        yield child
        yield from at_import_time(child)


def root(name: str) -> str:
    """Return the outermost package of ``name``."""
    return name.split(".")[0]


def layer(path: Path) -> str:
    """Return the folder of the package that ``path`` is in."""
    parts = path.relative_to(PACKAGE).parts
    return parts[0] if len(parts) > 1 else TOP


def target(name: str) -> str | None:
    """Return the layer that the imported ``name`` belongs to; None outside of the package."""
    parts = name.split(".")
    if parts[0] != "dualfoot_ros" or len(parts) < 2:
        return None
    if (PACKAGE / parts[1]).is_dir():
        return parts[1]
    return TOP if (PACKAGE / f"{parts[1]}.py").exists() else None


def breaches(modules: Iterable[Path], forbidden: Callable[[Path, str], bool], **how) -> list[str]:
    """Return "module imports name" for every import that is ``forbidden``."""
    return [
        f"{path.relative_to(PACKAGE)} imports {name}"
        for path in modules
        for name in imported(path, **how)
        if forbidden(path, name)
    ]


def calls(path: Path) -> set[str]:
    """Return the names of the plain functions that are called anywhere in ``path``."""
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    found = (node.func for node in nodes if isinstance(node, ast.Call))
    return {function.id for function in found if isinstance(function, ast.Name)}


def test_every_folder_of_the_package_has_its_place_among_the_layers():
    assert {layer(path) for path in MODULES} <= BELOW.keys() | ALL


def test_a_module_imports_only_from_the_layers_below():
    def forbidden(path: Path, name: str) -> bool:
        here, there = layer(path), target(name)
        return there not in (None, here) and there not in BELOW[here]

    lower = [p for p in MODULES if layer(p) not in ALL and p.name != "__main__.py"]
    assert breaches(lower, forbidden) == []


def test_only_the_nodes_import_ros():
    def forbidden(path: Path, name: str) -> bool:
        return root(name) in ROS and (path.name, root(name)) not in PRESETS

    assert breaches([p for p in MODULES if layer(p) != "nodes"], forbidden) == []


def test_the_core_reads_no_clock_and_logs_nothing():
    core = [p for p in MODULES if layer(p) == "core"]
    assert len(core) > 10
    assert breaches(core, lambda _, name: root(name) in CLOCK_OR_LOG) == []


def test_the_core_touches_no_file_but_to_keep_compiled_code():
    core = [p for p in MODULES if layer(p) == "core"]
    pure = [p for p in core if not (p.parent.name == "kernel" and p.name in COMPILER)]
    assert breaches(pure, lambda _, name: root(name) in FILES) == []
    assert [p for p in pure if calls(p) & {"open", "input"}] == []


def test_heavy_libraries_are_imported_where_they_are_used_and_not_before():
    modules = [p for p in MODULES if layer(p) != "nodes"]
    found = breaches(modules, lambda _, name: root(name) in HEAVY, top_level_only=True)
    assert found == []


def test_nothing_but_the_command_line_prints():
    others = [p for p in MODULES if layer(p) != "cli" and p.name != "__main__.py"]
    assert [str(p) for p in others if "print" in calls(p)] == []


def test_the_walk_sees_relative_and_absolute_imports_at_any_depth():
    seen = set(imported(PACKAGE / "recording" / "write.py"))
    assert {
        "dualfoot_ros.core.samples.series",
        "dualfoot_ros.recording.cdr",
        "rosbags.rosbag2",
    } <= seen
    early = set(imported(PACKAGE / "recording" / "write.py", top_level_only=True))
    assert "rosbags.rosbag2" not in early
    assert target("dualfoot_ros.recording.read") == "recording"
    assert target("dualfoot_ros.settings.presets") == "settings"

"""The layers of the package, by walking its imports: data only flows downwards."""

import ast
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "dualfoot_ros"
MODULES = sorted(PACKAGE.rglob("*.py"))
TOP = "modules at the top of the package"
TABLE = PACKAGE.parent / "docs" / "explanation" / "architecture.md"
NODES = "nodes"


def layers() -> dict[str, set[str]]:
    """Return the rooms and what each may import, from the table in TABLE."""
    rows = re.findall(r"^\| `(\w+)/` \|.*\| (.*) \|$", TABLE.read_text(encoding="utf-8"), re.M)
    rooms = {room for room, _ in rows}
    found = {}
    for room, allowed in rows:
        named = set(re.findall(r"`(\w+)`", allowed))
        found[room] = rooms - named if allowed.startswith("all") else named
    return found


BELOW = layers()
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
    "visualization_msgs",
}
HEAVY = {"bleak", "matplotlib", "numba", "rosbags", "scipy", "serial", *ROS}
CLOCK_OR_LOG = {"datetime", "logging", "time"}
OUTSIDE = {"io", "os", "pathlib", "shutil", "socket", "subprocess", "tempfile", "threading"}
COMPILER = "compiler"  # the room of core where compiled code is made and kept
# The ament index tells where an installed package keeps its presets; it is no part of rclpy.
PRESETS = {("presets.py", "ament_index_python")}


@cache
def parsed(path: Path) -> ast.Module:
    """Return the module in ``path`` as a tree."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def imported(path: Path, *, top_level_only: bool = False) -> tuple[str, ...]:
    """Return the absolute name of everything ``path`` imports."""
    return tuple(_imports(path, top_level_only))


def _imports(path: Path, top_level_only: bool) -> Iterator[str]:
    tree = parsed(path)
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
    return name.split(".", maxsplit=1)[0]


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
    nodes = ast.walk(parsed(path))
    found = (node.func for node in nodes if isinstance(node, ast.Call))
    return {function.id for function in found if isinstance(function, ast.Name)}


def module_name(path: Path) -> str:
    """Return the dotted name of the module at ``path``."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def by_name() -> dict[str, Path]:
    """Return the modules of the package by their dotted names."""
    return {module_name(path): path for path in MODULES}


def imported_modules(path: Path) -> set[str]:
    """Return the modules that ``path`` imports from, looking through faces."""
    modules = by_name()

    def home(name: str) -> str | None:
        """Return the module that defines ``name``, through any number of faces."""
        if name in modules:
            return name
        base, _, item = name.rpartition(".")
        if base not in modules:
            return None
        if modules[base].name == "__init__.py":
            for onward in imported(modules[base]):
                if onward.rpartition(".")[2] == item and onward != name:
                    return home(onward)
        return base

    found = {home(name) for name in imported(path)}
    faces = {name for name, p in modules.items() if p.name == "__init__.py"}
    return {name for name in found if name} - {module_name(path)} - faces


def circles(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Return the groups of modules that import each other (Tarjan's components)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    groups: list[list[str]] = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in arrows[name]:
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            at = stack.index(name)
            groups.append(stack[at:])
            del stack[at:]

    for name in arrows:
        if name not in index:
            visit(name)
    return [sorted(group) for group in groups if len(group) > 1]


def test_every_folder_of_the_package_has_its_place_among_the_layers():
    assert {layer(path) for path in MODULES} - {TOP} == set(BELOW)


def test_a_module_imports_only_from_the_layers_below():
    def forbidden(path: Path, name: str) -> bool:
        here, there = layer(path), target(name)
        return there not in (None, here, TOP) and there not in BELOW[here]

    rooms = [p for p in MODULES if layer(p) != TOP]
    assert breaches(rooms, forbidden) == []


def reached(path: Path) -> Iterator[str]:
    """Yield the modules that ``path`` imports, or imports from; a name on a face is the face's."""
    modules = by_name()
    tree = parsed(path)
    here = ["dualfoot_ros", *path.relative_to(PACKAGE).with_suffix("").parts]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = ".".join([*here[: -node.level], *([node.module] if node.module else [])])
            yield base
            shown = names_of(modules[base]) if base in modules else set()
            yield from (f"{base}.{a.name}" for a in node.names if a.name not in shown)


@cache
def names_of(face: Path) -> set[str]:
    """Return the names that a face lists in ``__all__``."""
    for node in parsed(face).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return set(ast.literal_eval(node.value))
    return set()


def test_another_room_is_used_through_its_face():
    faces = {module_name(p) for p in MODULES if p.name == "__init__.py"}
    modules = {module_name(p) for p in MODULES} - faces
    found = [
        f"{path.relative_to(PACKAGE)} imports {name}"
        for path in MODULES
        for name in reached(path)
        if layer(path) != TOP and target(name) not in (None, layer(path), TOP) and name in modules
    ]
    assert found == []


def test_a_function_on_a_face_is_not_taken_for_the_module_of_its_name():
    path = PACKAGE / "cli" / "calibrate" / "spacing.py"
    assert "dualfoot_ros.evaluation.track" in set(imported(path))
    assert "dualfoot_ros.evaluation.track" not in set(reached(path))
    behind = PACKAGE / "evaluation" / "tracked_person.py"
    assert "dualfoot_ros.evaluation.frames.association" in set(reached(behind))


def test_no_modules_import_each_other_in_a_circle():
    arrows = {module_name(p): imported_modules(p) for p in MODULES if p.name != "__init__.py"}
    assert circles(arrows) == []


def test_no_file_name_stands_twice_but_a_verb_and_its_library_module():
    counts = Counter(p.name for p in MODULES if not p.name.startswith("__"))
    twice = {name for name, count in counts.items() if count > 1}
    places = {name: [p for p in MODULES if p.name == name] for name in twice}
    verbs = {name for name, paths in places.items() if any(layer(p) == "cli" for p in paths)}
    assert twice - verbs == set()
    assert {name: len(places[name]) for name in verbs} == dict.fromkeys(verbs, 2)


def test_no_folder_lists_more_modules_than_one_sees_at_a_glance():
    counts = Counter(p.parent for p in MODULES if p.name != "__init__.py")
    assert {str(folder) for folder, count in counts.items() if count > 16} == set()


def test_only_the_nodes_import_ros():
    def forbidden(path: Path, name: str) -> bool:
        return root(name) in ROS and (path.name, root(name)) not in PRESETS

    assert breaches([p for p in MODULES if layer(p) != "nodes"], forbidden) == []


def test_the_core_reads_no_clock_and_logs_nothing():
    core = [p for p in MODULES if layer(p) == "core"]
    assert len(core) > 10
    assert breaches(core, lambda _, name: root(name) in CLOCK_OR_LOG) == []


def test_the_core_touches_nothing_outside_of_itself_but_to_keep_compiled_code():
    core = [p for p in MODULES if layer(p) == "core"]
    pure = [p for p in core if p.parent.name != COMPILER]
    assert breaches(pure, lambda _, name: root(name) in OUTSIDE) == []
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
    assert {"dualfoot_ros.core.FloatArray", "dualfoot_ros.recording.cdr"} <= seen
    deeper = PACKAGE / "recording" / "storage" / "bag_writer.py"
    assert {"dualfoot_ros.core.RecordingError", "rosbags.rosbag2"} <= set(imported(deeper))
    assert "rosbags.rosbag2" not in set(imported(deeper, top_level_only=True))
    assert target("dualfoot_ros.recording.read") == "recording"
    assert target("dualfoot_ros.settings.presets") == "settings"


def test_every_name_that_a_face_promises_is_there():
    for path in MODULES:
        if path.name == "__init__.py":
            module = import_module(module_name(path))
            promised = getattr(module, "__all__", ())
            assert [name for name in promised if not hasattr(module, name)] == [], path
            assert len(promised) == len(set(promised)), path

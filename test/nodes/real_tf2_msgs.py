"""The real tf2_msgs, built of its definition by the generators of ROS that the wheels bring.

There is no wheel of it.  Only what Fast DDS needs is built; it takes compilers for C and C++, and
two seconds of CPU.
"""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from importlib import util
from pathlib import Path

import numpy as np

DEFINITION = "geometry_msgs/TransformStamped[] transforms\n"
PACKAGE, MESSAGE = "tf2_msgs", "TFMessage"
FAST, INTROSPECTION = "rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"
GENERATORS = (
    "rosidl_generator_type_description",
    "rosidl_generator_c",
    INTROSPECTION,
    FAST,
    "rosidl_typesupport_c",
    "rosidl_generator_py",
)
NEEDED = ("geometry_msgs", "std_msgs", "builtin_interfaces")
LINKED = (
    *(f"{name}__{kind}" for name in NEEDED for kind in ("rosidl_generator_c", FAST)),
    "geometry_msgs__rosidl_typesupport_introspection_c",
    *("geometry_msgs__rosidl_generator_py", "geometry_msgs__rosidl_typesupport_c"),
    *(
        "rosidl_runtime_c",
        "rosidl_typesupport_c",
        FAST,
        INTROSPECTION,
        "rmw",
        "rcutils",
        "fastcdr",
    ),
)


def why_not() -> str:
    """Return what is missing to build it; empty when nothing is."""
    missing = [name for name in ("gcc", "g++") if shutil.which(name) is None]
    missing += [name for name in (*GENERATORS, "rosidl_adapter") if util.find_spec(name) is None]
    prefix = Path(sys.prefix)
    if not missing and not (prefix / "include" / "rosidl_runtime_c").is_dir():
        missing.append("the headers of the wheels of ROS")
    return f"tf2_msgs cannot be built here without {', '.join(missing)}" if missing else ""


def build(folder: Path) -> Path:
    """Build it in ``folder``; return the folder to import it from."""
    work = Work(folder)
    work.generate()
    work.compile()
    return folder


class Work:
    """The steps of the build."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.prefix = folder, Path(sys.prefix)
        self.made = folder / "made"
        self.share = self.prefix / "share"

    def generate(self) -> None:
        """Write the sources."""
        from rosidl_adapter.msg import convert_msg_to_idl

        (self.folder / "msg").mkdir(parents=True)
        (self.folder / "msg" / f"{MESSAGE}.msg").write_text(DEFINITION)
        convert_msg_to_idl(
            self.folder, PACKAGE, Path("msg") / f"{MESSAGE}.msg", self.folder / "msg"
        )
        for generator in GENERATORS:
            self._run(generator)
            for template in (self.share / generator / "resource").glob("*visibility_control.h.in"):
                text = template.read_text().replace("@PROJECT_NAME@", PACKAGE)
                text = text.replace("@PROJECT_NAME_UPPER@", PACKAGE.upper())
                (self.made / generator / PACKAGE / "msg" / template.stem).write_text(text)

    def _run(self, generator: str) -> None:
        out = self.folder if generator == "rosidl_generator_py" else self.made / generator
        description = f"{self.made}/{GENERATORS[0]}/{PACKAGE}/msg/{MESSAGE}.json"
        arguments = {
            "package_name": PACKAGE,
            "output_dir": f"{out}/{PACKAGE}",
            "template_dir": str(self.share / generator / "resource"),
            "idl_tuples": [f"{self.folder}:msg/{MESSAGE}.idl"],
            "ros_interface_dependencies": [],
            "target_dependencies": [],
            "include_paths": [f"{name}:{self.share / name}" for name in NEEDED],
            "type_description_tuples": [f"msg/{MESSAGE}.idl:{description}"],
        }
        path = self.folder / f"{generator}.json"
        path.write_text(json.dumps(arguments))
        script = self.prefix / "lib" / generator / generator
        command = [sys.executable, str(script), "--generator-arguments-file", str(path)]
        if generator == "rosidl_typesupport_c":
            command += ["--typesupports", FAST, INTROSPECTION]
        if generator == "rosidl_generator_py":
            command += ["--typesupport-impls", "rosidl_typesupport_c"]
        # The templates of this release are written for the locale of a build.
        done = subprocess.run(
            command, check=False, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}
        )
        assert done.returncode == 0, f"{generator}: {done.stdout}{done.stderr}"

    def compile(self) -> None:
        """Compile everything, and link the module that rclpy imports with its two libraries.

        rosidl opens the libraries by their names, which works because they are loaded already.
        """
        objects: dict[str, list[str]] = {"module": [], FAST: [], INTROSPECTION: []}
        sources = [*self.made.rglob("*.c"), *self.made.rglob("*.cpp")]
        for number, source in enumerate([*sources, *(self.folder / PACKAGE).rglob("*.c")]):
            objects[_part(source)].append(self._compile(source, str(self.folder / f"{number}.o")))
        for support in (INTROSPECTION, FAST):
            name = f"lib{PACKAGE}__{support}.so"
            after = [] if support is INTROSPECTION else [INTROSPECTION]
            self._link(name, objects[support], after, [f"-Wl,-soname,{name}"])
        suffix = sysconfig.get_config_var("EXT_SUFFIX")
        name = f"{PACKAGE}/{PACKAGE}_s__rosidl_typesupport_c{suffix}"
        self._link(name, objects["module"], [INTROSPECTION, FAST], ["-Wl,--no-as-needed"])

    def _compile(self, source: Path, target: str) -> str:
        headers = self.prefix / "include"
        folders = [
            headers,
            *headers.iterdir(),
            *self.made.iterdir(),
            sysconfig.get_path("include"),
        ]
        compiler = ["g++", "-std=c++17"] if source.suffix == ".cpp" else ["gcc"]
        included = [f"-I{folder}" for folder in (*folders, np.get_include())]
        self._call([*compiler, "-O0", "-fPIC", "-c", str(source), "-o", target, *included])
        return target

    def _link(self, name: str, objects: list[str], own: list[str], flags: list[str]) -> None:
        libraries = [f"-l{PACKAGE}__{support}" for support in own] + [f"-l{n}" for n in LINKED]
        found = [f"{how}{self.folder}" for how in ("-L", "-Wl,-rpath,")]
        found += [f"{how}{self.prefix / 'lib'}" for how in ("-L", "-Wl,-rpath,")]
        target = str(self.folder / name)
        self._call(["g++", "-shared", "-o", target, *flags, *objects, *found, *libraries])

    @staticmethod
    def _call(command: list[str]) -> None:
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr


def _part(source: Path) -> str:
    """Return the part that a source belongs to."""
    if "made" not in source.parts or "rosidl_typesupport_c" in source.parts:
        return "module"
    return FAST if FAST in source.parts else INTROSPECTION

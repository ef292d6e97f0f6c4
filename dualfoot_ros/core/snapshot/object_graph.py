"""Objects and what they refer to, as plain values and arrays, and back; without pickle.

An object stands once, however often others refer to it.  Only classes and functions of the core
and registered methods are made or called, so that a file cannot run other code.  Engines are left
out: whoever loads an object chooses its own.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator, Sequence
from enum import Enum
from functools import partial
from importlib import import_module
from types import FunctionType, MethodType
from typing import Any

import numpy as np

from ..compiler import BackgroundEngine
from ..constraints import METHODS
from ..errors import SnapshotError
from ..kernel import Engine

CORE = "dualfoot_ros.core."
KINDS: dict[str, type[Any]] = {
    "list": list,
    "tuple": tuple,
    "dict": dict,
    "deque": deque,
    "counter": Counter,
}
NAMES: dict[type[Any], str] = {kind: name for name, kind in KINDS.items()}


class Encoder:
    """Collects objects: plain values as they are, others by their number in ``objects``."""

    def __init__(self) -> None:
        """Start with nothing."""
        self.objects: list[dict[str, Any]] = []
        self.arrays: list[np.ndarray] = []
        self._numbers: dict[int, int] = {}
        self._kept: list[object] = []  # so that no identity is used twice

    def encode(self, item: Any) -> Any:
        """Return ``item`` as a value of JSON.

        Raises
        ------
        SnapshotError
            When it is of a kind that cannot be kept.
        """
        if item is None or isinstance(item, (Engine, BackgroundEngine)):
            return None
        if type(item) in (bool, int, float, str):
            return item
        if isinstance(item, Enum):
            return {"enum": path_of(type(item)), "name": item.name}
        if isinstance(item, np.generic):
            return {"scalar": self._array(np.asarray(item))}
        if id(item) not in self._numbers:
            self._numbers[id(item)] = len(self.objects)
            self._kept.append(item)
            entry: dict[str, Any] = {}
            self.objects.append(entry)
            entry.update(self._describe(item))
        return {"object": self._numbers[id(item)]}

    def _array(self, array: np.ndarray) -> int:
        self.arrays.append(array)
        return len(self.arrays) - 1

    def _describe(self, item: Any) -> dict[str, Any]:
        if isinstance(item, np.ndarray):
            return {"array": self._array(item)}
        if type(item) in NAMES:
            return self._describe_collection(item)
        if isinstance(item, tuple):  # with names
            path = path_of(type(item))
            resolve(path)
            return {"record": path, "items": [self.encode(each) for each in item]}
        if isinstance(item, partial):
            parts = (item.func, list(item.args), dict(item.keywords))
            return {"partial": [self.encode(part) for part in parts]}
        if isinstance(item, MethodType):
            return {"method": item.__func__.__name__, "of": self.encode(item.__self__)}
        if isinstance(item, FunctionType):
            return {"function": path_of(item)}
        values = {name: self.encode(value) for name, value in attributes(item)}
        return {"class": path_of(type(item)), "values": values}

    def _describe_collection(self, item: Any) -> dict[str, Any]:
        name = NAMES[type(item)]
        if isinstance(item, dict):
            pairs = [[self.encode(key), self.encode(value)] for key, value in item.items()]
            return {"kind": name, "items": pairs}
        entry = {"kind": name, "items": [self.encode(each) for each in item]}
        return {**entry, "maxlen": item.maxlen} if isinstance(item, deque) else entry


class Decoder:
    """Makes the objects again that an `Encoder` has collected."""

    def __init__(self, objects: Sequence[dict[str, Any]], arrays: Sequence[np.ndarray]) -> None:
        """Use what was collected."""
        self._objects, self._arrays = objects, arrays
        self._made: dict[int, Any] = {}

    def decode(self, value: Any) -> Any:
        """Return the item that ``value`` stands for."""
        if not isinstance(value, dict):
            return value
        if "enum" in value:
            return resolve(value["enum"])[value["name"]]
        if "scalar" in value:
            return self._arrays[value["scalar"]][()]
        number = value["object"]
        if number not in self._made:
            self._make(number, self._objects[number])
        return self._made[number]

    def _make(self, number: int, entry: dict[str, Any]) -> None:
        if "array" in entry:
            self._made[number] = self._arrays[entry["array"]]
        elif "kind" in entry:
            self._make_collection(number, entry)
        elif "record" in entry:
            items = [self.decode(each) for each in entry["items"]]
            self._made[number] = resolve(entry["record"])(*items)
        elif "partial" in entry:
            function, args, keywords = (self.decode(part) for part in entry["partial"])
            self._made[number] = partial(function, *args, **keywords)
        elif "method" in entry:
            self._made[number] = getattr(self.decode(entry["of"]), entry["method"])
        elif "function" in entry:
            self._made[number] = resolve(entry["function"])
        else:
            item = self._made[number] = object.__new__(resolve(entry["class"]))
            for name, value in entry["values"].items():
                object.__setattr__(item, name, self.decode(value))

    def _make_collection(self, number: int, entry: dict[str, Any]) -> None:
        kind, items = KINDS[entry["kind"]], entry["items"]
        if kind is tuple:
            self._made[number] = tuple(self.decode(each) for each in items)
            return
        made = deque(maxlen=entry["maxlen"]) if kind is deque else kind()
        self._made[number] = made
        for each in items:
            if isinstance(made, dict):
                made[self.decode(each[0])] = self.decode(each[1])
            else:
                made.append(self.decode(each))


def attributes(item: Any) -> Iterator[tuple[str, Any]]:
    """Yield the attributes of an object of a class that may be kept."""
    resolve(path_of(type(item)))
    yield from vars(item).items() if hasattr(item, "__dict__") else ()
    for kind in type(item).__mro__:
        for name in getattr(kind, "__slots__", ()):
            if hasattr(item, name):
                yield name, getattr(item, name)


def path_of(item: Any) -> str:
    """Return the module and the name of a class or a function."""
    return f"{item.__module__}:{item.__qualname__}"


def resolve(path: str) -> Any:
    """Return the class or the function of the core, or of a registered method, at ``path``.

    Raises
    ------
    SnapshotError
        When it is neither, or is not there.
    """
    registered = (METHODS[name] for name in METHODS)
    known = {path_of(each): each for kind in registered for each in (kind, kind.config_class)}
    if path in known:
        return known[path]
    module, _, name = path.partition(":")
    if module.startswith(CORE) and name.isidentifier():
        try:
            return getattr(import_module(module), name)
        except (ImportError, AttributeError):
            pass
    raise SnapshotError(f"'{path}' is no part of a tracker that a snapshot can keep")

"""The methods by name: those of this package, and those that other packages bring.

Another package offers a method as an entry point of the group ``dualfoot_ros.methods`` whose name
is that of the method and whose object is a class derived from :class:`Method`.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, overload

from ..errors import ConfigError
from ..parameters import Parameters
from .method import Method

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

ENTRY_POINTS = "dualfoot_ros.methods"
OWN = {
    "zupt": "zupt:ZuptOnly",
    "max_distance": "max_distance:MaxDistance",
    "min_distance": "min_distance:MinDistance",
    "mdmd_ekf": "mdmd:MdmdEkf",
    "mdmd_ukf": "mdmd:MdmdUkf",
    "mdmd_ckf": "mdmd:MdmdCkf",
    "idc": "idc:Idc",
    "max_distance_projection": "max_distance_projection:MaxDistanceProjection",
    "varying_distance": "varying_distance:VaryingDistance",
    "spacing_vector": "spacing_vector:SpacingVector",
    "step_length": "step_length:StepLength",
    "rigid_pair": "rigid_pair:RigidPair",
}
"""The methods of this package: module here, and class."""


class MethodRegistry(Mapping[str, type[Method]]):
    """Classes of methods by name.

    One of this package is imported when it is asked for.  Those of other packages are looked for
    when a name is none of this package, or all are asked for: to look through all that is
    installed takes as long as to import the kernel.
    """

    def __init__(self, own: Mapping[str, str]) -> None:
        """Start with the methods of this package, ``own`` as in `OWN`."""
        self.own = own
        self._loaded: dict[str, type[Method]] = {}
        self._brought: dict[str, type[Method]] | None = None

    def __getitem__(self, name: str) -> type[Method]:
        """Return the class of a method."""
        return self._of_here(name) if name in self.own else self._of_others()[name]

    def __contains__(self, name: object) -> bool:
        """Return whether there is a method of that name."""
        return name in self.own or name in self._of_others()

    def __iter__(self) -> Iterator[str]:
        """Yield the names, this package's first."""
        yield from self.own
        yield from self._of_others()

    def __len__(self) -> int:
        """Return how many methods there are."""
        return len(self.own) + len(self._of_others())

    def names(self) -> Sequence[str]:
        """Return the names, this package's first."""
        return _Names(self)

    def _of_here(self, name: str) -> type[Method]:
        if name not in self._loaded:
            module, _, its_name = self.own[name].partition(":")
            found = getattr(import_module(f".{module}", __package__), its_name)
            self._loaded[name] = checked(found, name)
        return self._loaded[name]

    def _of_others(self) -> dict[str, type[Method]]:
        from importlib.metadata import entry_points  # here: it brings the parser of e-mails

        if self._brought is None:
            self._brought = {}
            for point in entry_points(group=ENTRY_POINTS):
                self._bring(point)
        return self._brought

    def _bring(self, point: EntryPoint) -> None:
        """Add a method of another package; warn of one that cannot be used."""
        assert self._brought is not None
        try:
            method = _load(point, (*self.own, *self._brought))
        except Exception as error:  # whatever happens in the code of others
            text = f"method '{point.name}' of {point.value} is not used: {error}"
            warnings.warn(text, stacklevel=2)
        else:
            self._brought[point.name] = method


class _Names(Sequence[str]):
    """Names of a registry; only who asks for all of them has other packages looked for."""

    def __init__(self, methods: MethodRegistry) -> None:
        self._methods = methods

    def __contains__(self, name: object) -> bool:
        return name in self._methods

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        return tuple(self._methods)[index]

    def __len__(self) -> int:
        return len(self._methods)


def _load(point: EntryPoint, taken: Sequence[str]) -> type[Method]:
    """Return the method of an entry point, whose name must not be ``taken``."""
    method = checked(point.load(), point.name)
    if point.name in taken:
        raise ConfigError("there is a method of that name already")
    return method


def checked(method: object, name: str) -> type[Method]:
    """Return ``method`` if it is a class of methods that can be selected by ``name``.

    Raises
    ------
    ConfigError
        When it is not.
    """
    if not (isinstance(method, type) and issubclass(method, Method)):
        raise ConfigError(f"{method!r} is not a class derived from Method")
    if method.name != name:
        raise ConfigError(f"its name is '{method.name}', its entry point's '{name}'")
    if not issubclass(method.config_class, Parameters):
        raise ConfigError(
            f"its config_class {method.config_class!r} is not derived from Parameters"
        )
    return method


METHODS = MethodRegistry(OWN)

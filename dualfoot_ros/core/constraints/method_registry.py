"""The methods by name: those of this package, and those that other packages bring.

Another package offers a method as an entry point of the group ``dualfoot_ros.methods`` whose name
is that of the method and whose object is a class derived from :class:`Method`.
"""

from __future__ import annotations

import warnings
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, overload

from ..errors import ConfigError
from ..parameters import Parameters
from .idc import Idc
from .max_distance import MaxDistance
from .max_distance_projection import MaxDistanceProjection
from .mdmd import MdmdCkf, MdmdEkf, MdmdUkf
from .method import Method
from .min_distance import MinDistance
from .rigid_pair import RigidPair
from .spacing_vector import SpacingVector
from .step_length import StepLength
from .varying_distance import VaryingDistance
from .zupt import ZuptOnly

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

ENTRY_POINTS = "dualfoot_ros.methods"
OWN: tuple[type[Method], ...] = (
    ZuptOnly,
    MaxDistance,
    MinDistance,
    MdmdEkf,
    MdmdUkf,
    MdmdCkf,
    Idc,
    MaxDistanceProjection,
    VaryingDistance,
    SpacingVector,
    StepLength,
    RigidPair,
)


class MethodRegistry(Mapping[str, type[Method]]):
    """Classes of methods by name.

    Those of other packages are looked for when a name is none of this package, or all are asked
    for: to look through all that is installed takes as long as to import the kernel.
    """

    def __init__(self, own: tuple[type[Method], ...]) -> None:
        """Start with the methods ``own`` of this package."""
        self.own = {each.name: each for each in own}
        self._all: dict[str, type[Method]] | None = None

    def __getitem__(self, name: str) -> type[Method]:
        """Return the class of a method."""
        return self.own[name] if name in self.own else self._methods()[name]

    def __iter__(self) -> Iterator[str]:
        """Yield the names, this package's first."""
        return iter(self._methods())

    def __len__(self) -> int:
        """Return how many methods there are."""
        return len(self._methods())

    def names(self) -> Sequence[str]:
        """Return the names, this package's first."""
        return _Names(self)

    def _methods(self) -> dict[str, type[Method]]:
        from importlib.metadata import entry_points  # here: it brings the parser of e-mails

        if self._all is None:
            self._all = dict(self.own)
            for point in entry_points(group=ENTRY_POINTS):
                self._bring(self._all, point)
        return self._all

    def _bring(self, methods: dict[str, type[Method]], point: EntryPoint) -> None:
        """Add a method of another package; warn of one that cannot be used."""
        try:
            method = _load(point, methods)
        except Exception as error:  # whatever happens in the code of others
            text = f"method '{point.name}' of {point.value} is not used: {error}"
            warnings.warn(text, stacklevel=2)
        else:
            methods[point.name] = method


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


def _load(point: EntryPoint, taken: Container[str]) -> type[Method]:
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

"""What other sensors than the inertial ones have measured: taken, refused and counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..constraints.method import Method
from ..errors import ConfigError
from ..groups import AidsConfig
from ..refusals import Refusal
from ..results.events import FEET
from ..samples.series import FieldSeries, FloatArray
from .barometer import WORN, Barometer
from .field import FieldLog
from .flat_floor import FlatFloor
from .magnetic_heading import MagneticHeading
from .pressure import PressureLog
from .straight_lines import StraightLines

Vector = Sequence[float] | FloatArray


class AidInputs:
    """Air pressure and magnetic field of a tracker, and the aids that use them."""

    def __init__(self, config: AidsConfig, counters: Counter[str]) -> None:
        """Count in ``counters`` what is taken and refused."""
        self._config, self._counters = config, counters
        self._pressure = {worn: PressureLog() for worn in WORN}
        self._fields = {foot: FieldLog() for foot in FEET}

    def methods(self) -> list[Method]:
        """Return the aids that are on, knowing nothing of the walk yet."""
        config, counters = self._config, self._counters
        found: list[Method] = [FlatFloor(config)] if config.flat_floor else []
        if config.barometer:
            found.append(Barometer(config, self._pressure, counters))
        if config.magnetic_heading:
            found.append(MagneticHeading(config, self._fields, counters))
        if config.straight_lines:
            found.append(StraightLines(config))
        return found

    def retune(self, config: AidsConfig, aids: Sequence[Method]) -> list[Method]:
        """Return ``aids`` with the weights of ``config``, and the flat floor on or off.

        The barometer and the magnetic heading stay as they are, on or off.
        """
        self._config = replace(
            config,
            barometer=self._config.barometer,
            magnetic_heading=self._config.magnetic_heading,
        )
        others = [aid for aid in aids if not isinstance(aid, FlatFloor)]
        floors = [aid for aid in aids if isinstance(aid, FlatFloor)] or [FlatFloor(self._config)]
        found: list[Method] = [*(floors if config.flat_floor else []), *others]
        for aid in found:
            aid.retune(self._config)
        return found

    def take_pressure(self, worn: str, stamp_ns: int, pascal: float) -> Refusal | None:
        """Take a pressure in Pa; return why it is refused, if it is.

        Raises
        ------
        ConfigError
            When ``worn`` is not in WORN.
        """
        _check_worn("pressure", worn, WORN)
        used = self._config.barometer
        log = self._pressure[worn]
        refused = log.add(stamp_ns, pascal) if used else Refusal.PRESSURE_UNUSED
        self._counters[refused or "pressures"] += 1
        return refused

    def take_field(self, foot: str, stamp_ns: int, tesla: Vector) -> Refusal | None:
        """Take a magnetic field (3,) T; return why it is refused, if it is.

        Raises
        ------
        ConfigError
            When ``foot`` is none, or ``tesla`` are not three numbers.
        """
        _check_worn("magnetic field", foot, FEET)
        if np.shape(tesla) != (3,):
            raise ConfigError(f"magnetic field has shape {np.shape(tesla)}; allowed is (3,)")
        used = self._config.magnetic_heading
        refused = self._fields[foot].add(stamp_ns, tesla) if used else Refusal.FIELD_UNUSED
        self._counters[refused or "fields"] += 1
        return refused

    def take_fields(self, foot: str, series: FieldSeries) -> None:
        """Take a whole series, one by one.

        Raises
        ------
        ConfigError
            When ``foot`` is none.
        """
        _check_worn("magnetic field", foot, FEET)
        if not self._config.magnetic_heading:
            self._counters[Refusal.FIELD_UNUSED] += len(series)
            return
        for stamp, tesla in zip(series.stamp_ns.tolist(), series.tesla, strict=True):
            self.take_field(foot, stamp, tesla)

    def trim(self) -> None:
        """Forget what is too old to be asked for, now and then."""
        for pressure in self._pressure.values():
            pressure.trim()
        for field in self._fields.values():
            field.trim()


def _check_worn(what: str, worn: str, allowed: Sequence[str]) -> None:
    if worn not in allowed:
        raise ConfigError(f"{what} is of '{worn}'; allowed is one of {', '.join(allowed)}")

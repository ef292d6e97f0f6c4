"""Samples of one sensor on their way out: checked, stamped, turned, published."""

from __future__ import annotations

import numpy as np
from rclpy.node import Node
from sensor_msgs.msg import Imu

from ...core import FloatArray, Refusal
from ...drivers import Sample, SensorCheck
from ...settings import AdapterConfig
from ..inputs.stamper import Stamper
from ..inputs.unit_check import UnitCheck
from ..ros import qos
from ..ros.messages import set_imu_values, set_time
from ..ros.watched_publisher import watched_publisher
from .conversion import Conversion
from .first_seconds import FirstSeconds


class SampleOutput:
    """Publishes ``imu/data_raw`` of one foot, and counts."""

    def __init__(
        self,
        node: Node,
        config: AdapterConfig,
        foot: str,
        depth: int,
        conversion: Conversion,
        check: SensorCheck,
    ) -> None:
        """Publish with ``node``; `begin` says how samples are stamped."""
        self._config, self._foot = config, foot
        self._conversion, self._check = conversion, check
        self._out = watched_publisher(node, Imu, "imu/data_raw", qos.sensor(depth))
        self.unit_check = UnitCheck(node.get_logger().warning)
        self.counters: dict[str, int] = {"relayed": 0, Refusal.NOT_FINITE: 0}

    def begin(self, stamper: Stamper, first_seconds: FirstSeconds) -> None:
        """Stamp samples by ``stamper`` from now on, and show them to ``first_seconds``."""
        self._stamper, self._first_seconds = stamper, first_seconds

    def has_listener(self) -> bool:
        """Return whether anybody takes the samples."""
        return bool(self._out.get_subscription_count() > 0)

    def check(self, header_ns: int, values: FloatArray) -> FloatArray | None:
        """Return a sample (6,) in SI units and the axes of the sensor; None when refused."""
        sensed = self._conversion.scale(values)
        if not np.isfinite(sensed).all():
            self.counters[Refusal.NOT_FINITE] += 1
            self._check.interrupt()
            return None
        force, rate = tuple(sensed[:3].tolist()), tuple(sensed[3:].tolist())
        return sensed if self._check.accept(Sample(header_ns, force, rate)) else None

    def send(
        self, message: Imu, header_ns: int | None, arrival_ns: int, sensed: FloatArray
    ) -> int | None:
        """Publish a sample; return its stamp, None when it gets none."""
        self._first_seconds.add(header_ns, arrival_ns, sensed)
        stamp_ns = self._stamp(header_ns, arrival_ns)
        if stamp_ns is None:
            return None
        values = self._conversion.turn(sensed)
        self.unit_check.add(values.tolist())
        set_time(message.header.stamp, stamp_ns)
        set_imu_values(message, values)
        self._conversion.convert_covariances(message)
        self._out.publish(message)
        self.counters["relayed"] += 1
        return stamp_ns

    def _stamp(self, header_ns: int | None, arrival_ns: int) -> int | None:
        if header_ns is None and self._config.stamp == "even":
            header_ns = 0
        if header_ns is None:  # a device without a clock
            return arrival_ns + round(1e9 * self._config.stamp_offset)
        return self._stamper.stamp(self._foot, header_ns, arrival_ns)

"""A device with a clock that is off and runs wrong, on a bursty link, in a time that is made up.

The angular rate about x of a sample is its number times ``RATE``.
"""

import socket
import struct

import numpy as np
from drivers import frames

START_NS = 10**18  # when it takes sample 0, by the host's clock
STEP_NS = 5_000_000
OFFSET_S = 3600.0
BURST = 20  # samples, 0.1 s
RATE = 1e-3  # rad/s


def frame(k, time_ns):
    """Return sample k in the frame for boards of one's own."""
    us = time_ns // 1000 & 0xFFFFFFFF
    plain = struct.pack("<BHI6f", 1, k & 0xFFFF, us, 0.1 * (k % 7), 0.2, 9.8, RATE * k, 0.0, 0.01)
    return frames.cobs(plain + struct.pack("<H", frames.crc16(plain, 0xFFFF)))


class SkewedDevice:
    """Sends to the UDP port of an adapter that has ``use_sim_time``, and sets its clock."""

    def __init__(self, bench, node, skew_ppm):
        self._bench, self._node, self._skew_ppm = bench, node, skew_ppm
        self._rng = np.random.default_rng(1)
        self._sent = self._sent_bytes = 0

    def _own_ns(self, k):
        """Return what the device's clock shows when sample k is taken."""
        return round(OFFSET_S * 1e9 + k * STEP_NS * (1.0 + 1e-6 * self._skew_ppm))

    def send(self, count):
        """Send that many samples more, in bursts; each has arrived before the next is sent."""
        source = self._node.device.source
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            for _ in range(count // BURST):
                last_ns = START_NS + (self._sent + BURST - 1) * STEP_NS
                self._bench.set_now(self._node, last_ns + round(self._rng.exponential(1e6)))
                for k in range(self._sent, self._sent + BURST):
                    message = frame(k, self._own_ns(k))
                    out.sendto(message, ("127.0.0.1", source.transport.port))
                    self._sent_bytes += len(message)
                self._sent += BURST
                self._bench.until(
                    lambda: source.decoder.counters["bytes"] == self._sent_bytes, "a burst"
                )

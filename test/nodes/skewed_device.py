"""A device in a process of its own: ``python skewed_device.py PORT COUNT HOUR_S SKEW_PPM BURST``.

It samples every 5 ms, stamps with a clock that is off and runs wrong, and sends to UDP in bursts.
First it prints when it took sample 0 by the host's wall clock, ns; the angular rate about x of a
sample is its number times ``RATE``.
"""

import socket
import struct
import sys
import time

from drivers import frames

STEP_NS = 5_000_000
RATE = 1e-3  # rad/s


def frame(k, time_ns):
    """Return sample k in the frame for boards of one's own."""
    us = time_ns // 1000 & 0xFFFFFFFF
    plain = struct.pack("<BHI6f", 1, k & 0xFFFF, us, 0.1 * (k % 7), 0.2, 9.8, RATE * k, 0.0, 0.01)
    return frames.cobs(plain + struct.pack("<H", frames.crc16(plain, 0xFFFF)))


def own_ns(k, offset_s, skew_ppm):
    """Return what the device's clock shows when sample k is taken."""
    return round(offset_s * 1e9 + k * STEP_NS * (1.0 + 1e-6 * skew_ppm))


def main(port, count, offset_s, skew_ppm, burst):
    start_ns = time.time_ns()
    print(start_ns, flush=True)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        for first in range(0, int(count), int(burst)):
            taken = range(first, first + int(burst))
            ready = [frame(k, own_ns(k, float(offset_s), float(skew_ppm))) for k in taken]
            time.sleep(max(0.0, (start_ns + taken[-1] * STEP_NS - time.time_ns()) * 1e-9))
            for each in ready:
                out.sendto(each, ("127.0.0.1", int(port)))


if __name__ == "__main__":
    main(*sys.argv[1:])

"""A device in a process of its own: sends frames over UDP or serves them over TCP.

``python device.py udp|tcp PORT FORMAT COUNT [OFFSET_S SKEW_PPM]``; its clock is off and runs
wrong, as those of devices do, and goes by the samples: nothing is waited for.  With ``tcp`` and
port 0 the port is printed.
"""

import socket
import struct
import sys

import frames

INTERVAL_S = 0.005


def messages(name, count, offset_s, skew_ppm):
    """Yield frames that are stamped by a clock of our own."""
    for k in range(count):
        own_s = offset_s + k * INTERVAL_S * (1.0 + 1e-6 * skew_ppm)
        yield stamped(name, k, round(own_s * 1e6))


def stamped(name, k, own_us):
    """Return the k-th frame with the device's own microseconds in it."""
    if name == "ximu3_ascii":
        kind, _, values = frames.ximu3_ascii(k).decode().split(",", 2)
        return f"{kind},{own_us},{values}".encode()
    force, rate = frames.truth(k)
    plain = struct.pack("<BHI6f", 1, k & 0xFFFF, own_us & 0xFFFFFFFF, *force, *rate)
    return frames.cobs(plain + struct.pack("<H", frames.crc16(plain, 0xFFFF)))


def main(kind, port, name, count, offset_s="3600", skew_ppm="1500"):
    stream = messages(name, int(count), float(offset_s), float(skew_ppm))
    if kind == "udp":
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            for message in stream:
                out.sendto(message, ("127.0.0.1", int(port)))
        return
    with socket.create_server(("127.0.0.1", int(port))) as server:
        print(server.getsockname()[1], flush=True)
        link, _ = server.accept()
        with link:
            for message in stream:
                link.sendall(message)


if __name__ == "__main__":
    main(*sys.argv[1:])

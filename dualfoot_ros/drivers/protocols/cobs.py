"""Consistent overhead byte stuffing (Cheshire and Baker 1999): frames without zero bytes."""


def decode(stuffed: bytes) -> bytes | None:
    """Return the bytes that ``stuffed`` (without its terminating zero) stands for, or None.

    Each block starts with a code byte n: n - 1 plain bytes follow, then a zero is implied,
    unless n is 255 or the message ends there.
    """
    plain = bytearray()
    at = 0
    while at < len(stuffed):
        code = stuffed[at]
        end = at + code
        if code == 0 or end > len(stuffed):
            return None
        plain += stuffed[at + 1 : end]
        at = end
        if code < 255 and at < len(stuffed):
            plain.append(0)
    return bytes(plain)

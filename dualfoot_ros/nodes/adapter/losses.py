"""How much of what a sensor sends is lost on the way or cannot be used, and why."""

from __future__ import annotations

from collections.abc import Mapping

from ..ros.diagnostics import WARN, Status

SHARE = 0.03  # of the samples of a period; fewer are only counted
LEAST = 3  # samples
LEAST_BYTES = 100
REFUSED = {
    "not_finite": "not finite",
    "out_of_range": "out of range",
    "bad_checksum": "with a wrong checksum",
    "malformed": "malformed",
    "incomplete": "without specific force or angular rate",
}
WORDS = {"lost": "lost on the way", **REFUSED}
GARBAGE = "garbage_bytes"
MIXED = "senders"
"""The kind of the finding that several devices share a port."""


def counts(counters: Mapping[str, int]) -> dict[str, int]:
    """Return the counters that tell of samples and what became of them; absent is 0."""
    return {name: counters.get(name, 0) for name in ("bytes", "samples", GARBAGE, *WORDS)}


def increases(now: Mapping[str, int], before: Mapping[str, int]) -> dict[str, int]:
    """Return by how much each counter has grown."""
    return {name: count - before.get(name, 0) for name, count in now.items()}


def lost(found: Mapping[str, int]) -> int:
    """Return the samples lost on the way; a frame that cannot be read is not lost as well."""
    unread = found.get("bad_checksum", 0) + found.get("malformed", 0)
    return max(0, found.get("lost", 0) - unread)


def in_words(found: Mapping[str, int]) -> str:
    """Return the counts that are not zero with what they count; empty when all are."""
    return _listed({**found, "lost": lost(found)})


def _listed(found: Mapping[str, int]) -> str:
    words = [f"{found[name]} {what}" for name, what in WORDS.items() if found.get(name)]
    if found.get(GARBAGE):
        words.append(f"{found[GARBAGE]} bytes in no frame")
    return ", ".join(words)


class Refusals:
    """Warns when more than a few percent of a report's period are lost or refused."""

    def __init__(self) -> None:
        self._before: dict[str, int] = {}

    def describe(self, counters: Mapping[str, int], status: Status) -> None:
        """Take the counters at the end of a period, and say what is too much."""
        now = counts(counters)
        found, self._before = increases(now, self._before), now
        total = found["samples"] + sum(found[name] for name in REFUSED if name != "out_of_range")
        found["lost"] = lost(found)
        total += found["lost"]
        much = {n: found[n] for n in WORDS if found[n] >= max(LEAST, SHARE * total)}
        if found[GARBAGE] >= max(LEAST_BYTES, SHARE * found["bytes"]):
            much[GARBAGE] = found[GARBAGE]
        if much and MIXED not in status.logged:  # between two numberings there are only holes
            said = f"since the last report, of {total} samples: {_listed(much)}"
            status.note(WARN, said, f"refused {', '.join(much)}")

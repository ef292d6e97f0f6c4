"""Samples counted by sender, for a port on which any device may send."""

from __future__ import annotations

MAX_SENDERS = 16


class Senders:
    """Counter of samples by the address they came from, for the newest ``MAX_SENDERS`` addresses.

    ``returns`` counts how often an address sent again after another one had.  Devices that share
    a port take turns, so that each returns; a device that starts again with a new port does not.
    """

    def __init__(self) -> None:
        """Start with no sender."""
        self.samples: dict[str, int] = {}
        self.returns: dict[str, int] = {}
        self._last: str | None = None

    def count(self, sender: str, samples: int) -> None:
        """Count the samples that a datagram of ``sender`` brought."""
        if sender == self._last:
            self.samples[sender] += samples
            return
        self._last = sender
        known = sender in self.samples
        count, returns = self.samples.pop(sender, 0), self.returns.pop(sender, -1)
        if not known and len(self.samples) >= MAX_SENDERS:
            oldest = next(iter(self.samples))
            del self.samples[oldest], self.returns[oldest]
        self.samples[sender], self.returns[sender] = count + samples, returns + 1

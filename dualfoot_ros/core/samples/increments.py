"""What the numbers of a sample are: compensated increments, means, or values at the instant."""

from __future__ import annotations

from enum import StrEnum


class Increments(StrEnum):
    """What an angular rate and a specific force say about the interval that ends at their stamp.

    Attributes
    ----------
    COMPENSATED : held constant over the interval they give the increments of attitude and velocity
        that the device integrated at a higher rate, coning and sculling compensated
    AVERAGED : means over the interval, as Liu et al. 2023 take them, eqs (1)-(3)
    SAMPLED : values at the instant of the stamp
    """

    COMPENSATED = "compensated"
    AVERAGED = "averaged"
    SAMPLED = "sampled"

    @property
    def words(self) -> str:
        """What the samples are, in words."""
        return _WORDS[self]


_WORDS = {
    Increments.COMPENSATED: "compensated increments",
    Increments.AVERAGED: "means over their interval",
    Increments.SAMPLED: "values at their stamp",
}

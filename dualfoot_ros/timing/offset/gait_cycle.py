"""Which cycle the feet walk in turn at, how sure that is, and what to say when it is not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import TimingError
from .correlation import STEP_S, Correlation, Signal
from .evenness import unevenness
from .middles import Middle, highest_middles
from .result import DOUBT

LEAST_PEAK = 0.6  # correlation below which these are not two feet walking
LEAST_CYCLES = 3.0
MOST_UNEVEN = 0.05  # of a cycle, beyond which the feet do not walk together
DOUBTFUL_UNEVEN = 0.016  # of a cycle, that is a confidence of one half
DOUBTFUL_PEAK = 0.8  # correlation that is a confidence of one half
CANDIDATES = 7  # cycles that are compared
EVEN_MARGIN = 2.0  # preference over the next cycle that is a confidence of one half
PER_CYCLE = 2.0  # preference for a cycle's lead in the correlation of the whole
LENGTH_CYCLES = 1.2  # that the walk may be longer on one foot: one begins, one may end
LARGEST_SKEW = 1000e-6  # that is looked for


@dataclass(frozen=True)
class Choice:
    """The middle that was chosen, and how it compares."""

    middle: Middle
    second: float
    uneven: float
    margin: float

    @property
    def confidence(self) -> float:
        """0 to 1: told from other cycles, and alike and even enough for feet of one walk."""
        told = self.margin / (self.margin + EVEN_MARGIN)
        even = 1.0 / (1.0 + (self.uneven / DOUBTFUL_UNEVEN) ** 4)
        differ = max(1.0 - self.middle.height, 0.0) / (1.0 - DOUBTFUL_PEAK)
        return min(told, even, 1.0 / (1.0 + differ**4))


def walking(foot: Signal) -> np.ndarray:
    """Tell (N,) where the foot walks: where a second's mean is a fifth of a brisk one."""
    second = np.ones(round(1.0 / STEP_S)) * STEP_S
    mean = np.convolve(foot.values, second, mode="same")
    return np.asarray(mean > max(0.2 * float(np.quantile(mean, 0.95)), 0.5))


def choose(left: Signal, right: Signal, correlation: Correlation, walked_s: float) -> Choice:
    """Return the middle that fits best by the whole and by its windows."""
    middles = highest_middles(correlation, CANDIDATES)
    windows = [unevenness(left, right, middle) for middle in middles]
    most = max(count for _, count in windows)
    cycles = walked_s / middles[0].cycle_s

    def preference(index: int) -> float:
        uneven = min(windows[index][0], 1.0)
        # windows overlap by half, so half of them are told apart
        return PER_CYCLE * cycles * middles[index].height - 0.5 * most * float(np.log(uneven))

    order = sorted(range(len(middles)), key=preference, reverse=True)
    best = order[0]
    margin = preference(best) - preference(order[1]) if len(order) > 1 else PER_CYCLE * cycles
    second = max((m.height for k, m in enumerate(middles) if k != best), default=0.0)
    return Choice(middles[best], second, windows[best][0], margin)


def check(choice: Choice, cycles: float, left: Signal, right: Signal) -> None:
    """Raise a TimingError where these are not two feet of one walk."""
    best = choice.middle
    lengths = _lengths_apart(best.cycle_s, left, right)
    if best.height < LEAST_PEAK or cycles < LEAST_CYCLES:
        raise TimingError(
            f"the feet do not walk together: best agreement {best.height:.3f} over "
            f"{cycles:.1f} gait cycles; needed are {LEAST_PEAK:.3f} and {LEAST_CYCLES:.1f}; "
            f"is this one walk, with a sensor on each foot?{lengths}"
        )
    if MOST_UNEVEN < choice.uneven < float("inf"):
        raise TimingError(
            "the feet do not walk in turn: from step to step they are apart by "
            f"{100.0 * choice.uneven:.1f} % of a cycle; at most {100.0 * MOST_UNEVEN:g} % is one "
            f"walk; are both recordings of the same walk?{lengths}"
        )


def doubts(choice: Choice, left: Signal, right: Signal) -> tuple[str, ...]:
    """Return what makes the choice doubtful, and what to do; nothing where it is sure."""
    if choice.confidence >= DOUBT:
        return ()
    best = choice.middle
    if choice.margin < EVEN_MARGIN:
        why = f"another offset, a cycle of {best.cycle_s:.2f} s or more away, fits nearly as well"
    elif choice.uneven == float("inf"):
        why = "the feet walk together for too short to see whether they do so in turn"
    else:
        why = (
            f"the feet agree by {best.height:.2f} and are apart by {100.0 * choice.uneven:.1f} % "
            "of a cycle from step to step, as those of two walks may be"
        )
    return (
        f"doubtful: {why}; record for longer, with a stop in between, or shake both devices "
        "together first and use the method shake, or the method arrival on a live recording."
        f"{_lengths_apart(best.cycle_s, left, right)}",
    )


def _lengths_apart(cycle_s: float, left: Signal, right: Signal) -> str:
    """Return a further cause, if the walk lasts longer on one clock than on the other."""
    feet = [np.flatnonzero(walking(foot)) for foot in (left, right)]
    one, two = (STEP_S * float(f[-1] - f[0]) if len(f) else 0.0 for f in feet)
    if min(one, two) <= 0.0 or abs(two - one) < LENGTH_CYCLES * cycle_s:
        return ""
    return (
        f" From the first to the last step it is {one:.1f} s on the left foot's clock and "
        f"{two:.1f} s on the right one's: if neither recording is cut, these are two walks or the "
        f"right clock's skew is near {1e6 * (two / one - 1.0):+.0f} ppm, and the gait tells up to "
        f"{1e6 * LARGEST_SKEW:.0f} ppm."
    )

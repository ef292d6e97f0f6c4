"""The cycle at which two feet walk in turn: candidates, their scatter, the choice, its doubts.

No two cycles last equally long.  Where a step is paired with its neighbours of the same walk, the
middle between them hardly moves; a cycle off it moves by what the cycles differ by, and with the
feet of two walks it wanders.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...core import FloatArray, TimingError
from .correlation import STEP_S, Correlation, Signal, correlate_near
from .result import DOUBT

LEAST_PEAK = 0.6  # correlation below which these are not two feet walking
LEAST_CYCLES = 3.0
LARGEST_SCATTER = 0.05  # of a cycle, beyond which the feet do not walk together
DOUBTFUL_SCATTER = 0.016  # of a cycle, that is a confidence of one half
DOUBTFUL_PEAK = 0.8  # correlation that is a confidence of one half
CANDIDATES = 7  # cycles that are compared
EVEN_MARGIN = 2.0  # preference over the next cycle that is a confidence of one half
PER_CYCLE = 2.0  # preference for a cycle's lead in the correlation of the whole
LENGTH_CYCLES = 1.2  # that the walk may be longer on one foot: one begins, one may end
LARGEST_SKEW = 1000e-6  # that is looked for
CYCLE_S = (0.6, 2.5)  # gait cycles that are looked for
WINDOW_S, HOP_S = 4.0, 2.0
LEAST_WINDOWS = 4
LEAST_SPAN_S = 60.0  # of the windows, to tell a skew
MOST_POINTS = 500  # that the line is fitted to; the fit takes their square in memory
KEPT = 0.9  # share of the windows that counts: at a stop one may find nothing
FLOOR = 0.001  # of a cycle; more even than that is not told apart


@dataclass(frozen=True)
class ChosenCycle:
    """The middle that was chosen, and how it compares."""

    offset: CandidateOffset
    second: float
    phase_scatter: float
    margin: float

    @property
    def confidence(self) -> float:
        """0 to 1: told from other cycles, and alike and even enough for feet of one walk."""
        told = self.margin / (self.margin + EVEN_MARGIN)
        even = 1.0 / (1.0 + (self.phase_scatter / DOUBTFUL_SCATTER) ** 4)
        differ = max(1.0 - self.offset.height, 0.0) / (1.0 - DOUBTFUL_PEAK)
        return min(told, even, 1.0 / (1.0 + differ**4))


def walking(foot: Signal) -> np.ndarray:
    """Tell (N,) where the foot walks: where a second's mean is a fifth of a brisk one."""
    second = np.ones(round(1.0 / STEP_S)) * STEP_S
    mean = np.convolve(foot.values, second, mode="same")
    return np.asarray(mean > max(0.2 * float(np.quantile(mean, 0.95)), 0.5))


def choose_cycle(
    left: Signal, right: Signal, correlation: Correlation, walked_s: float
) -> ChosenCycle:
    """Return the candidate that fits best by the whole and by its windows."""
    candidates = candidate_offsets(correlation, CANDIDATES)
    windows = [phase_scatter(left, right, candidate) for candidate in candidates]
    most = max(count for _, count in windows)
    cycles = walked_s / candidates[0].cycle_s

    def preference(index: int) -> float:
        uneven = min(windows[index][0], 1.0)
        # windows overlap by half, so half of them are told apart
        return PER_CYCLE * cycles * candidates[index].height - 0.5 * most * float(np.log(uneven))

    order = sorted(range(len(candidates)), key=preference, reverse=True)
    best = order[0]
    margin = preference(best) - preference(order[1]) if len(order) > 1 else PER_CYCLE * cycles
    second = max((m.height for k, m in enumerate(candidates) if k != best), default=0.0)
    return ChosenCycle(candidates[best], second, windows[best][0], margin)


def check_gait(choice: ChosenCycle, cycles: float, left: Signal, right: Signal) -> None:
    """Raise a TimingError where these are not two feet of one walk."""
    best = choice.offset
    lengths = _explain_lengths(best.cycle_s, left, right)
    if best.height < LEAST_PEAK or cycles < LEAST_CYCLES:
        raise TimingError(
            f"the feet do not walk together: best agreement {best.height:.3f} over "
            f"{cycles:.1f} gait cycles; needed are {LEAST_PEAK:.3f} and {LEAST_CYCLES:.1f}; "
            f"is this one walk, with a sensor on each foot?{lengths}"
        )
    if LARGEST_SCATTER < choice.phase_scatter < float("inf"):
        raise TimingError(
            "the feet do not walk in turn: from step to step they are apart by "
            f"{100.0 * choice.phase_scatter:.1f} % of a cycle; at most "
            f"{100.0 * LARGEST_SCATTER:g} % is one walk; are both recordings of the same walk?"
            f"{lengths}"
        )


def explain_doubt(choice: ChosenCycle, left: Signal, right: Signal) -> tuple[str, ...]:
    """Return what makes the choice doubtful, and what to do; nothing where it is sure."""
    if choice.confidence >= DOUBT:
        return ()
    best = choice.offset
    if choice.margin < EVEN_MARGIN:
        why = f"another offset, a cycle of {best.cycle_s:.2f} s or more away, fits nearly as well"
    elif choice.phase_scatter == float("inf"):
        why = "the feet walk together for too short to see whether they do so in turn"
    else:
        why = (
            f"the feet agree by {best.height:.2f} and are apart by "
            f"{100.0 * choice.phase_scatter:.1f} % of a cycle from step to step, as those of two "
            "walks may be"
        )
    return (
        f"doubtful: {why}; record for longer, with a stop in between, or shake both devices "
        "together first and use the method shake, or the method arrival on a live recording."
        f"{_explain_lengths(best.cycle_s, left, right)}",
    )


def _explain_lengths(cycle_s: float, left: Signal, right: Signal) -> str:
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


@dataclass(frozen=True)
class CandidateOffset:
    """Two neighbouring peaks: the lag between them, their distance (the cycle), mean height."""

    lag_s: float
    cycle_s: float
    height: float


def candidate_offsets(correlation: Correlation, count: int) -> list[CandidateOffset]:
    """Return the middles between neighbouring peaks, the highest first."""
    from scipy.signal import find_peaks

    value = correlation.value
    found, _ = find_peaks(
        value, height=0.5 * float(value.max()), distance=round(CYCLE_S[0] / STEP_S)
    )
    peaks = [correlation.peak(int(i)) for i in found]
    candidates = [
        CandidateOffset(0.5 * (one[0] + two[0]), two[0] - one[0], 0.5 * (one[1] + two[1]))
        for one, two in pairwise(peaks)
        if CYCLE_S[0] <= two[0] - one[0] <= CYCLE_S[1]
    ]
    if not candidates:
        raise TimingError("no gait is seen in the recordings: no two peaks of agreement")
    return sorted(candidates, key=lambda m: -m.height)[:count]


def phase_scatter(left: Signal, right: Signal, whole: CandidateOffset) -> tuple[float, int]:
    """Return by what share of a cycle the windows differ, rms, and how many there are.

    A straight line, a skew, is taken off where they span a minute.  Infinite when there are too
    few windows, or fewer than half of those that walk have a middle.
    """
    points, walking = offsets_of_windows(left, right, whole, WINDOW_S, HOP_S, 1.0)
    if len(points) < max(LEAST_WINDOWS, walking / 2):
        return float("inf"), len(points)
    from scipy.stats import siegelslopes

    time_s, lag = points[:, 0] - points[0, 0], points[:, 1] - whole.lag_s
    if time_s[-1] >= LEAST_SPAN_S:
        few = slice(None, None, 1 + len(lag) // MOST_POINTS)
        lag = lag - siegelslopes(lag[few], time_s[few]).slope * time_s
    squares = np.sort((lag - np.median(lag)) ** 2)[: max(round(KEPT * len(lag)), 1)]
    return max(float(np.sqrt(squares.mean())) / whole.cycle_s, FLOOR), len(points)


def offsets_of_windows(
    left: Signal,
    right: Signal,
    whole: CandidateOffset,
    window_s: float,
    hop_s: float,
    reach_cycles: float,
) -> tuple[FloatArray, int]:
    """Return (right stamp in s, lag in s) (N, 2) of the windows that walk; how many there are."""
    size, hop = round(window_s / STEP_S), round(hop_s / STEP_S)
    reach = round(reach_cycles * whole.cycle_s / STEP_S)
    brisk = 0.5 * float(left.values.mean())
    out, walking = [], 0
    for begin in range(0, len(left.values) - size // 2, hop):
        part = left.part(begin, begin + size)
        at = (part.start_ns - right.start_ns) * 1e-9 - whole.lag_s
        start = round(at / STEP_S)
        if start + size < 0 or start > len(right.values):
            continue
        other = right.part(start - reach, max(start + size + reach, 0))
        if min(len(part.values), len(other.values)) < size // 2 or part.values.mean() <= brisk:
            continue
        walking += 1
        lag = _offset_near(correlate_near(part, other, whole.lag_s, 0.75 * whole.cycle_s), whole)
        if lag is not None:
            out.append((at + 0.5 * window_s + right.start_ns * 1e-9, lag))
    return np.array(out).reshape(-1, 2), walking


def _offset_near(correlation: Correlation, whole: CandidateOffset) -> float | None:
    half = 0.5 * whole.cycle_s
    one = correlation.maximum_near(whole.lag_s - half, 0.5 * half)
    two = correlation.maximum_near(whole.lag_s + half, 0.5 * half)
    return None if one is None or two is None else 0.5 * (one[0] + two[0])

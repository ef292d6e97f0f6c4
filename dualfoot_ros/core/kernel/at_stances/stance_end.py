"""The end of a stance: the constraint at the moment at which one foot has passed the other.

What is to be done is the array ``rule`` (R_SIZE,) of a method; ``learnt`` (L_SIZE,) is what is
known of the spacing.  Whatever is not as usual is left to Python, which asks the method itself.
"""

from ..epoch import rerun, restore
from ..layout import (
    C_PERIOD,
    END_ASK,
    END_DONE,
    END_NO_STEP,
    FOOT,
    L_STATE,
    N_EPOCH,
    N_FLAGS,
    N_FOOT,
    N_LEAVE,
    N_MOMENT,
    N_OLDEST,
    N_RING,
    N_START,
    N_STRIDE,
    N_WINDOW,
    POS,
    R_DISTANCE,
    R_HEIGHT_STD,
    R_KIND,
    R_LATERAL,
    R_LEARNS,
    R_LEFT_ALONE,
    R_LONGEST_S,
    R_ROWS,
    R_SHARE,
    R_SPACING,
    R_STD,
    X_AFTER,
    X_BEFORE,
    X_NIS,
    X_TARGET,
)
from .distance_constraint import constrain_distance
from .landing import snapshot_before
from .separation import length
from .spacing_constraint import constrain_spacing
from .spacing_learner import learn_spacing


def end_stance(w, n, x, rule, learnt, foot, ahead_x, ahead_y, gate, since):
    """Constrain the feet at a moment of the stance of ``foot`` that has ended, and learn from it.

    (ahead_x, ahead_y) is where the person faces.  Returns END_DONE, END_NO_STEP where there is
    nothing to do, or END_ASK: where something has been applied after the moment, ``since`` being
    the newest epoch of that, or where the constraint does not fit, its NIS a row being beyond
    ``gate``.  Then Python goes back itself.
    """
    o = N_FOOT + foot * N_STRIDE
    first = n[o + N_START]
    last = n[o + N_LEAVE] - 1
    moment = share_of_stance(first, last, rule[R_SHARE], lag_of(n[N_WINDOW]))
    n[N_MOMENT] = moment
    if (last - first + 1) * w[C_PERIOD] > rule[R_LONGEST_S] or not has_swung(n, 1 - foot, moment):
        return END_NO_STEP
    target = learnt[L_STATE]
    x[X_TARGET] = target
    if rule[R_KIND] == R_DISTANCE and distance_at(w, n, x, moment) <= target:
        a = x[X_BEFORE]
        b = x[X_BEFORE + 1]
        c = x[X_BEFORE + 2]
        constrain_distance(w, x, target, rule[R_STD], 1, 1, a, b, c)  # there is nothing to do
    else:
        if since > moment:
            return END_ASK
        restore(w, n, moment + 1)
        if not constrain_as(w, x, rule, target, ahead_x, ahead_y, gate):
            return END_ASK
        rerun(w, n, moment + 1, n[N_EPOCH])
    if rule[R_LEARNS] != 0.0:
        learn_spacing(
            learnt, x[X_BEFORE], x[X_BEFORE + 1], x[X_AFTER], x[X_AFTER + 1], ahead_x, ahead_y
        )
    return END_DONE


def has_swung(n, foot, moment):
    """Return whether ``foot`` was in swing at ``moment``, to which the filter can go back."""
    if moment + 1 < n[N_OLDEST] or moment + 1 > n[N_EPOCH]:
        return False
    return not (n[N_FLAGS + moment % n[N_RING]] >> foot) & 1


def lag_of(window: int) -> float:
    """Return by how many epochs a ``window`` of the detector ends after its middle."""
    return 0.5 * (window - 1)


def share_of_stance(first: int, last: int, share: float, lag: float) -> int:
    """Return the epoch at a ``share`` of a stance that the detector, ``lag`` late, has found.

    Eq. (31) of Liu et al. 2023 for kappa; of a half, the even epoch.
    """
    at = (1.0 - share) * first + share * last - lag
    epoch = int(at)
    if epoch > at:
        epoch -= 1
    beyond = at - epoch
    if beyond > 0.5 or (beyond == 0.5 and epoch % 2 == 1):
        epoch += 1
    return epoch


def distance_at(w, n, x, moment):
    """Return the distance of the feet as estimated at ``moment``, m."""
    o = snapshot_before(n, moment + 1) + POS
    for i in range(3):
        x[X_BEFORE + i] = w[o + i] - w[o + FOOT + i]
    return length(x, X_BEFORE)


def constrain_as(w, x, rule, target, ahead_x, ahead_y, gate):
    """Constrain the present state to ``target`` m; return whether that fits."""
    if rule[R_KIND] == R_SPACING:
        lateral = int(rule[R_LATERAL])
        kind = int(rule[R_LEFT_ALONE])
        std = rule[R_STD]
        up = rule[R_HEIGHT_STD]
        nis = constrain_spacing(w, x, ahead_x, ahead_y, target, std, up, lateral, kind)
        return not nis > gate * rule[R_ROWS]
    exceeds = constrain_distance(w, x, target, rule[R_STD], 1, 0, 0.0, 0.0, 0.0)
    return exceeds and not x[X_NIS] > gate

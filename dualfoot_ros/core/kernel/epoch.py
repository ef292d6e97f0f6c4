"""One epoch of the tracker, the loop over many, and the re-run after a roll-back.

Live and batch both go through ``advance``: live with one sample, batch with all of them.  It
stops after every epoch that set a notice, because what a notice asks for (a constraint, a re-run)
is decided by the tracker and not here.
"""

from ..samples.pair_gate import LIMIT
from .covariance import correlated, propagate_foot
from .detector import detect
from .floor import carry, floor_moves, watch_floor
from .layout import (
    C_PERIOD,
    C_WATCH,
    FLAG_STILL,
    FOOT,
    N_EPOCH,
    N_FLAGS,
    N_LONGEST,
    N_NOTICE,
    N_OLDEST,
    N_PAIRS,
    N_RING,
    N_UNEVEN,
    NOT_TAKEN,
    NOTICE_FLOOR,
    NOTICE_SHIFT,
    NOTICE_STOOD,
    NOTICE_WATCH,
    PLACE,
    POS,
    RINGS,
    S_CDT,
    S_SF,
    SAMPLE,
    STATE,
    TAKEN,
    TO_ATTEND,
    TRACKED,
    WALKED,
    Z_LEFT,
    ZUPT_INFO,
)
from .outputs.kept_row import keep
from .outputs.output_row import (
    collect_stand,
    emit,
    missing,
    squared_distance,
    stands,
    tell,
    watch_presence,
)
from .strapdown import mechanize, orthonormalise
from .zero_velocity import zupt

NEARLY_EVEN_S = 0.7e-3  # by which an interval that is nearly the nominal one may differ from it
ORTHONORMAL_EVERY = 32768  # epochs, over which rounding turns an attitude by 1e-13


def coupled_feet(w):
    """Return whether the cross block of P matters: it is not zero, or a moving floor fills it."""
    return floor_moves(w) or correlated(w)


def filter_epoch(w, n, epoch, coupled):
    """Run the filter over a stored epoch: eqs (1)-(3), (7)-(11) and, in stance, (12).

    Both feet are propagated before either is corrected: a correction moves both.  ``coupled`` is
    what `coupled_feet` found; no epoch changes it.
    """
    i = epoch % n[N_RING]
    sample = RINGS + SAMPLE * i
    dt = w[sample]
    flags = n[N_FLAGS + i]
    still = flags // FLAG_STILL
    for foot in range(2):
        if missing(w, sample + 1 + 6 * foot):
            hold(w, foot, dt, coupled)
            continue
        o = foot * FOOT + POS
        x = w[o]
        y = w[o + 1]
        z = w[o + 2]
        mechanize(w, foot, dt, sample + 1 + 6 * foot)  # eqs (1)-(3)
        propagate_foot(w, foot, dt, coupled)  # eqs (7)-(11), with the attitude before the step
        if (still >> foot) & 1:  # a standing foot stays where it is
            w[o] = x
            w[o + 1] = y
            w[o + 2] = z
    w[TRACKED] += dt
    if flags % FLAG_STILL != 3:  # one foot swings
        w[WALKED] += dt
    for foot in range(2):
        if (flags >> foot) & 1:
            zupt(w, foot, (still >> foot) & 1 == 1, coupled)  # eq. (12)
        else:
            for k in range(ZUPT_INFO):
                w[Z_LEFT + foot * ZUPT_INFO + k] = 0.0
    if floor_moves(w):
        carry(w, dt)
    if epoch % ORTHONORMAL_EVERY == ORTHONORMAL_EVERY - 1:
        orthonormalise(w, 0)
        orthonormalise(w, 1)


def hold(w, foot, dt, coupled):
    """Keep a foot without samples where it is; its position becomes as uncertain as its speed."""
    for i in range(9):
        w[S_CDT + i] = 0.0
    for i in range(3):
        w[S_SF + i] = 0.0
    propagate_foot(w, foot, dt, coupled)


def save(w, n, epoch):
    """Keep a snapshot of the state before ``epoch``."""
    ring = n[N_RING]
    o = (RINGS + SAMPLE * ring + STATE * (epoch % ring)) & PLACE
    for k in range(STATE):
        w[o + k] = w[k]


def restore(w, n, epoch):
    """Go back to the state before ``epoch``; it must not be older than n[N_OLDEST]."""
    ring = n[N_RING]
    o = (RINGS + SAMPLE * ring + STATE * (epoch % ring)) & PLACE
    for k in range(STATE):
        w[k] = w[o + k]


def set_flags(n, foot, first, last, value):
    """Set or clear the zero-velocity flag of ``foot`` over the stored epochs first..last."""
    for epoch in range(first, last + 1):
        i = N_FLAGS + epoch % n[N_RING]
        if value:
            n[i] = n[i] | (1 << foot)
        else:
            n[i] = n[i] & ~(1 << foot)


def rerun(w, n, first, last):
    """Run the filter again over the stored epochs first..last, renewing the snapshots."""
    coupled = coupled_feet(w)
    for epoch in range(first, last + 1):
        save(w, n, epoch)
        filter_epoch(w, n, epoch, coupled)


def begin(w, n, ring_stamps, stamp, dt):
    """Begin the next epoch, ``dt`` s after the one before; return where its sample belongs.

    Its ``stamp`` is kept in the ring ``ring_stamps``.
    """
    ring = n[N_RING]
    epoch = n[N_EPOCH] + 1
    n[N_EPOCH] = epoch
    if epoch - n[N_OLDEST] >= ring:
        n[N_OLDEST] = epoch - ring + 1
    i = epoch % ring
    ring_stamps[i] = stamp
    if abs(dt - w[C_PERIOD]) > NEARLY_EVEN_S:
        n[N_UNEVEN] = epoch
    o = RINGS + SAMPLE * i
    w[o] = dt
    return o


def run_newest(w, n, o, coupled):
    """Run the newest epoch, whose sample is at ``o``, and set n[N_NOTICE]."""
    epoch = n[N_EPOCH]
    save(w, n, epoch)  # the state before the epoch: where a roll-back begins
    presence = watch_presence(w, n, 0, o + 1) | watch_presence(w, n, 1, o + 7)
    left, left_notice = detect(w, n, 0)
    right, right_notice = detect(w, n, 1)
    flags = 0
    if left:
        flags = 1 + FLAG_STILL * stands(n, 0)
    if right:
        flags += 2 + 2 * FLAG_STILL * stands(n, 1)
    n[N_FLAGS + epoch % n[N_RING]] = flags
    n[N_NOTICE] = left_notice | (right_notice << NOTICE_SHIFT) | presence
    for foot in range(2):
        if collect_stand(w, foot, (flags // FLAG_STILL >> foot) & 1, o):
            n[N_NOTICE] = n[N_NOTICE] | (NOTICE_STOOD << foot)
    filter_epoch(w, n, epoch, coupled)
    if watch_floor(w, n, w[o]):
        n[N_NOTICE] = n[N_NOTICE] | NOTICE_FLOOR
    if squared_distance(w) > w[C_WATCH]:
        n[N_NOTICE] = n[N_NOTICE] | NOTICE_WATCH


def advance(
    w, n, ring_stamps, stamps, left_force, left_rate, right_force, right_rate, start, stop,
    left, right, nis, nothing, covariances,
    left_pos, left_vel, left_att, right_pos, right_vel, right_att, relative,
):  # fmt: skip
    """Run the epochs of samples ``start..stop-1``; sample ``start`` follows the one before it.

    ``stamps`` (N,) are in ns, forces and rates (N, 3).  Each epoch writes its row of what a
    trajectory keeps (`keep`), and keeps its stamp in ``ring_stamps``.  Returns the index after the
    last epoch that was run: ``stop``, or earlier when one set n[N_NOTICE].
    """
    coupled = coupled_feet(w)
    for k in range(start, stop):
        o = begin(w, n, ring_stamps, stamps[k], (stamps[k] - stamps[k - 1]) * 1e-9)
        for j in range(3):
            w[o + 1 + j] = left_force[k, j]
            w[o + 4 + j] = left_rate[k, j]
            w[o + 7 + j] = right_force[k, j]
            w[o + 10 + j] = right_rate[k, j]
        run_newest(w, n, o, coupled)
        keep(
            w, n, k, left, right, nis, nothing, covariances,
            left_pos, left_vel, left_att, right_pos, right_vel, right_att, relative,
        )  # fmt: skip
        if n[N_NOTICE] != 0:
            return k + 1
    return stop


def step(w, n, ring_stamps, stamp, dt, sample, told):
    """Run the epoch of one ``sample`` (12,), and write all that is told of it to ``told``.

    Returns whether that is the end of it: all of ``told`` (1, TOLD) is numbers, and no notice is
    set.
    """
    o = begin(w, n, ring_stamps, stamp, dt)
    for j in range(12):
        w[o + 1 + j] = sample[j]
    run_newest(w, n, o, coupled_feet(w))
    emit(w, n, told, 0)
    return tell(w, told) and n[N_NOTICE] == 0


def take_pair(w, n, ring_stamps, stamp, sample, told):
    """Run the epoch of a pair that just follows the one before, as `step` does.

    That is one in order, without a hole before it, with every value in range.  Returns TAKEN when
    that is the end of it, TO_ATTEND when `step` says that it is not, and NOT_TAKEN for any other
    pair, with which nothing is done.
    """
    last = ring_stamps[n[N_EPOCH] % n[N_RING]]
    if n[N_EPOCH] < 0 or stamp <= last or stamp - n[N_LONGEST] > last:
        return NOT_TAKEN
    good = 0
    for j in range(12):
        if abs(sample[j]) < LIMIT:
            good += 1
    if good != 12:
        return NOT_TAKEN
    n[N_PAIRS] += 1
    dt = (stamp - last) * 1e-9
    return TAKEN if step(w, n, ring_stamps, stamp, dt, sample, told) else TO_ATTEND

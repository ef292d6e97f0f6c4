"""What an epoch is watched for: feet that go missing, that stand, that are far apart."""

from .layout import (
    A_COUNT,
    A_FOOT,
    A_SECONDS,
    A_SQUARES,
    A_STRIDE,
    A_SUM,
    FOOT,
    N_BACK,
    N_EPOCH,
    N_FOOT,
    N_GONE,
    N_START,
    N_STILL,
    N_STRIDE,
    NOTICE_BACK,
    NOTICE_GONE,
    POS,
    STOOD_S,
)


def missing(w, sample):
    """Return whether the sample of a foot at index ``sample`` is not there: nan."""
    return w[sample] != w[sample]


def watch_presence(w, n, foot, sample):
    """Take note whether ``foot`` has a sample; return the notice of a change."""
    o = N_FOOT + foot * N_STRIDE
    gone = missing(w, sample)
    if gone and n[o + N_GONE] == 0:
        n[o + N_GONE] = 1
        return NOTICE_GONE << foot
    if not gone and n[o + N_GONE] == 1:
        n[o + N_GONE] = 0
        n[o + N_BACK] = n[N_EPOCH]
        return NOTICE_BACK << foot
    return 0


def collect_stand(w, foot, standing, o):
    """Take the sample at ``o`` into the window of a standing foot; return whether it is full.

    Whoever reads a full window sets its length to zero.
    """
    a = A_FOOT + foot * A_STRIDE
    if standing == 0 or w[a + A_SECONDS] == 0.0:
        for k in range(A_STRIDE):
            w[a + k] = 0.0
    if standing == 0:
        return False
    w[a + A_SECONDS] += w[o]
    w[a + A_COUNT] += 1.0
    for k in range(3):
        rate = w[o + 4 + 6 * foot + k]
        w[a + A_SUM + k] += rate
        w[a + A_SQUARES + k] += rate * rate
    return w[a + A_SECONDS] >= STOOD_S


def stands(n, foot):
    """Return 1 when the stance of ``foot`` has lasted long enough to be a standstill, else 0."""
    if n[N_EPOCH] - n[N_FOOT + foot * N_STRIDE + N_START] >= n[N_STILL]:
        return 1
    return 0


def squared_distance(w):
    """Return the squared distance of the feet, m^2."""
    x = w[POS] - w[FOOT + POS]
    y = w[POS + 1] - w[FOOT + POS + 1]
    z = w[POS + 2] - w[FOOT + POS + 2]
    return x * x + y * y + z * z

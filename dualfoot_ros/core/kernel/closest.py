"""The least correction that brings the separation of the feet to a given distance.

Liu et al. 2023, eqs (14), (15): the minimiser is r = (I + mu P)^-1 r0 with |r| (1 - mu s^2) = c0,
one monotone equation in mu, solved in the principal axes of P.  ``x`` (M_SIZE,) holds everything,
so that nothing is allocated.
"""

import math

from .layout import M_ALONG, M_AT, M_AXES, M_DIRECTION, M_NOISE, M_P, M_PUSH, M_R, M_VARIANCES

SWEEPS = 10  # of Jacobi's rotations
STEPS = 200  # of Newton's method, at most


def closest(x, c0, std):
    """Write the row, innovation and noise that move the state to the minimiser of eq. (14).

    ``x`` holds r with |r| > c0 and P; P is overwritten.  A hard c0 (``std`` zero) that the
    uncertain directions cannot reach gives a zero row: nothing is done.
    """
    principal_axes(x)
    for k in range(3):
        a = M_AXES + 3 * k
        x[M_ALONG + k] = x[a] * x[M_R] + x[a + 1] * x[M_R + 1] + x[a + 2] * x[M_R + 2]
        x[M_DIRECTION + k] = 0.0
    x[M_PUSH] = 0.0
    x[M_NOISE] = 1.0
    mu = multiplier(x, c0, std)
    if mu < 0.0:
        return
    damp(x, mu)
    length = norm(x, M_AT)
    s = 0.0
    for k in range(3):
        share = x[M_AT + k] / length
        s += x[M_VARIANCES + k] * (share * share)
    s += std * std
    for i in range(3):
        total = 0.0
        for k in range(3):
            total += x[M_AT + k] * x[M_AXES + 3 * k + i]
        x[M_DIRECTION + i] = total / length
    x[M_PUSH] = mu * length * s
    x[M_NOISE] = std * std


def multiplier(x, c0, std):
    """Solve |(I + mu P)^-1 r| (1 - mu s^2) = c0 for mu >= 0; -1 when a hard c0 is out of reach.

    The left side falls monotonically from |r| > c0, so a bracket and Newton steps kept inside it
    always end.  Out of reach is a c0 when too much of r is along certain axes.
    """
    noise = std * std
    stuck = 0.0
    most = 1e-15
    for k in range(3):
        most = max(most, x[M_VARIANCES + k])
        if x[M_VARIANCES + k] == 0.0:
            stuck += x[M_ALONG + k] * x[M_ALONG + k]
    if noise == 0.0 and math.sqrt(stuck) >= c0:
        return -1.0
    low = 0.0
    high = 1.0 / noise if noise > 0.0 else math.inf
    mu = min((norm(x, M_ALONG) - c0) / (c0 * most), 0.5 * high)
    for _ in range(STEPS):
        damp(x, mu)
        length = norm(x, M_AT)
        value = length * (1.0 - mu * noise) - c0
        if abs(value) <= 1e-14 * c0:
            break
        if value > 0.0:
            low = mu
        else:
            high = mu
        fall = 0.0
        for k in range(3):
            at = x[M_AT + k]
            fall += x[M_VARIANCES + k] * at * at / (1.0 + mu * x[M_VARIANCES + k])
        slope = fall / length * (1.0 - mu * noise) + length * noise
        step = mu + value / slope if slope > 0.0 else math.inf
        previous = mu
        between = 2.0 * mu if high == math.inf else 0.5 * (low + high)
        mu = step if low < step < high else between
        if mu == previous:
            break
    return mu


def damp(x, mu):
    """Write (I + mu P)^-1 r0 in the principal axes of P to M_AT."""
    for k in range(3):
        x[M_AT + k] = x[M_ALONG + k] / (1.0 + mu * x[M_VARIANCES + k])


def norm(x, start):
    """Return the length of the vector (3,) at ``start``."""
    return math.sqrt(
        x[start] * x[start] + x[start + 1] * x[start + 1] + x[start + 2] * x[start + 2]
    )


def principal_axes(x):
    """Write the variances (3,) along the principal axes of P, and the axes, one a row.

    Jacobi's rotations; what is negligible against the greatest variance is zero.
    """
    for k in range(9):
        x[M_AXES + k] = 1.0 if k % 4 == 0 else 0.0
    for _ in range(SWEEPS):
        jacobi(x, 0, 1)
        jacobi(x, 0, 2)
        jacobi(x, 1, 2)
    least = 1e-12 * max(x[M_P], x[M_P + 4], x[M_P + 8])
    for k in range(3):
        v = x[M_P + 4 * k]
        x[M_VARIANCES + k] = v if v > least else 0.0


def jacobi(x, i, j):
    """Rotate P so that its element (i, j) vanishes, and the axes with it."""
    own = M_P + 4 * i
    other = M_P + 4 * j
    mixed = x[M_P + 3 * i + j]
    if abs(mixed) <= 1e-18 * (abs(x[own]) + abs(x[other])):
        return
    theta = 0.5 * (x[other] - x[own]) / mixed
    t = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1.0))
    c = 1.0 / math.sqrt(t * t + 1.0)
    s = t * c
    for k in range(3):
        turn_pair(x, M_P + 3 * k + i, M_P + 3 * k + j, c, s)
    for k in range(3):
        turn_pair(x, M_P + 3 * i + k, M_P + 3 * j + k, c, s)
        turn_pair(x, M_AXES + 3 * i + k, M_AXES + 3 * j + k, c, s)


def turn_pair(x, a, b, c, s):
    """Replace the numbers at ``a`` and ``b`` by c a - s b and s a + c b."""
    first = x[a]
    second = x[b]
    x[a] = c * first - s * second
    x[b] = s * first + c * second

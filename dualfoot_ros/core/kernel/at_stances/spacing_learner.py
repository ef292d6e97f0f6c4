"""One passing for the filter that learns the spacing of the feet, in closed form.

Its states are the spacing s, the placement a (2,) and the advance d of one foot a passing, as
`core.constraints.learnt_spacing` has them.  The array ``x`` (L_SIZE,) holds all that it knows.
"""

from ..layout import L_AFTER, L_BEGUN, L_COVARIANCE, L_FREE, L_STATE

WANDER = 0.03 * 0.03  # m^2, of the placement from one passing to the next
ACROSS = 0.04 * 0.04  # m^2, of a passing across the walk
ALONG = 0.1 * 0.1  # m^2, along it
STATES = 4


def learn_spacing(x, before_x, before_y, after_x, after_y, c, s):
    """Take the separation before and after the constraint of a passing, ahead being (c, s)."""
    if x[L_BEGUN] == 0.0:
        x[L_BEGUN] = 1.0
        x[L_FREE] = before_x
        x[L_FREE + 1] = before_y
    else:
        x[L_FREE] += before_x - x[L_AFTER]
        x[L_FREE + 1] += before_y - x[L_AFTER + 1]
    x[L_AFTER] = after_x
    x[L_AFTER + 1] = after_y
    u = x[L_FREE]
    v = x[L_FREE + 1]
    go_on(x, c, s)
    learn(x, 1.0, -s, c, c * v - s * u, ACROSS)
    learn(x, 0.0, c, s, c * u + s * v, ALONG)


def go_on(x, c, s):
    """Let the placement run along the walk, whose direction is (c, s), and wander."""
    ahead = x[L_STATE + 3]
    x[L_STATE + 1] += c * ahead
    x[L_STATE + 2] += s * ahead
    last = L_COVARIANCE + STATES * 3
    for j in range(STATES):
        x[L_COVARIANCE + STATES + j] += c * x[last + j]
        x[L_COVARIANCE + STATES * 2 + j] += s * x[last + j]
    for i in range(STATES):
        row = L_COVARIANCE + STATES * i
        x[row + 1] += c * x[row + 3]
        x[row + 2] += s * x[row + 3]
    x[L_COVARIANCE + STATES + 1] += WANDER
    x[L_COVARIANCE + STATES * 2 + 2] += WANDER
    make_symmetric(x)


def learn(x, a, b, c, value, noise):
    """Update with ``value``, which a s + (b, c) a is but for ``noise`` m^2."""
    g0 = covariance_with(x, 0, a, b, c)
    g1 = covariance_with(x, 1, a, b, c)
    g2 = covariance_with(x, 2, a, b, c)
    g3 = covariance_with(x, 3, a, b, c)
    variance = a * g0 + b * g1 + c * g2 + noise
    expected = a * x[L_STATE] + b * x[L_STATE + 1] + c * x[L_STATE + 2]
    push = (value - expected) / variance
    correct_state(x, 0, g0, push, g0, g1, g2, g3, variance)
    correct_state(x, 1, g1, push, g0, g1, g2, g3, variance)
    correct_state(x, 2, g2, push, g0, g1, g2, g3, variance)
    correct_state(x, 3, g3, push, g0, g1, g2, g3, variance)
    make_symmetric(x)


def covariance_with(x, i, a, b, c):
    """Return the covariance of state ``i`` with a s + (b, c) a."""
    row = L_COVARIANCE + STATES * i
    return x[row] * a + x[row + 1] * b + x[row + 2] * c


def correct_state(x, i, g, push, g0, g1, g2, g3, variance):
    """Correct state ``i``, whose covariance with the measurement is ``g``, and its row of P."""
    x[L_STATE + i] += g * push
    gain = g / variance
    row = L_COVARIANCE + STATES * i
    x[row] -= gain * g0
    x[row + 1] -= gain * g1
    x[row + 2] -= gain * g2
    x[row + 3] -= gain * g3


def make_symmetric(x):
    """Copy the upper triangle of P onto the lower one."""
    for i in range(STATES):
        for j in range(i + 1, STATES):
            x[L_COVARIANCE + STATES * j + i] = x[L_COVARIANCE + STATES * i + j]

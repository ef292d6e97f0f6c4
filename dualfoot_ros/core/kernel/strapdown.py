"""Strapdown mechanization of one foot, eqs (1)-(3) of Liu et al. 2023, in a frame with z up.

The paper writes north-east-down with g = (0, 0, +g); here z points up, so g = (0, 0, -g) and the
equations are otherwise unchanged (they are the same in any level frame).
"""

import math

from .layout import (
    ALPHA,
    BA,
    BG,
    C_FOOT,
    C_GRAVITY,
    C_INCREMENTS,
    C_STRIDE,
    COMPENSATED,
    FOLLOWS,
    FOOT,
    FORCE,
    GAMMA,
    POS,
    RATE,
    ROT,
    S_ALPHA,
    S_CDT,
    S_GAMMA,
    S_ROTATION,
    S_SF,
    S_TMP,
    SAMPLED,
    VEL,
)


def rotation_increment(w, x, y, z):
    """Write exp([r x]) of the rotation vector (x, y, z) rad to S_ROTATION, as in eq. (1)."""
    q = x * x + y * y + z * z
    if q < 0.49:  # series: the same bits on every platform
        # sin(r) / r and (1 - cos(r)) / r^2 in q = r^2, to the last bit for r < 0.7 rad
        a = 1.0 - q * (1.0 / 210.0)
        a = 1.0 - q * (1.0 / 156.0) * a
        a = 1.0 - q * (1.0 / 110.0) * a
        a = 1.0 - q * (1.0 / 72.0) * a
        a = 1.0 - q * (1.0 / 42.0) * a
        a = 1.0 - q * (1.0 / 20.0) * a
        a = 1.0 - q * (1.0 / 6.0) * a
        b = 1.0 - q * (1.0 / 240.0)
        b = 1.0 - q * (1.0 / 182.0) * b
        b = 1.0 - q * (1.0 / 132.0) * b
        b = 1.0 - q * (1.0 / 90.0) * b
        b = 1.0 - q * (1.0 / 56.0) * b
        b = 1.0 - q * (1.0 / 30.0) * b
        b = 1.0 - q * (1.0 / 12.0) * b
        b = 0.5 * b
    else:
        r = math.sqrt(q)
        a = math.sin(r) / r
        b = (1.0 - math.cos(r)) / q
    w[S_ROTATION + 0] = 1.0 - b * (y * y + z * z)
    w[S_ROTATION + 1] = b * x * y - a * z
    w[S_ROTATION + 2] = b * x * z + a * y
    w[S_ROTATION + 3] = b * x * y + a * z
    w[S_ROTATION + 4] = 1.0 - b * (x * x + z * z)
    w[S_ROTATION + 5] = b * y * z - a * x
    w[S_ROTATION + 6] = b * x * z - a * y
    w[S_ROTATION + 7] = b * y * z + a * x
    w[S_ROTATION + 8] = 1.0 - b * (x * x + y * y)


def rotate_body(w, foot):
    """Right-multiply R_nb of ``foot`` by S_ROTATION (a rotation of the body)."""
    r = foot * FOOT + ROT
    for i in range(3):
        for j in range(3):
            w[S_TMP + 3 * i + j] = (
                w[r + 3 * i] * w[S_ROTATION + j]
                + w[r + 3 * i + 1] * w[S_ROTATION + 3 + j]
                + w[r + 3 * i + 2] * w[S_ROTATION + 6 + j]
            )
    for i in range(9):
        w[r + i] = w[S_TMP + i]


def orthonormalise(w, foot):
    """Take the rounding errors of many steps off R_nb of ``foot``: R (3 I - R' R) / 2."""
    r = foot * FOOT + ROT
    for i in range(3):
        for j in range(3):
            total = w[r + i] * w[r + j] + w[r + 3 + i] * w[r + 3 + j]
            w[S_ROTATION + 3 * i + j] = -0.5 * (total + w[r + 6 + i] * w[r + 6 + j])
        w[S_ROTATION + 4 * i] += 1.5
    rotate_body(w, foot)


def rotate_navigation(w, foot):
    """Left-multiply R_nb of ``foot`` by S_ROTATION (a rotation of the navigation frame)."""
    r = foot * FOOT + ROT
    for i in range(3):
        for j in range(3):
            w[S_TMP + 3 * i + j] = (
                w[S_ROTATION + 3 * i] * w[r + j]
                + w[S_ROTATION + 3 * i + 1] * w[r + 3 + j]
                + w[S_ROTATION + 3 * i + 2] * w[r + 6 + j]
            )
    for i in range(9):
        w[r + i] = w[S_TMP + i]


def increments(w, foot, dt, sample):
    """Write the rotation and velocity increments of an interval to S_ALPHA and S_GAMMA.

    ``sample`` is the index in ``w`` of specific force (m/s^2) and angular rate (rad/s), 3 + 3.
    Values held over the interval are taken times dt; values at the instants ("sampled") by the
    trapezoid with those before.
    """
    o = foot * FOOT
    trapezoid = w[C_FOOT + foot * C_STRIDE + C_INCREMENTS] == SAMPLED and w[o + FOLLOWS] == 1.0
    for i in range(3):
        force = w[sample + i] - w[o + BA + i]
        rate = w[sample + 3 + i] - w[o + BG + i]
        if trapezoid:
            w[S_GAMMA + i] = 0.5 * (w[o + FORCE + i] + force) * dt
            w[S_ALPHA + i] = 0.5 * (w[o + RATE + i] + rate) * dt
        else:
            w[S_GAMMA + i] = force * dt
            w[S_ALPHA + i] = rate * dt
        w[o + FORCE + i] = force
        w[o + RATE + i] = rate
    w[o + FOLLOWS] = 1.0


def mechanize(w, foot, dt, sample):
    """Advance position, velocity and attitude of ``foot`` by one sample, eqs (1)-(3).

    ``sample`` is the index in ``w`` of specific force (m/s^2) and angular rate (rad/s), 3 + 3.
    Leaves R_nb dt in S_CDT and the velocity increment in navigation axes in S_SF, both of the
    attitude before the step, for the covariance.
    """
    o = foot * FOOT
    increments(w, foot, dt, sample)
    # gamma_k and alpha_k, and those of the interval before
    gx = w[S_GAMMA]
    gy = w[S_GAMMA + 1]
    gz = w[S_GAMMA + 2]
    ax = w[S_ALPHA]
    ay = w[S_ALPHA + 1]
    az = w[S_ALPHA + 2]
    px = w[o + ALPHA]
    py = w[o + ALPHA + 1]
    pz = w[o + ALPHA + 2]
    qx = w[o + GAMMA]
    qy = w[o + GAMMA + 1]
    qz = w[o + GAMMA + 2]
    kind = w[C_FOOT + foot * C_STRIDE + C_INCREMENTS]
    if kind == COMPENSATED:
        # the sensor has compensated coning and sculling: held constant, its rate and force give
        # its increments, so v_sf = [I + (1 - cos a)/a^2 [alpha x] + (1 - sin a/a)/a^2 [alpha x]^2]
        # gamma, and nothing goes across samples
        t = 0.0
        held_velocity(w, ax, ay, az, gx, gy, gz)
        sx = w[S_TMP]
        sy = w[S_TMP + 1]
        sz = w[S_TMP + 2]
    else:
        # v_sf of eq. (2): rotation within the interval, and the two-sample sculling term; twice of
        # it where trapezoids cut the corners of the motion, by dt^2 / 12 of its second derivative
        t = 1.0 / 6.0 if kind == SAMPLED else 1.0 / 12.0
        sx = gx + 0.5 * (ay * gz - az * gy) + t * (py * gz - pz * gy + qy * az - qz * ay)
        sy = gy + 0.5 * (az * gx - ax * gz) + t * (pz * gx - px * gz + qz * ax - qx * az)
        sz = gz + 0.5 * (ax * gy - ay * gx) + t * (px * gy - py * gx + qx * ay - qy * ax)
    for i in range(9):
        w[S_CDT + i] = w[o + ROT + i] * dt
    for i in range(3):  # R_nb of the epoch before, as in eq. (2)
        r = o + ROT + 3 * i
        w[S_SF + i] = w[r] * sx + w[r + 1] * sy + w[r + 2] * sz
    for i in range(3):  # eqs (2), (3)
        before = w[o + VEL + i]
        after = before + w[S_SF + i]
        if i == 2:
            after = after - w[C_GRAVITY] * dt
        w[o + VEL + i] = after
        w[o + POS + i] = w[o + POS + i] + 0.5 * (before + after) * dt
    # eq. (1), rho with the two-sample coning term
    rotation_increment(
        w,
        ax + t * (py * az - pz * ay),
        ay + t * (pz * ax - px * az),
        az + t * (px * ay - py * ax),
    )
    rotate_body(w, foot)
    w[o + ALPHA] = ax
    w[o + ALPHA + 1] = ay
    w[o + ALPHA + 2] = az
    w[o + GAMMA] = gx
    w[o + GAMMA + 1] = gy
    w[o + GAMMA + 2] = gz


def held_velocity(w, ax, ay, az, gx, gy, gz):
    """Write to S_TMP the velocity increment of force and rate that are constant in the body.

    (ax, ay, az) rad is the rotation and (gx, gy, gz) m/s the force times the interval; the result
    is in the axes at the start of the interval.
    """
    q = ax * ax + ay * ay + az * az
    if q < 0.49:  # series: the same bits on every platform
        b = 0.5 - q / 24.0 * (1.0 - q / 30.0 * (1.0 - q / 56.0 * (1.0 - q / 90.0)))
        c = (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0)))) / 6.0
    else:
        r = math.sqrt(q)
        b = (1.0 - math.cos(r)) / q
        c = (1.0 - math.sin(r) / r) / q
    ux = ay * gz - az * gy
    uy = az * gx - ax * gz
    uz = ax * gy - ay * gx
    w[S_TMP] = gx + b * ux + c * (ay * uz - az * uy)
    w[S_TMP + 1] = gy + b * uy + c * (az * ux - ax * uz)
    w[S_TMP + 2] = gz + b * uz + c * (ax * uy - ay * ux)

"""Hard iron: it parts from the earth's field as soon as the walk has turned, drift or not."""

import math

import numpy as np
import pytest

from dualfoot_ros.core import about_z
from dualfoot_ros.core.aids.field import NavigationField
from dualfoot_ros.core.aids.hard_iron import HardIron

EARTH = np.array([18e-6, 4e-6, -45e-6])
NEAR = NavigationField(*EARTH)
IRON = np.array([0.8e-6, -0.6e-6, 0.0])
SECOND = 1_000_000_000


def learnt(headings, drift=0.0, iron=IRON, noise=0.2e-6):
    """Return what stances at these headings, one a second, tell."""
    found, rng = HardIron(), np.random.default_rng(0)
    for k, heading in enumerate(headings):
        true = about_z(heading)
        measured = true.T @ EARTH + iron + noise * rng.standard_normal(3)
        found.add(k * SECOND, about_z(heading - drift * k), measured, NEAR)
    return found


def test_iron_is_found_on_a_walk_that_turns():
    found = learnt(np.linspace(0.0, 4.0 * math.pi, 200))
    assert found.known
    assert np.allclose(found.tesla[:2], IRON[:2], atol=0.15e-6)


@pytest.mark.parametrize("drift", (-1e-3, 1e-3))
def test_a_heading_that_drifts_is_not_taken_for_iron(drift):
    found = learnt(np.repeat([0.0, math.pi / 2, math.pi, -math.pi / 2], 60), drift, np.zeros(3))
    assert found.known
    assert np.abs(found.tesla[:2]).max() < 0.3e-6


def test_on_a_straight_line_iron_stays_unknown():
    found = learnt(np.zeros(300))
    assert not found.known and not found.tesla.any()


def test_the_field_without_iron_is_the_earths():
    found = learnt(np.linspace(0.0, 4.0 * math.pi, 200))
    assert found.field.angle == pytest.approx(NEAR.angle, abs=0.02)

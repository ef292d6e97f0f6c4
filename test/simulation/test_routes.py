"""Routes are lines of stated length whose heading is the direction of the line."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.simulation import ROUTES, SimulationError, route
from dualfoot_ros.simulation.routes import Route, arc, stairs, straight

WALKED = [name for name in ROUTES if name != "standing"]


@pytest.mark.parametrize("name", WALKED)
def test_the_heading_is_the_direction_in_which_the_line_goes(name):
    line = route(name)
    progress = np.linspace(0.01, line.length - 0.01, 400)
    step = 1e-5
    zero = np.zeros_like(progress)
    moved = line.point(progress + step, zero) - line.point(progress - step, zero)
    heading = line.heading(progress)
    along = moved[:, 0] * np.cos(heading) + moved[:, 1] * np.sin(heading)
    across = -moved[:, 0] * np.sin(heading) + moved[:, 1] * np.cos(heading)
    np.testing.assert_allclose(along, 2 * step, rtol=1e-4)
    np.testing.assert_allclose(across, 0.0, atol=1e-8)


@pytest.mark.parametrize("name", [name for name, kind in ROUTES.items() if kind.build().closed])
def test_a_closed_route_ends_where_it_starts(name):
    line = route(name)
    end = line.point(np.array([line.length]), np.zeros(1))[0]
    np.testing.assert_allclose(end, 0.0, atol=1e-9)
    assert np.cos(line.heading(np.array([line.length])))[0] == pytest.approx(1.0)


def test_the_track_is_400_m_and_the_city_route_1100_m_long():
    assert route("track").length == pytest.approx(400.0)
    assert route("city").length == pytest.approx(1100.0)


def test_the_city_route_neither_closes_nor_turns_round():
    line = route("city")
    progress = np.linspace(0.0, line.length, 2000)
    points = line.point(progress, np.zeros_like(progress))
    assert np.linalg.norm(points[-1] - points[0]) > 600.0
    assert np.all(np.cos(line.heading(progress)) > 0.0)


def test_each_tread_of_a_flight_is_one_riser_above_the_one_before():
    line = Route((straight(2.0), stairs(5, 0.17), straight(1.0)))
    treads = line.floor(2.0 + 0.3 * np.arange(6) + 0.05)
    np.testing.assert_allclose(np.diff(treads), 0.17, atol=1e-12)
    assert line.floor(np.array([0.5]))[0] == 0.0
    assert line.floor(np.array([3.9]))[0] == pytest.approx(5 * 0.17)


@given(radius=st.floats(0.5, 50.0), degrees=st.floats(-350.0, 350.0), lateral=st.floats(-0.4, 0.4))
def test_a_line_beside_an_arc_keeps_its_distance_from_the_centre(radius, degrees, lateral):
    line = Route((arc(radius, degrees),))
    progress = np.linspace(0.0, line.length, 7)
    sign = 1.0 if degrees >= 0 else -1.0
    points = line.point(progress, np.full(7, lateral))
    distance = np.linalg.norm(points - [0.0, sign * radius], axis=1)
    expected = radius - sign * lateral if line.length > 0 else distance
    np.testing.assert_allclose(distance, expected, atol=1e-9)


def test_laps_multiply_the_length_of_a_closed_route():
    assert route("rectangle", 3).length == pytest.approx(3 * route("rectangle").length)


def test_an_open_route_cannot_be_repeated():
    with pytest.raises(SimulationError, match="laps is 2, but the route is open"):
        route("city", 2)


def test_an_unknown_route_is_refused_with_the_known_ones():
    with pytest.raises(SimulationError, match="route is 'moon'; allowed is one of straight"):
        route("moon")

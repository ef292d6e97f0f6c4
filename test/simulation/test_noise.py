"""Random processes of the simulator."""

import numpy as np
import pytest
from scipy.signal import lfilter

from dualfoot_ros.simulation.noise import gauss_markov


@pytest.mark.parametrize("keep", [0.0, 0.7, 0.99999])
@pytest.mark.parametrize("shape", [(500, 3), (500,), (1, 3), (0, 3), (0,)])
def test_a_gauss_markov_process_is_the_recursive_filter_of_its_drive_to_the_bit(keep, shape):
    normal = np.random.default_rng(3).standard_normal(shape)
    drive = np.sqrt(1.0 - keep * keep) * normal
    drive[:1] = normal[:1]
    found = gauss_markov(keep, normal.copy())
    np.testing.assert_allclose(found[:1], normal[:1], rtol=1e-15)
    drive[:1] = found[:1]
    assert found.tobytes() == lfilter([1.0], [1.0, -keep], drive, axis=0).tobytes()


def test_its_variance_is_one_and_neighbours_are_as_alike_as_they_should_be():
    found = gauss_markov(0.8, np.random.default_rng(4).standard_normal(40_000))
    assert np.var(found) == pytest.approx(1.0, abs=0.05)
    assert np.mean(found[1:] * found[:-1]) == pytest.approx(0.8, abs=0.05)

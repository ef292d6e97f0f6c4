"""Gates as probabilities, against scipy."""

import pytest
from scipy.stats import chi2

from dualfoot_ros.core.carried.probability import nis_below, nis_gate


@pytest.mark.parametrize("dimensions", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("probability", [0.05, 0.5, 0.95, 0.99, 0.9999])
def test_a_gate_is_the_quantile_of_chi_square(dimensions, probability):
    assert nis_gate(probability, dimensions) == pytest.approx(
        chi2.ppf(probability, dimensions), rel=1e-9
    )


@pytest.mark.parametrize("dimensions", [1, 2, 3, 6])
def test_the_probability_of_a_value_is_that_of_chi_square(dimensions):
    for value in (0.0, 0.1, 3.0, 40.0):
        assert nis_below(value, dimensions) == pytest.approx(
            chi2.cdf(value, dimensions), abs=1e-12
        )


def test_a_gate_of_probability_zero_lets_nothing_pass():
    assert nis_gate(0.0, 3) == pytest.approx(0.0, abs=1e-12)

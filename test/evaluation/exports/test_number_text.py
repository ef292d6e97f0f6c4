"""Text of many numbers: to the byte that of Python's own formatting."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.evaluation.exports.number_text import BLOCK, integers, lines, seconds

LARGE = 4e5  # m; beyond anyone's walk


def written(stamps, values, decimals):
    """Return the text of ``values`` (N, K) as Python formats them, one by one."""
    rows = [[f"{value:.{decimals}f}" for value in row] for row in values.tolist()]
    texts = [f"{stamp // 10**9}.{stamp % 10**9:09d}" for stamp in stamps.tolist()]
    return "".join(" ".join([text, *row]) + "\n" for text, row in zip(texts, rows, strict=True))


def made(stamps, values, decimals):
    return b"".join(lines(seconds(stamps), values, decimals, " ")).decode()


@given(
    st.lists(st.floats(-LARGE, LARGE), min_size=1, max_size=30),
    st.sampled_from([6, 9]),
    st.integers(0, 2**62),
)
def test_any_number_is_written_as_python_writes_it(numbers, decimals, stamp):
    values = np.array(numbers)[:, None]
    stamps = np.full(len(values), stamp)
    assert made(stamps, values, decimals) == written(stamps, values, decimals)


def test_halves_small_negative_numbers_and_zeros_are_rounded_alike():
    numbers = [
        0.0,
        -0.0,
        -1e-12,
        1e-12,
        0.5e-9,
        1.5e-9,
        2.5e-6,
        0.0000005,
        -0.1234565,
        999.9999999,
    ]
    numbers += [999.9999999996, 1000.0, 12345.6789, *np.arange(1, 200) * 2.0**-20]
    values = np.array(numbers)[:, None]
    stamps = np.arange(len(values)) * 10**8 + 3
    for decimals in (6, 9):
        assert made(stamps, values, decimals) == written(stamps, values, decimals)


@pytest.mark.parametrize("odd", [np.nan, np.inf, -np.inf, 1e300])
def test_what_is_no_number_or_huge_is_written_too(odd):
    values = np.array([[1.25, -2.5], [odd, 3.0]])
    stamps = np.array([10**9, 2 * 10**9])
    assert made(stamps, values, 6) == written(stamps, values, 6)


def test_more_rows_than_a_block_are_all_written():
    values = np.random.default_rng(0).normal(0.0, 100.0, (BLOCK + 7, 2))
    stamps = 10**18 + np.arange(len(values)) * 5_000_000
    assert made(stamps, values, 9) == written(stamps, values, 9)


def test_whole_numbers_have_no_point():
    text = b"".join(lines(integers(np.array([0, 7, 10**18])), np.zeros((3, 1)), 1, ","))
    assert text == b"0,0.0\n7,0.0\n1000000000000000000,0.0\n"

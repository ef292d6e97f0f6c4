"""Text of many numbers: to the byte that of Python's own formatting."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.compiler.made_library import can_compile
from dualfoot_ros.evaluation.exports import decimal_text, text_table
from dualfoot_ros.evaluation.exports.number_text import BLOCK, lines, with_point
from dualfoot_ros.evaluation.exports.text_table import (
    MANY,
    Form,
    compiled_text,
    text_of,
    write_table,
)

LARGE = 4e5  # m; beyond anyone's walk
HALVES = [
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
    999.9999999996,
    1000.0,
    12345.6789,
    *np.arange(1, 200) * 2.0**-20,
]


def written(stamps, values, form):
    """Return the text of ``values`` (N, K) as Python formats them, one by one."""
    rows = [[f"{value:.{form.decimals}f}" for value in row] for row in values.tolist()]
    texts = [f"{s // 10**9}.{s % 10**9:09d}" if form.places else str(s) for s in stamps.tolist()]
    pairs = zip(texts, rows, strict=True)
    return "".join(form.separator.join([text, *row]) + "\n" for text, row in pairs)


def with_numpy(stamps, values, form):
    return lines(with_point(stamps, form.places), values, form.decimals, form.separator).decode()


def one_by_one(stamps, values, form):
    text = text_of(vars(decimal_text), stamps, values, form)
    return None if text is None else bytes(text).decode()


def compiled(stamps, values, form):
    text = text_of(compiled_text(), stamps, values, form)
    return None if text is None else bytes(text).decode()


needs_a_compiler = pytest.mark.skipif(not can_compile(), reason="there is no C compiler")
every_way = pytest.mark.parametrize(
    "made", [with_numpy, one_by_one, pytest.param(compiled, marks=needs_a_compiler)]
)


@every_way
@given(
    st.lists(st.floats(-LARGE, LARGE), min_size=1, max_size=30),
    st.sampled_from([Form(9, 6, " "), Form(0, 9, ","), Form(9, 1, " "), Form(0, 0, " ")]),
    st.integers(0, 2**62),
)
def test_any_number_is_written_as_python_writes_it(made, numbers, form, stamp):
    values = np.array(numbers)[:, None]
    stamps = np.full(len(values), stamp)
    assert made(stamps, values, form) == written(stamps, values, form)


@every_way
def test_halves_small_negative_numbers_and_zeros_are_rounded_alike(made):
    values = np.array(HALVES)[:, None]
    stamps = np.arange(len(values)) * 10**8 + 3
    for form in (Form(9, 6, " "), Form(9, 9, " ")):
        assert made(stamps, values, form) == written(stamps, values, form)


@pytest.mark.parametrize("odd", [np.nan, np.inf, -np.inf, 1e300])
def test_what_is_no_number_or_huge_is_written_too(odd):
    values = np.array([[1.25, -2.5], [odd, 3.0]])
    stamps, form = np.array([10**9, 2 * 10**9]), Form(9, 6, " ")
    assert with_numpy(stamps, values, form) == written(stamps, values, form)
    assert one_by_one(stamps, values, form) is None


@pytest.mark.parametrize("library", [True, False])
def test_a_long_table_is_the_same_with_and_without_a_library(library, monkeypatch):
    if not library:
        monkeypatch.setattr(text_table, "compiled_text", lambda: None)
    values = np.random.default_rng(0).normal(0.0, 100.0, (MANY + BLOCK + 7, 1))
    values[5 * BLOCK] = np.nan  # a block that the library leaves to numpy
    stamps = 10**18 + np.arange(len(values)) * 5_000_000
    file, form = io.BytesIO(), Form(9, 9, " ")
    write_table(file, stamps, lambda rows: values[rows], form)
    assert file.getvalue().decode() == written(stamps, values, form)


def test_whole_numbers_have_no_point():
    text = with_numpy(np.array([0, 7, 10**18]), np.zeros((3, 1)), Form(0, 1, ","))
    assert text == "0,0.0\n7,0.0\n1000000000000000000,0.0\n"

"""The translation to C: what Python computes, to the last bit, and refusal of all the rest."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.compiler import made_library
from dualfoot_ros.core.compiler.c_library import library_source
from dualfoot_ros.core.compiler.entries import Entry, Kind
from dualfoot_ros.core.compiler.kernel_function import TranslationError
from dualfoot_ros.core.compiler.made_library import make_library
from dualfoot_ros.core.kernel.tiles import transpose_tile

LIMIT = 0.7
W, N, ROWS, INTEGER, X = Kind.REALS, Kind.INTEGERS, Kind.ROWS, Kind.INTEGER, Kind.REAL


def whole_numbers(n, a, b):
    """Division and remainder round towards less."""
    n[0], n[1] = a // b, a % b
    n[2] = (a & 5) | (b << 2) | (a >> 1)
    n[3] = (~a & 1) + bool(a)
    n[4] = min(a, b, 3) + max(a, b) + abs(a)
    return a - -b


def real_numbers(w, x, y):
    """A name that is an integer first becomes real; a constant is that of the module."""
    total = 0
    for k in range(3):
        total += w[k] * x
    w[3] = total / 3 if x < LIMIT else -math.inf
    w[4] = min(x, y) - max(y, x, 0.5) * abs(y)
    w[5] = math.sqrt(x * x) + math.sin(y) + math.cos(x) + math.copysign(2.0, y)
    w[6] = 1 / 3 * int(x)
    return total


def branches(n, a):
    """Loops, ways out of them, and names that a loop shares with what follows."""
    for k in range(2, 10, 3):
        if k == a:
            continue
        n[0] += k
        if n[0] > 9:
            break
    for i in range(3):
        k = 2 - i
        n[1 + k] = k * a
    n[4] = k
    while n[5] < a and not n[5] >= 7:
        n[5] += 1
    for sign in (1, -1, 3):
        n[6] += sign


def conditions(n, a):
    """What is chosen by whole conditions and by parts of them."""
    if 2 < a <= 5 or a == -1:
        n[7] = 1
    elif a < 0:
        n[7] = 2
    else:
        n[7] = 3
    return a > 2 and n[7] > 1


def several(w, n, x):
    """Results of a function are taken apart; exchanged names do not overwrite each other."""
    a, b = both(w, x)
    n[1] = b
    b = w[4]
    a, b = b, a
    n[0] = twice(3)
    w[0], w[1] = a, b
    return scaled(w[2]) + scaled(x, 0.5) + scaled(x, 3, True)


def both(w, x):
    return w[5] * x, x > 0.0


def twice(k):
    return 2 * k


def scaled(x, factor=4, more=False):
    return x if more else x * factor


def table(rows, k, j):
    rows[k, j] += rows[k - 1, 2 * j]
    return rows[k, j]


def chosen(w, x, y):
    w[0], w[1] = min(x, y), max(x, y)


def ends_early(w, x):
    if x < 0.0:
        return
    w[0] = x


ENTRIES = {
    "whole_numbers": Entry((N, INTEGER, INTEGER), INTEGER),
    "real_numbers": Entry((W, X, X), X),
    "branches": Entry((N, INTEGER)),
    "conditions": Entry((N, INTEGER), INTEGER),
    "several": Entry((W, N, X), X),
    "table": Entry((ROWS, INTEGER, INTEGER), X),
    "chosen": Entry((W, X, X)),
    "ends_early": Entry((W, X)),
}
FUNCTIONS = [
    whole_numbers, real_numbers, branches, conditions, several, both, twice, scaled, table, chosen,
    ends_early,
]  # fmt: skip

small = st.integers(-9, 9)
real = st.floats(-50.0, 50.0)


@pytest.fixture(scope="module")
def in_c(tmp_path_factory):
    """Return the entries as the C compiler has made them."""
    if not made_library.can_compile():
        pytest.skip("needs a C compiler (cc), on Linux")
    path = tmp_path_factory.mktemp("library") / "library.so"
    functions = {each.__name__: each for each in FUNCTIONS}
    return make_library(path, library_source(functions, ENTRIES), ENTRIES, bool)


def agrees(compiled, function, arrays, *numbers):
    """Return whether both forms give the same result and leave the same arrays behind."""
    found = []
    for form in (compiled, function):
        given_arrays = [array.copy() for array in arrays]
        result = form(*given_arrays, *numbers)
        found.append((result, [array.tobytes() for array in given_arrays]))
    return found[0] == found[1]


@given(small, small.filter(bool))
def test_whole_numbers(in_c, a, b):
    assert agrees(in_c["whole_numbers"], whole_numbers, [np.zeros(8, dtype=np.int64)], a, b)


@given(real, real)
def test_real_numbers(in_c, x, y):
    assert agrees(in_c["real_numbers"], real_numbers, [np.linspace(0.1, 3.0, 8)], x, y)


@given(small)
def test_branches(in_c, a):
    for function in (branches, conditions):
        compiled = in_c[function.__name__]
        assert agrees(compiled, function, [np.zeros(8, dtype=np.int64)], a)


@given(real)
def test_calls(in_c, x):
    arrays = [np.linspace(-1.0, 3.0, 8), np.zeros(8, dtype=np.int64)]
    assert agrees(in_c["several"], several, arrays, x)
    assert agrees(in_c["ends_early"], ends_early, arrays[:1], x)


def test_tables(in_c):
    assert agrees(in_c["table"], table, [np.arange(30.0).reshape(3, 10)], 2, 4)


@pytest.mark.parametrize("values", [(math.nan, 1.0), (1.0, math.nan), (math.nan, math.nan)])
def test_the_first_is_taken_where_one_is_no_number(in_c, values):
    assert agrees(in_c["chosen"], chosen, [np.zeros(8)], *values)


def test_nothing_divided_by_nothing_ends_no_process(in_c):
    """numpy, whose numbers the kernel in Python has, gives zero."""
    n = np.zeros(8, dtype=np.int64)
    in_c["whole_numbers"](n, 5, 0)
    assert n[0] == n[1] == 0


def power(w):
    w[0] = w[1] ** 2


def slices(w):
    w[0] = w[1:3]


def words(w):
    w[0] = "nothing"


def real_remainder(w):
    w[0] = w[1] % 2


def counts_down(w):
    for k in reversed(range(3)):
        w[k] = 0.0


def unknown_call(w):
    w[0] = math.tan(w[1])


@pytest.mark.parametrize(
    ("function", "named"),
    [
        (power, "w[1] ** 2"),
        (slices, "1:3"),
        (words, "'nothing'"),
        (real_remainder, "w[1] % 2"),
        (counts_down, "reversed(range(3))"),
        (unknown_call, "math.tan(w[1])"),
    ],
)
def test_what_has_no_translation_is_named(function, named):
    name = function.__name__
    with pytest.raises(TranslationError) as refused:
        library_source({name: function}, {name: Entry((W,))})
    assert str(refused.value).startswith(f"{name} of the kernel has '")
    assert named in str(refused.value)


def test_a_tile_is_turned_over_by_the_text_in_c_as_in_python(tmp_path):
    if not made_library.can_compile():
        pytest.skip("needs a C compiler (cc), on Linux")
    entries = {"transpose_tile": Entry((W, INTEGER, INTEGER, INTEGER, INTEGER))}
    source = library_source({"transpose_tile": transpose_tile}, entries)
    made = []
    for k, text in enumerate((source, source.replace("__has_builtin", "__has_none_of_them"))):
        compiled = make_library(tmp_path / f"{k}.so", text, entries, lambda _: True)
        for rows, columns in ((4, 4), (3, 4), (4, 3)):
            found = [np.arange(200.0), np.arange(200.0)]
            compiled["transpose_tile"](found[0], 5, 106, rows, columns)
            transpose_tile(found[1], 5, 106, rows, columns)
            assert np.array_equal(*found)
            made.append(found[0].tobytes())
    assert made[:3] == made[3:] and len(set(made)) == 3

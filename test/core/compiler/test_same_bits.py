"""A compiled kernel with other bits than the kernel in Python is found out, whichever entry."""

import numpy as np
import pytest

from dualfoot_ros.core.compiler import compiled
from dualfoot_ros.core.compiler.same_bits import same_bits
from dualfoot_ros.core.kernel import ENTRIES, MODULES
from dualfoot_ros.core.kernel import layout as lay


@pytest.fixture(scope="module")
def functions():
    """Return the compiled entries by name."""
    try:
        engine = compiled()
    except ImportError:
        pytest.skip("needs a C compiler (cc) or numba")
    return {name: getattr(engine, name) for name in ENTRIES}


def last_bit_off(function):
    """Return ``function`` with the last bit of a number that it has written changed."""

    def other(*arguments):
        before = [each.copy() if isinstance(each, np.ndarray) else None for each in arguments]
        result = function(*arguments)
        for old, new in zip(before, arguments, strict=True):
            if old is not None and (changed := np.flatnonzero(old.ravel() != new.ravel())).size:
                flat = new.reshape(-1)
                flat.view(np.int64)[changed[-1]] ^= 1
                return result
        raise AssertionError("it has written nothing")

    return other


def test_the_compiled_kernel_has_the_bits(functions):
    assert same_bits(functions)


@pytest.mark.parametrize("name", ENTRIES)
def test_one_bit_of_one_entry_is_enough(functions, name):
    assert not same_bits({**functions, name: last_bit_off(functions[name])})


def test_numbers_stay_numbers(functions):
    """What is compared means something: no number of the state is lost on the way."""
    from dualfoot_ros.core.compiler.same_bits import _computed

    for made in _computed(functions):
        state = np.frombuffer(made[: 8 * lay.STATE])
        assert np.isfinite(state).all()


def test_no_turn_of_a_loop_over_lanes_needs_another_one(functions, monkeypatch):
    """That is what the C compiler is told: in the opposite order the bits are the same."""
    loops = [module for module in MODULES if hasattr(module, "lanes")]
    assert len(loops) > 4
    for module in loops:
        monkeypatch.setattr(module, "lanes", lambda *bounds: reversed(range(*bounds)))
    assert same_bits(functions)

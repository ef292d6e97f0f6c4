"""Layout files: what is saved is read back, and what cannot be is refused with what is allowed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core import FORCE_UNITS, RATE_UNITS, Increments
from dualfoot_ros.recording import RecordingError
from dualfoot_ros.recording.importers.tables import (
    LAYOUTS,
    ROLES,
    TIME_UNITS,
    Layout,
    layout_text,
    load_layout,
    parse_columns,
)

names = st.text("abc xyz_()[]/#:,=0123456789²°", min_size=1, max_size=20).map(str.strip)


@given(
    st.builds(
        Layout,
        columns=st.dictionaries(st.sampled_from(ROLES), names, max_size=9),
        delimiter=st.sampled_from([None, ",", ";", "\t", "|", " "]),
        decimal=st.sampled_from([None, ".", ","]),
        skip=st.integers(0, 40),
        time_units=st.sampled_from([(), *((unit,) for unit in TIME_UNITS)]),
        rate_hz=st.one_of(st.none(), st.floats(10, 1000)),
        force_unit=st.sampled_from([None, *FORCE_UNITS]),
        rate_unit=st.sampled_from([None, *RATE_UNITS]),
        wrap_bits=st.sampled_from([0, 16, 32]),
        increments=st.sampled_from([None, *Increments]),
    )
)
def test_a_layout_comes_back_as_it_was_saved(tmp_path_factory, layout):
    path = tmp_path_factory.mktemp("layout") / "mine.yaml"
    path.write_text(layout_text(layout), encoding="utf-8")
    assert load_layout(path) == layout


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_a_file_that_names_a_known_layout_has_all_that_it_has(tmp_path, layout):
    path = tmp_path / "mine.yaml"
    path.write_text(f"format: dualfoot_layout\nname: {layout.name}\nrate: 50\n")
    found = load_layout(path)
    assert found.rate_hz == 50
    assert (found.marks, found.parts, found.prefer) == (layout.marks, layout.parts, layout.prefer)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a: [", "no YAML"),
        ("format: other", "allowed is a file with format: dualfoot_layout"),
        ("format: dualfoot_layout\nspeed: 1", "has the key 'speed'; allowed are"),
        ("format: dualfoot_layout\nforce_unit: lb", "force_unit is 'lb'; allowed is m/s"),
        ("format: dualfoot_layout\nincrements: smooth", "increments is 'smooth'; allowed is comp"),
        ("format: dualfoot_layout\nrate: -1", "rate is '-1'; allowed is a number of Hz"),
        ("format: dualfoot_layout\nskip: x", "skip is 'x'; allowed is a whole number"),
        ("format: dualfoot_layout\ndelimiter: '::'", "delimiter is '::'"),
        ("format: dualfoot_layout\ncolumns: {speed: v}", "columns is .*allowed is time, counter"),
        ("format: dualfoot_layout\ncolumns: 7", "columns is '7'"),
    ],
)
def test_what_is_wrong_with_a_layout_is_named(tmp_path, text, sentence):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(RecordingError, match=sentence):
        load_layout(path)


def test_names_of_columns_may_hold_commas():
    found = parse_columns("time=Time, s, ax=Acc (x, forward),gx=5")
    assert found == {"time": "Time, s", "ax": "Acc (x, forward)", "gx": "5"}

"""References: what is saved comes back, what is wrong is named."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.recording import RecordingError, Reference

GOOD = """\
format: dualfoot_reference
version: 1
source: by hand
unit: m
closed_loop: true
length: 3
markers:
  left: [[0, 0], [1.5, 0, 0.2]]
"""

points = st.lists(
    st.tuples(*[st.floats(-1e3, 1e3).map(lambda v: round(v, 6))] * 3), min_size=2, max_size=8
)


@given(st.dictionaries(st.sampled_from(["left", "right"]), points), st.booleans())
def test_a_reference_comes_back_from_its_file(tmp_path_factory, markers, closed):
    path = tmp_path_factory.mktemp("reference") / "reference.yaml"
    arrays = {foot: np.array(p) for foot, p in markers.items()}
    Reference("somewhere: 'odd' text\n", arrays, closed, 5.5).save(path)
    read = Reference.load(path)
    assert read.source == "somewhere: 'odd' text\n"
    assert (read.closed_loop, read.length_m) == (closed, 5.5)
    assert read.markers.keys() == arrays.keys()
    for foot, p in arrays.items():
        assert np.array_equal(read.markers[foot], p)


def test_a_file_written_by_hand_may_leave_out_heights_and_what_is_not_known(tmp_path):
    path = tmp_path / "r.yaml"
    path.write_text(GOOD)
    read = Reference.load(path)
    assert read.markers["left"].tolist() == [[0, 0, 0], [1.5, 0, 0.2]]
    assert read.length_m == 3.0
    assert "2 markers of the left foot" in read.summary()
    path.write_text("format: dualfoot_reference\nversion: 1\n")
    assert Reference.load(path) == Reference("")


@pytest.mark.parametrize(
    ("before", "after", "sentence"),
    [
        ("unit: m", "unit: cm", "'unit' is 'cm'; allowed is m"),
        ("version: 1", "version: 7", "'version' is 7; allowed is 1"),
        ("closed_loop: true", "closed_loop: 1", "'closed_loop' is 1; allowed is true or false"),
        ("length: 3", "length: -3", "'length' is -3"),
        ("length: 3", "lenght: 3", "unknown key 'lenght'"),
        ("left:", "middle:", "'markers' is 'middle'; allowed is left or right"),
        ("[1.5, 0, 0.2]", "[1.5]", r"'markers.left' is \[1.5\]"),
        ("[1.5, 0, 0.2]", "[.nan, 0]", r"'markers.left' is \[nan, 0\]"),
        ("[[0, 0], [1.5, 0, 0.2]]", "[[0, 0]]", "at least two points"),
        (GOOD, "- 1\n- 2\n", "allowed is a mapping"),
        (GOOD, "a: [", "is no YAML"),
        ("format: dualfoot_reference", "format: other", "'format' is 'other'"),
    ],
)
def test_what_is_wrong_in_a_reference_is_named_with_what_is_allowed(
    tmp_path, before, after, sentence
):
    path = tmp_path / "r.yaml"
    path.write_text(GOOD.replace(before, after))
    with pytest.raises(RecordingError, match=sentence):
        Reference.load(path)

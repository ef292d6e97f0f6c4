"""The format of a stream is recognised from its bytes, whatever it was taken for."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualfoot_ros.drivers import recognise

from ..frames import FORMATS, decoder_format, item, stream, vectornav_line, witmotion_combined
from ..frames import xbus_message as message


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_recognised_also_from_the_middle_and_in_pieces(name):
    data = stream(name, 60)
    start = 0 if name == "dot_csv" else 7  # which names its columns at the start
    pieces = [data[k : k + 33] for k in range(start, len(data), 33)]
    found = recognise(pieces)
    assert found[0].format == decoder_format(name)
    assert found[0].samples >= 50
    assert found[0].sentence == f"the bytes are of the format '{decoder_format(name)}'"


def test_frames_of_a_bluetooth_witmotion_are_recognised():
    data = b"".join(witmotion_combined(k) for k in range(50))
    assert recognise([data])[0].format == "witmotion"


def test_a_device_that_sends_no_motion_is_recognised_and_told_what_it_lacks():
    quaternions = message(0x36, item(0x2010, bytes(16))) * 20
    lines = vectornav_line("VNYPR,+010.071,+000.278,-002.026") * 20
    for data, name in ((quaternions, "xbus"), (lines, "vectornav_ascii")):
        (found,) = recognise([data])
        assert (found.format, found.samples) == (name, 0)
        assert "without specific force and angular rate" in found.sentence


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_noise_is_of_no_format(seed):
    noise = np.random.default_rng(seed).integers(0, 256, 4000, dtype=np.uint8).tobytes()
    assert [found for found in recognise([noise]) if found.samples] == []


def test_nothing_is_of_no_format():
    assert recognise([]) == []

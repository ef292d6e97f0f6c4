"""How frames are found in a stream, on a format small enough to see what happens.

A frame is ``H``, its length in all, content, and the sum of all before, modulo 256.
"""

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.drivers.protocols.framing import (
    BAD_CHECKSUM,
    NEED_MORE,
    NO_FRAME,
    DelimitedFramer,
    HeaderFramer,
)

HEADER = ord("H")
LONGEST = 40
contents = st.binary(max_size=LONGEST - 3)


def frame(content):
    body = bytes([HEADER, len(content) + 3]) + content
    return body + bytes([sum(body) % 256])


def probe(buffer, at):
    if at >= len(buffer):
        return NEED_MORE
    if buffer[at] != HEADER:
        return NO_FRAME
    if at + 2 > len(buffer):
        return NEED_MORE
    length = buffer[at + 1]
    if not 3 <= length <= LONGEST:
        return NO_FRAME
    if at + length > len(buffer):
        return NEED_MORE
    good = sum(buffer[at : at + length - 1]) % 256 == buffer[at + length - 1]
    return length if good else BAD_CHECKSUM


def framer(doubt=lambda frame, in_step: False):
    counters = Counter()
    return HeaderFramer(HEADER, probe, LONGEST, counters, doubt), counters


def weak():
    return framer(lambda frame, in_step: not in_step)


def found(frames):
    return [item for item in frames if item]


@given(st.lists(contents, max_size=6), st.integers(1, 7))
def test_frames_back_to_back_all_come_out_however_they_are_cut(parts, size):
    frames = [frame(part) for part in parts]
    data = b"".join(frames)
    finder, counters = framer()
    came = [f for k in range(0, len(data), size) for f in finder.push(data[k : k + size])]
    assert came == frames
    assert not counters


@given(st.binary(max_size=200), st.booleans())
def test_every_byte_ends_in_a_frame_among_the_garbage_or_in_the_buffer(data, is_weak):
    finder, counters = weak() if is_weak else framer()
    frames = found(finder.push(data))
    assert sum(map(len, frames)) + counters["garbage_bytes"] + finder.buffered == len(data)
    assert finder.buffered <= finder.max_buffer


def test_a_weak_frame_on_its_own_is_held_until_the_next_one_follows():
    finder, _ = weak()
    assert finder.push(frame(b"one")) == []
    assert finder.push(frame(b"two")) == [frame(b"one"), frame(b"two")]
    assert finder.push(frame(b"three")) == [frame(b"three")]


def test_a_weak_frame_between_garbage_is_dropped():
    finder, counters = weak()
    data = b"xx" + frame(b"chance") + b"yy"
    assert found(finder.push(data)) == []
    assert counters["garbage_bytes"] == len(data)


def test_a_strong_frame_between_garbage_comes_out():
    finder, _ = framer()
    assert found(finder.push(b"xx" + frame(b"real") + b"yy")) == [frame(b"real")]


def test_a_gap_between_frames_is_marked():
    finder, _ = framer()
    assert finder.push(frame(b"a") + b"x" + frame(b"b") + frame(b"c")) == [
        frame(b"a"),
        b"",
        frame(b"b"),
        frame(b"c"),
    ]


def test_a_header_that_waits_gives_way_to_two_frames_in_a_row_and_to_no_single_one():
    finder, counters = framer()
    fake = bytes([HEADER, LONGEST])
    assert finder.push(frame(b"a") + fake + frame(b"b")) == [frame(b"a")]
    assert found(finder.push(frame(b"c"))) == [frame(b"b"), frame(b"c")]
    assert counters["garbage_bytes"] == 2


def test_a_frame_inside_the_content_of_another_is_not_taken_for_one():
    finder, _ = framer()
    outer = frame(b"-" + frame(b"in") + b"-")
    for byte in outer[:-1]:
        assert finder.push(bytes([byte])) == []
    assert finder.push(outer[-1:]) == [outer]


def test_a_checksum_is_counted_as_bad_only_where_a_frame_was_due():
    finder, counters = framer()
    damaged = frame(b"abc")[:-1] + b"\x00"
    finder.push(damaged)
    assert not counters["bad_checksum"]
    finder.push(frame(b"a") + damaged + frame(b"b"))
    assert counters["bad_checksum"] == 1


@given(st.binary(max_size=300), st.integers(1, 50))
def test_lines_are_those_that_a_split_gives_unless_too_long(data, size):
    counters = Counter()
    splitter = DelimitedFramer(ord("\n"), LONGEST, counters)
    came = [f for k in range(0, len(data), size) for f in splitter.push(data[k : k + size])]
    assert came == [line for line in data.split(b"\n")[:-1] if 0 < len(line) <= LONGEST]
    assert splitter.buffered <= LONGEST


def test_the_end_of_a_line_that_is_too_long_is_not_taken_for_a_line():
    splitter = DelimitedFramer(ord("\n"), LONGEST, Counter())
    assert splitter.push(b"-" * 100) == []
    assert splitter.push(b"I,1,2\nnext\n") == [b"next"]

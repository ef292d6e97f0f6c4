"""The index behind a chunk is believed where it names all messages of the chunk, and else not."""

import struct

import numpy as np
import pytest

from dualfoot_ros.recording.storage import mcap_format as mcap
from dualfoot_ros.recording.storage.mcap_index import indexed_starts


def message(channel: int, size: int) -> bytes:
    return mcap.record(mcap.MESSAGE, mcap.MESSAGE_HEAD.pack(channel, 0, 5, 5) + bytes(size))


def index_of(channel: int, starts: list[int]) -> bytes:
    entries = b"".join(struct.pack("<QQ", 5, start) for start in starts)
    return mcap.record(mcap.MESSAGE_INDEX, struct.pack("<H", channel) + mcap.sized(entries))


CHANNEL = mcap.record(mcap.CHANNEL, b"about a channel")
PARTS = (CHANNEL, message(2, 40), message(1, 30), message(2, 40), message(1, 7))
RECORDS = b"".join(PARTS)
STARTS = np.cumsum([0, *map(len, PARTS)])[1:-1].tolist()
WHOLE = index_of(1, STARTS[1::2]) + index_of(2, STARTS[0::2])


def test_the_index_gives_the_messages_of_each_channel_by_their_places():
    shuffled = index_of(1, STARTS[:0:-2]) + index_of(2, STARTS[0::2])
    for index in (WHOLE, shuffled):
        found = indexed_starts(index, RECORDS)
        assert found is not None and list(found) == [2, 1]
        assert found[2].tolist() == STARTS[0::2] and found[1].tolist() == STARTS[1::2]


WRONG = {
    "none": b"",
    "a channel too few": index_of(2, STARTS[0::2]),
    "the first message too few": index_of(1, STARTS[1::2]) + index_of(2, STARTS[2::2]),
    "the last message too few": index_of(1, STARTS[1:2]) + index_of(2, STARTS[0::2]),
    "another channel": index_of(3, STARTS[1::2]) + index_of(2, STARTS[0::2]),
    "a place in the middle of a message": index_of(1, [STARTS[1] + 3]) + WHOLE[-60:],
    "a place behind the end": index_of(1, [10**9]) + index_of(2, STARTS[0::2]),
    "a place before the start": index_of(1, [2**64 - 5]) + index_of(2, STARTS[0::2]),
    "no whole entries": mcap.record(mcap.MESSAGE_INDEX, struct.pack("<H", 1) + mcap.sized(b"12")),
    "another record": WHOLE + CHANNEL,
}


@pytest.mark.parametrize("index", WRONG.values(), ids=WRONG.keys())
def test_an_index_that_is_not_complete_is_not_believed(index):
    assert indexed_starts(index, RECORDS) is None


def test_records_behind_the_messages_are_to_be_searched():
    assert indexed_starts(WHOLE, RECORDS + CHANNEL) is None

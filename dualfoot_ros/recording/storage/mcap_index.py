"""Where the messages of a chunk begin, as the index behind the chunk says.

The index is believed where its messages follow each other without a hole to the end of the chunk
and no message is before them; else the chunk is to be searched record by record.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mcap_format import HEAD, MESSAGE, MESSAGE_HEAD, MESSAGE_INDEX
from .mcap_scan import split, u16
from .message_rows import rows_at

Starts = dict[int, NDArray[np.int64]]
ENTRIES_AT = 6  # in a record of the index: behind the channel and the size of the entries
LEAST = HEAD.size + MESSAGE_HEAD.size


def indexed_starts(index: bytes, records: bytes) -> Starts | None:
    """Return where the messages of each channel begin in a chunk, or None if it is to be searched.

    ``index`` are the records behind the chunk, ``records`` those within it.  Channels are in the
    order of their first messages.
    """
    found: Starts = {}
    for record in split(index):
        entries = record.content[ENTRIES_AT:]
        if record.opcode != MESSAGE_INDEX or len(entries) % 16:
            return None
        if entries:
            found[u16(record.content, 0)] = np.sort(np.frombuffer(entries, dtype="<i8")[1::2])
    if not found or not _is_complete(found, records):
        return None
    return dict(sorted(found.items(), key=lambda item: int(item[1][0])))


def _is_complete(found: Starts, records: bytes) -> bool:
    """Return whether these are all messages of the chunk."""
    starts = np.concatenate(list(found.values()))
    channels = np.concatenate([np.full(len(own), channel) for channel, own in found.items()])
    order = np.argsort(starts)
    starts, channels = starts[order], channels[order]
    if starts[0] < 0 or starts[-1] + LEAST > len(records):
        return False
    heads = rows_at(records, starts, HEAD.size + 2)
    ends = starts + HEAD.size + heads[:, 1 : HEAD.size].copy().view("<i8")[:, 0]
    own = heads[:, HEAD.size :].copy().view("<u2")[:, 0]
    follow = np.array_equal(ends, np.append(starts[1:], len(records)))
    messages = bool((heads[:, 0] == MESSAGE).all()) and np.array_equal(own, channels)
    return follow and messages and not _has_message(records, int(starts[0]))


def _has_message(records: bytes, end: int) -> bool:
    """Return whether a message is among the records before ``end``, or one goes beyond it."""
    at = 0
    while at < end:
        opcode, length = HEAD.unpack_from(records, at)
        if opcode == MESSAGE:
            return True
        at += HEAD.size + length
    return at != end

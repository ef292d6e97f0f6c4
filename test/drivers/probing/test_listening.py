"""Listening: format and baud are found, and stand in the URI that comes out."""

import pytest

from dualfoot_ros.drivers import BAUDS, SourceError, Transport, listen

from ..frames import stream

RIGHT_BAUD = 460800


class FakeTransport(Transport):
    """A link that brings ``pieces`` and ends."""

    def __init__(self, pieces, error=None):
        super().__init__("a fake")
        self.pieces, self.error, self.closed = list(pieces), error, False

    def open(self):
        if self.error is not None:
            raise self.error

    def read(self):
        return self.pieces.pop(0) if self.pieces else None

    def close(self):
        self.closed = True


def cut(data, size=64):
    return [data[k : k + size] for k in range(0, len(data), size)]


def port_at(right, data):
    """Return what makes the transports of a port: at any other baud it brings rubbish."""

    def make(source):
        rubbish = bytes(range(128, 250)) * 4
        return FakeTransport(cut(data if source.transport.baud == right else rubbish))

    return make


def test_the_baud_and_the_format_of_a_port_are_found():
    make = port_at(RIGHT_BAUD, stream("witmotion", 40))
    heard = listen("serial:///dev/ttyUSB0", make=make)
    assert heard.uri == f"serial:///dev/ttyUSB0?baud={RIGHT_BAUD}&format=witmotion"
    assert heard.tried == BAUDS[: BAUDS.index(RIGHT_BAUD) + 1]
    assert heard.bytes == len(stream("witmotion", 40))


def test_a_baud_that_is_given_is_kept_and_a_format_that_is_wrong_is_not():
    make = port_at(9600, stream("xbus", 40))
    heard = listen("serial:///dev/ttyUSB0?format=mcu&baud=9600", make=make)
    assert heard.uri == "serial:///dev/ttyUSB0?baud=9600&format=xbus"


def test_a_port_with_nothing_known_on_it_lists_what_was_tried():
    heard = listen("serial:///dev/ttyUSB0", make=port_at(1, b""))
    assert heard.tried == BAUDS
    assert heard.recognised == []
    assert heard.uri == "serial:///dev/ttyUSB0"


def test_options_of_the_link_are_kept():
    transport = FakeTransport(cut(stream("ximu3", 40)))
    heard = listen("udp://0.0.0.0:8000?peers=192.168.1.5", make=lambda source: transport)
    assert heard.uri == "udp://0.0.0.0:8000?peers=192.168.1.5&format=ximu3"


def test_a_capture_is_heard_to_its_end(tmp_path):
    path = tmp_path / "capture.bin"
    path.write_bytes(stream("vectornav", 200))
    heard = listen(f"file://{path}")
    assert heard.uri == f"file://{path}?format=vectornav"
    assert heard.bytes == path.stat().st_size


def test_a_link_that_cannot_be_opened_is_a_sentence_and_is_given_back():
    transport = FakeTransport([], OSError("busy"))
    with pytest.raises(SourceError, match="a fake: busy"):
        listen("tcp://192.168.1.5:7000", make=lambda source: transport)
    assert transport.closed


@pytest.mark.parametrize("uri", ["carrier-pigeon://roof", "udp://8000", "udp://:8000?frmat=mcu"])
def test_a_uri_that_is_wrong_is_refused(uri):
    with pytest.raises(SourceError):
        listen(uri)

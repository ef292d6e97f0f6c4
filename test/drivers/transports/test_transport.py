"""Every transport answers every question of the base class, so that nobody asks for its type."""

import pytest

from dualfoot_ros.drivers import SCHEMES, make_transport, parse_uri

ADDRESSES = {
    "serial": "serial:///dev/no_such_port?format=mcu",
    "udp": "udp://:0?format=mcu&peers=127.0.0.2",
    "tcp": "tcp://:7000?format=mcu",
    "file": "file:///dev/null?format=mcu&speed=2",
}


@pytest.fixture(params=ADDRESSES)
def transport(request):
    return make_transport(parse_uri(ADDRESSES[request.param]))


def test_every_scheme_but_bluetooth_which_needs_bleak_is_tried_here():
    assert set(ADDRESSES) == set(SCHEMES) - {"ble"}


def test_a_transport_that_was_never_opened_has_sent_nothing_and_can_be_closed(transport):
    transport.close()
    assert transport.sender == "" and transport.strangers == {} and not transport.counters


def test_only_datagrams_come_from_anybody(transport):
    datagrams = transport.description.startswith("UDP")
    assert transport.connectionless == datagrams
    assert transport.peers == ({"127.0.0.2"} if datagrams else set())


def test_only_a_file_has_an_end_and_a_speed(transport):
    is_file = transport.description == "/dev/null"
    assert transport.reopens == (not is_file)
    assert transport.speed == (2.0 if is_file else 0.0)


def test_two_transports_share_no_counts():
    first, second = (make_transport(parse_uri(ADDRESSES["udp"])) for _ in range(2))
    first.strangers["10.0.0.1"] = 1
    first.counters["foreign"] += 1
    assert second.strangers == {} and not second.counters

"""The URI of a source: what is understood, and what is refused with what is allowed."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.drivers import SCHEMES, SourceError, make_transport, parse_uri
from dualfoot_ros.drivers.transports.address import parse as parse_address


def test_a_serial_source_names_port_speed_and_format():
    uri = parse_uri("serial:///dev/ttyUSB0?baud=921600&format=mcu")
    assert (uri.scheme, uri.location, uri.format) == ("serial", "/dev/ttyUSB0", "mcu")
    assert uri.transport.baud == 921600


def test_options_of_transport_decoder_and_retries_are_told_apart():
    uri = parse_uri("tcp://foot.local:7000?format=ximu3&silence=2&field_unit=5e-5&retry_max=0.5")
    assert uri.transport.silence == 2.0
    assert uri.decoder.field_unit == 5e-5
    assert uri.backoff.retry_max == 0.5


@pytest.mark.parametrize(
    ("text", "location"),
    [
        ("serial://COM3?format=mcu", "COM3"),
        ("file://walk.csv", "walk.csv"),
        ("file:///tmp/my%20walk.csv", "/tmp/my walk.csv"),
        ("udp://:8000?format=ximu3", ":8000"),
        ("udp://[::1]:8000?format=ximu3", "[::1]:8000"),
        ("ble://D4:22:CD:00:12:34", "D4:22:CD:00:12:34"),
    ],
)
def test_what_a_source_names_is_kept_as_written(text, location):
    assert parse_uri(text).location == location


def test_a_csv_file_and_a_bluetooth_device_need_no_format():
    assert parse_uri("file://walk.CSV").format == "dot_csv"
    assert parse_uri("ble://AA?payload=custom5").decoder.payload == "custom5"


@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_example_of_every_scheme_is_understood(scheme):
    assert parse_uri(SCHEMES[scheme].example).scheme == scheme


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("usb:///dev/ttyUSB0", "serial:///dev/ttyUSB0"),
        ("/dev/ttyUSB0", "no known scheme"),
        ("serial:///dev/ttyUSB0", "format="),
        ("serial:///dev/ttyUSB0?format=nmea", "mcu, ximu3, witmotion"),
        ("serial:///dev/ttyUSB0?format=mcu&baud=fast", "'fast'"),
        ("serial:///dev/ttyUSB0?format=mcu&baud=1", "300"),
        ("serial:///dev/ttyUSB0?format=mcu&buad=9600", "unknown option 'buad'"),
        ("serial:///dev/ttyUSB0?format=mcu&baud=9600&baud=9600", "baud twice"),
        ("serial:///dev/ttyUSB0?format=dot", "ble://"),
        ("ble://AA?format=mcu", "allowed over ble:// is one of dot, witmotion"),
        ("udp://?format=mcu", "names nothing"),
        ("udp://[::1?format=mcu", "no URI"),
        ("file://a#b.csv", "%23"),
        ("file://walk.bin", "format="),
        ("file://walk.csv?follow=perhaps", "true or false"),
    ],
)
def test_what_is_wrong_is_refused_and_what_is_allowed_is_said(text, says):
    with pytest.raises(SourceError) as refusal:
        parse_uri(text)
    assert says in str(refusal.value)
    assert text.split("?")[0] in str(refusal.value) or "format is" in str(refusal.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("udp://localhost?format=mcu", "HOST:PORT"),
        ("udp://localhost:99999?format=mcu", "65535"),
        ("tcp://a..b:7000?format=mcu", "a..b:7000"),
        ("tcp://localhost:0?format=mcu", "a port from 1 to 65535"),
        ("ble://left_foot", "'left_foot'; allowed is as in D4:22"),
        ("ble://D4:22:CD:00:12", "'D4:22:CD:00:12'"),
        ("udp://:8000?format=mcu&peers=foot", "IP addresses"),
        ("file://no_such.csv", "no_such.csv"),
    ],
)
def test_a_source_that_cannot_be_put_together_is_refused_before_anything_is_opened(text, says):
    with pytest.raises(SourceError, match=says):
        make_transport(parse_uri(text))


def test_an_address_without_a_host_is_this_machine_only():
    assert parse_address(":8000") == ("127.0.0.1", 8000)
    assert str(parse_address("[::1]:8000")) == "[::1]:8000"


@given(st.text(max_size=60))
def test_any_text_is_understood_or_refused_and_nothing_else(text):
    with contextlib.suppress(SourceError):
        parse_uri(text)


@given(st.text(max_size=30), st.sampled_from(sorted(SCHEMES)))
def test_any_text_behind_a_known_scheme_is_understood_or_refused_and_nothing_else(text, scheme):
    with contextlib.suppress(SourceError):
        parse_uri(f"{scheme}://{text}")

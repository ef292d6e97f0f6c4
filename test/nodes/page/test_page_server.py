"""The server: it is read by its own address only, by several at once, and frees its port."""

import http.client
import json
import socket

import pytest

from dualfoot_ros.core import ConfigError
from dualfoot_ros.nodes.page import page_server
from dualfoot_ros.nodes.page.live_state import PERSON, LiveState
from dualfoot_ros.nodes.page.page_server import PageServer
from dualfoot_ros.nodes.page.trail import Place


@pytest.fixture
def server(monkeypatch):
    monkeypatch.setattr(page_server, "PERIOD_S", 0.01)
    made = PageServer("127.0.0.1", 0, LiveState(), "<p>the page</p>")
    yield made
    made.close()


def ask(server, path="/", method="GET", host=None, timeout=30):
    connection = http.client.HTTPConnection(*server.server_address[:2], timeout=timeout)
    connection.putrequest(method, path, skip_host=host is not None)
    if host is not None:
        connection.putheader("Host", host)
    connection.endheaders()
    return connection.getresponse()


def events(answer):
    """Yield the messages of a stream."""
    while line := answer.readline():
        if line.startswith(b"data: "):
            yield json.loads(line.removeprefix(b"data: "))


def test_the_page_and_its_state_are_served_and_never_kept(server):
    answer = ask(server)
    assert (answer.status, answer.read()) == (200, b"<p>the page</p>")
    assert answer.getheader("Cache-Control") == "no-store"
    server.state.show(phase="walking")
    assert json.loads(ask(server, "/state.json").read())["now"]["phase"] == "walking"
    assert ask(server, "/", "HEAD").read() == b""


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1:9", "[::1]:80", "192.168.1.5"])
def test_an_address_is_answered_to(server, host):
    assert ask(server, host=host).status == 200


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8770", "", "127.0.0.1.example"])
def test_another_name_is_refused_whatever_is_asked(server, host):
    for path in ("/", "/state.json", "/events"):
        answer = ask(server, path, host=host)
        assert answer.status == 421
        assert b"answers only to its address" in answer.read()


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS"])
def test_the_page_can_only_be_read(server, method):
    assert ask(server, method=method).status == 405


def test_an_unknown_path_names_those_that_are_there(server):
    answer = ask(server, "/../etc/passwd")
    assert answer.status == 404
    assert b"/state.json" in answer.read()


def test_a_stream_begins_with_all_and_goes_on_with_what_is_new(server):
    server.state.add((PERSON,), Place(0.0, 0.0, 0.0, 0.0))
    stream = events(ask(server, "/events"))
    assert next(stream)["trails"][PERSON]["places"] == [[0.0, 0.0, 0.0, 0.0]]
    server.state.add((PERSON,), Place(1.0, 5.0, 0.0, 0.0))
    new = next(m for m in stream if m["trails"])
    assert new["trails"] == {PERSON: {"first": 1, "places": [[1.0, 5.0, 0.0, 0.0]]}}


def test_several_browsers_are_served_and_one_too_many_is_told_so(server):
    streams = [ask(server, "/events") for _ in range(page_server.MOST_READERS)]
    assert all(next(events(each)) for each in streams)
    refused = ask(server, "/events")
    assert refused.status == 503
    assert b"close one" in refused.read()
    assert ask(server).status == 200


def test_a_browser_that_goes_away_makes_room_for_another(server):
    for _ in range(2):
        streams = [ask(server, "/events") for _ in range(page_server.MOST_READERS)]
        assert all(each.status == 200 for each in streams)
        for each in streams:
            each.close()
        free = [server.readers.acquire(timeout=60) for _ in streams]
        assert all(free)
        for _ in free:
            server.readers.release()


def test_a_port_that_is_in_use_is_named_with_what_to_do(server):
    port = server.server_address[1]
    with pytest.raises(ConfigError, match=rf"port {port} .* in use.*--port.*{port + 1}"):
        PageServer("127.0.0.1", port, LiveState(), "")


def test_an_address_of_another_machine_is_named():
    with pytest.raises(ConfigError, match=r"no address '192\.0\.2\.1'"):
        PageServer("192.0.2.1", 0, LiveState(), "")


def test_a_closed_server_ends_its_streams_and_frees_its_port():
    server = PageServer("127.0.0.1", 0, LiveState(), "")
    stream = ask(server, "/events")
    next(events(stream))
    port = server.server_address[1]
    server.close()
    assert list(events(stream)) is not None  # it has an end
    again = PageServer("127.0.0.1", port, LiveState(), "")
    again.close()


@pytest.mark.skipif(not socket.has_ipv6, reason="this machine has no IPv6")
def test_the_address_of_a_page_on_ipv6_has_brackets():
    try:
        server = PageServer("::1", 0, LiveState(), "")
    except ConfigError:
        pytest.skip("this machine has no ::1")
    assert server.url == f"http://[::1]:{server.server_address[1]}/"
    server.close()

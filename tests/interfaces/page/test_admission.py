"""Who is let in at the teaching page, and what it may say."""

import time
from pathlib import Path

import pages
import pytest
from drawn import pen, strokes
from gibberish import KINDS, messages
from hypothesis import given, settings
from hypothesis import strategies as some
from pages import HERE, LIVE, Nobody, page, served
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from motionese.errors import SettingError
from motionese.interfaces.page.admission import Admission
from motionese.interfaces.page.messages import MOST_AT_ONCE, MOST_BYTES, MOST_POINTS, Pace

TOKEN = "correct horse"


@pytest.fixture
def client(tmp_path):
    """A server without a robot."""
    (tmp_path / "session").mkdir()
    with served(Nobody, tmp_path / "session") as client:
        yield client


@pytest.mark.parametrize("path", ["/", "/health", "/export.npz", "/static/nothing.js", "/nowhere"])
def test_no_answer_lets_a_page_load_anything_from_elsewhere(client, path):
    policy = client.get(path).headers["content-security-policy"]
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert rules["default-src"] == rules["frame-ancestors"] == "'none'"
    assert rules["script-src"] == rules["style-src"] == rules["connect-src"] == "'self'"
    assert "unsafe" not in policy and "http" not in policy and "*" not in policy
    assert client.get(path).headers["x-content-type-options"] == "nosniff"


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8000", "127.0.0.1.evil.example", "192.168.0.7", "", "["]
)
def test_a_name_that_was_rebound_to_this_machine_is_refused(client, host):
    refused = client.get("/", headers={"host": host})
    assert refused.status_code == 403 and "server's" in refused.text
    with pytest.raises(WebSocketDisconnect) as closed:  # noqa: SIM117
        with client.websocket_connect(LIVE, headers={"host": host, "origin": f"http://{host}"}):
            pass
    assert closed.value.code == 1008


@pytest.mark.parametrize("host", ["127.0.0.1:8000", "localhost:8000", "[::1]:8000"])
def test_this_machine_is_let_in_under_its_own_names(client, host):
    assert client.get("/", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "origin", ["https://evil.example", "null", "http://127.0.0.1:9", "http://localhost:8000", None]
)
def test_pages_of_other_sites_open_no_connection(client, origin):
    headers = {} if origin is None else {"origin": origin}
    with pytest.raises(WebSocketDisconnect) as closed:  # noqa: SIM117
        with client.websocket_connect(LIVE, headers=headers):
            pass
    assert closed.value.code == 1008 and closed.value.reason


@pytest.mark.parametrize("host", ["0.0.0.0", "192.168.0.7", "::", "robot.local"])
def test_other_machines_need_a_token(host):
    with pytest.raises(SettingError, match="--token"):
        Admission(host)
    assert Admission(host, TOKEN)


@pytest.mark.parametrize("token", ["short", "pässwörter-sind-schön"])
def test_a_token_must_be_worth_its_name(token):
    with pytest.raises(SettingError, match="--token"):
        Admission("127.0.0.1", token)


def test_the_token_comes_once_in_the_address_and_then_as_a_cookie(tmp_path):
    with served(Nobody, tmp_path, Admission("0.0.0.0", TOKEN)) as client:
        assert client.get("/").status_code == 403
        assert client.get("/", params={"token": "wrong horse!"}).status_code == 403
        first = client.get("/", params={"token": TOKEN}, follow_redirects=False)
        assert first.status_code == 303 and first.headers["location"] == "/"
        cookie = first.headers["set-cookie"].lower()
        assert "httponly" in cookie and "samesite=strict" in cookie
        assert client.get("/").status_code == 200, "the cookie is enough"
        with page(client) as own:
            own.hear("owner")
        other = TestClient(client.app, base_url=HERE)
        with pytest.raises(WebSocketDisconnect), page(other) as stranger:
            stranger.hear("owner")
        assert client.get("/", headers={"host": "10.0.0.9:80"}).status_code == 200
        assert client.get("/", headers={"host": "evil.example"}).status_code == 403


@pytest.mark.parametrize(
    "path",
    ["/static/../server.py", "/static/%2e%2e/server.py", "/static//etc/passwd", "/../session.json"],
)
def test_no_path_leads_out_of_the_page(client, path):
    answer = client.get(path)
    assert answer.status_code in (403, 404) and "import" not in answer.text


DOWN = pen("down", [(0, 0.5, 0.5)])
POINT = '{"type":"pen","phase":"down","points":[[%s]]}'
WRONG = {
    "nonsense": "hello",
    "no object": "[]",
    "unknown": {"type": "shutdown"},
    "no type": {},
    "extra field": {"type": "imitate", "path": "/etc/passwd"},
    "NaN": POINT % "0, NaN, 0.5",
    "infinity": POINT % "0, Infinity, 0.5",
    "overflow": POINT % "0, 1e999, 0.5",
    "huge": POINT % "0, 1e9, 0.5",
    "negative time": POINT % "-1, 0.5, 0.5",
    "text": POINT % '0, "0.5", 0.5',
    "true": POINT % "0, true, 0.5",
    "follow": {**DOWN, "follow": 1},
    "two numbers": POINT % "0, 0.5",
    "many points": pen("down", [(0, 0.5, 0.5)] * (MOST_POINTS + 1)),
    "many bytes": POINT % ("0, 0.5, 0." + "5" * MOST_BYTES),
    "deep": "[" * 60_000,
    "long name": {"type": "demonstrate", "motion": "UR " + "↓" * 100},
    "entry": {"type": "forget", "entry": 1.5},
    "negative entry": {"type": "forget", "entry": -1},
    "map": {"type": "hover", "slow": [0, 1e300], "primitive": "UR ↓"},
    "robot": {"type": "begin", "with": "../run"},
    "surrogate": '{"type":"demonstrate","motion":"\\ud800"}',
}


@pytest.mark.parametrize("name", WRONG)
def test_a_malformed_message_closes_its_connection_and_nothing_else(client, name):
    with page(client) as own:
        own.hear("owner")
        with page(client) as other:
            other.say(WRONG[name])
            code, reason = other.closed()
            assert code == 1008 and 0 < len(reason.encode()) <= 123
        own.say({"type": "imitate"})
    assert [said["type"] for said in client.hub._supervisor.heard] == ["imitate", "left"]


@pytest.mark.parametrize(
    "said",
    [
        [pen("move", [(0, 0.5, 0.5)])],
        [pen("up")],
        [DOWN, DOWN],
        [DOWN, pen("up"), pen("up")],
        [DOWN, pen("move", [(20, 0.5, 0.5), (10, 0.5, 0.5)])],
        [pen("down", [(20, 0.5, 0.5)]), pen("move", [(10, 0.5, 0.5)])],
    ],
)
def test_a_drawing_out_of_order_closes_its_connection(client, said):
    with page(client) as own:
        for message in said:
            own.say(message)
        code, reason = own.closed()
    assert code == 1008 and "out of order" in reason


def test_a_page_says_hello_before_anything_else(client):
    with page(client, hello=False) as silent:
        silent.say({"type": "imitate"})
        assert silent.closed() == (1008, "a page must say hello first")


def test_bytes_are_no_messages(client):
    with page(client) as own:
        own.socket.send_bytes(b"\x00\xff")
        assert own.closed() == (1008, "messages must be text")


def test_too_many_messages_close_the_connection(client):
    with page(client) as own:
        for _ in range(int(MOST_AT_ONCE) + 200):
            own.say({"type": "stop"})
        assert own.closed() == (1008, "more than 60 messages a second")
    with page(client) as again:
        assert again.hear("owner")["yours"]


def test_a_pen_of_many_points_a_second_is_not_too_fast(client):
    with page(client) as own:
        for message in strokes("UR ↓↑", size=10):
            own.say(message)
        own.say({"type": "hello"})
        own.hear("owner")
    assert sum(said["type"] == "pen" for said in client.hub._supervisor.heard) > 10


def test_the_bucket_leaks():
    pace = Pace()
    for _ in range(int(MOST_AT_ONCE) - 1):
        pace.one_more()
    pace._at -= 1.0
    began = time.monotonic()
    for _ in range(50):
        pace.one_more()
    assert time.monotonic() - began < 1


@given(some.lists(messages, max_size=12))
@settings(max_examples=100)
def test_whatever_is_said_is_passed_on_as_it_should_be_or_refused(said):
    with served(Nobody, Path()) as client:
        with page(client) as own:
            for message in said:
                own.say(message)
        with page(client) as again:
            assert again.hear("owner")["yours"], "the server goes on"
        for passed in client.hub._supervisor.heard:
            assert passed["type"] in KINDS[1:17] or passed["type"] == "left"
            for at, x, y in passed.get("points", ()):
                assert 0 <= at <= 1e12 and -1 <= x <= 2 and -1 <= y <= 2


def test_a_page_that_hears_nothing_does_not_wait_for_ever(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "PATIENCE_S", 0.1)
    vain = pytest.raises(AssertionError, match="in vain for verdict after")
    with served(Nobody, tmp_path) as client, page(client) as own, vain:
        own.hear("verdict")

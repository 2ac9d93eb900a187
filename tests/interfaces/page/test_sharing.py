"""A session goes out as a file and comes in as one: who may, and what is refused."""

import io
import json
import zipfile

import pytest
from pages import HERE, Nobody, page, served

from motionese.interfaces.page import sharing
from motionese.interfaces.page.admission import Admission
from motionese.teaching.packed_session import MANIFEST, manifest, pack
from motionese.teaching.session_contents import OPENED

SHARED = "/session.motionese"
FROM_HERE = {"origin": HERE}


@pytest.fixture
def session(tmp_path):
    """A folder that looks like a session's, as far as the server knows them."""
    folder = tmp_path / "session"
    (folder / "robot-2").mkdir(parents=True)
    (folder / "session.json").write_text("{}")
    (folder / "robot-2" / "session.json").write_text("{}")
    (folder / MANIFEST).write_bytes(manifest("robot-2"))
    return folder


@pytest.fixture
def client(session):
    """A server without a robot."""
    with served(Nobody, session) as client:
        yield client


def waiting(session):
    return [path.name for path in session.glob(f"{OPENED}*")]


def test_what_goes_out_comes_in_and_waits_to_be_opened(client, session):
    packed = client.get(SHARED)
    assert "robot-school.motionese" in packed.headers["content-disposition"]
    assert set(zipfile.ZipFile(io.BytesIO(packed.content)).namelist()) == {
        *("session.json", "robot-2/session.json", "school.json")
    }
    names = [client.post(SHARED, content=packed.content, headers=FROM_HERE) for _ in range(2)]
    last = names[-1].json()["file"]
    assert waiting(session) == [f"{OPENED}{last}"], "what came before and was not opened is gone"
    assert (session / "session.json").read_text() == "{}", "nothing is replaced before"
    with page(client) as own:
        own.hear("owner")
        own.say({"type": "open", "file": last})
        own.say({"type": "open", "file": "../../etc"})
        assert own.closed()[0] == 1008
    heard = [said for said in client.hub._supervisor.heard if said["type"] == "open"]
    assert [said["file"] for said in heard] == [last]


def test_a_session_that_is_not_there_yet_is_told(tmp_path):
    with served(Nobody, tmp_path) as client:
        answer = client.get(SHARED)
    assert answer.status_code == 404 and "no session" in answer.text


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 and nothing", b"GIF89a"])
def test_what_is_no_session_is_refused_in_a_sentence(client, session, content):
    refused = client.post(SHARED, content=content, headers=FROM_HERE)
    assert refused.status_code == 422
    assert refused.text.startswith("This file is no session") and "/" not in refused.text
    assert waiting(session) == []


def test_a_newer_format_is_refused_by_name(client, session):
    newer = json.dumps({"format": "motionese-school", "version": 2, "taught": "robot-7"})
    (session / MANIFEST).write_text(newer)
    refused = client.post(SHARED, content=pack(session), headers=FROM_HERE)
    assert refused.status_code == 422 and "format 2" in refused.text


def test_what_is_too_large_is_not_read_to_its_end(client, session, monkeypatch):
    monkeypatch.setattr(sharing, "MOST_PACKED", 1000)
    read = []

    def endless():
        while len(read) < 100:
            read.append(1)
            yield bytes(100)

    refused = client.post(SHARED, content=endless(), headers=FROM_HERE)
    assert refused.status_code == 413 and "larger" in refused.text
    assert waiting(session) == []


@pytest.mark.parametrize(
    "headers",
    [
        *({}, {"origin": "https://evil.example"}, {"origin": "null"}),
        {"host": "evil.example", "origin": "http://evil.example"},
    ],
)
def test_other_sites_send_nothing(client, session, headers):
    refused = client.post(SHARED, content=pack(session), headers=headers)
    assert refused.status_code == 403 and waiting(session) == []
    assert "default-src 'none'" in refused.headers["content-security-policy"]


def test_where_there_is_a_token_it_is_asked_for(session):
    with served(Nobody, session, Admission("0.0.0.0", "correct horse")) as client:
        assert client.get(SHARED).status_code == 403
        assert client.post(SHARED, content=pack(session), headers=FROM_HERE).status_code == 403
        client.get("/", params={"token": "correct horse"})
        assert client.get(SHARED).status_code == 200
        assert client.post(SHARED, content=pack(session), headers=FROM_HERE).status_code == 200


def test_the_export_is_that_of_the_robot_that_is_taught(client, session):
    (session / "demonstrations.npz").write_bytes(b"first")
    assert client.get("/export.npz").status_code == 404
    (session / "robot-2" / "demonstrations.npz").write_bytes(b"second")
    assert client.get("/export.npz").content == b"second"

"""A page teaches a robot through the server, with the robot in a process of its own."""

import numpy as np
import pytest
from drawn import pen, strokes
from gibberish import messages, right
from hypothesis import given, settings
from hypothesis import strategies as some
from pages import page, served

from motionese.imitation import Scene, newborn
from motionese.interfaces.page.supervisor import Supervisor
from motionese.interfaces.page.worker import Origin
from motionese.recordings import read
from motionese.teaching.school import read_school
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture(scope="module")
def session(tmp_path_factory, small_settings):
    """The folder of a session whose robot knows next to nothing and learns in a moment."""
    folder, scene = SessionFolder(tmp_path_factory.mktemp("session")), Scene(small_settings, 0)
    learner = newborn(scene, 2)
    values, state = np.full((14, len(learner.channels)), 0.5), np.zeros(learner.network.size)
    folder.begin("fresh", scene, learner.experiencing(1, "LL ↑", values, state))
    return folder.path


@pytest.fixture(scope="module")
def client(session):
    """A server whose robot is awake."""
    with served(lambda told: Supervisor(Origin("", session), told), session) as client:
        with page(client) as first:
            first.hear("worker", where=lambda m: m["state"] == "ready")
        yield client


def idle(own):
    return own.hear("session", where=lambda m: m["busy"] == "")


def show(own, name):
    for message in strokes(name):
        own.say(message)
    verdict = own.hear("verdict")
    return verdict, idle(own)


def test_a_page_is_told_all_it_needs(client):
    with page(client) as own:
        scene, session = own.hear("scene"), own.hear("session")
    assert own.heard[0] == {"type": "owner", "yours": True, "sentence": ""}
    task = scene["task"]
    assert set(task["places"]) == {"UR", "UL", "LR", "LL"}
    assert task["places"]["LR"]["title"] == "the lower right, where a button is"
    assert [effect["places"] for effect in task["effects"]] == [["LR"], ["LL"]]
    assert {(p["sign"], p["start"]) for p in task["primitives"]} >= {("↓", "UR"), ("←", "UR")}
    assert len(task["motions"]) == 5 + 6 + 7 and scene["rate_hz"] == 10
    assert [level["name"] for level in scene["levels"]] == ["io", "cf", "cs"]
    assert {"name", "body", "type", "size", "pos", "quat", "rgba"} == set(
        scene["robot"]["geoms"][0]
    )
    assert len(scene["robot"]["pose"]) == 7 * len(scene["robot"]["bodies"])
    assert [c["unit"] for c in scene["channels"]] == ["rad"] * 4 + ["px"] * 2
    assert session["phase"] == 1 and session["can_grow"]


def test_drawing_understanding_verdict_imitation_learning(client, session):
    with page(client) as own:
        before = idle(own)
        verdict, noted = show(own, "UR ←")
        assert verdict["shown"] == verdict["motion"] == "UR ←" and verdict["advice"] == "imitate"
        assert verdict["seen"][0]["share"] > 0.9 and not verdict["claim"]["made"]
        assert len(verdict["path"]) == len(verdict["drawn"]) and len(verdict["next"]) == 14
        assert noted["notebook"][-1]["motion"] == "UR ←" and noted["shown"] == verdict["entry"]
        assert noted["watched"] == verdict["drawn"], "a page that comes later can show it again"
        assert len(noted["notebook"]) == len(before["notebook"]) + 1

        own.say({"type": "imitate"})
        performed = own.hear("performed")
        assert performed["pushes"] == [] and performed["advice"] == "learn"
        assert performed["sentence"].startswith("It missed by")
        assert performed["begins"] == [0.0] and len(performed["path"]) == len(verdict["drawn"])
        frames = [m for m in own.heard if m["type"] == "frames"]
        count = sum(len(m["poses"]) for m in frames)
        assert count == 2 * len(verdict["drawn"]) - 1 and frames[-1]["last"]
        assert [m["from"] for m in frames] == list(range(0, count, 4))
        assert frames[0]["rate_hz"] == 20 and len(frames[0]["activity"]["cf"][0]) == 40

        own.say({"type": "learn"})
        learned = own.hear("learned")
        assert learned["entry"] == verdict["entry"] and learned["motion"] == "UR ←"
        practices = [m for m in own.heard if m["type"] == "practice"]
        assert [m["attempt"] for m in practices] == list(range(practices[0]["of"] + 1))
        assert [m["error_cm"] for m in practices] == learned["tries"]
        assert all(set(m["film"]) >= {"poses", "actual", "commanded"} for m in practices)
        assert len(practices[0]["film"]["poses"]) == count
        assert learned["after_cm"] == learned["tries"][learned["kept"]]
        assert "cm" in learned["sentence"]
        assert not learned["claim"]["made"] and "my last try" in learned["claim"]["sentence"]
        progress = [m for m in own.heard if m["type"] == "progress"]
        assert [m["done"] for m in progress] == list(range(5, progress[0]["of"] + 1, 5))
        after = idle(own)
        assert after["notebook"][-1]["learned"] == bool(learned["kept"])
        (curve,) = [c for c in after["curves"] if c["motion"] == "UR ←"]
        assert curve["points"][-1]["error_cm"] == learned["after_cm"]

        own.say({"type": "replay", "entry": verdict["entry"]})
        replayed = own.hear("replayed")
        assert replayed["error_cm"] == learned["after_cm"]
        assert replayed["sentence"].startswith("It missed by") and replayed["advice"] == "learn"
        kept = practices[learned["kept"]]
        assert {**kept, "type": "replayed"}["film"] == replayed["film"], "what it can do now"
        idle(own)
    with page(client) as reloaded:
        found = reloaded.hear("session")
        assert found["notebook"] == after["notebook"] and found["shown"] == verdict["entry"]
    exported = client.get("/export.npz")
    assert "attachment" in exported.headers["content-disposition"]
    (session / "got.npz").write_bytes(exported.content)
    assert read(session / "got.npz").episodes[-1].name.startswith("UR ←")


def test_what_is_understood_is_told_while_the_pen_moves(client):
    with page(client) as own:
        idle(own)
        *drawing, up = strokes("UR ↓")
        for message in drawing:
            own.say(message)
        understanding = own.hear("understanding")
        assert (
            understanding["seen"][0]["motion"].startswith("UR") and len(understanding["next"]) == 14
        )
        own.say(up)
        own.hear("verdict")


def test_the_scripted_caregiver_shows_and_is_understood(client):
    with page(client) as own:
        idle(own)
        own.say({"type": "demonstrate", "motion": "UR ↓"})
        shown = own.hear("shown")
        assert shown["path"][0][0] == 0 and len(shown["path"]) == 14
        own.say({"type": "demonstrate", "motion": "UR ←"})
        assert "wait a moment" in own.hear("told")["sentence"]
        assert own.hear("verdict")["shown"] == "UR ↓"
        assert idle(own)["notebook"][-1]["source"] == "scripted"
        own.say({"type": "demonstrate", "motion": "UR →"})
        assert own.hear("told")["kind"] == "refusal"


def test_slips_of_the_pen_are_told_kindly(client):
    with page(client) as own:
        idle(own)
        own.say(pen("down", [(0, 0.5, 0.5)]))
        own.say(pen("up"))
        assert "very short" in own.hear("told")["sentence"]


def test_a_second_page_is_told_and_may_take_over(client):
    with page(client) as own:
        own.hear("owner")
        with page(client) as second:
            assert not second.hear("owner")["yours"]
            second.say({"type": "learn"})
            assert second.hear("told")["kind"] == "refusal"
            second.say({"type": "hello", "take": True})
            assert second.hear("owner")["yours"] and second.hear("session")
            assert not own.hear("owner")["yours"]
            own.say({"type": "imitate"})
            assert own.hear("told")["kind"] == "refusal"


def test_what_has_emerged_is_told_when_there_is_time_and_to_every_page(client):
    with page(client) as own:
        told = own.hear("emergence")
    assert len(told["directions"]) == 5 and told["levels"] == ["io", "cf"]
    assert {d["primitive"]: d["learned"] for d in told["directions"]}["LL ↑"]
    assert not told["slow"] and "no slow level" in told["first"]["missing"]
    with page(client) as other:
        assert other.hear("emergence") == told


@pytest.mark.slow
def test_undo_and_growth_and_the_map(client):
    with page(client) as own:
        before = show(own, "UR ↓")[1]
        number = before["notebook"][-1]["entry"]
        own.say({"type": "forget", "entry": number})
        assert number not in [e["entry"] for e in idle(own)["notebook"]]
        own.say({"type": "map"})
        fast = own.hear("map")
        assert (fast["level"], fast["slow"]) == ("cf", False), "there is no slow level yet"
        show(own, "UR ↓")
        own.say({"type": "learn"})
        own.hear("learned")
        idle(own)
        own.say({"type": "grow"})
        grown = own.hear("grown")
        assert grown["levels"] == ["io", "cf", "cs"]
        assert "UR ↓" in [change["motion"] for change in grown["changes"]] and grown["sentence"]
        assert idle(own)["phase"] == 2
        own.say({"type": "map"})
        drawn = own.hear("map")
        assert (drawn["level"], drawn["slow"]) == ("cs", True)
        for strokes in drawn["primitives"].values():
            (first, second), points = strokes, len(drawn["axis"]) ** 2
            assert {len(s[of]) for s in (first, second) for of in ("direction", "way")} == {points}
        own.say({"type": "hover", "slow": [0.5, -1.0], "primitive": "UR ↓"})
        hovered = own.hear("hovered")
        assert len(hovered["path"]) == 28 and hovered["slow"] == [0.5, -1.0]


@pytest.mark.slow
def test_thousands_of_messages_leave_server_and_session_whole(client, session):
    said = 0

    @given(some.lists(messages | right, min_size=8, max_size=30))
    @settings(max_examples=300)
    def spoken(some_messages):
        nonlocal said
        with page(client) as own:
            for message in some_messages:
                own.say(message)
                said += 1

    pid = client.hub.worker_pid
    spoken()
    assert said > 2000
    with page(client) as own:
        own.say({"type": "stop"})
        verdict, after = show(own, "UR ←")
        assert verdict["shown"] == "UR ←" and after["notebook"][-1]["entry"] == verdict["entry"]
    assert client.hub.worker_pid == pid, "the robot's process went on all the time"
    assert client.get("/").status_code == 200
    outside = {path.name for path in session.parent.iterdir()}
    assert read_school(session).taught.teaching.notebook.entries[-1].motion == "UR ←"
    assert outside == {path.name for path in session.parent.iterdir()}

"""What every robot promises at every task; a further robot is a row of BODIES, a task one of TASKS.

A trial depends on its own calls and its generator, and on nothing before it.
"""

import subprocess
import sys
from functools import cache

import numpy as np
import pytest

from motionese.body import BODIES, Geometry, SimulatedRobot, load_model, open_body, pictures
from motionese.body.rendering import open_renderer
from motionese.errors import MotionError, RenderingError, SettingError, TaskError
from motionese.minimum_jerk import minimum_jerk
from motionese.task import TASKS

SHARES = minimum_jerk(np.minimum(np.arange(1, 15) / 12, 1.0))
"""Twelve steps of a stroke and two of rest."""
NOISE_PX = 0.3

every_pair = pytest.mark.parametrize("pair", [(b, t) for b in BODIES for t in TASKS], ids="-".join)
"""Every robot at every task."""
every_body = pytest.mark.parametrize("name", BODIES)


@cache
def body_at(name, task, **chosen):
    """Return a robot at a task, opened once: every trial restores it."""
    return open_body(BODIES[name][0](**chosen), TASKS[task])


@cache
def command_at(body, place):
    return body.command_reaching(body.task.position(place))


def some_posture(body, share):
    low, high = body.command_range
    return low + share * (high - low)


def acting(body, seed=5):
    body.reset(some_posture(body, 0.6), np.random.default_rng(seed))
    sensed = [body.sense()]
    for share in np.linspace(0.6, 0.4, 6):
        body.command(some_posture(body, share))
        body.step()
        sensed.append(body.sense())
    return np.array(sensed)


def watching(body, primitive, seed=6):
    path = path_of(body, primitive)
    body.watch(path[0], np.random.default_rng(seed))
    sensed = [body.sense()]
    for position in path[1:]:
        body.move_caregiver(position)
        body.step()
        sensed.append(body.sense())
    return np.array(sensed)


def path_of(body, primitive):
    start, end = (body.task.position(place) for place in (primitive.start, primitive.end))
    return body.reachable(primitive.way(np.concatenate([[0.0], SHARES]), start, end))


def performing(body, primitive, seed=7):
    start, end = (command_at(body, place) for place in (primitive.start, primitive.end))
    body.reset(start, np.random.default_rng(seed))
    sensed = [body.sense()]
    for share in SHARES:
        body.command(start + share * (end - start))
        body.step()
        sensed.append(body.sense())
    return np.array(sensed)


def direction(body, position):
    x, y, z = position - body.eye_position
    return np.array([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))])


def ray(bearing):
    azimuth, elevation = bearing
    ahead = np.cos(elevation)
    return np.array([ahead * np.cos(azimuth), ahead * np.sin(azimuth), np.sin(elevation)])


@every_pair
def test_joints_are_among_the_channels(pair):
    body = body_at(*pair)
    assert isinstance(body, SimulatedRobot)
    units = {channel.name: channel.unit for channel in body.channels}
    assert [units[joint] for joint in body.joints] == ["rad"] * len(body.joints)
    assert body.command_range.shape == (2, len(body.joints))
    assert (body.command_range[0] < body.command_range[1]).all()
    assert body.channels.names[-2:] == ("u", "v") and body.sense().shape == (len(units),)
    assert body.rate_hz == 10.0


@every_body
def test_a_joint_that_is_not_sensed_is_refused(name, monkeypatch):
    settings, robot = BODIES[name]
    other = type("Other", (robot,), {"joints": (*robot.joints, "knee")})
    monkeypatch.setitem(BODIES, name, (settings, other))
    with pytest.raises(SettingError, match=rf"body {name} commands knee, which it does not sense"):
        open_body(settings(), TASKS["shapes"])


@every_pair
def test_a_trial_is_the_same_bits_whatever_came_before(pair):
    name, task = pair
    used, stroke = body_at(name, task), TASKS[task].primitives[0]
    fresh = [open_body(BODIES[name][0](), TASKS[task]) for _ in range(2)]
    acted, watched = acting(fresh[0]), watching(fresh[1], stroke)
    for _ in range(2):
        np.testing.assert_array_equal(watching(used, stroke), watched)
        used.command(used.command_range[1])
        used.step()
        np.testing.assert_array_equal(acting(used), acted)
        used.move_caregiver(TASKS[task].position(stroke.end))
        used.step()


@every_body
def test_a_trial_is_the_same_bits_in_another_process(name):
    code = (
        "import sys, numpy as np\n"
        "from motionese.body import BODIES, open_body\n"
        "from motionese.task import PUSHING_BUTTONS\n"
        f"body = open_body(BODIES[{name!r}][0](), PUSHING_BUTTONS)\n"
        "low, high = body.command_range\n"
        "body.reset(low + 0.5 * (high - low), np.random.default_rng(3))\n"
        "body.command(low + 0.6 * (high - low))\n"
        "body.step()\n"
        "sys.stdout.buffer.write(body.sense().tobytes())"
    )
    other = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout
    body = body_at(name, "pushing_buttons")
    body.reset(some_posture(body, 0.5), np.random.default_rng(3))
    body.command(some_posture(body, 0.6))
    body.step()
    assert other == body.sense().tobytes()


@every_body
def test_noise_follows_the_generator(name):
    body = body_at(name, "pushing_buttons")
    one, same, other = acting(body, 1), acting(body, 1), acting(body, 2)
    np.testing.assert_array_equal(one, same)
    assert (one[:, -2:] != other[:, -2:]).all()
    np.testing.assert_array_equal(body.sense(), body.sense())


@every_body
def test_noise_is_what_was_set(name):
    body, exact = (body_at(name, "shapes", pixel_noise=noise) for noise in (NOISE_PX, 0.0))
    exact.reset(some_posture(exact, 0.5), np.random.default_rng(0))
    noisy = []
    for seed in range(100):
        body.reset(some_posture(body, 0.5), np.random.default_rng(seed))
        noisy.append(body.sense() - exact.sense())
    # The gaze of a trial settles on the noiseless picture: joints and neck are exact.
    assert np.abs(noisy)[:, :-2].max() == 0
    assert np.std(noisy, axis=0)[-2:] == pytest.approx([NOISE_PX] * 2, rel=0.25)


@every_pair
def test_a_command_beyond_the_range_is_clamped(pair):
    body, (_, high) = body_at(*pair), body_at(*pair).command_range
    sensed = []
    for command in (high, high + 1.0):
        body.reset(command, np.random.default_rng(1))
        body.command(some_posture(body, 0.5))
        body.step()
        body.command(command)
        body.step()
        sensed.append(body.sense())
    np.testing.assert_array_equal(*sensed)
    body.reset(some_posture(body, 0.5), np.random.default_rng(1))
    body.step()
    assert np.abs(body.sense() - sensed[0]).max() > 0.01


@every_body
@pytest.mark.parametrize("angle", [np.nan, np.inf])
def test_a_command_that_is_not_finite_is_refused(name, angle):
    body = body_at(name, "shapes")
    command = some_posture(body, 0.5)
    command[-1] = angle
    with pytest.raises(MotionError, match="must be finite, got"):
        body.command(command)


@every_body
def test_the_rate_changes_how_often_not_how_fast(name):
    sensed = []
    for rate_hz in (5.0, 10.0, 20.0):
        body = body_at(name, "shapes", rate_hz=rate_hz, pixel_noise=0.0)
        body.reset(some_posture(body, 0.4), np.random.default_rng(0))
        start = body.sense()
        body.command(some_posture(body, 0.6))
        for _ in range(round(0.4 * rate_hz)):
            body.step()
        sensed.append(body.sense())
    assert np.abs(sensed[0] - start)[body.channels.indices(body.joints)].min() > 0.02
    np.testing.assert_array_equal(sensed[1], sensed[0])
    np.testing.assert_array_equal(sensed[2], sensed[0])


@every_pair
def test_the_caregiver_s_hand_goes_where_it_is_told_within_a_step(pair):
    body, task = body_at(*pair), TASKS[pair[1]]
    start, end = (task.position(p) for p in (task.primitives[0].start, task.primitives[0].end))
    body.watch(start, np.random.default_rng(0))
    np.testing.assert_allclose(body.caregiver_position(), start, atol=1e-12)
    goal = (start + end) / 2
    body.move_caregiver(goal)
    goal += 9.0
    np.testing.assert_allclose(body.caregiver_position(), start, atol=1e-12)
    body.step()
    np.testing.assert_allclose(body.caregiver_position(), (start + end) / 2, atol=1e-12)


@every_pair
def test_the_caregiver_does_not_touch_the_robot(pair):
    body, hands = body_at(*pair), []
    for touching in (False, True):
        body.reset(some_posture(body, 0.5), np.random.default_rng(0))
        if touching:
            body.move_caregiver(body.hand_position())
        for _ in range(5):
            body.step()
        hands.append(body.hand_position())
    np.testing.assert_array_equal(*hands)


@every_pair
def test_the_hand_reaches_every_place_and_stays(pair):
    body = body_at(*pair)
    for place in body.task.places:
        position = body.task.position(place)
        assert np.linalg.norm(body.reachable(position) - position) < 0.01
        body.reset(command_at(body, place), np.random.default_rng(0))
        np.testing.assert_allclose(body.hand_position(), body.reachable(position), atol=3e-4)
        body.step()
        np.testing.assert_allclose(body.hand_position(), body.reachable(position), atol=3e-4)


@every_pair
def test_a_place_out_of_reach_is_named_with_its_distance(pair):
    body = body_at(*pair)
    with pytest.raises(TaskError, match=r"place X \(1.500, .* is [5-9].\.. cm out of the arm's"):
        body.command_reaching(np.array([1.5, -0.18, 1.0]), name="place X")


@every_pair
def test_what_is_sensed_is_finite_and_within_the_ranges_while_the_hand_moves(pair):
    body = body_at(*pair)
    seen = [i for i, n in enumerate(body.channels.names) if n not in body.joints]
    for primitive in body.task.primitives:
        own = body.channels.to_unit(performing(body, primitive))
        other = body.channels.to_unit(watching(body, primitive))[:, seen]
        for units in (own, other):
            assert np.isfinite(units).all()
            assert units.min() >= 0.1 and units.max() <= 0.9


@every_pair
def test_effects_are_named_as_the_task_names_them(pair):
    body, task = body_at(*pair), TASKS[pair[1]]
    for primitive in task.primitives:
        performing(body, primitive)
        assert tuple(body.effects()) == task.effects
        for name, depth in body.effects().items():
            if name == primitive.effect:
                assert 9.0 < depth < 15.5
            else:
                assert depth < 0.1


@every_pair
@pytest.mark.parametrize("whose", ["own", "caregiver"])
def test_the_bearing_points_at_the_marker(pair, whose):
    name, task = pair
    body = body_at(name, task, pixel_noise=0.0)
    for primitive in body.task.primitives:
        trial, where = (
            (performing, body.hand_position)
            if whose == "own"
            else (watching, body.caregiver_position)
        )
        sensed = trial(body, primitive)
        assert body.bearing(sensed).shape == (len(sensed), 2)
        np.testing.assert_allclose(body.bearing(sensed[-1]), direction(body, where()), atol=1e-9)


@every_pair
def test_a_ray_meets_the_surface_of_the_hand_where_the_hand_is(pair):
    name, task = pair
    body = body_at(name, task, pixel_noise=0.0)
    for primitive in body.task.primitives:
        path = path_of(body, primitive)
        rays = np.array([ray(direction(body, position)) for position in path])
        assert np.linalg.norm(body.met(rays) - path, axis=-1).max() < 0.01
        performing(body, primitive)
        met = body.met(ray(body.bearing(body.sense())))
        assert np.linalg.norm(met - body.hand_position()) < 0.01


@every_pair
def test_what_is_reachable_stays_what_it_is(pair):
    body = body_at(*pair)
    beside = np.random.default_rng(0).uniform([0.2, -0.9, 0.4], [1.0, 0.6, 1.5], (50, 3))
    near = body.reachable(beside)
    assert np.linalg.norm(near - beside, axis=-1).max() > 0.1
    np.testing.assert_allclose(body.reachable(near), near, atol=1e-9)


@every_pair
def test_the_other_marker_is_out_of_view(pair):
    body, task = body_at(*pair), TASKS[pair[1]]

    def outside(hand, position):
        data = body._simulation.data
        behind = data.camera("eye").xmat.reshape(3, 3)[:, 2] @ (position - body.eye_position) > 0
        off = np.abs(data.sensor(f"{hand}_in_view").data - [64, 48]) - [64, 48]
        return behind or (off > 10).any()

    for place in task.places:
        body.reset(command_at(body, place), np.random.default_rng(0))
        assert outside("caregiver", body.caregiver_position())
        assert not outside("own", body.hand_position())
        body.watch(task.position(place), np.random.default_rng(0))
        assert outside("own", body.hand_position())


@every_pair
def test_a_pose_tells_where_every_shape_is(pair):
    name, task = pair
    body = body_at(name, task)
    geometry = Geometry(load_model(BODIES[name][0](), TASKS[task]))
    poses = []
    for share in (0.3, 0.7):
        body.reset(some_posture(body, share), np.random.default_rng(0))
        poses.append(body.pose())
    placed = geometry.placed(np.array(poses))
    assert placed.shape == (2, len(geometry.bodies), 7) and np.ptp(placed, axis=0).max() > 0.01
    carrier = next(s["body"] for s in geometry.shapes if s["name"] == "own_marker")
    apart = np.linalg.norm(placed[1, carrier, :3] - body.hand_position())
    (marker,) = (s for s in geometry.shapes if s["name"] == "own_marker")
    assert apart == pytest.approx(np.linalg.norm(marker["pos"]), abs=1e-4)


@pytest.fixture(scope="module")
def gl():
    try:
        open_renderer(load_model(BODIES["actroid"][0](), TASKS["shapes"]), 64, 48).close()
    except RenderingError as refusal:
        pytest.skip(str(refusal))


@every_pair
def test_pictures_show_the_hand_to_eye_and_onlooker(pair, gl):
    body, task = body_at(*pair), TASKS[pair[1]]
    poses = []
    for place in list(task.places)[:2]:
        body.reset(command_at(body, place), np.random.default_rng(0))
        poses.append(body.pose())
    for camera in ("outside", "eye"):
        film = pictures(body.model, np.array(poses), camera=camera)
        assert film.shape == (2, 240, 320, 3) and (film[0] != film[1]).any()
    red = (film[..., 0] > 200) & (film[..., 1:] < 60).all(axis=-1)
    assert (red.sum(axis=(1, 2)) > 50).all()


@every_body
def test_a_rendered_hand_agrees_with_its_projection(name, gl):
    pytest.importorskip("cv2")
    for task in TASKS:
        rendered, exact = (
            body_at(name, task, **chosen) for chosen in ({"vision": "rendered"}, {"pixel_noise": 0})
        )
        for trial in (performing, watching):
            primitive = rendered.task.primitives[0]
            apart = (trial(rendered, primitive) - trial(exact, primitive))[:, -2:]
            assert np.abs(apart).max() < 1.5
            assert np.sqrt(np.mean(np.square(apart))) < 0.5


@every_body
def test_a_hand_out_of_view_is_not_observed_until_it_comes_back(name, gl):
    pytest.importorskip("cv2")
    body = body_at(name, "shapes", vision="rendered")
    position = body.task.position("T")
    body.watch(position, np.random.default_rng(0))
    before = body.sense()
    body.move_caregiver(np.array([-2.0, 0.0, 1.0]))
    for _ in range(3):
        body.step()
    unseen = body.sense()
    assert np.isnan(unseen[-2:]).all() and np.isfinite(unseen[:-2]).all()
    body.step()
    # The gaze rests where it is.
    np.testing.assert_allclose(body.sense()[:-2], unseen[:-2], atol=2e-2)
    body.move_caregiver(position)
    for _ in range(15):
        body.step()
    np.testing.assert_allclose(body.sense(), before, atol=1.0)

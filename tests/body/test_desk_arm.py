"""The desk arm: quick servos, three joints in closed form, a camera that stands still."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from motionese.body.desk_arm import DeskArm, DeskArmSettings
from motionese.body.desk_arm.desk_arm import COMMAND_RANGE, JOINTS
from motionese.task import PUSHING_BUTTONS, TASKS

POSTURES = arrays(np.float64, 3, elements=st.floats(0, 1)).map(
    lambda share: COMMAND_RANGE[0] + share * (COMMAND_RANGE[1] - COMMAND_RANGE[0])
)
AWAY, NOTHING = np.array([1.3, 1.1, 0.95]), np.zeros(0)


@pytest.fixture(scope="module", params=TASKS)
def arm(request):
    return DeskArm(DeskArmSettings(pixel_noise=0.0), TASKS[request.param])


@pytest.fixture(scope="module")
def at_buttons():
    return DeskArm(DeskArmSettings(pixel_noise=0.0), PUSHING_BUTTONS)


def test_closed_form_agrees_with_the_model_everywhere(at_buttons):
    data = mujoco.MjData(at_buttons.model)
    postures = np.random.default_rng(3).uniform(*COMMAND_RANGE, size=(50, 3))
    simulated = []
    for posture in postures:
        for joint, angle in zip(JOINTS, posture, strict=True):
            data.joint(joint).qpos = angle
        mujoco.mj_kinematics(at_buttons.model, data)
        simulated.append(data.site("own_marker").xpos.copy())
    np.testing.assert_allclose(at_buttons.marker_at(postures), simulated, atol=1e-12)


@given(POSTURES)
def test_inverse_undoes_forward(at_buttons, posture):
    marker = at_buttons.marker_at(posture)
    np.testing.assert_allclose(at_buttons.angles_nearest(marker), posture, atol=1e-6)
    np.testing.assert_allclose(at_buttons.reachable(marker), marker, atol=1e-9)


def test_the_camera_is_where_the_model_has_it(at_buttons):
    np.testing.assert_array_equal(at_buttons.eye_position, at_buttons.model.camera("eye").pos)


@pytest.mark.parametrize("joint", [0, 1, 2])
def test_step_response(at_buttons, joint):
    simulation = at_buttons._simulate()
    start = np.radians([-15.0, 15.0, 60.0])
    simulation.place(start, NOTHING, AWAY)
    for _ in range(60):
        simulation.advance(start, NOTHING)
    step = np.radians(10.0) * np.eye(3)[joint]
    before, way = simulation.angles[joint], []
    # One physics step between two pictures, to look at every one of them.
    simulation.substeps = 1
    for _ in range(300):
        simulation.advance(start + step, NOTHING)
        way.append((simulation.angles[joint] - before) / step[joint])
    assert 100 <= 5 * (np.argmax(np.array(way) > 0.632) + 1) <= 150
    assert max(way) < 1.01 and way[-1] > 0.98


def test_a_folded_arm_rests_where_it_is_put(arm, rng):
    arm.watch(arm.task.position(next(iter(arm.task.places))), rng)
    np.testing.assert_allclose(arm.sense()[:3], arm.folded, atol=0.03)
    # Behind the camera.
    assert arm.hand_position()[0] < arm.eye_position[0]


def followed(arm, primitive, rng, minimum_jerk):
    """Return the path of a stroke, where the marker was, and what was sensed and commanded."""
    start, end = (arm.task.position(place) for place in (primitive.start, primitive.end))
    path = primitive.way(np.concatenate([[0.0], minimum_jerk]), start, end)
    angles = arm.angles_nearest(path)
    sag = [arm.command_reaching(p) - a for p, a in ((start, angles[0]), (end, angles[-1]))]
    share = np.concatenate([[0.0], minimum_jerk])[:, None]
    commands = angles + (1 - share) * sag[0] + share * sag[1]
    arm.reset(commands[0], rng)
    done, sensed = [arm.hand_position()], [arm.sense()]
    for command in commands[1:]:
        arm.command(command)
        arm.step()
        done.append(arm.hand_position())
        sensed.append(arm.sense())
    return path, np.array(done), np.array(sensed), commands


def test_follows_strokes_with_less_than_a_step_of_lag(arm, rng, minimum_jerk):
    for primitive in arm.task.primitives:
        path, done, _, _ = followed(arm, primitive, rng, minimum_jerk)
        rows = np.arange(len(path))
        late = [
            np.linalg.norm(
                done - np.stack([np.interp(rows - lag, rows, c) for c in path.T], axis=-1), axis=-1
            ).max()
            for lag in np.linspace(0, 1, 11)
        ]
        assert min(late) < 0.015


@pytest.mark.slow
def test_ranges_hold_what_occurs_and_not_much_more(rng, minimum_jerk):
    units = []
    for task in TASKS.values():
        arm = DeskArm(DeskArmSettings(), task)
        for primitive in task.primitives:
            _, _, sensed, commands = followed(arm, primitive, rng, minimum_jerk)
            units += [arm.channels.to_unit(sensed)]
            units += [arm.channels.to_unit(np.hstack([commands, sensed[:, 3:]]))]
    units = np.concatenate(units)
    assert units.min() >= 0.1 and units.max() <= 0.9
    assert (np.ptp(units, axis=0) > 0.5).all()


def test_off_the_plane_the_picture_alone_does_not_tell(at_buttons):
    place = at_buttons.task.position("UL")
    ray = place - at_buttons.eye_position
    np.testing.assert_allclose(at_buttons.met(ray), place, atol=1e-9)
    np.testing.assert_allclose(at_buttons.met(0.9 * ray), place, atol=1e-9)

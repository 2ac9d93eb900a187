import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from motionese.body import load_model
from motionese.body.actroid import ActroidSettings
from motionese.body.actroid.reach import (
    COMMAND_RANGE,
    arm_nearest,
    marker_at,
    on_reach,
    projected,
    reachable,
)
from motionese.errors import TaskError
from motionese.task import PUSHING_BUTTONS

CORNERS = {name: PUSHING_BUTTONS.position(name) for name in PUSHING_BUTTONS.places}

POSTURES = arrays(np.float64, 2, elements=st.floats(0, 1)).map(
    lambda share: COMMAND_RANGE[0] + share * (COMMAND_RANGE[1] - COMMAND_RANGE[0])
)


def test_closed_form_agrees_with_the_model_everywhere():
    model = load_model(ActroidSettings(), PUSHING_BUTTONS)
    data = mujoco.MjData(model)
    rng = np.random.default_rng(3)
    postures = rng.uniform(*COMMAND_RANGE, size=(50, 2))
    simulated = []
    for shoulder, armpit in postures:
        data.joint("shoulder").qpos = shoulder
        data.joint("armpit").qpos = armpit
        mujoco.mj_kinematics(model, data)
        simulated.append(data.site("own_marker").xpos.copy())
    np.testing.assert_allclose(marker_at(postures), simulated, atol=1e-12)


@given(POSTURES)
def test_inverse_undoes_forward(posture):
    np.testing.assert_allclose(arm_nearest(marker_at(posture)), posture, atol=1e-9)


@given(POSTURES, st.floats(0.8, 1.25))
def test_projection_is_the_nearest_reachable_point(posture, stretch):
    reachable = marker_at(posture)
    shoulder = np.array([0.0, -0.18, 1.07])
    beside = shoulder + stretch * (reachable - shoulder)
    np.testing.assert_allclose(projected(beside), reachable, atol=1e-12)
    others = marker_at(posture + np.random.default_rng(0).normal(0, 0.1, (30, 2)))
    nearest = np.linalg.norm(beside - projected(beside))
    assert (np.linalg.norm(others - beside, axis=-1) >= nearest - 1e-12).all()


def test_projected_path_stays_on_the_surface_and_keeps_its_ends():
    path = CORNERS["UR"] + np.linspace(0, 1, 28)[:, None] * (CORNERS["LR"] - CORNERS["UR"])
    surface = projected(path)
    np.testing.assert_allclose(surface[[0, -1]], path[[0, -1]], atol=1e-12)
    assert 0.005 < np.linalg.norm(surface - path, axis=-1).max() < 0.02
    for point in surface:
        np.testing.assert_allclose(marker_at(arm_nearest(point)), point, atol=1e-12)


@pytest.mark.parametrize(("start", "end"), [("UR", "LR"), ("UL", "LL"), ("UR", "UL")])
def test_strokes_are_about_a_forearm_long(start, end):
    assert 0.20 < np.linalg.norm(CORNERS[start] - CORNERS[end]) < 0.26


def test_corners_lie_as_they_are_called():
    assert CORNERS["UR"][1] < CORNERS["UL"][1] and CORNERS["LR"][1] < CORNERS["LL"][1]
    assert CORNERS["LR"][2] < CORNERS["UR"][2] and CORNERS["LL"][2] < CORNERS["UL"][2]


@given(POSTURES, st.floats(0.2, 0.9))
def test_a_ray_from_inside_meets_the_surface(posture, share):
    origin = np.array([0.02, 0.0, 1.33])
    ray = share * (marker_at(posture) - origin)
    np.testing.assert_allclose(on_reach(origin, ray), marker_at(posture), atol=1e-9)


def test_points_beyond_the_range_of_angles_are_reached_at_its_edge():
    beyond = marker_at(COMMAND_RANGE[1] + [0.1, 0.2])
    np.testing.assert_allclose(reachable(beyond), marker_at(COMMAND_RANGE[1]), atol=1e-12)


@pytest.mark.parametrize(
    ("position", "miss"),
    [
        pytest.param([0.75, -0.30, 1.05], "22.7", id="too-far"),
        pytest.param([0.30, -0.60, 1.00], "22.0", id="armpit"),
        pytest.param([0.10, -0.18, 0.55], "32.2", id="shoulder"),
    ],
)
def test_unreachable_corner_is_named_with_its_distance(body, position, miss):
    with pytest.raises(TaskError, match=rf"place UR \({position[0]:.3f}, .* is {miss} cm") as e:
        body.command_reaching(np.array(position), name="place UR")
    assert "1 cm are allowed" in str(e.value) and "53.3 cm around" in str(e.value)


def test_tolerance_decides(body):
    off = CORNERS["UR"] + [0.02, 0.0, 0.0]
    with pytest.raises(TaskError):
        body.command_reaching(off)
    command = body.command_reaching(off, tolerance_m=0.03)
    assert np.linalg.norm(marker_at(command) - off) < 0.03

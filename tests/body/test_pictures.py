"""Rendered pictures: what the eye finds in them, films, and machines that render nothing."""

import os
import subprocess
import sys

import numpy as np
import pytest

from motionese.body import pictures
from motionese.body.actroid import Actroid, ActroidSettings
from motionese.body.actroid.reach import marker_at, projected
from motionese.body.eye import ProjectedEye
from motionese.body.graphics_library import without_graphics
from motionese.errors import RenderingError
from motionese.task import PUSHING_BUTTONS

CORNERS = {name: PUSHING_BUTTONS.position(name) for name in PUSHING_BUTTONS.places}


@pytest.fixture(scope="module")
def rendering_body(gl):
    pytest.importorskip("cv2")
    return Actroid(ActroidSettings(vision="rendered"), PUSHING_BUTTONS)


def off(body, hand):
    """Return the seen marker minus its exact projection [px]."""
    exact = ProjectedEye(body.model, 0.0).see(
        body._simulation.data, hand, np.zeros(2), np.random.default_rng(0)
    )
    return body.sense()[4:] - exact


def test_rendered_own_hand_agrees_with_the_projection(rendering_body, rng):
    apart = []
    rendering_body.reset(np.radians([8.0, -12.6]), rng)
    for _ in range(25):
        rendering_body.command(rng.uniform(np.radians([5, -15]), np.radians([38, 15])))
        rendering_body.step()
        apart.append(off(rendering_body, "own"))
    assert np.abs(apart).max() < 1
    assert np.sqrt(np.mean(np.square(apart))) < 0.3


def test_rendered_caregiver_agrees_with_the_projection(rendering_body, rng):
    apart = []
    rendering_body.watch(CORNERS["UL"], rng)
    for goal in ("LL", "UL", "UR", "LR"):
        start = rendering_body.caregiver_position()
        for share in np.linspace(0, 1, 8):
            rendering_body.move_caregiver(projected(start + share * (CORNERS[goal] - start)))
            rendering_body.step()
            apart.append(off(rendering_body, "caregiver"))
    assert np.abs(apart).max() < 1
    assert np.sqrt(np.mean(np.square(apart))) < 0.3


def test_of_two_markers_the_one_last_seen_is_followed(rendering_body, rng):
    rendering_body.reset(np.radians([20.0, -5.0]), rng)
    beside = marker_at(np.radians([20.0, 5.0]))
    rendering_body.move_caregiver(beside)
    for _ in range(4):
        rendering_body.step()
    assert np.abs(off(rendering_body, "own")).max() < 1


def test_rendered_trials_are_repeated_to_the_bit(rendering_body):
    def trial():
        rendering_body.reset(np.radians([8.0, -12.6]), np.random.default_rng(1))
        sensed = []
        for _ in range(6):
            rendering_body.command(np.radians([30.0, 10.0]))
            rendering_body.step()
            sensed.append(rendering_body.sense())
        return np.array(sensed)

    first = trial()
    rendering_body.watch(CORNERS["LL"], np.random.default_rng(2))
    np.testing.assert_array_equal(trial(), first)


def test_the_eye_draws_the_seen_hand_in_its_middle(gl, body, rng):
    body.reset(body.command_reaching(CORNERS["UR"]), rng)
    (picture,) = pictures(body.model, body.pose()[None], camera="eye")
    red = (picture[..., 0] > 200) & (picture[..., 1:] < 60).all(axis=-1)
    rows, columns = np.nonzero(red)
    np.testing.assert_allclose([columns.mean(), rows.mean()], [159.5, 119.5], atol=1)


def test_film_of_no_moments_is_empty(gl, body):
    none = np.empty((0, len(body.pose())))
    assert pictures(body.model, none, size=(64, 48)).shape == (0, 48, 64, 3)


WITHOUT_GL = """
import ctypes, os
load = ctypes.CDLL.__init__
def refuse(self, name, *rest, **more):
    if name and any(part in name for part in ("EGL", "libGL", "OSMesa")):
        raise OSError(name + ": cannot open shared object file")
    load(self, name, *rest, **more)
ctypes.CDLL.__init__ = refuse
ctypes.util = __import__("ctypes.util").util
ctypes.util.find_library = lambda name: None
from motionese.errors import RenderingError
try:
    from motionese.body import open_body, pictures
    from motionese.body.actroid import ActroidSettings
    from motionese.task import PUSHING_BUTTONS
    body = open_body(ActroidSettings(), PUSHING_BUTTONS)
    body.step()
    print("projected view works")
    for picture in (lambda: pictures(body.model, body.pose()[None]),
                    lambda: open_body(ActroidSettings(vision="rendered"), PUSHING_BUTTONS)):
        try:
            picture()
        except RenderingError as refusal:
            print(refusal)
except RenderingError as refusal:
    print(refusal)
"""
UNKNOWN_DRIVER = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"}


def printed(code, **variables):
    clean = {k: v for k, v in os.environ.items() if k not in ("MUJOCO_GL", "PYOPENGL_PLATFORM")}
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**clean, **variables},
        check=True,
    )
    return done.stdout.splitlines()


def test_without_gl_the_body_works_and_pictures_say_what_to_install():
    works, *refusals = printed(WITHOUT_GL)
    assert works == "projected view works"
    assert len(refusals) == 2
    for refusal in refusals:
        assert "libegl1" in refusal and "libgl1" in refusal
        assert "pip install 'motionese[vision]'" in refusal


def test_gl_that_cannot_open_a_picture_says_so(gl):
    code = WITHOUT_GL.split("ctypes.CDLL.__init__ = refuse")[0] + WITHOUT_GL.split("None\n", 1)[1]
    works, *refusals = printed(code, **UNKNOWN_DRIVER)
    assert works == "projected view works" and len(refusals) == 2
    assert all("libegl1" in refusal for refusal in refusals)


@pytest.mark.parametrize("asked", ["egl", "osmesa", "no such library"])
def test_missing_gl_that_was_asked_for_stops_pictures_alone(asked):
    works, *refusals = printed(WITHOUT_GL, MUJOCO_GL=asked)
    assert works == "projected view works" and len(refusals) == 2
    for refusal in refusals:
        assert f"unset MUJOCO_GL (it asks for '{asked}')" in refusal and "libegl1" in refusal


def test_choosing_gl_late_leaves_the_environment_as_it_was(monkeypatch):
    for before in ("osmesa", None):
        if before is None:
            monkeypatch.delenv("MUJOCO_GL", raising=False)
        else:
            monkeypatch.setenv("MUJOCO_GL", before)
        with without_graphics():
            assert os.environ["MUJOCO_GL"] == "disabled"
        assert os.environ.get("MUJOCO_GL") == before


def test_without_opencv_the_rendered_view_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    with pytest.raises(RenderingError, match=r"OpenCV: pip install 'motionese\[vision\]'"):
        Actroid(ActroidSettings(vision="rendered"), PUSHING_BUTTONS)

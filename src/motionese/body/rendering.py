"""Opens MuJoCo's renderer, or says what is missing on this machine."""

import importlib
import os
import platform

import mujoco

from motionese.errors import RenderingError

_refused: list[RenderingError] = []
"""The first failure, if any: MuJoCo ends the whole process when a failed GL library is retried."""


def open_renderer(model: mujoco.MjModel, width: int, height: int) -> mujoco.Renderer:
    """Return a renderer for pictures of width × height [px]; `close` it, or use it in a `with`.

    MuJoCo chooses its GL library while it is imported. Where nobody has chosen one, EGL, which
    needs no screen, is chosen now: asked for earlier, a machine without it could not even import
    MuJoCo.

    Raises:
        RenderingError: There is no GL library, or it cannot open a picture.
    """
    if _refused:
        raise _refused[0]
    try:
        if platform.system() == "Linux" and not os.environ.get("MUJOCO_GL"):
            _choose_egl()
        return mujoco.Renderer(model, height, width)
    except (ImportError, AttributeError, OSError, RuntimeError, mujoco.FatalError) as fault:
        refusal = RenderingError(
            "pictures cannot be rendered on this machine: install the libraries libegl1 and libgl1 "
            "(Debian, Ubuntu) and the Python packages of pip install 'motionese[vision]' "
            f"(the reason given: {str(fault) or type(fault).__name__})"
        )
        _refused.append(refusal)
        raise refusal from fault


def _choose_egl() -> None:
    """Let MuJoCo choose its GL library once more, with EGL as the answer."""
    from mujoco.rendering.classic import gl_context  # noqa: PLC0415

    os.environ["MUJOCO_GL"] = "egl"
    try:
        importlib.reload(gl_context)
    except BaseException:
        del os.environ["MUJOCO_GL"]
        raise

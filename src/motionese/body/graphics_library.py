"""The graphics library (GL) that MuJoCo draws with: chosen for the first picture, not before.

MuJoCo loads the library that MUJOCO_GL asks for while it is imported, and cannot be imported where
the machine has no such library, although nothing but pictures needs one.
"""

import importlib
import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager

NAME = "MUJOCO_GL"


@contextmanager
def without_graphics() -> Iterator[None]:
    """Let MuJoCo be imported without any graphics library."""
    with _asked_for("disabled"):
        yield


def choose_graphics() -> None:
    """Let MuJoCo load the library that was asked for; on Linux EGL, which needs no screen, if none.

    Raises:
        ImportError, AttributeError, OSError, RuntimeError: There is no such library.
    """
    from mujoco.rendering.classic import gl_context  # noqa: PLC0415

    wanted = os.environ.get(NAME) or ("egl" if platform.system() == "Linux" else "")
    if wanted != os.environ.get(NAME, "") or not hasattr(gl_context, "GLContext"):
        with _asked_for(wanted):
            importlib.reload(gl_context)
        os.environ[NAME] = wanted


@contextmanager
def _asked_for(wanted: str) -> Iterator[None]:
    before = os.environ.get(NAME)
    os.environ[NAME] = wanted
    try:
        yield
    finally:
        if before is None:
            del os.environ[NAME]
        else:
            os.environ[NAME] = before

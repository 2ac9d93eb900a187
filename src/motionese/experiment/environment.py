"""What an experiment was made with: versions and machine, without names of users or hosts."""

import os
import platform
from importlib import metadata
from typing import Any

PACKAGES = (
    "motionese",
    "jax",
    "jaxlib",
    "equinox",
    "optax",
    "mujoco-core",
    "numpy",
    "scipy",
    "pydantic",
    "distributed",
)


def environment() -> dict[str, Any]:
    """Return the versions of Python and of the packages that results depend on, and the machine."""
    return {
        "python": platform.python_version(),
        **versions(),
        "machine": f"{platform.system()} {platform.machine()}",
        "cores": os.cpu_count(),
    }


def versions() -> dict[str, str]:
    """Return the versions of the packages that results depend on."""
    return {package: metadata.version(package) for package in PACKAGES}

"""The environment in which one process does one run on one core, compiling nothing twice."""

import os
import sys
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ONE_THREAD = "--xla_cpu_multi_thread_eigen"
KEPT_FROM = "0.1"
"""Functions that compile faster than this [s] are not kept."""


@contextmanager
def one_core_each() -> Iterator[None]:
    """Let every process that is started meanwhile use one core; this one keeps its environment.

    The variables must be there when a process starts: jax reads them when it is imported.
    """
    before = dict(os.environ)
    os.environ.update(one_core())
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def one_core() -> dict[str, str]:
    """Return environment variables for a process that is to use one core.

    Networks this small are fastest on one core of a CPU. What XLA compiles is kept in
    `cache_folder`, where it can be written; what the user has set stands.
    """
    flags = os.environ.get("XLA_FLAGS", "")
    if ONE_THREAD not in flags:
        flags = f"{flags} {ONE_THREAD}=false".strip()
    variables = {
        "JAX_PLATFORMS": "cpu",
        "JAX_COMPILATION_CACHE_DIR": _writable(cache_folder()),
        "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": KEPT_FROM,
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
    }
    return {"XLA_FLAGS": flags} | {n: os.environ.get(n, v) for n, v in variables.items() if v}


def cache_folder() -> Path:
    """Return where compiled functions are kept: in the user's cache folder, apart by processor.

    That is `$XDG_CACHE_HOME` if set, else `~/.cache`, `~/Library/Caches` or `%LOCALAPPDATA%`,
    and there `motionese/compiled-…`; it may be deleted at any time.
    """
    usual = {"darwin": "~/Library/Caches", "win32": "~/AppData/Local"}
    told = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    base = told or usual.get(sys.platform, "~/.cache")
    return Path(base).expanduser() / "motionese" / f"compiled-{_processor():08x}"


def _processor() -> int:
    """Return a number for what this processor can do: code for another one may not run here."""
    known = Path("/proc/cpuinfo")
    lines = known.read_text().splitlines() if known.is_file() else []
    able = next((line for line in lines if line.startswith(("flags", "Features"))), "")
    return zlib.crc32(able.encode())


def _writable(folder: Path) -> str:
    """Return the folder, made if need be; nothing where it cannot be written to."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return ""
    return str(folder) if os.access(folder, os.W_OK) else ""

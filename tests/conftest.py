"""What all tests share: one thread, kept compilation, checked array shapes, fixed examples."""

import os
from pathlib import Path, PurePosixPath

from hypothesis import HealthCheck, settings
from jaxtyping import install_import_hook
from xdist.scheduler import LoadScopeScheduling

# Read by XLA when jax is imported, which must come after this line. Without its newer emitters of
# fused code XLA compiles in little more than half the time; `make test-all` leaves them on, as
# users have them. What stands behind a word without dashes is not read: that word is the last.
os.environ.setdefault(
    "XLA_FLAGS",
    "--xla_cpu_multi_thread_eigen=false --xla_cpu_use_fusion_emitters=false "
    "intra_op_parallelism_threads=1",
)
install_import_hook("motionese", "typechecking.checked")

import jax  # noqa: E402
import jaxtyping  # noqa: E402
import pytest  # noqa: E402

from motionese.one_core import cache_folder  # noqa: E402

# What is compiled is kept, here and by the commands that the tests start.
COMPILED = Path(__file__).parent.parent / "build" / "tests" / cache_folder().name
COMPILED.mkdir(parents=True, exist_ok=True)
os.environ["JAX_COMPILATION_CACHE_DIR"] = str(COMPILED)
jax.config.update("jax_compilation_cache_dir", str(COMPILED))
jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)

MAPPED, MOST_MAPPINGS = Path("/proc/self/maps"), 20_000
"""A process on Linux has at most 65,530 mappings, and every compiled function takes a few."""
COMPILING = (
    "analysis",
    "contracts",
    "imitation",
    "learning",
    "network",
    "roles",
    "runtime",
)
"""Folders whose tests compile far longer than they compute: little is optimised there.

Not `experiment`, which compares bits with those of processes that optimise."""

settings.register_profile(
    "motionese",
    derandomize=True,
    deadline=None,
    max_examples=15,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
settings.load_profile("motionese")


class ByFile(LoadScopeScheduling):
    """Keep a file's tests on one worker, and a folder's where they share what is dear to make."""

    def _split_scope(self, nodeid):
        path = PurePosixPath(nodeid.partition("::")[0])
        return str(path.parent if path.parent.name in ("experiment", "page") else path)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    return ByFile(config, log)


@pytest.fixture(autouse=True, scope="module")
def little_optimised(request):
    """Compile as fast as can be where that is what takes the time."""
    jax.config.update("jax_disable_most_optimizations", request.path.parent.name in COMPILING)
    yield
    jax.config.update("jax_disable_most_optimizations", False)


@pytest.fixture(autouse=True, scope="module")
def few_mappings():
    """Forget what was compiled before the system refuses to map more of it, and XLA crashes."""
    yield
    if MAPPED.is_file() and MAPPED.read_bytes().count(b"\n") > MOST_MAPPINGS:
        jax.clear_caches()


@pytest.fixture
def float64():
    """Let jax compute in double precision, as the twins by hand do."""
    with jax.enable_x64(True):
        yield


@pytest.fixture
def unchecked():
    """Run without the checks of annotations, as users do, to meet the package's own refusals."""
    jaxtyping.config.update("jaxtyping_disable", True)
    yield
    jaxtyping.config.update("jaxtyping_disable", False)

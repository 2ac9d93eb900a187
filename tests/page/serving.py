"""`motionese teach` in a process of its own, and a robot to begin with."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from urllib.request import urlopen

import psutil

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
"""The installed Chromium, if there is one."""
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream"),
)
COMMAND = str(Path(sys.executable).with_name("motionese"))
ENVIRONMENT = dict(os.environ)
"""As it is before any test changes it."""
TRAINING = """
import os, sys
from pathlib import Path
from motionese.one_core import one_core
os.environ.update(one_core())
from motionese.experiment import condition_named, go_through, read_settings
from motionese.experiment.run_folder import open_run_folder
short = ["stages.0.until.loops=8", "stages.1.until.loops=8"]

def told(loop):
    # What is taught on is the robot after the last loop; its evaluation is not needed.
    if loop == 16:
        sys.exit()

settings = read_settings("default", short)
with open_run_folder(Path(sys.argv[1]), settings, "default") as folder:
    condition = condition_named("TD/MD", settings.factors)
    go_through(folder.run(condition, 7), settings, told)
"""


@dataclass(frozen=True)
class Served:
    """A server that runs.

    Attributes:
        process: Its process.
        address: Its page.
    """

    process: "subprocess.Popen[str]"
    address: str

    def worker(self) -> psutil.Process:
        """The process that holds the robot."""
        (robot,) = (
            child
            for child in psutil.Process(self.process.pid).children()
            # One that was killed is a zombie until it is waited for, and has no command line.
            if child.status() != psutil.STATUS_ZOMBIE
            and any("spawn_main" in argument for argument in child.cmdline())
        )
        return robot

    def awake(self, patience_s: float = 120.0) -> "Served":
        """Wait until the robot is."""
        end = time.monotonic() + patience_s
        while b"ready" not in urlopen(f"{self.address}health").read():
            assert time.monotonic() < end, "the robot does not wake up"
            time.sleep(0.05)
        return self


def train_robot(folder: Path) -> None:
    """Let a robot go through a short experiment; it ends with a run folder."""
    arguments = [sys.executable, "-c", TRAINING, str(folder)]
    subprocess.run(arguments, env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL)


@contextmanager
def served(folder: Path, begin: str | Path) -> Iterator[Served]:
    """Serve the page with a session in a folder; the server has said its address."""
    options = ["--no-browser", "--session", str(folder / "session"), "--begin", str(begin)]
    with (folder / "errors").open("w") as errors:
        process = subprocess.Popen(
            [COMMAND, "teach", *options],
            env=ENVIRONMENT,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
        )
    try:
        line = process.stdout.readline()
        assert "http://127.0.0.1:" in line, (line, (folder / "errors").read_text())
        yield Served(process, next(word for word in line.split() if word.startswith("http")))
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()

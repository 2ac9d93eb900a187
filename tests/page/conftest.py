"""The page in Chromium, served by the command in a process of its own."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from drawn import places
from filelock import FileLock
from page.filming import film
from page.person import Person
from page.serving import CHROMIUM, FLAGS, Served, served, train_robot
from playwright.sync_api import Browser, BrowserContext, sync_playwright

FILMED = "UR ↓"


@pytest.fixture(scope="session")
def chromium() -> str:
    """The path of the installed Chromium."""
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed: apt install chromium")
    return CHROMIUM


@pytest.fixture(scope="session")
def trained(tmp_path_factory, chromium) -> Path:
    """A run folder with a robot that has gone through a short experiment, one for all workers."""
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder = shared / "trained"
    with FileLock(f"{folder}.lock"):
        if not (folder / "done").exists():
            train_robot(folder)
            (folder / "done").touch()
    return folder


@pytest.fixture(scope="session")
def taught(trained, tmp_path_factory) -> Iterator[Served]:
    """A server with the trained robot, which the tests of a worker visit one after another."""
    with served(tmp_path_factory.mktemp("taught"), trained) as server:
        yield server.awake()


@pytest.fixture(scope="session")
def newborn(chromium, tmp_path_factory) -> Iterator[Served]:
    """A server with a robot that has only babbled."""
    with served(tmp_path_factory.mktemp("newborn"), "babbling") as server:
        yield server.awake()


@pytest.fixture(scope="module")
def browser(chromium, tmp_path_factory) -> Iterator[Browser]:
    """A browser whose camera sees something red; not longer than a module, as it holds a loop."""
    filmed = [tuple(place) for place in places(FILMED)]
    camera = film(tmp_path_factory.mktemp("film") / "red.y4m", filmed)
    with sync_playwright() as playwright:
        flags = [*FLAGS, f"--use-file-for-fake-video-capture={camera}"]
        browser = playwright.chromium.launch(executable_path=chromium, args=flags)
        yield browser
        browser.close()


@pytest.fixture
def open_page(browser) -> Iterator[Callable[..., Person]]:
    """Open a page of a server in a browser window of its own."""
    windows: list[BrowserContext] = []

    def opened(server: Served, **window) -> Person:
        window = {"viewport": {"width": 1280, "height": 800}, **window}
        windows.append(browser.new_context(**window))
        return Person(windows[-1].new_page(), server.address)

    yield opened
    for window in windows:
        window.close()


@pytest.fixture
def person(open_page, taught) -> Person:
    """A person before the trained robot."""
    return open_page(taught).arrives()


@pytest.fixture
def parent(open_page, newborn) -> Person:
    """A person before the robot that has only babbled."""
    return open_page(newborn).arrives()

"""README and docs: what they show runs, and what they point to is there."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

ROOT = Path(__file__).parents[1]
FOLDERS = ("docs", "src", "integrations")
PAGES = sorted([*ROOT.glob("*.md"), *(page for f in FOLDERS for page in ROOT.glob(f"{f}/**/*.md"))])

TUTORIAL = ROOT / "docs" / "your_own_robot.md"
PYTHON = r"```python\n((?s:.*?))```"
COMMAND = r"^ {4}(?:\.venv/bin/)?motionese (.*)$"
LINK = r"\]\(([^)#]+)[^)]*\)"
IMAGE = r'src="([^"]+)"'
TARGET = r"(?:^ {4}|`)make ([a-z-]+)"
SETTING = r"--set ([\w.]+=[^\s`]+)"
SHOWN = {
    PYTHON: ("README.md", "docs/first_steps.md", "docs/your_own_robot.md", "docs/extending.md"),
    COMMAND: ("README.md", "docs/first_steps.md", "docs/your_own_robot.md", "docs/teach.md"),
    LINK: (
        "README.md",
        "docs/index.md",
        "docs/gallery.md",
        "docs/api/index.md",
        "integrations/lerobot_policy_motionese/README.md",
    ),
    TARGET: ("README.md", "CONTRIBUTING.md", "docs/first_steps.md"),
    SETTING: ("README.md", "docs/first_steps.md"),
}
"""What pages show, and pages that surely show it: a test of pages that show nothing cannot fail."""


def called(page):
    return page.relative_to(ROOT).as_posix()


def shown(page, pattern):
    return re.findall(pattern, page.read_text(), re.MULTILINE)


def pages_that_show(pattern, but=(), slow=()):
    pages = [page for page in PAGES if page not in but and shown(page, pattern)]
    late = {page: pytest.mark.slow if called(page) in slow else () for page in pages}
    return pytest.mark.parametrize(
        "page", [pytest.param(page, marks=late[page], id=called(page)) for page in pages]
    )


@pytest.mark.parametrize("pattern", SHOWN)
def test_pages_show_what_they_are_tested_for(pattern):
    assert set(SHOWN[pattern]) <= {called(page) for page in PAGES if shown(page, pattern)}


@pages_that_show(PYTHON, but=[TUTORIAL], slow=["docs/extending.md", "docs/first_steps.md"])
def test_snippets_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet in shown(page, PYTHON):
        exec(compile(snippet, called(page), "exec"), names)


@pytest.mark.slow
def test_the_tutorial_s_snippets_and_commands_run_in_order(tmp_path, monkeypatch):
    from motionese.interfaces.commands.command_line import app, spread

    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet, command in shown(TUTORIAL, f"{PYTHON}|{COMMAND}"):
        if command:
            told = CliRunner().invoke(app, spread(shlex.split(command, comments=True)))
            assert told.exit_code == 0, f"{command}\n{told.output}"
        else:
            exec(compile(snippet, called(TUTORIAL), "exec"), names)


@pages_that_show(f"{LINK}|{IMAGE}")
def test_links_lead_somewhere(page):
    for target in shown(page, LINK) + shown(page, IMAGE):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target


@pages_that_show(COMMAND)
def test_commands_and_their_options_exist(page):
    from motionese.interfaces.commands.command_line import app

    for line in shown(page, COMMAND):
        command, *arguments = shlex.split(line, comments=True)
        told = CliRunner().invoke(app, [command, "--help"], env={"COLUMNS": "200"})
        assert told.exit_code == 0, line
        for option in (word for word in arguments if word.startswith("--")):
            assert option.partition("=")[0] in told.output, line


@pages_that_show(TARGET)
def test_make_targets_exist(page):
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    assert set(shown(page, TARGET)) <= targets


@pages_that_show(SETTING)
def test_settings_named_in_the_docs_exist(page):
    from motionese.experiment import read_settings

    for override in shown(page, SETTING):
        read_settings(overrides=[override])


def test_every_room_has_a_page_of_its_public_names():
    rooms = {path.parent.name for path in (ROOT / "src" / "motionese").glob("*/__init__.py")}
    told = "".join(page.read_text() for page in (ROOT / "docs" / "api").glob("*.md"))

    assert rooms <= set(re.findall(r"automodule:: motionese\.(\w+)", told))


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Build the site as `make docs` does, with warnings as errors."""
    folder = tmp_path_factory.mktemp("site")
    build = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q"]
    subprocess.run([*build, str(ROOT / "docs"), str(folder)], check=True)
    return folder


@pytest.mark.slow
def test_the_site_is_built_without_warnings(site):
    from typer.main import get_command

    import motionese
    from motionese.interfaces.commands.command_line import app

    library = (site / "api" / "index.html").read_text()
    assert all(f"mo.{name}<" in library for name in motionese.__all__)
    learning = (site / "api" / "learning.html").read_text()
    assert 'id="motionese.learning.train"' in learning
    commands = (site / "command_line.html").read_text()
    assert all(f'id="motionese-{name}"' in commands for name in get_command(app).commands)
    assert "The network: equations and names" in (site / "network.html").read_text()
    assert 'href="network.html"' in (site / "equations.html").read_text()


@pytest.mark.slow
def test_the_site_asks_for_nothing_outside(site):
    loads = r"<(?:script|link|img|iframe|source)\b[^>]*?(?:src|href)=\"((?:https?:)?//[^\"]*)"
    for page in site.rglob("*.html"):
        assert not re.findall(loads, page.read_text()), page
    for sheet in site.rglob("*.css"):
        assert not re.findall(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", sheet.read_text()), sheet

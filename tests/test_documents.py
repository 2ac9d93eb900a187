"""README and docs: what they show runs, and what they point to is there."""

import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

ROOT = Path(__file__).parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("src/**/*.md")])


def called(page):
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", PAGES, ids=called)
def test_snippets_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for snippet in re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL):
        exec(compile(snippet, called(page), "exec"), names)


@pytest.mark.parametrize("page", PAGES, ids=called)
def test_links_lead_somewhere(page):
    text = page.read_text()
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", text) + re.findall(r'src="([^"]+)"', text):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target


@pytest.mark.parametrize("page", PAGES, ids=called)
def test_commands_and_their_options_exist(page):
    from motionese.interfaces.command_line import app

    for line in re.findall(r"^ {4}(?:\.venv/bin/)?motionese (.*)$", page.read_text(), re.MULTILINE):
        command, *arguments = shlex.split(line, comments=True)
        told = CliRunner().invoke(app, [command, "--help"], env={"COLUMNS": "200"})
        assert told.exit_code == 0, line
        for option in (word for word in arguments if word.startswith("--")):
            assert option.partition("=")[0] in told.output, line


@pytest.mark.parametrize("page", PAGES, ids=called)
def test_make_targets_exist(page):
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    assert set(re.findall(r"`?\bmake ([a-z-]+)`?$", page.read_text(), re.MULTILINE)) <= targets


def test_settings_named_in_the_docs_exist():
    from motionese.experiment.reading import read_settings

    for page in PAGES:
        for override in re.findall(r"--set (\S+=[^\s`]+)", page.read_text()):
            if "…" not in override:
                read_settings(overrides=[override])

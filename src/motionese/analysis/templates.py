"""How the pages are made: templates that share their parts, all in one style."""

from importlib import resources
from typing import Any

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup

from motionese import __version__


def rendered(template: str, **values: Any) -> str:
    """Return a page as HTML."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        loader=FunctionLoader(_part),
    )  # fmt: skip
    style = Markup(_part("report.css"))
    return environment.get_template(template).render(style=style, version=__version__, **values)


def _part(name: str) -> str:
    return resources.files("motionese.analysis").joinpath(name).read_text(encoding="utf-8")

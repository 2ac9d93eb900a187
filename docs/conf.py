"""The documentation site: `make docs` builds it, offline and with warnings as errors."""

import re
from importlib import import_module

from docutils import nodes
from typer.cli import get_docs_for_click
from typer.main import get_command

import motionese
from motionese.interfaces.commands.command_line import app as command_line

project = "motionese"
author = copyright = "The motionese authors"
release = version = motionese.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.viewcode"]
root_doc = "index"
html_theme = "furo"
html_title = f"motionese {release}"
html_copy_source = False
highlight_language = "none"
smartquotes = False  # It would turn --option into –option.
myst_heading_anchors = 3

# Docstrings write names as they do in Markdown, between single backticks.
default_role = "py:obj"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
napoleon_attr_annotations = False
napoleon_use_ivar = True
napoleon_use_rtype = False
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88

BESIDE_THE_CODE = {
    "../integrations/lerobot_policy_motionese/README.md": "lerobot.md",
    "../src/motionese/network/README.md": "network.md",
    "../src/motionese/analysis/mochizuki2013/departures.md": "departures.md",
}
"""Pages whose text stands beside the code, and the pages of this site that include it."""

ROOMS = (
    *("learning", "network", "kinematics", "channels"),
    *("interfaces.estimator", "interfaces.onnx_export"),
)
"""Where the package's own public names are documented."""


def public_names():
    """Return the table of the package's own public names, as Markdown."""
    rows = ["| name | |", "|---|---|"]
    for name in (name for name in dir(motionese) if not name.startswith("__")):
        room = next(r for r in ROOMS if hasattr(import_module(f"motionese.{r}"), name))
        told = getattr(motionese, name).__doc__.partition("\n")[0]
        rows.append(f"| {{py:obj}}`mo.{name} <motionese.{room}.{name}>` | {told} |")
    return "\n".join(rows)


def every_command():
    """Return the help of every command, as Markdown."""
    command = get_command(command_line)
    context = command.make_context("motionese", [], resilient_parsing=True)
    # Before the first command stand their first lines, cut to a width.
    told = get_docs_for_click(obj=command, ctx=context, name="motionese")
    return "".join(told.partition("\n## ")[1:])


GENERATED = {"api/index": public_names, "command_line": every_command}
"""Pages that end with what is generated."""


def complete(app, page, source):
    """Add to a page what is generated, and lead links beside the code to this site's pages."""
    for target, beside in BESIDE_THE_CODE.items():
        source[0] = source[0].replace(f"]({target})", f"]({beside})")
    if page in GENERATED:
        source[0] += "\n" + GENERATED[page]()


def as_written(app, what, name, obj, options, lines):
    """Keep |u| and fit_ in docstrings what they are: reStructuredText takes them for references."""
    lines[:] = [re.sub(r"(?<=\w)_(?!\w)", r"\\_", line).replace("|", r"\|") for line in lines]


IN_SIGNATURES = {
    r"jaxlib\._jax\.": "",
    r"<factory>": "...",
    r"Annotated\[(\w+), FieldInfo\((?:[^()]|\([^()]*\))*\)\]": r"\1",
}
"""What stands in signatures as Python tells them, and what the code says."""


def shorter(app, what, name, obj, options, signature, returned):
    """Write a signature as the code does."""
    told = [signature or "", returned or ""]
    for pattern, short in IN_SIGNATURES.items():
        told = [re.sub(pattern, short, text) for text in told]
    return told[0] or None, told[1] or None


def dashed(app, page):
    """Set the dash between a parameter and what it is."""
    for text in [text for text in page.findall(nodes.Text) if text == " -- "]:
        text.parent.replace(text, nodes.Text(" – "))


def without_aliases(app, what, name, obj, skip, options):
    """Leave out a named tuple's fields, which its docstring explains, from its members."""
    return True if (getattr(obj, "__doc__", "") or "").startswith("Alias for field") else None


def setup(app):
    """Connect what is done to pages and docstrings."""
    app.connect("source-read", complete)
    app.connect("autodoc-process-docstring", as_written)
    app.connect("autodoc-process-signature", shorter)
    app.connect("autodoc-skip-member", without_aliases)
    app.connect("doctree-read", dashed)

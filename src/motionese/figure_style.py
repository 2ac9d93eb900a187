"""How all figures look, and how they become SVG and PNG with the same bytes every time."""

import io
import re
from dataclasses import dataclass

from matplotlib import rc_context
from matplotlib.figure import Figure

INK, FAINT, PAPER = "#1b1f24", "#808890", "#ffffff"
HUES = (("#0072b2", "#56b4e9"), ("#d55e00", "#e69f00"), ("#007a5a", "#4dc3a1"))
"""Dark and light, after Okabe & Ito's palette: distinguishable without colour vision."""
WIDTH = 9.6
"""Width of a figure [inch]: the page's column."""

ROLES = {
    "ink": INK,
    "faint": FAINT,
    "paper": PAPER,
    **{f"hue-{i}-dark": dark for i, (dark, _) in enumerate(HUES)},
    **{f"hue-{i}-light": light for i, (_, light) in enumerate(HUES)},
}
"""Names by which a page may give these colours others, as on dark ground."""

SETTINGS = {
    **dict.fromkeys(("text.color", "axes.labelcolor", "xtick.labelcolor", "ytick.labelcolor"), INK),
    **dict.fromkeys(("axes.edgecolor", "grid.color", "xtick.color", "ytick.color"), FAINT),
    **dict.fromkeys(("axes.spines.top", "axes.spines.right", "axes.grid", "legend.frameon"), False),
    "figure.facecolor": PAPER,
    "axes.facecolor": "none",
    "axes.titlelocation": "left",
    "axes.titlesize": 10,
    "axes.labelsize": 9.5,
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "legend.fontsize": 9,
    "grid.alpha": 0.25,
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.8,
    "lines.markersize": 4.5,
    "figure.constrained_layout.use": True,
    "svg.fonttype": "none",
    "path.simplify": False,
}


@dataclass(frozen=True)
class Drawing:
    """A finished figure: as SVG, as PNG, and as SVG to be put into a page."""

    svg: str
    png: bytes

    @property
    def inline(self) -> str:
        """The SVG for a page: its colours and font are the page's."""
        text = self.svg[self.svg.index("<svg") :]
        text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
        text = re.sub(r'<g id="[^"]*"', "<g", text)
        text = re.sub(r"'DejaVu Sans'[^;\"]*", "var(--sans)", text)
        for size in ("width", "height"):
            text = re.sub(rf'^<svg ([^>]*?){size}="[^"]*"', r"<svg \1", text, count=1)
        for role, colour in ROLES.items():
            text = text.replace(colour, f"var(--{role})")
        return text


def finished(figure: Figure, name: str) -> Drawing:
    """Turn a figure into files, without a date or a version in them."""
    svg = as_svg(figure, name)
    figure.set_layout_engine("none")  # what has been laid out stays, at half the time
    return Drawing(svg, as_png(figure))


def as_svg(figure: Figure, name: str) -> str:
    """Return a figure as SVG whose names begin with `name`."""
    svg = io.StringIO()
    with rc_context({"svg.hashsalt": "motionese"}):
        figure.savefig(svg, format="svg", metadata={"Date": None, "Creator": None})
    return _settled(svg.getvalue(), name)


def as_png(figure: Figure) -> bytes:
    """Return a figure as PNG."""
    png = io.BytesIO()
    figure.savefig(png, format="png", dpi=150, metadata={"Software": None})
    return png.getvalue()


def _settled(svg: str, name: str) -> str:
    """Return an SVG without what the last bits of a layout change: long decimals, hashed names.

    Names are numbered and begin with the figure's, so that no two figures of a page share one.
    """
    svg = re.sub(r"-?\d+\.\d{4,}", lambda m: f"{float(m[0]):.3f}".rstrip("0").rstrip("."), svg)
    svg = re.sub(r"(?<![\w.])-0(?![\d.])", "0", svg)
    used = dict.fromkeys(re.findall(r"#([\w-]+)(?=[\")])", svg))
    named = set(re.findall(r'\bid="([^"]+)"', svg))
    numbered = {old: f"{name}-{i}" for i, old in enumerate(old for old in used if old in named)}
    return re.sub(r'(\bid="|#)([\w-]+)(?=[")])', lambda m: m[1] + numbered.get(m[2], m[2]), svg)

"""What the figures are drawn from, and how they are put into a page."""

import re

import numpy as np
import pandas as pd
import pytest
from invented_runs import STUDY, inside_arrays
from matplotlib import rc_context
from matplotlib.figure import Figure

from motionese.analysis.curves import along_stages
from motionese.analysis.film import film, moments
from motionese.analysis.inside import principal_plane
from motionese.analysis.style import looks_of
from motionese.body import load_model
from motionese.figure_style import SETTINGS, finished


def drawing(name="one"):
    with rc_context(SETTINGS):
        figure = Figure(figsize=(3, 2))
        axes = figure.subplots()
        axes.plot([1, 2, 3], [1.234567, 2, 1], label="x")
        axes.set_title("title")
        return finished(figure, name)


def test_the_same_figure_has_the_same_bytes():
    assert drawing() == drawing()


def test_files_carry_no_date_and_no_version():
    assert "dc:date" not in drawing().svg and "Matplotlib v" not in drawing().svg
    assert b"Software" not in drawing().png


def test_inline_figures_take_the_pages_colours_and_ask_for_nothing():
    text = drawing().inline
    assert text.startswith("<svg") and text.rstrip().endswith("</svg>")
    assert "metadata" not in text and "DOCTYPE" not in text
    assert "var(--ink)" in text and "var(--sans)" in text
    assert not re.search(r"\d\.\d{4,}", text)
    assert not re.search(r'^<svg [^>]*(width|height)="', text)


def test_figures_of_one_page_do_not_share_names():
    pages = [drawing(name).inline for name in ("one", "two")]
    names = [set(re.findall(r'\bid="([^"]+)"', text)) for text in pages]
    assert names[0] and not names[0] & names[1]
    for text, own in zip(pages, names, strict=True):
        assert set(re.findall(r"url\(#([^)]+)\)", text)) <= own


def test_every_condition_has_a_look_of_its_own():
    looks = looks_of(STUDY.factors)
    assert list(looks) == [c.name for c in STUDY.conditions]
    for part in ("colour", "marker"):
        assert len({getattr(look, part) for look in looks.values()}) == len(looks)
    assert [look.line for look in looks.values()] == ["-", "--", "-", "--"]


def test_other_designs_have_looks_by_the_same_rule():
    three = looks_of({"pace": ("slow", "quick", "none")})
    assert len({look.colour for look in three.values()}) == 3
    many = looks_of({"a": tuple("bcdef"), "g": ("h", "i")})
    assert len({(look.colour, look.line, look.marker) for look in many.values()}) >= 8


def test_principal_plane_of_a_line():
    t = np.linspace(-1, 1, 20)[:, None]
    points, share = principal_plane(t * np.array([3.0, 0.0, 4.0]))
    assert share == pytest.approx([1, 0], abs=1e-9)
    assert np.ptp(points[:, 0]) == pytest.approx(10)
    assert points[-1, 0] > 0, "the largest loading is positive"


def test_principal_plane_of_a_single_unit_and_of_stillness():
    points, share = principal_plane(np.arange(4.0)[:, None])
    assert points.shape == (4, 2) and share == pytest.approx([1, 0])
    assert principal_plane(np.ones((4, 3)))[1] == pytest.approx([0, 0])


def test_moments_go_from_the_start_over_the_press_to_the_release():
    depths = {"right": np.zeros(42), "left": np.zeros(42)}
    depths["left"][13] = 8.0
    rows = moments(depths, 42)
    assert len(rows) == 8 and rows[0] == 0 and 13 in rows and rows[-1] == 26
    assert (np.diff(rows) > 0).all()


def test_moments_without_a_press():
    for effects in ({"right": np.zeros(42)}, {}):
        rows = moments(effects, 42)
    assert rows[0] == 0 and rows[-1] == 41 and len(rows) == 8


def test_a_film_without_gl_is_drawn_and_says_so(unrendered):
    figure, note = film(
        inside_arrays(np.random.default_rng(0)), load_model(STUDY.body, STUDY.task.task()), 10.0
    )
    assert len(figure.axes) == 8
    assert note.startswith("Drawn from the side") and "no GL" in note
    titles = [axes.get_title() for axes in figure.axes]
    assert any("pressed 9.0 mm" in title for title in titles)


def test_stages_begin_together_where_learning_settled_at_different_times():
    runs = {0: [1, 1, 1, 2, 2], 1: [1, 2, 2, 2]}
    loops = pd.DataFrame(
        [
            {"condition": "TD/MD", "seed": seed, "loop": loop, "phase": phase}
            for seed, phases in runs.items()
            for loop, phase in enumerate(phases, 1)
        ]
    )
    together = along_stages(loops)
    assert together[together["seed"] == 0]["loop"].tolist() == [1, 2, 3, 4, 5]
    assert together[together["seed"] == 1]["loop"].tolist() == [1, 4, 5, 6]
    alike = loops[loops["seed"] == 0]
    pd.testing.assert_frame_equal(along_stages(alike), alike)

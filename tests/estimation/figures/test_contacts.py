# SPDX-License-Identifier: BSD-3-Clause
"""Contact forces over time: sessions end to end, every peak, and means that are those of what is drawn."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from forcetorque.base.errors import ShapeError, UnitError
from forcetorque.estimation.figures import contact_figure
from forcetorque.results.figure_style import png_bytes
from tests.cases import some_cases
from tests.report.drawing import legend_of, panels

COUNT = 600
TIME = np.arange(COUNT) * 0.01


def _forces(seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(COUNT, 3))


def _drawn(figure: Figure, row: int, candidate: int = 0) -> np.ndarray:
    """Times and values of a line, without its breaks."""
    line = panels(figure)[row].lines[candidate].get_xydata()
    return line[np.isfinite(line[:, 1])]


@pytest.mark.parametrize(("unit", "labels"), [("N", ["|f|", "fx", "fy", "fz"]), ("N m", ["|t|", "tx", "ty", "tz"])])
def test_rows_are_magnitude_and_components(unit: str, labels: list[str], drawn: list[Figure]) -> None:
    """In this order, with the unit, over one axis of time."""
    forces = _forces()
    contact_figure(TIME, {"Workbench": forces}, unit=unit)
    shown = panels(drawn[0])
    assert [panel.get_ylabel() for panel in shown] == [f"{label}, {unit}" for label in labels]
    assert shown[-1].get_xlabel() == "time, s"
    np.testing.assert_allclose(_drawn(drawn[0], 0), np.column_stack([TIME, np.linalg.norm(forces, axis=1)]), rtol=1e-15)
    for axis in range(3):
        np.testing.assert_array_equal(_drawn(drawn[0], axis + 1), np.column_stack([TIME, forces[:, axis]]))


def test_the_legend_states_the_mean_magnitude(drawn: list[Figure]) -> None:
    """By hand: the mean of norms, not the norm of means, of the samples in sessions and no others."""
    forces = np.zeros((COUNT, 3))
    forces[0:100] = [3.0, 4.0, 0.0]
    forces[100:300] = [-3.0, -4.0, 0.0]
    forces[300:] = 1e6
    contact_figure(TIME, {"a": forces, "b": 0.0 * forces}, unit="N", spans=[("s", 0, 300)])
    assert legend_of(drawn[0]) == ["a: mean |f| 5 N", "b: mean |f| 0 N"]


@pytest.mark.long
def test_sessions_of_two_days_are_drawn_end_to_end(drawn: list[Figure]) -> None:
    """A day between them, or clocks that start again, take no room; a line and a label part them."""
    forces = _forces()
    spans = [("day 1", 0, 200), ("day 2", 200, 600)]
    again = np.concatenate([TIME[:200], TIME[:400]])
    day_later = again + np.repeat([0.0, 86400.0], [200, 400])
    first, later = (contact_figure(time, {"a": forces}, unit="N", spans=spans) for time in (again, day_later))
    assert png_bytes(first) == png_bytes(later)
    # 1.99 s and 3.99 s: from the first to the last sample of each
    assert _drawn(drawn[0], 1)[-1, 0] == pytest.approx(1.99 + 3.99)
    for panel in panels(drawn[0]):
        np.testing.assert_allclose(panel.lines[-1].get_xdata(), 1.99)
    texts = [text for text in panels(drawn[0])[0].texts if text.get_text()]
    assert [text.get_text() for text in texts] == ["day 1", "day 2"]
    assert [text.xy[0] for text in texts] == pytest.approx([1.99 / 2, 1.99 + 3.99 / 2])
    assert "end to end" in panels(drawn[0])[-1].get_xlabel()


def test_the_line_is_broken_between_sessions(drawn: list[Figure]) -> None:
    """No stroke joins the last sample of one with the first of the next."""
    contact_figure(TIME, {"a": _forces()}, unit="N", spans=[("1", 0, 200), ("2", 200, 600)])
    values = panels(drawn[0])[1].lines[0].get_ydata()
    assert np.flatnonzero(np.isnan(values)).tolist() == [200, 601]


@pytest.mark.long
def test_every_peak_of_a_long_recording_stays(drawn: list[Figure]) -> None:
    """One sample among half a million, in a session among many short ones, in component and magnitude."""
    count = 500_000
    forces = np.zeros((count, 3))
    forces[123_457, 1] = -80.0
    spans = [(f"session {k}", 10_000 * k, 10_000 * (k + 1)) for k in range(50)]
    contact_figure(np.arange(count) * 0.001, {"a": forces}, unit="N", spans=spans)
    assert (_drawn(drawn[0], 2)[:, 1].min(), _drawn(drawn[0], 0)[:, 1].max()) == (-80.0, 80.0)
    assert len(_drawn(drawn[0], 0)) < 4000


@pytest.mark.parametrize("count", [2, 6, 25])
def test_labels_of_sessions_keep_apart(count: int, drawn: list[Figure]) -> None:
    """Level while they fit in their sessions; slanted or upright ones take less room than their sessions have."""
    edges = np.linspace(0, COUNT, count + 1).astype(int)
    spans = [(f"Balancing support leg {k}", edges[k], edges[k + 1]) for k in range(count)]
    contact_figure(TIME, {"a": _forces()}, unit="N", spans=spans)
    panel = panels(drawn[0])[0]
    angles = {text.get_rotation() for text in panel.texts}
    boxes = [text.get_window_extent() for text in panel.texts]
    assert len(boxes) == count
    if count < 25:
        assert angles == {0.0}
        assert all(first.x1 < second.x0 for first, second in zip(boxes, boxes[1:], strict=False))
    else:
        assert angles == {30.0}
        height = panels(drawn[0])[0].texts[0].get_fontsize() * 100 / 72
        steps = [second.x0 - first.x0 for first, second in zip(boxes, boxes[1:], strict=False)]
        # lines at 30 degrees are half as far apart as their beginnings
        assert min(steps) * 0.5 > height
    assert all(box.x0 >= 0.0 and box.x1 <= 1200.0 for box in boxes)


def test_missing_values_break_the_line(drawn: list[Figure]) -> None:
    """They count in no mean; a calibration without any value has none."""
    forces = np.full((COUNT, 3), 2.0)
    forces[100:200, 2] = np.nan
    contact_figure(TIME, {"a": forces, "b": np.full((COUNT, 3), np.nan)}, unit="N m")
    assert len(_drawn(drawn[0], 3)) == len(_drawn(drawn[0], 0)) == 500
    assert len(_drawn(drawn[0], 1)) == 600
    assert legend_of(drawn[0]) == ["a: mean |t| 3.46 N m", "b: no samples"]


def test_candidates_have_points_that_do_not_meet(drawn: list[Figure]) -> None:
    """Beside the colour every line has points of another shape, at other times, all along it."""
    contact_figure(TIME, {name: _forces() for name in "abcde"}, unit="N")
    lines = panels(drawn[0])[1].lines[:5]
    places = [set(line.get_markevery()) for line in lines]
    assert all(len(each) == 12 for each in places)
    assert len(set.union(*places)) == 60
    assert len({line.get_marker() for line in lines}) == 5


@some_cases("count", [1, 2])
def test_a_few_samples_are_drawn(count: int) -> None:
    """The shortest recordings, and sessions of one sample, make a figure too."""
    spans = [(f"s{k}", k, k + 1) for k in range(count)]
    assert png_bytes(contact_figure(TIME[:count], {"a": _forces()[:count]}, unit="N", spans=spans))[:4] == b"\x89PNG"


def test_what_cannot_be_drawn_is_refused() -> None:
    """Wrenches instead of forces, another unit, sessions beyond the samples, time that falls within a session."""
    forces = _forces()
    with pytest.raises(UnitError, match="in 'Nm'; did you mean \"N m\""):
        contact_figure(TIME, {"a": forces}, unit="Nm")
    with pytest.raises(ShapeError, match="candidates: expected at least one"):
        contact_figure(TIME, {}, unit="N")
    with pytest.raises(ShapeError, match=r"candidates\['a'\]: expected an array of shape \(600, 3\), got \(600, 6\)"):
        contact_figure(TIME, {"a": np.zeros((COUNT, 6))}, unit="N")
    for start, stop in ((-1, 5), (5, 5), (0, 601)):
        with pytest.raises(
            ShapeError, match=rf"session 'x': expected 0 <= start < stop <= 600, got {start} and {stop}"
        ):
            contact_figure(TIME, {"a": forces}, unit="N", spans=[("x", start, stop)])
    with pytest.raises(ShapeError, match=r"time_s of session 'x': expected finite instants .* at index 1$"):
        contact_figure(-TIME, {"a": forces}, unit="N", spans=[("x", 0, 5)])

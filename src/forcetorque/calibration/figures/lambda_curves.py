# SPDX-License-Identifier: BSD-3-Clause
"""Figures over lambda: the axis with 0 and infinity, distance to the prior matrix, error on held-out data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ShapeError, require_known
from forcetorque.results.figures import (
    GRID,
    MUTED,
    PAPER,
    REFERENCE_COLOUR,
    ROW_INCHES,
    Look,
    drawable,
    drawable_each,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    number_log_axis,
    shown_name,
)
from forcetorque.results.visual_roles import HIGHLIGHT

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


LAMBDA_LABEL = "lambda, counts²"
"""Label of the axis."""
LAMBDA_MEANING = (
    "lambda of (5.4): it weighs |C - C_prior|² beside mean |f - C r - o|²; tables of the thesis print a sixth"
)
"""The number means nothing without its convention."""

MARKED: Final[dict[str, Any]] = {
    "color": HIGHLIGHT,
    "marker": "*",
    "markersize": 17.0,
    "markeredgecolor": REFERENCE_COLOUR,
    "markeredgewidth": 1.0,
    "linestyle": "none",
}
"""Look of the point that was chosen, on a curve of any colour."""

_LOGARITHMIC_RATIO = 10.0
"""Largest height over the smallest beyond which a linear axis would press the good curves together."""
_ZERO_DECADES = 0.7
"""Room between lambda 0 and the smallest positive lambda; decades."""
_SAME = 0.006
"""Curves no further apart than this are seen as one; part of what the panel's height spans."""
_DASH = 12.0
"""Length of the dashes of curves that take turns; points."""
_WIDTHS, _SIZES = (1.8, 3.0), (6.5, 9.0)
"""Widths of lines and sizes of points, of the last colour and of the first; points."""


def rising_lambdas(lambdas: Any) -> tuple[FloatArray, IntArray]:
    """Check lambdas and bring them in order.

    Args:
        lambdas: Weights of the prior; shape (l,); counts2.

    Returns:
        The same, rising, and where each stood; shapes (l,), (l,).

    Raises:
        ShapeError: If the shape differs, there are none, or one is negative or not finite.
    """
    unsorted = drawable(lambdas, name="lambdas", shape=(None,))
    if not (unsorted >= 0.0).all():
        # NaN is not at least 0 either
        at = int(np.argmin(unsorted >= 0.0))
        raise ShapeError(
            f"lambdas: expected finite numbers of at least 0 counts2, got {np.asarray(lambdas)[at]} at index {at}"
        )
    order = np.argsort(unsorted, kind="stable").astype(np.int64)
    return unsorted[order], order


def infinite_place(lambdas: FloatArray) -> float:
    """Choose where on the axis lambda infinite, with which the prior is kept, is drawn.

    Args:
        lambdas: All finite lambdas that share the axis; rising; shape (l,); counts2.

    Returns:
        A place right of them, as far as 0 is on the left; counts2.
    """
    positive = lambdas[lambdas > 0.0]
    return float(positive[-1]) * 10.0**_ZERO_DECADES if len(positive) else 1.0


def set_lambda_axis(panel: Axes, lambdas: FloatArray, *, infinite: float | None = None) -> None:
    """Give a panel an axis of decades, with 0 at its left end if it is among the lambdas.

    Args:
        panel: The panel.
        lambdas: What is drawn over; rising, finite, none only if infinity is drawn; shape (l,); counts2.
        infinite: Where lambda infinite is drawn, as `infinite_place` chose it; None where it is not; counts2.
    """
    positive = lambdas[lambdas > 0.0]
    if not len(positive):
        # 0 alone, or nothing but infinity
        panel.set_xticks(lambdas)
    elif len(positive) == len(lambdas):
        panel.set_xscale("log")
        if infinite is not None:
            panel.set_xticks(_decades(positive) or [positive[0]])
            panel.xaxis.set_major_formatter(_lambda_text)
    else:
        panel.set_xscale("symlog", linthresh=positive[0], linscale=_ZERO_DECADES)
        panel.set(
            xticks=[0.0, *(_decades(positive) or [positive[0]])], xlim=(-0.15 * positive[0], _right_edge(positive))
        )
        panel.xaxis.set_major_formatter(_lambda_text)
    if infinite is not None:
        _add_infinite(panel, positive, infinite)
    panel.set_xticks([], minor=True)
    panel.grid(visible=True, color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


def _decades(positive: FloatArray) -> list[float]:
    """Powers of ten among positive lambdas, at most some ten of them."""
    least, most = math.log10(positive[0]), math.log10(positive[-1])
    step = max(1, math.ceil((most - least) / 10.0))
    return [10.0**k for k in range(math.ceil(least), math.floor(most) + 1, step)]


def _right_edge(positive: FloatArray, last: float | None = None) -> float:
    least, most = math.log10(positive[0]), math.log10(positive[-1] if last is None else last)
    return float(10.0 ** (most + 0.02 * (most - least) + 0.05))


def _add_infinite(panel: Axes, positive: FloatArray, infinite: float) -> None:
    """A place of its own right of the last lambda, behind a dotted line."""
    finite = [float(tick) for tick in panel.get_xticks()]
    texts = [_lambda_text(tick, 0.0) for tick in finite]
    panel.set_xticks([*finite, infinite], [*texts, "∞"])
    if len(positive):
        right = _right_edge(positive, infinite)
        # without a 0 as much room on the left as on the right
        panel.set_xlim(panel.get_xlim()[0] if panel.get_xscale() == "symlog" else positive[0] * infinite / right, right)
        panel.axvline(infinite / 10.0 ** (0.5 * _ZERO_DECADES), color=MUTED, linestyle=":", linewidth=1.0)
    else:
        panel.set_xlim(-0.2, infinite + 0.2)


def _lambda_text(value: float, _: float) -> str:
    power = math.log10(value) if value > 0.0 else 0.0
    return f"$10^{{{power:.0f}}}$" if power.is_integer() and value > 0.0 else f"{value:g}"


def set_height_axis(panel: Axes, heights: FloatArray) -> None:
    """Make the vertical axis logarithmic if heights span more than a decade.

    Args:
        panel: The panel.
        heights: All that is to be drawn on it; NaN where there is nothing; shape (n,).
    """
    known = heights[np.isfinite(heights)]
    if len(known) and known.min() > 0.0 and known.max() > _LOGARITHMIC_RATIO * known.min():
        panel.set_yscale("log")
        number_log_axis(panel.yaxis)


def draw_curves(panel: Axes, lambdas: FloatArray, curves: Sequence[FloatArray], looks: Sequence[Look]) -> None:
    """Draw curves so that none hides another.

    Those of the first colour are the widest and show beside the others. Of those that coincide from end to end, each
    colour draws every other dash, and their points take turns.

    Args:
        panel: The panel, which has its vertical scale already.
        lambdas: Where the points are; rising; shape (l,); counts2.
        curves: Heights of the points; shape (l,) each.
        looks: Look of each curve.
    """
    colours = list(dict.fromkeys(style.colour for style in looks))
    groups = _coinciding(panel.get_yscale() == "log", curves)
    for k, (values, style) in enumerate(zip(curves, looks, strict=True)):
        group = next(group for group in groups if k in group)
        rest = 1.0 - colours.index(style.colour) / max(1, len(colours) - 1)
        width = _WIDTHS[0] + rest * (_WIDTHS[1] - _WIDTHS[0])
        panel.plot(
            lambdas,
            values,
            color=style.colour,
            linestyle=_dashes(k, group, looks, width),
            linewidth=width,
            dash_capstyle="butt",
            marker=style.marker,
            markersize=_SIZES[0] + rest * (_SIZES[1] - _SIZES[0]),
            markeredgecolor=PAPER,
            markeredgewidth=0.5,
            # with fewer points than curves, the last ones share a point
            markevery=(min(group.index(k), len(lambdas) - 1), len(group)),
        )


def _dashes(k: int, group: list[int], looks: Sequence[Look], width: float) -> Any:
    """Dashes of a curve: its own alone, turns of its colour among several; none where its colour has had its turn."""
    colours = list(dict.fromkeys(looks[j].colour for j in group))
    if any(looks[j].colour == looks[k].colour for j in group[: group.index(k)]):
        return "none"
    if len(colours) == 1:
        return looks[k].dashes
    # matplotlib counts dashes in widths of the line
    dash, turn = _DASH / width, colours.index(looks[k].colour)
    return (len(colours) - turn) * dash, (dash, (len(colours) - 1) * dash)


def _coinciding(logarithmic: bool, curves: Sequence[FloatArray]) -> list[list[int]]:
    """Groups of curves that are seen as one; most have one member."""
    heights = [np.log(values) if logarithmic else values for values in curves]
    every = np.concatenate(heights)
    near = _SAME * (np.nanmax(every) - np.nanmin(every)) if np.isfinite(every).any() else 0.0
    groups: list[list[int]] = []
    for k, values in enumerate(heights):
        group_near = next((group for group in groups if _is_near(values, heights[group[0]], near)), None)
        if group_near is None:
            groups.append([k])
        else:
            group_near.append(k)
    return groups


def _is_near(first: FloatArray, second: FloatArray, near: float) -> bool:
    return bool((np.isnan(first) == np.isnan(second)).all() and (np.nan_to_num(np.abs(first - second)) <= near).all())


@in_figure_style
def lambda_difference_figure(lambdas: FloatArray, curves: Mapping[str, FloatArray], *, unit: str) -> Figure:
    """Draw the difference to the Workbench matrix over lambda [1].

    Curves that coincide are dashed in turn, and their points take turns, so that each is seen.

    Args:
        lambdas: Those of equation (5.4) of [1], at least 0, in any order; shape (l,); counts2.
        curves: Difference to the Workbench matrix by estimation type; shape (l,); in `unit`. What is not a finite
            number breaks the curve.
        unit: Unit of the difference with its power of ten, such as `1e-4 N/count`.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no curves or no lambdas, the shapes differ, or a lambda is negative or not finite.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.4.
    """
    rising, order = rising_lambdas(lambdas)
    lines = drawable_each(curves, name="curves", shape=(len(rising),))
    figure = new_figure(1.4 * ROW_INCHES[1])
    panel = figure.add_subplot()
    looks = [look(k) for k in range(len(lines))]
    draw_curves(panel, rising, [values[order] for values in lines.values()], looks)
    set_lambda_axis(panel, rising)
    panel.set(
        xlabel=LAMBDA_LABEL,
        ylabel=f"difference to the Workbench matrix, {shown_name(unit)}",
        ylim=(min(0.0, panel.get_ylim()[0]), None),
    )
    legend_below(
        figure, [(shown_name(name), style.key) for name, style in zip(lines, looks, strict=True)], title=LAMBDA_MEANING
    )
    known = {name: values[order] for name, values in lines.items() if np.isfinite(values).any()}
    if known:
        best = min(known, key=lambda name: float(np.nanmin(known[name])))
        least = int(np.nanargmin(known[best]))
        at = f"{shown_name(best)} at lambda {rising[least]:g}"
        headline(
            figure, f"Least difference to the Workbench matrix: {known[best][least]:.3g} in {shown_name(unit)}, {at}"
        )
    return figure


_MEANING = "lambda as thesis (5.4) and calibration files count it: it weighs |C - C_prior|² beside mean |f - C r - o|²"
_PRIOR = "∞: the prior"
_AS_PRIOR: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (10, 3)), "linewidth": 1.2}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Curve:
    """One curve, lambdas rising."""

    lambdas: FloatArray
    """Finite lambdas, and infinity at the end if it was given; shape (l,); counts2."""
    rmse: FloatArray
    """Held-out error; shape (l,)."""
    ratio: FloatArray | None
    """Worst ratio to the prior; shape (l,)."""
    chosen: int | None
    """Index of the choice."""

    @property
    def finite(self) -> FloatArray:
        """Lambdas but infinity."""
        return self.lambdas[np.isfinite(self.lambdas)]


@in_figure_style
def held_out_figure(
    curves: Mapping[str, tuple[FloatArray, FloatArray, float | None]],
    *,
    worst_ratios: Mapping[str, FloatArray] | None = None,
) -> Figure:
    """Draw the error on held-out blocks over lambda, and mark the choice.

    Lambda 0, and infinite, with which the prior is kept, have places of their own at the ends of the axis. The axis of
    errors is logarithmic where they span more than a decade. The choice need not be the lowest point: the rule of
    `calibration` takes only lambdas with which no block is judged worse than with its prior. A second panel draws this
    ratio where it is given.

    Args:
        curves: By name, such as that of a sensor: lambdas, 0 to infinite, in any order, each curve its own, shape
            (l,), counts2; root mean square held-out error with each, 1 N counted like 1 N m, shape (l,), where what is
            not a finite number breaks the curve; and the lambda that was chosen, or None. They are
            `Calibration.selection.lambda_counts2`, `.held_out_rmse` and `Calibration.lambda_counts2`.
        worst_ratios: Largest ratio over the blocks of the held-out mean squared error to that of the prior, by the same
            names, as many as lambdas; `Calibration.selection.worst_ratio_to_prior`. Names may be missing.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no curves or no lambdas, the shapes differ, a lambda is negative or not a number, what
            was chosen is not among the lambdas, or ratios have a name that no curve has.
    """
    checked = _checked(curves, worst_ratios or {})
    with_ratio = any(curve.ratio is not None for curve in checked.values())
    figure = new_figure((2.2 if with_ratio else 1.4) * ROW_INCHES[1])
    panels = figure.subplots(1 + with_ratio, squeeze=False, sharex=True, height_ratios=(3, 2)[: 1 + with_ratio])[:, 0]
    finite = np.unique(np.concatenate([curve.finite for curve in checked.values()]))
    infinite = infinite_place(finite)
    _draw(panels[0], {k: (curve, curve.rmse) for k, curve in enumerate(checked.values())}, infinite)
    panels[0].set_ylabel("held-out rms error, 1 N counted like 1 N m")
    if with_ratio:
        ratios = {k: (curve, curve.ratio) for k, curve in enumerate(checked.values()) if curve.ratio is not None}
        panels[1].axhline(1.0, **_AS_PRIOR)
        _draw(panels[1], ratios, infinite)
        panels[1].set_ylabel("worst block: error² over prior's")
    has_infinite = any(len(curve.finite) < len(curve.lambdas) for curve in checked.values())
    for panel in panels:
        set_lambda_axis(panel, finite, infinite=infinite if has_infinite else None)
    panels[-1].set_xlabel(f"{LAMBDA_LABEL} ({_PRIOR})" if has_infinite else LAMBDA_LABEL)
    legend_below(figure, _keys(checked, with_ratio=with_ratio), title=_MEANING)
    chosen = [f"{shown_name(name)} {_choice(curve)}" for name, curve in checked.items() if curve.chosen is not None]
    headline(figure, f"Chosen: {'; '.join(chosen)}" if chosen else "No lambda is chosen")
    return figure


def _checked(curves: Mapping[str, tuple[Any, Any, float | None]], ratios: Mapping[str, Any]) -> dict[str, _Curve]:
    if not curves:
        raise ShapeError("curves: expected at least one name with its curve to draw, got none")
    for name in ratios:
        require_known(name, curves, ShapeError, f"worst_ratios: no curve is called {name!r}")
    return {name: _curve(name, *columns, ratios.get(name)) for name, columns in curves.items()}


def _curve(name: str, lambdas: Any, rmse: Any, chosen: float | None, ratio: Any) -> _Curve:
    where = f"curves[{name!r}]"
    unsorted = np.array(lambdas, dtype=np.float64)
    infinite = unsorted == np.inf
    if unsorted.ndim != 1 or infinite.sum() > 1:
        raise ShapeError(f"{where}: expected lambdas of shape (n,), at most one infinite, got {lambdas!r}")
    try:
        # infinity, which has its own place, stands at the end where sorting puts it
        finite = rising_lambdas(unsorted[~infinite])[0] if (~infinite).any() else unsorted[:0]
    except ShapeError as error:
        raise ShapeError(f"{where}: {error}") from error
    order = np.argsort(unsorted, kind="stable")
    rising = np.append(finite, unsorted[infinite])
    heights = drawable(rmse, name=f"{where}: rmse", shape=unsorted.shape)[order]
    worst = None if ratio is None else drawable(ratio, name=f"worst_ratios[{name!r}]", shape=unsorted.shape)[order]
    if chosen is not None and chosen not in rising:
        raise ShapeError(f"{where}: chosen: expected one of the lambdas {rising.tolist()}, got {chosen!r}")
    place = None if chosen is None else int(np.flatnonzero(rising == chosen)[0])
    return _Curve(lambdas=rising, rmse=heights, ratio=worst, chosen=place)


def _draw(panel: Axes, curves: Mapping[int, tuple[_Curve, FloatArray]], infinite: float) -> None:
    """Draw curves with the look of their index; those over the same lambdas together, so that none hides another."""
    set_height_axis(panel, np.concatenate([values for _, values in curves.values()]))
    groups: dict[tuple[float, ...], list[int]] = {}
    for k, (curve, _) in curves.items():
        groups.setdefault(tuple(curve.lambdas.tolist()), []).append(k)
    for lambdas, members in groups.items():
        at = np.where(np.isfinite(lambdas), lambdas, infinite)
        draw_curves(panel, at, [curves[k][1] for k in members], [look(k) for k in members])
    for curve, values in curves.values():
        if curve.chosen is not None:
            at_lambda = min(float(curve.lambdas[curve.chosen]), infinite)
            panel.plot(at_lambda, values[curve.chosen], zorder=4.0, clip_on=False, **MARKED)


def _keys(curves: Mapping[str, _Curve], *, with_ratio: bool) -> list[tuple[str, dict[str, Any]]]:
    keys = [(f"{shown_name(name)}: {_choice(curve)}", look(k).key) for k, (name, curve) in enumerate(curves.items())]
    if any(curve.chosen is not None for curve in curves.values()):
        keys.append(("chosen", MARKED))
    if with_ratio:
        keys.append(("as good as the prior", _AS_PRIOR))
    return keys


def _choice(curve: _Curve) -> str:
    if curve.chosen is None:
        return "none chosen"
    value, error = float(curve.lambdas[curve.chosen]), float(curve.rmse[curve.chosen])
    return f"{'prior kept' if math.isinf(value) else f'lambda {value:.4g}'}, error {error:.4g}"

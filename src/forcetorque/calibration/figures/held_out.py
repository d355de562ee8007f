# SPDX-License-Identifier: BSD-3-Clause
"""Figure of how lambda was chosen: the error on held-out data over lambda."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ShapeError, known_names
from forcetorque.calibration.figures.lambda_axis import (
    LAMBDA_LABEL,
    MARKED,
    draw_curves,
    infinite_place,
    rising_lambdas,
    set_height_axis,
    set_lambda_axis,
)
from forcetorque.results.figures.canvas import REFERENCE_COLOUR, ROW_INCHES, legend_below, look, new_figure, shown_name
from forcetorque.results.figures.curves import drawable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


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
    return figure


def _checked(curves: Mapping[str, tuple[Any, Any, float | None]], ratios: Mapping[str, Any]) -> dict[str, _Curve]:
    if not curves:
        raise ShapeError("curves: expected at least one name with its curve to draw, got none")
    for name in ratios:
        if name not in curves:
            raise ShapeError(f"worst_ratios: no curve is called {name!r}; {known_names(name, curves)}")
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

# SPDX-License-Identifier: BSD-3-Clause
"""Figures of thesis 5.3 for one sensor and their files; candidates of several sensors; figure of thesis 7.3."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ShapeError, require_known
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.calibration.figures.lambda_curves import (
    LAMBDA_LABEL,
    LAMBDA_MEANING,
    MARKED,
    draw_curves,
    rising_lambdas,
    set_height_axis,
    set_lambda_axis,
)
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset, ValidationSet
from forcetorque.results.figures import (
    MUTED,
    REFERENCE_COLOUR,
    ROW_INCHES,
    drawable_each,
    headline,
    in_figure_style,
    legend_below,
    look,
    new_figure,
    number_log_axis,
    png_bytes,
    shown_name,
    two_digits,
)
from forcetorque.results.visual_roles import PRIOR
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate_fits import WORKBENCH
from forcetorque.study.selection import TWO_SIGMA, Candidate, with_offset
from forcetorque.study.study import SensorStudy

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from forcetorque.study.result import ChosenCandidate, StudiedSensor
    from forcetorque.study.skin.result import SkinStudy


_PAUSE_S = 2.0
"""Pause that is drawn between validation intervals; s."""


def write_figures(sensor: SensorStudy, folder: Path, progress: Progress = lambda _: None) -> list[str]:
    """Draw figures 5.2 to 5.7 and 5.9; those over the types are of the best candidate's data set.

    Args:
        sensor: The study.
        folder: Folder for the files.
        progress: Called with a line for people as work goes on.

    Returns:
        Names of the files.
    """
    from forcetorque.calibration.figures.excitation import space_figure
    from forcetorque.calibration.figures.lambda_curves import lambda_difference_figure
    from forcetorque.evaluation.figures.errors_and_matrices import difference_figure

    study = sensor.study
    chosen = study.choices[Offset.FIRST_SECOND].by_magnitude
    data_set = study.candidates[chosen].data_set
    names, differences = tables.matrix_differences(study, data_set)
    unit = "1e-4 N/count"  # that of `tables.DIFFERENCE_UNIT`
    draw: dict[str, Callable[[], Figure]] = {
        "figure_5_2_wrench_space.png": lambda: space_figure(_clouds(sensor)),
        "figure_5_3_matrix_differences.png": lambda: difference_figure(names, differences, unit=unit),
        "figure_5_6_contact_forces.png": lambda: _contact_figure(sensor, FORCE, "N"),
        "figure_5_7_contact_moments.png": lambda: _contact_figure(sensor, MOMENT, "N m"),
        "figure_5_9_measured_and_reference.png": lambda: _comparison_figure(sensor),
    }
    lambdas = {candidate.lambda_counts2 for candidate in study.fits.candidates}
    if study.workbench is not None and len(lambdas) > 1:
        lambdas_of, curves = tables.differences_to_workbench(study, data_set)
        draw["figure_5_4_differences_to_workbench.png"] = lambda: lambda_difference_figure(
            np.array(lambdas_of), curves, unit=unit
        )
        for offset in KNOWN_BEFORE:
            name = f"figure_5_5_mean_forces_offset_{offset.replace('-', '_')}.png"
            draw[name] = partial(_lambda_force_figure, sensor, offset)
    left = TimeLeft(progress, "drawing figures", len(draw))
    for done, (name, figure) in enumerate(draw.items()):
        left.at(done)
        write_bytes_atomically(folder / name, png_bytes(figure()))
    return sorted(draw)


def _clouds(sensor: SensorStudy) -> dict[str, FloatArray]:
    kinds: dict[str, list[FloatArray]] = {}
    for interval in sensor.data.calibration:
        kinds.setdefault(interval.kind, []).append(interval.part.samples.reference)
    return {kind: np.concatenate(parts) for kind, parts in kinds.items()}


def _lambda_force_figure(sensor: SensorStudy, offset: Offset) -> Figure:

    study = sensor.study
    pooled, best = study.errors[offset].pooled(), study.choices[offset].by_magnitude
    curves: dict[str, dict[str, list[float]]] = {}
    for candidate, value in zip(study.fits.candidates, pooled.force_mean, strict=False):
        curves.setdefault(candidate.data_set, {}).setdefault(candidate.kind.name, []).append(float(value))
    lambdas = list(dict.fromkeys(candidate.lambda_counts2 for candidate in study.fits.candidates))
    chosen = study.candidates[best]
    first = len(study.fits.candidates)
    default = pooled.force_mean[first : first + len(study.generative)]
    return lambda_force_figure(
        np.array(lambdas),
        {name: {kind: np.array(values) for kind, values in types.items()} for name, types in curves.items()},
        workbench=float(pooled.force_mean[-1]),
        generative=float(default.min()) if len(default) else None,
        chosen=(chosen.data_set, chosen.kind.name, chosen.lambda_counts2) if isinstance(chosen, Candidate) else None,
    )


def _judged_models(sensor: SensorStudy, session: str) -> dict[str, tuple[WrenchModel, Offset]]:
    """The candidates of figures 5.6 and 5.7 in a session, with the offset that each is evaluated with."""
    models = {}
    if sensor.study.workbench is not None:
        models[WORKBENCH] = (sensor.study.workbench, Offset.FIRST_SECOND)
    for offset in KNOWN_BEFORE:
        for name, key in (("best", "best"), ("best by axis", "best_by_axis")):
            calibration = sensor.calibrations[f"{key}_offset_{offset.replace('-', '_')}"]
            models[f"{name}, offset {offset}"] = (calibration.in_session(session).model, offset)
    return models


def _contact_figure(sensor: SensorStudy, axes: slice, unit: str) -> Figure:
    from forcetorque.estimation.figures import contact_figure

    sets = [interval.validation_set for interval in sensor.data.validation]
    errors: dict[str, list[FloatArray]] = {}
    for one in sets:
        for name, (model, offset) in _judged_models(sensor, one.session).items():
            errors.setdefault(name, []).append((with_offset(model, one, offset) - one.reference)[:, axes])
    candidates = {name: np.concatenate(parts) for name, parts in errors.items()}
    time, spans = _joined_time(sets)
    return contact_figure(time, candidates, unit=unit, spans=spans)


def _joined_time(sets: Sequence[ValidationSet]) -> tuple[FloatArray, list[tuple[str, int, int]]]:
    """One time axis for all validation intervals, and where each lies on it."""
    parts, spans, start, first = [], [], 0.0, 0
    for one in sets:
        parts.append(start + one.time_s - one.time_s[0])
        spans.append((one.label, first, first + len(one.time_s)))
        start, first = float(parts[-1][-1]) + _PAUSE_S, first + len(one.time_s)
    return np.concatenate(parts), spans


def _comparison_figure(sensor: SensorStudy) -> Figure:
    from forcetorque.evaluation.figures.errors_and_matrices import comparison_figure

    sets = [interval.validation_set for interval in sensor.data.validation]
    liveliest = max(sets, key=lambda one: float(one.reference[:, :3].var(axis=0).sum()))
    candidates = {
        name: with_offset(model, liveliest, offset)
        for name, (model, offset) in _judged_models(sensor, liveliest.session).items()
        if name in (WORKBENCH, f"best, offset {Offset.FIRST_SECOND}")
    }
    return comparison_figure(liveliest.time_s, liveliest.reference, candidates)


_CHOICE_INCHES, _FRAME_INCHES = 0.42, 0.8
"""Height of a sensor with one offset, and of axes; inch."""
_BEFORE: dict[str, Any] = {"color": PRIOR.colour, "marker": PRIOR.marker, "linestyle": "none"}


@in_figure_style
def studies_figure(sensors: Sequence[StudiedSensor]) -> Figure:
    """Draw the mean contact force of candidates where nothing touches, beside the best and the workbench matrix.

    Candidates that the data do not determine are never chosen and are not drawn.

    Args:
        sensors: Studies, a line each for both offsets.

    Returns:
        The figure; intervals are 95 %.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no sensor.
    """
    lines = [(sensor, mode) for sensor in sensors for mode in sensor.modes]
    if not lines:
        raise ShapeError("sensors: expected at least one studied sensor to draw, got none")
    figure = new_figure(_FRAME_INCHES + _CHOICE_INCHES * len(lines))
    panel = figure.subplots()
    for place, (sensor, mode) in enumerate(lines):
        key = f"force_mean_{mode.offset.replace('-', '_')}"
        forces = [row[key] for row in sensor.candidate_rows if row.get("determined")]
        panel.plot(forces, np.full(len(forces), place), color=MUTED, marker="|", linestyle="none", markersize=9.0)
        if sensor.workbench is not None and mode.offset is Offset.FIRST_SECOND:
            _draw_chosen(panel, place, sensor.workbench, _BEFORE)
        _draw_chosen(panel, place, mode.best, look(0).key | {"linestyle": "none"})
    panel.set_xscale("log")
    number_log_axis(panel.xaxis)
    panel.set_yticks(
        range(len(lines)), [f"{shown_name(sensor.sensor)}, offset {mode.offset}" for sensor, mode in lines]
    )
    panel.set(ylim=(len(lines) - 0.5, -0.5), xlabel="mean contact force where nothing touches, N")
    headline(figure, "; ".join(_best_words(sensor) for sensor in sensors))
    keys = [
        ("candidate that the data determine", {"color": MUTED, "marker": "|", "linestyle": "none"}),
        ("best; line: 95 % interval", look(0).key | {"linestyle": "-"}),
        (WORKBENCH, _BEFORE),
    ]
    legend_below(figure, keys)
    return figure


def _draw_chosen(panel: Axes, place: int, chosen: ChosenCandidate, style: dict[str, Any]) -> None:
    half_width = min(TWO_SIGMA * chosen.force_mean_error_N, 0.99 * chosen.force_mean_N)
    panel.errorbar(chosen.force_mean_N, place, xerr=half_width, elinewidth=1.8, zorder=3.0, **style)


def _best_words(sensor: StudiedSensor) -> str:
    best = min((mode.best for mode in sensor.modes), key=lambda chosen: chosen.force_mean_N)
    words = f"{shown_name(sensor.sensor)}: best {two_digits(best.force_mean_N)} N by {shown_name(best.name)}"
    return words + ("" if sensor.workbench is None else f", {WORKBENCH} {two_digits(sensor.workbench.force_mean_N)} N")


MOST_HUES, MOST_CURVES = 6, 20
"""Data sets, and curves, in one panel; with more, each data set has its own."""

_PANEL_COLUMNS = 3
_WORKBENCH: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (10, 3)), "linewidth": 1.2}
_GENERATIVE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": (0, (2, 2)), "linewidth": 1.6}

_Level = tuple[str, float, dict[str, Any]]
"""A force that no lambda changes: name, force and look of its line."""

_Curves = dict[str, dict[str, FloatArray]]


@in_figure_style
def lambda_force_figure(
    lambdas: FloatArray,
    curves: Mapping[str, Mapping[str, FloatArray]],
    *,
    workbench: float | None = None,
    generative: float | None = None,
    chosen: tuple[str, str, float] | None = None,
) -> Figure:
    """Draw the mean magnitude of the contact force on validation data over lambda [1].

    Up to `MOST_HUES` data sets with `MOST_CURVES` curves share a panel, colour by data set, dashes and points by
    estimation type; of more, each has its own panel. The axis of forces is logarithmic where they span more than a
    decade.

    Args:
        lambdas: Those of equation (5.4) of [1], at least 0, in any order; shape (l,); counts2.
        curves: Mean magnitude of the contact force by data set and estimation type; shape (l,); N. What is not a finite
            number breaks the curve.
        workbench: The same with the Workbench matrix, for a horizontal line; N. None where there is no such matrix.
        generative: The same with the best generative fit, which has no lambda; N. None where there is no such fit.
        chosen: Data set, estimation type and lambda of the point to mark.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no curves or no lambdas, the shapes differ, a lambda is negative or not finite, the
            force of a horizontal line is not finite, or what was chosen is not among the curves.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 5.5 and tables 5.5, 5.6.
    """
    rising, order = rising_lambdas(lambdas)
    lines = _sorted(curves, order)
    best = math.nan if chosen is None else _force_at(chosen, rising, lines)
    levels = _levels(workbench, generative)
    shared = len(lines) <= MOST_HUES and sum(map(len, lines.values())) <= MOST_CURVES
    groups = [lines] if shared else [{name: types} for name, types in lines.items()]
    kinds = list(dict.fromkeys(kind for types in lines.values() for kind in types))
    figure, panels = _panels(len(groups))
    set_height_axis(panels[0], _heights(lines, levels))
    for panel, group in zip(panels, groups, strict=True):
        _draw(panel, rising, group, kinds, levels)
        if len(group) == 1:
            panel.set_title(shown_name(next(iter(group))))
        if chosen is not None and chosen[0] in group:
            panel.plot(chosen[2], best, zorder=4.0, clip_on=False, **MARKED)
    figure.supylabel("mean magnitude of the contact force, N")
    keys = _keys(list(groups[0]), kinds)
    keys += [(f"{name}: {force:.4g} N", style) for name, force, style in levels]
    if chosen is not None:
        name, kind = map(shown_name, chosen[:2])
        keys.append((f"{name}, {kind}, lambda {chosen[2]:g}: {best:.4g} N", MARKED))
        headline(figure, f"Mean contact force of the choice: {best:.3g} N ({name}, {kind}, lambda {chosen[2]:g})")
    elif np.isfinite(forces := _heights(lines, [])).any():
        headline(figure, f"Least mean contact force: {np.nanmin(forces):.3g} N")
    legend_below(figure, keys, title=LAMBDA_MEANING)
    return figure


def _sorted(curves: Mapping[str, Mapping[str, FloatArray]], order: IntArray) -> _Curves:
    if not curves:
        raise ShapeError("curves: expected at least one data set with its curves, got none")
    checked = {
        name: drawable_each(types, name=f"curves[{name!r}]", shape=(len(order),)) for name, types in curves.items()
    }
    return {name: {kind: values[order] for kind, values in types.items()} for name, types in checked.items()}


def _force_at(chosen: tuple[str, str, float], rising: FloatArray, lines: _Curves) -> float:
    name, kind, value = chosen
    require_known(name, lines, ShapeError, f"chosen: no data set is called {name!r}")
    require_known(kind, lines[name], ShapeError, f"chosen: {name!r} has no estimation type {kind!r}")
    (places,) = np.nonzero(rising == value)
    if not len(places):
        raise ShapeError(f"chosen: expected one of the lambdas {rising.tolist()}, got {value!r}")
    return float(lines[name][kind][places[0]])


def _levels(workbench: float | None, generative: float | None) -> list[_Level]:
    levels: list[_Level] = []
    for name, force, style in (("Workbench", workbench, _WORKBENCH), ("generative, best", generative, _GENERATIVE)):
        if force is None:
            continue
        if not math.isfinite(force):
            raise ShapeError(f"{name.lower()}: expected a finite force in N, got {force}; None draws no line")
        levels.append((name, force, style))
    return levels


def _heights(lines: _Curves, levels: list[_Level]) -> FloatArray:
    forces = [values for types in lines.values() for values in types.values()]
    return np.concatenate([*forces, [force for _, force, _ in levels]])


def _panels(count: int) -> tuple[Figure, list[Axes]]:
    columns = min(count, _PANEL_COLUMNS)
    rows = math.ceil(count / columns)
    figure = new_figure(ROW_INCHES[1] * (1.7 if count == 1 else max(1.2, 0.85 * rows)))
    panels = list(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel())
    for k, unused in enumerate(panels[count:], start=count):
        panels[k - columns].tick_params(labelbottom=True)
        unused.remove()
    for panel in panels[max(0, count - columns) : count]:
        panel.set_xlabel(LAMBDA_LABEL)
    return figure, panels[:count]


def _draw(panel: Axes, rising: FloatArray, group: _Curves, kinds: list[str], levels: list[_Level]) -> None:
    """Draw curves of one data set, or of several that share a panel."""
    curves, looks = [], []
    for k, types in enumerate(group.values()):
        for kind, values in types.items():
            style = look(kinds.index(kind))
            curves.append(values)
            looks.append(style if len(group) == 1 else replace(style, colour=look(k).colour))
    for _, force, line in levels:
        panel.axhline(force, **line)
    draw_curves(panel, rising, curves, looks)
    set_lambda_axis(panel, rising)


def _keys(hues: list[str], kinds: list[str]) -> list[tuple[str, dict[str, Any]]]:
    """What the legend names: data sets by their colours where several share a panel, types by dashes and points."""
    if len(hues) == 1:
        return [(shown_name(kind), look(k).key) for k, kind in enumerate(kinds)]
    sets = [(shown_name(name), {"color": look(k).colour, "linewidth": 5.0}) for k, name in enumerate(hues)]
    return sets + [(shown_name(kind), look(k).key | {"color": MUTED}) for k, kind in enumerate(kinds)]


@in_figure_style
def skin_study_figure(study: SkinStudy) -> Figure:
    """Draw errors of forces and torques by load, and of torques by angle, with open points for the thesis.

    Args:
        study: Simulated trials.

    Returns:
        The figure.

    Raises:
        MissingExtraError: If matplotlib is not installed.
    """
    from forcetorque.study.skin.result import LEVEL_DEG

    figure = new_figure(ROW_INCHES[1])
    forces, torques, angles = figure.subplots(1, 3)
    level = [row for row in study.loads if row.degrees == LEVEL_DEG]
    leaning = [row for row in study.loads if row.leaning]
    names = [row.name for row in level]

    def draw(panel: Axes, at: Sequence[float], k: int, values: Sequence[float | None], *, of_thesis: bool) -> None:
        points = np.array([np.nan if value is None else value for value in values])
        panel.plot(at, points, **look(k).key | {"linestyle": "none", "markerfacecolor": "none" if of_thesis else None})

    at = range(len(level))
    draw(forces, at, 0, [row.simple_N - row.weight_N for row in level], of_thesis=False)
    draw(forces, at, 1, [row.interpolated_N - row.weight_N for row in level], of_thesis=False)
    for k, field in enumerate(("simple_N", "interpolated_N")):
        printed = [getattr(row.thesis, field) for row in level]
        less = [None if value is None else value - row.weight_N for value, row in zip(printed, level, strict=True)]
        draw(forces, at, k, less, of_thesis=True)
    draw(torques, at, 2, [row.rmse_to_ft_Nm for row in level], of_thesis=False)
    draw(torques, at, 2, [row.thesis.rmse_to_ft_Nm for row in level], of_thesis=True)
    draw(torques, at, 3, [row.skin_rmse_Nm for row in level], of_thesis=False)
    degrees = [row.degrees for row in leaning]
    draw(angles, degrees, 2, [row.skin_Nm - row.ft_Nm for row in leaning], of_thesis=False)
    draw(angles, degrees, 2, [row.thesis.leaning_change_Nm for row in leaning], of_thesis=True)
    draw(angles, degrees, 3, [row.skin_bias_Nm for row in leaning], of_thesis=False)
    for panel, label in ((forces, "force less weight, N"), (torques, "RMSE of the knee torque, N m")):
        panel.set_xticks(at, names, rotation=60, fontsize=7)
        panel.set_ylabel(label)
    angles.set(xticks=degrees, xlabel="angle of the leg, deg", ylabel="mean error of the knee torque, N m")
    for panel in (forces, angles):
        panel.axhline(0.0, color=REFERENCE_COLOUR, linewidth=0.8)
    headline(figure, f"{study.layout}: filled points are simulated, open ones of the thesis; * is on top")
    keys = ("simple force", "interpolated force", "skin to sensor", "skin to truth")
    legend_below(figure, [(name, look(k).key | {"linestyle": "none"}) for k, name in enumerate(keys)])
    return figure

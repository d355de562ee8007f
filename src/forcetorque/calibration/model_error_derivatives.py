# SPDX-License-Identifier: BSD-3-Clause
"""What errors of the robot model do to the expected wrenches of one sensor, on the windows of a fit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.noise.means import WINDOW_ROUNDING, WINDOW_S
from forcetorque.calibration.joint.model_error_columns import body_columns, delay_terms, error_terms
from forcetorque.experiment.calibration.model_error import ACCELERATION, DELAY, EXACT, ZERO, ErrorTerm, TermKind
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval, MovingSupport, Support
from forcetorque.robot.mechanics.root_motion import imu_frame
from forcetorque.robot.mechanics.samples import robot_motion_at
from forcetorque.robot.mechanics.sub_model_equations import (
    PartEquation,
    heavy_bodies,
    joints_of_part,
    part_equations,
)
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, SubModel, build_tree, sub_models

SAMPLES_PER_WINDOW: Final = 10
"""Samples of a window at which the columns are computed: what the model may have wrong moves no faster than a robot."""
_STEP: Final = 1e-6
"""Step of numerical derivatives by joint positions; rad or m."""
_ROUNDING: Final = 1e-6
"""Share of the largest effect of a term below which one is rounding, such as that of a yaw about gravity."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ModelColumns:
    """Derivatives of the expected wrench by the numbers of the model that may be wrong."""

    terms: tuple[ErrorTerm, ...]
    """The numbers."""
    columns: FloatArray
    """Derivatives, means over w windows; shape (w, 6, terms); N, N m per unit of the term."""


def model_columns(run: SensorRun, interval: Interval, data: DataSet) -> ModelColumns:
    """Differentiate the expected wrenches of a sensor by what the robot model may have wrong.

    The numbers are masses and centres of the links beyond the sensor, zeros of the joints between the support and
    these, the acceleration of the support frame, and the delay of the readings. Tolerances are those of the experiment.
    Attached loads are taken as they were specified or identified.

    Args:
        run: The sensor.
        interval: An interval of it.
        data: The fitted samples of the interval.

    Returns:
        Derivatives on the windows of `data`; no terms where the model is exact, no link beyond the sensor has inertia,
        or where a load stands in for the robot.
    """
    picked, window = _picked(data)
    nothing = ModelColumns(terms=(), columns=np.zeros((int(window[-1]) + 1, 6, 0)))
    experiment, support, loads = run.experiment, interval.support, run.experiment.loads
    tolerance = experiment.fit_options.tolerance
    of_load = loads is not None and (loads.applied is not None or loads.in_place_of_robot)
    if tolerance == EXACT or support is None or of_load:
        return nothing
    tree = build_tree(experiment.model_on(support), support.frame)
    part = next((part for part in sub_models(tree, [run.sensor.name]) if part.sensor == run.sensor.name), None)
    if part is None or not heavy_bodies(tree, part):
        return nothing
    bare = tree if loads is None else build_tree(experiment.model, support.frame)
    with_acceleration = _measured_at_root(run, support, tree)
    terms = [
        term
        for term in (*error_terms(bare, [part], tolerance), *delay_terms([data.recording], tolerance))
        if with_acceleration or term.kind is not TermKind.ACCELERATION
    ]
    if not terms:
        return nothing
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        joints_of_part(tree, part),
        run.stream,
        np.round(data.time_s[picked] * 1e9).astype(np.int64),
        processing=experiment.processing,
    )
    derivatives = _derivatives(tree, bare, part, joints, root)
    derivatives[f"{DELAY}{data.recording}"] = -_rates(data)[picked]
    columns = np.stack([derivatives[term.name] for term in terms], axis=2)
    means = _means(columns, window[picked], len(nothing.columns))
    effect = np.abs(means).max(axis=(0, 1)) * [term.deviation for term in terms]
    moved = effect > _ROUNDING * effect.max(initial=0.0)
    return ModelColumns(
        terms=tuple(_of_recording(term, data.recording) for term, used in zip(terms, moved, strict=True) if used),
        columns=means[:, :, moved],
    )


def _measured_at_root(run: SensorRun, support: Support | MovingSupport, tree: BodyTree) -> bool:
    """Whether the acceleration is known in the frame of the support, where an error of it is constant."""
    if isinstance(support, Support):
        return True
    frame = imu_frame(run.experiment.model, run.experiment.recording, support)
    return tree.frames[frame][0] == tree.frames[support.frame][0]


def _of_recording(term: ErrorTerm, recording: str) -> ErrorTerm:
    """The term under a name that only the recording has, where another recording may have another error."""
    if term.kind is not TermKind.ACCELERATION:
        return term
    return term.model_copy(update={"name": f"{term.name} in {recording}"})


def _picked(data: DataSet) -> tuple[IntArray, IntArray]:
    """Samples at which the columns are computed, and the number of the window of every sample."""
    elapsed = np.floor((data.time_s - data.time_s[0]) / WINDOW_S + WINDOW_ROUNDING)
    window = np.cumsum(np.diff(elapsed, prepend=elapsed[0]) > 0.0)
    starts = np.flatnonzero(np.diff(window, prepend=-1))
    counts = np.diff(starts, append=len(window))
    step = np.maximum(counts // SAMPLES_PER_WINDOW, 1)
    place = np.arange(len(window)) - starts[window]
    return np.flatnonzero((place - step[window] // 2) % step[window] == 0), window


def _rates(data: DataSet) -> FloatArray:
    """Rate of change of the expected wrench; shape (n, 6); N/s, N m/s; zero where no time passes."""
    if len(data.time_s) < 2 or not (np.diff(data.time_s) > 0.0).all():
        return np.zeros_like(data.reference)
    return np.gradient(data.reference, data.time_s - data.time_s[0], axis=0)


def _means(columns: FloatArray, window: IntArray, windows: int) -> FloatArray:
    """Means over windows of what is finite; zero where nothing is; shape (windows, 6, terms)."""
    whole = np.isfinite(columns).all(axis=(1, 2))
    total = np.zeros((windows, *columns.shape[1:]))
    np.add.at(total, window[whole], columns[whole])
    return total / np.maximum(np.bincount(window[whole], minlength=windows), 1)[:, None, None]


def _derivatives(
    tree: BodyTree, bare: BodyTree, part: SubModel, joints: JointMotion, root: RootMotion
) -> dict[str, FloatArray]:
    """Derivatives of the expected wrench, shape (n, 6) each, by name of the term.

    Masses and centres are those of the robot without attached loads, which are specified or identified by themselves.

    Returns:
        N, N m per unit of the term.
    """
    equation = next(part_equations(tree, [part], joints, root))
    expected, transmission = _expected(equation)
    columns = body_columns(bare, equation)
    columns |= {name: column for name, column in body_columns(tree, equation).items() if ACCELERATION in name}
    derivatives = {name: -_read(transmission, column) for name, column in columns.items()}
    for joint in joints_of_part(tree, part):
        again = next(part_equations(tree, [part], joints.shifted({joint: _STEP}), root))
        derivatives[f"{ZERO}{joint}"] = (_expected(again)[0] - expected) / _STEP
    return derivatives


def _expected(equation: PartEquation) -> tuple[FloatArray, FloatArray]:
    """What the sensor at the base of a part must read, and its transmission; shapes (n, 6) and (n, 6, 6)."""
    transmission = equation.transmission[:, 0]
    return _read(transmission, equation.demand), transmission


def _read(transmission: FloatArray, wrench: FloatArray) -> FloatArray:
    """What a sensor reads that transmits wrenches; shape (n, 6)."""
    return np.asarray(np.linalg.solve(transmission, wrench[..., None])[..., 0], dtype=np.float64)

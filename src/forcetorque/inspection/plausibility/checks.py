# SPDX-License-Identifier: BSD-3-Clause
"""All checks of the gate, in the order in which one explains the next."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.sensor_model import is_invertible, measured_components
from forcetorque.inspection.plausibility.compared_wrenches import ROBOT, Doubt, Movement, Setup
from forcetorque.inspection.plausibility.reversed_sense_and_gain import (
    axis_doubts,
    require_moment_unit,
    require_moving_load,
    require_same_sign,
    require_within_full_scale,
    scale_doubts,
    span_doubts,
)
from forcetorque.inspection.plausibility.timing import delay_doubts, require_gauges

FEWEST = 20
"""Samples below which six components of a reference explain any reading."""


def examine(
    data_sets: Sequence[DataSet],
    prior: FloatArray | None,
    full_scale: FloatArray | None = None,
    *,
    setup: Setup = ROBOT,
) -> tuple[Doubt, ...]:
    """Judge whether readings can be those of a sensor under the modelled load, before anything is fitted to them.

    Offsets of data sets are no matter, nor are slow drifts and what linear variables explain.

    Args:
        data_sets: Stretches of calibration data of one sensor.
        prior: Matrix that the sensor is read by so far; shape (6, c); without it sign and scale cannot be judged.
        full_scale: Largest wrench that the sensor reads; shape (6,); N, N m; None if it is not known.
        setup: Where the data come from, which decides on what is common there and where to look for causes.

    Returns:
        What is doubtful; nothing where all is well. Of few samples it is only asked whether their load moves, which
        stays a doubt.

    Raises:
        FitError: If nothing may be fitted: the prior is singular, the model has no mass, its load stands still or is
            beyond the sensor, a channel is a clock, or the reading does not follow the load, or follows it the wrong
            way round or by a factor that no sensor has, in all or in its moments.
        ShapeError: If data sets, or data and prior, have different numbers of channels or variables.
    """
    measures_all = prior is None or not np.any(prior) or bool(measured_components(np.asarray(prior)).all())
    if prior is not None and np.shape(prior) == (6, 6) and measures_all and not is_invertible(prior):
        raise FitError("the prior matrix is singular, so no matrix corrects what it made")
    filled = [data for data in data_sets if len(data.raw)]
    if not filled:
        return ()  # the fit itself says what is missing
    usable = [data for data in filled if len(data.raw) > 1]  # one sample has no neighbour
    if sum(len(data.raw) for data in usable) < FEWEST:
        require_moving_load(_pooled(filled), setup)
        return (_too_few(sum(len(data.raw) for data in filled)),)
    moments = _pooled(usable)
    require_moving_load(moments, setup)
    require_gauges(usable, moments)
    if full_scale is not None:
        require_within_full_scale(usable, read_only(full_scale, name="full_scale", shape=(6,)))
    if prior is not None:
        prior = read_only(prior, name="prior", shape=(6, moments.channels))
    movement = Movement.of(usable, prior)
    doubts = [*span_doubts(movement, setup, has_prior=prior is not None)]
    if prior is not None:
        require_same_sign(movement, prior, setup)
        if measures_all:
            require_moment_unit(movement, setup)
        doubts += [*scale_doubts(movement, prior, setup), *axis_doubts(movement, prior, setup)]
    return (*doubts, *delay_doubts(usable, prior))


def _pooled(data_sets: Sequence[DataSet]) -> Moments:
    return pooled(Moments.of(data.raw, data.reference, data.variables) for data in data_sets)


def _too_few(samples: int) -> Doubt:
    return Doubt(
        kind="span",
        message=f"{samples} samples are fitted, which do not tell whether the reading follows the load; fit a longer "
        "span, in which it moves",
    )

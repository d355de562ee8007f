# SPDX-License-Identifier: BSD-3-Clause
"""Rank the ranges of a catalogue for stated loads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.sensor.catalogue import Axes, CatalogueSensor
from forcetorque.sensor.choice.load_case import LoadCase, considerable_sizes
from forcetorque.sensor.choice.principles import compare_principles
from forcetorque.sensor.choice.result import Holds, SensorChoice, SensorRow


def range_shares(wrench: FloatArray, range_: Axes) -> FloatArray:
    """Give the share of the range of each axis that loads use.

    If the range of an axis is the largest load along it alone that saturates no channel, a load whose shares sum to at
    most 1 saturates none: the counts of a channel are at most the sum of its counts under each component. A load whose
    shares are below 1 one by one may saturate one.

    Args:
        wrench: Loads; shape (..., 6); N, N m.
        range_: Largest magnitude of each component.

    Returns:
        Shares; shape (..., 6).
    """
    return np.abs(wrench) / range_.components()


def rank_sensors(loads: Sequence[LoadCase], catalogue: Sequence[CatalogueSensor], *, margin: float) -> SensorChoice:
    """Rank the sensors of a catalogue: those that hold all loads first, of these the smallest stated error.

    Sensors whose error is not stated come behind those where it is, the narrowest range first.

    Args:
        loads: Loads that the sensor has to hold, at least one.
        catalogue: Sensors.
        margin: Share of every range that stays free, at least 0 and below 1.

    Returns:
        Ranges in order, and what each principle reads of the largest load.

    Raises:
        SensorError: If the margin is none, or there is no load.
    """
    if not 0.0 <= margin < 1.0:
        raise SensorError(f"margin: expected a share from 0 to below 1, got {margin:g}")
    if not loads:
        raise SensorError("loads: expected at least one")
    wrench = np.array([load.wrench for load in loads])
    rows = [row for sensor in catalogue for row in _rows(sensor, loads, wrench, margin)]
    if not rows:
        raise SensorError("catalogue: expected a sensor with a range, in [[sensor.calibrations]], got none")
    used = [row.load for row in rows]
    largest = max(loads, key=lambda load: used.count(load.name))
    principles, curves = compare_principles(largest.wrench)
    return SensorChoice(
        loads=tuple(load.name for load in loads),
        largest=largest.name,
        largest_wrench=largest.wrench,
        margin=margin,
        sensors=tuple(sorted(rows, key=_rank)),
        without_range=tuple(sensor.name for sensor in catalogue if not sensor.calibrations),
        principles=principles,
        curves=curves,
    )


def _rank(row: SensorRow) -> tuple[float, ...]:
    order = [*Holds].index(row.holds)
    if row.holds is Holds.EXCEEDED:
        return order, row.axis_percent
    return order, row.error_of_load_percent is None, row.error_of_load_percent or 0.0, -row.combined_percent


def _rows(sensor: CatalogueSensor, loads: Sequence[LoadCase], wrench: FloatArray, margin: float) -> Iterator[SensorRow]:
    for number, calibration in enumerate(sensor.calibrations, start=1):
        shares = range_shares(wrench, calibration.range)  # (loads, 6)
        combined = shares.sum(axis=1)
        worst, limit = int(combined.argmax()), 1.0 - margin
        one_by_one = float(shares.max())
        held = Holds.HELD if combined.max() <= limit else Holds.AXIS_BY_AXIS
        error = None if sensor.error is None else sensor.error.components(calibration.range)
        step = None if calibration.resolution is None else calibration.resolution.components()
        yield SensorRow(
            sensor=sensor.name,
            maker=sensor.maker,
            technology=sensor.technology,
            calibration=number,
            holds=held if one_by_one <= limit else Holds.EXCEEDED,
            load=loads[worst].name,
            axis_percent=100.0 * one_by_one,
            combined_percent=100.0 * float(combined.max()),
            error_force_N=_largest(error, 0),
            error_moment_Nm=_largest(error, 3),
            error_of_load_percent=None
            if error is None
            else 100.0 * _relative(error, wrench, calibration.range.components()),
            resolution_force_N=_largest(step, 0),
            resolution_moment_Nm=_largest(step, 3),
            bandwidth_hz=sensor.bandwidth_hz,
            mass_kg=sensor.mass,
            nonlinearity=sensor.nonlinearity,
            has_sign=calibration.has_sign,
            source=sensor.source,
        )


def _largest(values: FloatArray | None, first: int) -> float | None:
    return None if values is None else float(values[first : first + 3].max())


def _relative(error: FloatArray, wrench: FloatArray, range_: FloatArray) -> float:
    """Largest error over the largest load, of force and of moment; of a negligible part over the range."""
    parts = zip((slice(3), slice(3, 6)), considerable_sizes(wrench), strict=True)
    return max(
        float((error[part] / range_[part] if size is None else error[part] / size).max()) for part, size in parts
    )

# SPDX-License-Identifier: BSD-3-Clause
"""What the sensors of an experiment measured, as wrenches at given instants."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.applicability import one_per_sensor, require_fit
from forcetorque.analysis.samples import samples_of
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration import Calibration, WrenchModel, recover_raw
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Use
from forcetorque.recording.alignment import interpolate

NO_OFFSET = "no offset removed"
"""Said of a prior without an interval that could give its offset: its wrenches have whatever offset the sensor has."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Correction:
    """How raw counts become a wrench."""

    model: WrenchModel
    """What is done to the reading."""
    source: str
    """Where it comes from, in words."""
    of_wrench: bool = False
    """Whether the model is for the logged wrench, not for raw counts."""
    variables: tuple[str, ...] = ()
    """Variables of the sensor that the model needs, in its order."""

    @classmethod
    def of(cls, name: str, calibration: Calibration) -> Correction:
        """Read by a calibration.

        Args:
            name: Name of its file.
            calibration: The calibration.

        Returns:
            The correction.
        """
        variables = tuple(variable.name for variable in calibration.variables)
        return cls(model=calibration.model, source=name, variables=variables)


def corrections_of(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, Correction]:
    """Decide how every sensor is read.

    A calibration is used where one is given. Else the prior is, or the logged wrench, with the
    offset that makes its mean that of the model over the calibration intervals.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.

    Returns:
        Corrections by sensor.

    Raises:
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior.
    """
    chosen = one_per_sensor(experiment, calibrations)
    corrections = {}
    for sensor in experiment.sensors:
        if sensor.name in chosen:
            name, calibration = chosen[sensor.name]
            require_fit(name, calibration, experiment, sensor)
            correction = Correction.of(name, calibration)
        else:
            correction = uncalibrated(experiment, sensor)
        corrections[sensor.name] = correction
    return corrections


def wrench_at(experiment: Experiment, sensor: ExperimentSensor, correction: Correction, at_ns: IntArray) -> FloatArray:
    """Give what a sensor measured at given instants.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        correction: How it is read.
        at_ns: Instants; shape (n,); ns.

    Returns:
        Wrenches in its frame and direction; shape (n, 6); N, N m; NaN in gaps and while the board is saturated.
    """
    stream = experiment.recording.stream(sensor.stream)
    logged = np.where(stream.held[:, None], np.nan, stream.signal(sensor.quantity).values)
    values = interpolate(stream, logged, at_ns)
    if not correction.of_wrench and sensor.quantity == "wrench" and sensor.prior is not None:
        values = recover_raw(values, sensor.prior)
    columns = [sensor.variable(name).source.at(experiment.recording, at_ns) for name in correction.variables]
    return correction.model.wrench(values, np.stack(columns, axis=-1) if columns else None)


def uncalibrated(experiment: Experiment, sensor: ExperimentSensor) -> Correction:
    """Read a sensor by the prior of the experiment, or take the logged wrench.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.

    Returns:
        The correction, with the offset that the calibration intervals give; without any no offset is removed.

    Raises:
        ExperimentError: If raw counts have no prior.
    """
    if not any(interval.use is Use.CALIBRATION for interval in experiment.recording.intervals):
        return without_offset(sensor)
    matrix, words = _prior(sensor)
    parts = samples_of(experiment, sensor, Use.CALIBRATION)
    read = np.concatenate([p.samples.reading.values for p in parts])
    wrench = read if matrix is None else read @ matrix.T
    reference = np.concatenate([p.samples.reference for p in parts])
    labels = ", ".join(repr(part.interval.label) for part in parts)
    offset = (reference - wrench).mean(axis=0)
    return _with_prior(matrix, offset, f"{words}, offset over {labels} ({len(read)} samples)")


def without_offset(sensor: ExperimentSensor) -> Correction:
    """Read a sensor by the prior of the experiment, or take the logged wrench, with whatever offset it has.

    Args:
        sensor: The sensor.

    Returns:
        The correction.

    Raises:
        ExperimentError: If raw counts have no prior.
    """
    matrix, words = _prior(sensor)
    return _with_prior(matrix, np.zeros(6), f"{words}, {NO_OFFSET}")


def _prior(sensor: ExperimentSensor) -> tuple[FloatArray | None, str]:
    """The matrix that raw counts go through, none for a logged wrench, and its origin in words."""
    if sensor.quantity != "raw":
        return None, "the logged wrench"
    if sensor.prior is None:
        raise ExperimentError(f"sensor {sensor.name!r}: raw counts become wrenches by --calibration or a prior matrix")
    return sensor.prior, f"the prior {sensor.prior_source}"


def _with_prior(matrix: FloatArray | None, offset: FloatArray, source: str) -> Correction:
    model = WrenchModel(matrix=np.eye(6) if matrix is None else matrix, offset=offset)
    return Correction(model=model, source=source, of_wrench=matrix is None)

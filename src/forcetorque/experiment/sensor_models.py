# SPDX-License-Identifier: BSD-3-Clause
"""How every sensor of an experiment is read, where one is not judged but used."""

from __future__ import annotations

from collections.abc import Mapping

from forcetorque.experiment.applicability import one_per_sensor
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import offset_policies, with_policy
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset, OffsetPolicy

FITTED = OffsetPolicy(Offset.FITTED)


def corrections_of(
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    offset: OffsetPolicy | str = FITTED,
) -> dict[str, Correction]:
    """Decide how every sensor of an experiment is read.

    A calibration is used where one is given. Else the prior is, or the logged wrench, with the
    offset that makes its mean that of the model over the calibration intervals. Another offset can be asked for.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.
        offset: Where the offsets come from, such as `one-link-imu:hanging`; from the data that were fitted if left out.

    Returns:
        Corrections by sensor.

    Raises:
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior, or
            an offset cannot be told.
        FitError: If an offset has too few samples.
    """
    chosen = one_per_sensor(experiment, calibrations)
    (policy,) = offset_policies([offset])
    corrections = {}
    for sensor in experiment.sensors:
        run = SensorRun(experiment, sensor)
        calibrated = sensor.name in chosen
        correction = run.read_by(*chosen[sensor.name]) if calibrated else without_calibration(run, policy)
        corrections[sensor.name], _ = with_policy(run, correction, policy)
    return corrections


def without_calibration(run: SensorRun, policy: OffsetPolicy) -> Correction:
    """Read a sensor by the prior of the experiment, or as logged.

    Args:
        run: The sensor.
        policy: Where the offset is to come from; the model is asked for one only where the fitted offset is wanted.

    Returns:
        The correction, before the policy gives it another offset.
    """
    return run.uncalibrated() if policy.offset is Offset.FITTED else Correction.without_offset(run.sensor)

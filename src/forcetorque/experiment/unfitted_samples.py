# SPDX-License-Identifier: BSD-3-Clause
"""Whether a calibration has seen the data on which it is judged."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.applicability import overlapping
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.provenance import FittedInterval
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use


def require_unseen(name: str, calibration: Calibration, run: SensorRun) -> None:
    """Refuse a calibration that may not be applied, or that has seen the samples on which it would be judged.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        run: The sensor.

    Raises:
        SerialNumberError: If it is of another sensor.
        ExperimentError: If it was fitted on a judged interval, or the robot now reads the sensor in another way.
    """
    run.require_fit(name, calibration)
    for judged, fitted in _overlaps(run, calibration, calibration.provenance.intervals):
        raise ExperimentError(
            f"calibration {name!r} was fitted on the interval {fitted!r}, which overlaps the judged "
            f"interval {judged!r}; judge it on data that it has not seen"
        )


def require_unseen_if_judged(name: str, calibration: Calibration, run: SensorRun) -> None:
    """Refuse the same as `require_unseen`, where the recording may have nothing that is judged.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        run: The sensor.
    """
    if run.has(Use.VALIDATION):
        require_unseen(name, calibration, run)
    else:
        run.require_fit(name, calibration)


def doubts_about_choice(run: SensorRun, name: str, calibration: Calibration) -> tuple[str, ...]:
    """Say where a calibration is judged on what it was chosen on.

    Args:
        run: The sensor.
        name: Name of the calibration.
        calibration: The calibration.

    Returns:
        A sentence per validation interval on which it was chosen among others.
    """
    labels = dict.fromkeys(judged for judged, _ in _overlaps(run, calibration, calibration.selection.chosen_on))
    return tuple(f"{name} was chosen among others on {label!r} too, so the verdict on it flatters" for label in labels)


def _overlaps(run: SensorRun, calibration: Calibration, used: Iterable[FittedInterval]) -> Iterator[tuple[str, str]]:
    """Labels of judged intervals and of those used before that overlap them."""
    return overlapping(run.experiment, run.experiment.intervals(Use.VALIDATION), calibration, used)

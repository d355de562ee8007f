# SPDX-License-Identifier: BSD-3-Clause
"""How all sensors of a robot are read at once: by one candidate, with one offset."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from forcetorque.analysis.runs.applicability import one_per_sensor, overlapping
from forcetorque.analysis.runs.candidate import PRIOR
from forcetorque.analysis.runs.corrections import without_calibration
from forcetorque.analysis.runs.offsets import SensorOffset, with_policy
from forcetorque.analysis.runs.reading import Correction
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.calibration import Calibration
from forcetorque.evaluation import Offset, OffsetPolicy
from forcetorque.experiment import Experiment
from forcetorque.recording import Interval, Use


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reader:
    """All sensors as one candidate reads them with one offset."""

    candidate: str
    """Its name."""
    calibrations: Mapping[str, Calibration]
    """Its calibrations, by name of their file."""
    policy: OffsetPolicy
    """Where the offset comes from."""
    corrections: Mapping[str, Correction]
    """How each sensor is read."""
    offsets: Mapping[str, SensorOffset]
    """Offsets that the recording gave, by sensor."""
    by_prior: tuple[str, ...]
    """Sensors that no calibration of the candidate reads."""
    fitted_on: tuple[Interval, ...]
    """Calibration intervals of the experiment."""

    def evidence(self, experiment: Experiment, interval: Interval) -> bool:
        """Tell whether neither offset nor matrix come from a phase.

        Args:
            experiment: The experiment.
            interval: The phase.

        Returns:
            Whether its error is evidence.
        """
        gave = [offset.interval for offset in self.offsets.values()]
        gave += self.fitted_on if self.by_prior and self.policy.offset is Offset.FITTED else ()
        return not any(one.start_ns < interval.end_ns and interval.start_ns < one.end_ns for one in gave) and not any(
            list(overlapping(experiment, [interval], calibration, calibration.provenance.intervals))
            for calibration in self.calibrations.values()
        )


def readers_of(
    experiment: Experiment, candidates: Mapping[str, Mapping[str, Calibration]], policy: OffsetPolicy
) -> Iterator[Reader]:
    """Read the sensors of an experiment by the prior, then by every candidate, with one offset.

    Args:
        experiment: The experiment.
        candidates: By name of the candidate its calibrations by name of their file.
        policy: Where the offset comes from.

    Yields:
        A reader for each; what has no calibration is read by the prior.
    """
    fitted_on = tuple(one for one in experiment.recording.intervals if one.use is Use.CALIBRATION)
    every = {name: one for group in candidates.values() for name, one in group.items()}
    for candidate, calibrations in {PRIOR: {}, **candidates}.items():
        chosen = one_per_sensor(experiment, calibrations)
        corrections: dict[str, Correction] = {}
        offsets: dict[str, SensorOffset] = {}
        by_prior: list[str] = []
        for sensor in experiment.sensors:
            run = SensorRun(experiment, sensor)
            if sensor.name in chosen:
                correction = run.read_by(*chosen[sensor.name])
            else:
                correction = _of_prior(run, every, policy)
                by_prior.append(sensor.name)
            corrections[sensor.name], gave = with_policy(run, correction, policy)
            offsets.update((offset.sensor, offset) for offset in gave)
        yield Reader(
            candidate=candidate,
            calibrations=calibrations,
            policy=policy,
            corrections=corrections,
            offsets=offsets,
            by_prior=tuple(by_prior),
            fitted_on=fitted_on,
        )


def _of_prior(run: SensorRun, calibrations: Mapping[str, Calibration], policy: OffsetPolicy) -> Correction:
    """Read a sensor by the prior of the experiment, else by that of one of its calibrations."""
    if run.sensor.quantity == "raw" and run.sensor.prior is None:
        for name, calibration in calibrations.items():
            if calibration.prior is not None and calibration.sensor.serial == run.sensor.serial:
                return Correction.of_prior(name, calibration.prior, calibration.sessions)
    return without_calibration(run, policy)

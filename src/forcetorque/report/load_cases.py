# SPDX-License-Identifier: BSD-3-Clause
"""Whether the sensors of a report may be used: each pooled over all recordings that have it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.load_cases.judgement import use_verdicts
from forcetorque.evaluation.load_cases.verdict import UseVerdict
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.unfitted_samples import require_unseen_if_judged
from forcetorque.report.assessment.assessment import Demands
from forcetorque.results.row import Row

SensorKey = tuple[str, str]
"""Name of a sensor, and its serial number: robots share names."""


class Undecided(Row):
    """Why there is no verdict on a calibration."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str | None
    """The calibration file; None where the sensor has none."""
    reason: str
    """Why, and what was expected."""


def decide_uses(
    runs: Sequence[Mapping[str, SensorRun]],
    calibrations: Sequence[Mapping[str, Mapping[str, Calibration]]],
    demands: Demands,
) -> tuple[tuple[UseVerdict, ...], tuple[Undecided, ...]]:
    """Judge every calibration over all recordings whose validation intervals it has not seen.

    Args:
        runs: For every experiment the runs of the judged sensors, by sensor.
        calibrations: For every experiment calibrations by name of their file, by sensor.
        demands: Limits, whose load cases are judged too.

    Returns:
        Verdicts, and calibrations and sensors on which there is none.
    """
    more = demands.acceptance.load_case if demands.acceptance is not None else ()
    verdicts: list[UseVerdict] = []
    undecided: list[Undecided] = []

    def refuse(key: SensorKey, file: str | None, reason: object) -> None:
        undecided.append(Undecided(sensor=key[0], serial=key[1], candidate=file, reason=str(reason)))

    for key, own in _by_sensor(runs).items():
        files = {
            file: one
            for run, groups in zip(runs, calibrations, strict=True)
            if key[0] in run and sensor_key(run[key[0]]) == key
            for file, one in groups.get(key[0], {}).items()
        }
        if not files:
            refuse(key, None, "no calibration was given; without one nothing tells what its errors will be")
        for file, calibration in files.items():
            try:
                campaign = Campaign(_unseen(own, file, calibration))
                # a load case that cannot be had leaves the others to be judged
                verdicts += use_verdicts(campaign, {file: calibration}, more, refuse=partial(refuse, key, file))
            except ForceTorqueError as error:
                refuse(key, file, error)
    return tuple(verdicts), tuple(undecided)


def sensor_keys(uses: Sequence[UseVerdict], undecided: Sequence[Undecided]) -> list[SensorKey]:
    """Name the sensors of which something is said.

    Args:
        uses: Verdicts.
        undecided: Calibrations and sensors on which there is none.

    Returns:
        Name and serial number of each, once.
    """
    keys = [*((row.sensor, row.serial) for row in uses), *((row.sensor, row.serial) for row in undecided)]
    return list(dict.fromkeys(keys))


def sensor_key(run: SensorRun) -> SensorKey:
    """Tell sensors apart.

    Args:
        run: A sensor in a recording.

    Returns:
        Its name and serial number.
    """
    return run.sensor.name, run.sensor.serial


def _by_sensor(runs: Sequence[Mapping[str, SensorRun]]) -> dict[SensorKey, list[SensorRun]]:
    pooled: dict[SensorKey, list[SensorRun]] = {}
    for own in runs:
        for run in own.values():
            pooled.setdefault(sensor_key(run), []).append(run)
    return pooled


def _unseen(runs: Sequence[SensorRun], file: str, calibration: Calibration) -> list[SensorRun]:
    """The runs on which a calibration may be judged; the first reason where it is none of them."""
    left = list(_accepted(runs, file, calibration))
    if not left:
        require_unseen_if_judged(file, calibration, runs[0])
    return left


def _accepted(runs: Sequence[SensorRun], file: str, calibration: Calibration) -> Iterator[SensorRun]:
    for run in runs:
        try:
            require_unseen_if_judged(file, calibration, run)
        except ForceTorqueError:  # what it has seen there flatters it; other recordings may judge it
            continue
        yield run

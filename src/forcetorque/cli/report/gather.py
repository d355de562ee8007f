# SPDX-License-Identifier: BSD-3-Clause
"""Everything that the library can say about the sensors of an experiment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeVar

import numpy as np

from forcetorque.analysis import (
    AcceptanceFile,
    JudgedWrenches,
    SensorSphere,
    accept_sensor,
    analyse_sensor,
    beyond_fitted_range,
    check_sensor,
    compare_contact_forces,
    compare_joint_torques,
    inspect_experiment,
    judged_where_chosen,
    judged_wrenches,
    require_unseen,
    sphere_intervals,
    verdicts_on,
)
from forcetorque.analysis.candidate import PRIOR
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.cli.accept_result import criterion_rows, measured_row
from forcetorque.cli.evaluate_result import verdict_row
from forcetorque.cli.inspect_result import finding_row
from forcetorque.cli.report.comparisons import comparison_rows, independence_rows
from forcetorque.cli.report.result import (
    ExperimentReport,
    IntervalRow,
    SensorReport,
    StreamRow,
)
from forcetorque.cli.report.verdicts import sensor_verdict
from forcetorque.cli.sphere_result import sphere_row
from forcetorque.cli.validate_result import best_rows, contact_force_row, joint_torque_row
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment, ExperimentSensor
from forcetorque.recording import Recording
from forcetorque.result.names import short_names

_Found = TypeVar("_Found")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorMaterial:
    """Numbers of a sensor, and the samples that its figures show."""

    report: SensorReport
    """The numbers."""
    judged: JudgedWrenches | None
    """Wrenches on data that was not fitted."""
    spheres: tuple[SensorSphere, ...]
    """Sphere analyses."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentMaterial:
    """Numbers of an experiment, and the samples that its figures show."""

    report: ExperimentReport
    """The numbers."""
    sensors: tuple[SensorMaterial, ...]
    """Its sensors."""


@dataclass(slots=True)
class _Reasons:
    """Tries what not every experiment allows, and keeps the reason where it does not."""

    reasons: dict[str, str] = field(default_factory=dict)

    def attempt(self, what: str, find: Callable[[], _Found]) -> _Found | None:
        try:
            return find()
        except ForceTorqueError as error:
            self.reasons[what] = str(error)
            return None

    def passes(self, what: str, check: Callable[[], None]) -> bool:
        self.attempt(what, check)
        return what not in self.reasons


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Demands:
    """What sensors are compared with beside the model."""

    acceptance: AcceptanceFile | None
    """Limits."""
    population: Mapping[str, FloatArray] | None
    """Matrices of other sensors by serial number."""


def gather_experiment(
    path: Path,
    experiment: Experiment,
    calibrations: Mapping[str, Mapping[str, Calibration]],
    demands: Demands,
    progress: Callable[[str], None],
) -> ExperimentMaterial:
    """Find out everything about the sensors of an experiment.

    Args:
        path: Its file.
        experiment: The experiment.
        calibrations: Calibrations by name of their file, by sensor; the sensors that have any are judged, or all if
            none has.
        demands: Limits and other sensors.
        progress: Called with what is done next.

    Returns:
        What was found.
    """
    sensors = []
    for sensor in experiment.sensors:
        if calibrations and sensor.name not in calibrations:
            continue
        progress(f"judging {sensor.name}")
        rest = [group for name, group in calibrations.items() if name != sensor.name]
        others = {file: one for group in rest for file, one in group.items()}
        sensors.append(_gather_sensor(experiment, sensor, calibrations.get(sensor.name, {}), others, demands))
    start, end = experiment.recording.span_ns
    report = ExperimentReport(
        experiment=experiment.name,
        file=str(path),
        robot=experiment.model.name,
        duration_s=(end - start) * 1e-9,
        streams=_streams(experiment.recording),
        intervals=[
            IntervalRow(
                label=interval.label,
                use=interval.use.value,
                start_s=(interval.start_ns - start) * 1e-9,
                end_s=(interval.end_ns - start) * 1e-9,
                support=None if interval.support is None else interval.support.frame,
            )
            for interval in experiment.recording.intervals
        ],
        findings=[finding_row(finding, start) for finding in inspect_experiment(experiment)],
        sensors=[sensor.report for sensor in sensors],
        inputs_sha256=dict(experiment.inputs_sha256),
    )
    return ExperimentMaterial(report=report, sensors=tuple(sensors))


def _gather_sensor(
    experiment: Experiment,
    sensor: ExperimentSensor,
    calibrations: Mapping[str, Calibration],
    others: Mapping[str, Calibration],
    demands: Demands,
) -> SensorMaterial:
    tried = _Reasons()
    names = short_names(calibrations)
    unseen = {
        file: one
        for file, one in calibrations.items()
        if tried.passes(f"errors of {names[file]}", partial(require_unseen, file, one, experiment, sensor))
    }
    # where every calibration has seen the judged data there is nothing to judge it on; without any, the prior is judged
    judges = bool(unseen) or not calibrations
    judged = contacts = torques = None
    if judges:
        judged = tried.attempt("evaluation", partial(judged_wrenches, experiment, sensor, unseen))
        contacts = tried.attempt("contact forces", partial(compare_contact_forces, experiment, sensor, unseen))
        torques = tried.attempt("joint torques", partial(compare_joint_torques, experiment, sensor, unseen))
    left_out = [*(contacts.left_out if contacts else ()), *(torques.left_out if torques else ())]
    tried.reasons |= {f"left out ({k})": words for k, words in enumerate(dict.fromkeys(left_out), 1)}
    spheres = tried.attempt("spheres", partial(_spheres, experiment, sensor, calibrations)) or []
    independence = tried.attempt("independence", partial(independence_rows, judged)) if judged else None
    comparisons = tried.attempt("comparison", partial(comparison_rows, judged)) if judged else None
    checks, criteria = [], []
    candidates: list[tuple[str, Calibration] | None] = [*calibrations.items()] or [None]
    for candidate in candidates:
        name = PRIOR if candidate is None else names[candidate[0]]
        accepted = None
        if demands.acceptance is not None:
            judge = partial(accept_sensor, experiment, sensor, demands.acceptance, candidate)
            by_limits = partial(judge, others=others, population=demands.population)
            accepted = tried.attempt(f"acceptance of {name}", by_limits)
        if accepted is not None:
            criteria += criterion_rows(accepted)
            checks.append(measured_row(accepted.checks))
            continue
        checked = partial(check_sensor, experiment, sensor, candidate, population=demands.population)
        found = tried.attempt(f"static checks of {name}", checked)
        checks += [] if found is None else [measured_row(found)]
    report = SensorReport(
        sensor=sensor.name,
        serial=sensor.serial,
        verdict=[],
        evaluation=[verdict_row(verdict) for verdict in verdicts_on(sensor, judged)] if judged else [],
        comparisons=comparisons or [],
        independence=independence or [],
        contact_forces=[contact_force_row(verdict) for verdict in contacts.verdicts] if contacts else [],
        best=best_rows(contacts.verdicts) if contacts else [],
        joint_torques=[joint_torque_row(verdict) for verdict in torques.verdicts] if torques else [],
        spheres=[sphere_row(sphere) for sphere in spheres],
        static=checks,
        criteria=criteria,
        calibrations=dict(calibrations),
        warnings=[
            words for file, one in unseen.items() for words in _warnings(experiment, sensor, names[file], one, tried)
        ],
        not_judged=tried.reasons,
    )
    report.verdict = sensor_verdict(report)
    return SensorMaterial(report=report, judged=judged, spheres=tuple(spheres))


def _spheres(
    experiment: Experiment, sensor: ExperimentSensor, calibrations: Mapping[str, Calibration]
) -> list[SensorSphere]:
    return analyse_sensor(experiment, sensor, sphere_intervals(experiment, None), calibrations)


def _warnings(
    experiment: Experiment, sensor: ExperimentSensor, name: str, calibration: Calibration, tried: _Reasons
) -> list[str]:
    beyond = tried.attempt(f"range of {name}", partial(beyond_fitted_range, experiment, sensor, calibration))
    chosen = tried.attempt(f"choice of {name}", partial(judged_where_chosen, experiment, calibration))
    return [
        *(f"{name}: {sentence}" for sentence in beyond or ()),
        *(f"{name} was chosen among others on {label!r} too, so the verdict on it flatters" for label in chosen or ()),
    ]


def _streams(recording: Recording) -> list[StreamRow]:
    rows = []
    for name, stream in recording.streams.items():
        steps = np.diff(stream.stamp_ns)
        step = float(np.median(steps)) if len(steps) else 0.0
        rate = 1e9 / step if step > 0.0 else None
        rows.append(StreamRow(stream=name, samples=len(stream), rate_hz=rate, quantities=sorted(stream.signals)))
    return rows

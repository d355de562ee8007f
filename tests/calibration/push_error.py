# SPDX-License-Identifier: BSD-3-Clause
"""Sensors of a simulated iCub whose true matrices are known, and what calibrations make of pushes not recorded."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.toml_file import read_toml
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.thesis.calibrate import CalibrationFit, calibrate
from forcetorque.experiment.calibration.expected_sensor_errors import REPEATABILITY, Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.simulation.scenario.scenario import (
    INTERVAL_MARGIN_S,
    Scenario,
    SimulatedRecording,
    build_scenario,
    simulate,
    trace_recordings,
)
from forcetorque.simulation.scenario.scenario_file import ScenarioFile, bundled_scenario
from forcetorque.simulation.sensor_family import Specimen
from forcetorque.simulation.trace import Trace
from forcetorque.study.candidate_errors import push_error, pushes

TEMPERATURE = LinearVariable(name="temperature", unit="degC")
LIMIT_COUNTS = 32767.0
EXACT = 1e-9
"""Relative rounding of a lambda that was chosen among candidates."""
NOMINAL = 1.96
"""Standard deviations to either side that hold 95 % of a normal distribution."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One sensor with the recordings of one motion."""

    sensor: str
    motion: str
    seed: int
    data: list[DataSet]
    prior: FloatArray
    """Workbench matrix."""
    truth: FloatArray
    """True matrix."""
    specimen: Specimen
    """The sensor as drawn, to record it in other motions."""

    def fitted(self, regularisation: float | None = None) -> CalibrationFit:
        """Calibrate with the default type, temperature and all."""
        return calibrate(self.data, self.prior, regularisation=regularisation, variables=[TEMPERATURE])

    def unfloored(self, choice: CalibrationFit) -> CalibrationFit:
        """Calibrate with what the rule would choose if it had no floor."""
        curve = choice.curve
        assert curve is not None
        free = (curve.worst_ratio <= 1.0) & (np.abs(curve.regularisations - curve.floor) > EXACT * curve.floor)
        best = curve.regularisations[free][np.argmin(curve.held_out_error[free])]
        return self.fitted(float(best))

    def generative(
        self, *, repeatability: float = REPEATABILITY, accuracy: float = 0.0, with_prior: bool = True
    ) -> GenerativeFit:
        """Calibrate with the default estimator.

        Args:
            repeatability: Share of its response by which the sensor differs from one motion to the next.
            accuracy: Slow error of the reference over full scale; 0 as its only error is that of the derivative window.
            with_prior: Whether the prior is known.

        Returns:
            The fit.
        """
        assumed = Assumptions.of_counts(
            self.truth.shape[1],
            LIMIT_COUNTS,
            accuracy=accuracy * LIMIT_COUNTS * np.linalg.norm(self.prior, axis=1),
            repeatability=repeatability,
        )
        means = [WindowMeans.of(data) for data in self.data]
        return fit_generative(means, self.prior if with_prior else None, assumed, variables=[TEMPERATURE])

    def ratio(self, matrix: FloatArray) -> FloatArray:
        """Mean error of a push with a matrix over that with the prior; force and moment; shape (2,)."""
        return self.error(matrix) / self.error(self.prior)

    def error(self, matrix: FloatArray) -> FloatArray:
        """Mean error of a push with a matrix; force and moment; shape (2,); N, N m."""
        error = push_error(matrix, self.truth)
        return np.array([error.force_N, error.moment_Nm])

    def covered(self, fit: GenerativeFit) -> FloatArray:
        """Share of 95 % intervals that hold the truth: of coefficients, push forces, push moments; shape (3,)."""
        matrix = fit.model.matrix
        spread = np.sqrt(np.einsum("nii->ni", fit.posterior.error_covariance(pushes())))
        inside = np.abs(self._errors(matrix)) <= NOMINAL * spread
        known = np.abs(matrix - self.truth) <= NOMINAL * fit.posterior.matrix_error(matrix)
        return np.array([known.mean(), inside[:, :3].mean(), inside[:, 3:].mean()])

    def _errors(self, matrix: FloatArray) -> FloatArray:
        response = np.linalg.pinv(self.truth)  # counts that a load makes
        errors: FloatArray = pushes() @ (matrix @ response - np.eye(6)).T
        return errors


def cases(
    motions: Mapping[str, Sequence[str]],
    moved: Mapping[str, Sequence[str]],
    seeds: range,
    changes: Mapping[str, Any] = MappingProxyType({}),
) -> Iterator[Case]:
    """Calibration cases of `icub-insitu`, one after the other.

    Args:
        motions: Names of recordings by motion.
        moved: Motions by sensor, those in which its load changes.
        seeds: Seeds of the sensors.
        changes: Keys of `[sensors]` that change.

    Yields:
        A case for every seed, sensor and motion.
    """
    used = frozenset(name for names in motions.values() for name in names)
    scenario, traces, references = _moved(used, tuple(moved), tuple(changes.items()))
    for seed in seeds:
        drawn = scenario.with_sensors(seed=seed)
        data: dict[tuple[str, str], DataSet] = {}
        for recorded in simulate(drawn, traces):
            for sensor in moved if recorded.use is Use.CALIBRATION else ():
                key = (sensor, recorded.name)
                if key not in references:
                    references[key] = _reference(scenario, recorded, sensor)
                data[key] = _data_set(recorded, sensor, *references[key])
        for sensor, names in moved.items():
            for motion in names:
                yield Case(
                    sensor=sensor,
                    motion=motion,
                    seed=seed,
                    data=[data[sensor, name] for name in motions[motion]],
                    prior=drawn.specimens[sensor].workbench,
                    truth=drawn.specimens[sensor].sensor.matrix,
                    specimen=drawn.specimens[sensor],
                )


@lru_cache(maxsize=1)
def _moved(
    used: frozenset[str], sensors: tuple[str, ...], changes: tuple[tuple[str, Any], ...]
) -> tuple[Scenario, dict[str, Trace], dict[tuple[str, str], tuple[FloatArray, FloatArray, FloatArray]]]:
    """The recordings without their sensors, and room for their references; two files ask for the same."""
    content = read_toml(bundled_scenario("icub-insitu"), ScenarioFile, what="a scenario")
    # a recording that is not fitted sets the error of the workbench matrix
    kept = tuple(entry for entry in content.recording if entry.name in used or entry.name == "bsl_day1")
    changed = content.model_copy(update={"recording": kept}).with_sensors(names=sensors, **dict(changes))
    scenario = build_scenario(changed)
    return scenario, trace_recordings(scenario), {}


def _reference(
    scenario: Scenario, recorded: SimulatedRecording, sensor: str
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Samples that have an expected wrench, that wrench, and its flattening: none depends on the specimen."""
    (start, end), margin = recorded.recording.span_ns, round(INTERVAL_MARGIN_S * 1e9)
    movement = recorded.movement
    samples = sensor_samples(
        recorded.recording,
        scenario.model,
        sensor=sensor,
        stream=sensor,
        quantity="raw",
        interval=Interval(
            label=recorded.name,
            start_ns=start + margin,
            end_ns=end - margin,
            use=Use.CALIBRATION,
            support=Support(frame=movement.support, gravity_direction=movement.gravity_direction),
        ),
        processing=Processing(),
        evaluator=Evaluator.COMPILED,
    )
    inside = np.isin(recorded.recording.stream(sensor).stamp_ns, samples.stamp_ns)
    return np.flatnonzero(inside), samples.reference, samples.flattening


def _data_set(
    recorded: SimulatedRecording, sensor: str, index: FloatArray, reference: FloatArray, flattening: FloatArray
) -> DataSet:
    stream = recorded.recording.stream(sensor)
    valid = ~stream.held[index]
    return DataSet(
        label=recorded.name,
        raw=stream.signal("raw").values[index[valid]],
        reference=reference[valid],
        flattening=flattening[valid],
        time_s=stream.stamp_ns[index[valid]] * 1e-9,
        session=recorded.session,
        recording=recorded.name,
        variables=stream.signal("temperature").values[index[valid]],
    )

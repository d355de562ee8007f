# SPDX-License-Identifier: BSD-3-Clause
"""The sensor of a simulated iCub's left leg on grids and other motions, under loads that are computed once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.evaluation.sphere.sensor_sphere import SphereAnalysis, analyse_sphere
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.simulation.scenario.scenario import (
    INTERVAL_MARGIN_S,
    Scenario,
    SimulatedRecording,
    load_scenario,
    simulate,
    trace_recordings,
)
from forcetorque.simulation.scenario.scenario_file import bundled_scenario
from forcetorque.simulation.trace import Trace

LEG = "l_leg_ft"
GRAVITY = 9.80665
TEMPERATURE = LinearVariable(name="temperature", unit="degC")
FITTED = ("grid", "grid_2", "tz", "tz_2", "bsl", "bsl_2")
"""Recordings of the third day, cold and warm, that a calibration is fitted to."""
JUDGED = "grid_day2"
"""Grid of another day and power-up."""

SCREWS: Mapping[str, tuple[float, ...]] = MappingProxyType(
    {
        "2 N m": (2.0,) * 6,
        "0.5 N m": (0.5,) * 6,
        "mixed1": (1.0, 2.0, 2.0, 1.0, 2.0, 2.0),
        "mixed2": (2.0, 1.0, 1.0, 2.0, 1.0, 1.0),
    }
)
"""Screw torques of thesis 4.2.3, from the x axis on: mixed1 has 1 N m along x and 2 N m elsewhere, mixed2 not so."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """One sensor with its recordings and its workbench matrix."""

    data: dict[str, DataSet]
    workbench: FloatArray
    truth: FloatArray

    def analysed(self, name: str, matrix: FloatArray, part: slice = slice(None)) -> SphereAnalysis:
        """Analyse a recording, or a part of it, read with a matrix."""
        data = self.data[name]
        return analyse_sphere(data.raw[part] @ matrix.T, data.reference[part], gravity=GRAVITY)

    def calibrated(self, *, temperature: bool) -> SphereAnalysis:
        """Analyse the grid of another day with a calibration of the third day."""
        fitted = [self.data[name] if temperature else _without_variables(self.data[name]) for name in FITTED]
        result = calibrate(
            fitted, self.workbench, regularisation=1000.0, variables=[TEMPERATURE] if temperature else []
        )
        judged = self.data[JUDGED]
        wrench = result.fit.model.wrench(judged.raw, judged.variables if temperature else None)
        return analyse_sphere(wrench, judged.reference, gravity=GRAVITY)


def leg(seed: int, **changes: object) -> Leg:
    """Draw a sensor and record it."""
    drawn = _scenario().with_sensors(seed=seed, **changes)
    specimen = drawn.specimens[LEG]
    return Leg(
        data={made.name: _data_set(made) for made in simulate(_of_use(drawn), _traces())},
        workbench=specimen.workbench,
        truth=specimen.sensor.matrix,
    )


def screwed(seed: int, screws: str) -> Leg:
    """Draw a sensor that nothing but its screws changed: a rim that is tighter by 2 N m stiffens a channel by 30 %."""
    return leg(
        seed,
        workbench_error=None,
        mounting_sd=0.0,
        mounting_strength=0.3,
        screw_torque_Nm=SCREWS[screws],
    )


@cache
def _scenario() -> Scenario:
    return load_scenario(bundled_scenario("icub-insitu")).with_sensors(names=(LEG,))


@cache
def _traces() -> dict[str, Trace]:
    return trace_recordings(_of_use(_scenario()))


def _of_use(scenario: Scenario) -> Scenario:
    """The recordings that are looked at; all others have random numbers of their own, so these stay the same."""
    return replace(scenario, plans=tuple(plan for plan in scenario.plans if plan.name in {*FITTED, JUDGED}))


@cache
def _references() -> dict[str, tuple[FloatArray, FloatArray]]:
    """Instants of every recording and their expected wrenches; they do not depend on the sensor."""
    found = {}
    for made in simulate(_of_use(_scenario()), _traces()):
        start, end = made.recording.span_ns
        margin = round(INTERVAL_MARGIN_S * 1e9)
        support = Support(frame=made.movement.support, gravity_direction=made.movement.gravity_direction)
        interval = Interval(
            label=made.name, start_ns=start + margin, end_ns=end - margin, use=Use.CALIBRATION, support=support
        )
        samples = sensor_samples(
            made.recording,
            _scenario().model,
            sensor=LEG,
            stream=LEG,
            quantity="raw",
            interval=interval,
            processing=Processing(),
            evaluator=Evaluator.COMPILED,
        )
        inside = np.flatnonzero(np.isin(made.recording.stream(LEG).stamp_ns, samples.stamp_ns))
        found[made.name] = (inside, samples.reference)
    return found


def _data_set(made: SimulatedRecording) -> DataSet:
    inside, reference = _references()[made.name]
    stream = made.recording.stream(LEG)
    valid = ~stream.held[inside]
    return DataSet(
        label=made.name,
        raw=stream.signal("raw").values[inside[valid]],
        reference=reference[valid],
        variables=stream.signal("temperature").values[inside[valid]],
    )


def _without_variables(data: DataSet) -> DataSet:
    return DataSet(label=data.label, raw=data.raw, reference=data.reference, variables=np.empty((len(data.raw), 0)))

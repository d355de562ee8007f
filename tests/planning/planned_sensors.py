# SPDX-License-Identifier: BSD-3-Clause
"""Simulated sensors that are recorded as a plan says, and what calibrations of them err at the loads of use."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.evaluation.load_cases.load_case import LoadCase
from forcetorque.experiment.calibration.expected_sensor_errors import REPEATABILITY, Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.planning.proposed_recordings import Proposal
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.scenario.scenario import INTERVAL_MARGIN_S, Scenario
from forcetorque.simulation.sensor_family import Specimen
from forcetorque.simulation.trace import Trace, trace_movement

TEMPERATURE = LinearVariable(name="temperature", unit="degC")
LIMIT_COUNTS = 32767.0
_POWER_UP, _NOISE, _STAMPS = 40, 41, 42
_WARMS_DEGC = (30.0, 30.3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """A motion as a sensor is recorded in it; references are computed once, as they depend on no specimen."""

    trace: Trace
    number: int
    power_up: int
    _known: dict[str, tuple[FloatArray, FloatArray, FloatArray]] = field(default_factory=dict)

    @classmethod
    def of(cls, movement: Movement, sensor: str, *, number: int, power_up: int) -> Motion:
        """Follow a movement."""
        trace = trace_movement(movement, [sensor], rate_hz=100.0, rng=np.random.default_rng([_STAMPS, number]))
        return cls(trace=trace, number=number, power_up=power_up)

    def recorded(self, sensor: str, specimen: Specimen, seed: int, seconds: float = np.inf) -> DataSet:
        """Record a specimen, for as long as it says at most."""
        powered = specimen.powered_up(np.random.default_rng([seed, _POWER_UP, self.power_up]))
        rng = np.random.default_rng([seed, _NOISE, self.number])
        recording = self.trace.recorded({sensor: powered}, rng=rng, temperature_degC=_WARMS_DEGC)
        if sensor not in self._known:
            self._known[sensor] = _reference(recording, self.trace.movement, sensor)
        index, reference, flattening = self._known[sensor]
        stream, name = recording.stream(sensor), f"motion {self.number}"
        time = (stream.stamp_ns[index] - self.trace.start_ns) * 1e-9
        kept = ~stream.held[index] & (time <= seconds)
        return DataSet(
            label=name,
            raw=stream.signal("raw").values[index[kept]],
            reference=reference[kept],
            flattening=flattening[kept],
            time_s=time[kept],
            session=f"power-up {self.power_up}",
            recording=name,
            variables=stream.signal("temperature").values[index[kept]],
        )


def _reference(recording: Recording, movement: Movement, sensor: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    (start, end), margin = recording.span_ns, round(INTERVAL_MARGIN_S * 1e9)
    support = Support(frame=movement.support, gravity_direction=movement.gravity_direction)
    interval = Interval(label="all", start_ns=start + margin, end_ns=end - margin, use=Use.CALIBRATION, support=support)
    samples = sensor_samples(
        recording,
        movement.model,
        sensor=sensor,
        stream=sensor,
        quantity="raw",
        interval=interval,
        processing=Processing(),
        evaluator=Evaluator.COMPILED,
    )
    inside = np.isin(recording.stream(sensor).stamp_ns, samples.stamp_ns)
    return np.flatnonzero(inside), samples.reference, samples.flattening


def planned_motions(proposals: Sequence[Proposal], sensor: str, *, first: int) -> list[Motion]:
    """Follow planned recordings, each a power-up of its own."""
    motions = []
    for number, proposal in enumerate(proposals, start=first):
        way = proposal.trajectory
        movement = proposal.place.stand.movement(f"planned {number}", MovementKind.GRID, way, way.duration_s)
        motions.append(Motion.of(movement, sensor, number=number, power_up=number))
    return motions


def calibrated(data: Sequence[DataSet], specimen: Specimen, *, repeatability: float = REPEATABILITY) -> GenerativeFit:
    """Calibrate by the default estimator; the reference is exact, as `forcetorque simulate` states it."""
    assumed = Assumptions.of_counts(6, LIMIT_COUNTS, accuracy=np.zeros(6), repeatability=repeatability)
    return fit_generative([WindowMeans.of(one) for one in data], specimen.workbench, assumed, variables=[TEMPERATURE])


def true_error(matrix: FloatArray, specimen: Specimen, case: LoadCase) -> FloatArray:
    """Root mean square force and moment error of changes of load at a use; shape (2,); N, N m."""
    wrong = case.wrench @ (matrix @ np.linalg.pinv(specimen.sensor.matrix) - np.eye(6)).T
    return np.sqrt([(wrong[:, part] ** 2).sum(axis=1).mean() for part in (slice(3), slice(3, 6))])


_FILE = """schema = "forcetorque/experiment/1"
name = "planned"
[robot]
urdf = "{urdf}"
tolerance = "exact"
[[sensor]]
name = "{sensor}"
serial = "{serial}"
prior = "matrix_{serial}.txt"
variable = [{{ name = "temperature" }}]
{supports}
[calibration]
accuracy = {{ force_N = 0.0, moment_Nm = 0.0 }}
{rest}
"""


def planned_run(
    folder: Path, scenario: Scenario, sensor: str, supports: Sequence[str], rest: str, specimen: Specimen | None = None
) -> SensorRun:
    """Describe a sensor of which nothing was recorded, with its workbench matrix as the prior."""
    own = scenario.specimens[sensor] if specimen is None else specimen
    write_matrix_file(folder / f"matrix_{own.serial}.txt", encode_matrix(own.workbench))
    stands = "\n".join(f'[[support]]\nframe = "{name}"\ngravity_direction = [0.0, 0.0, -1.0]' for name in supports)
    text = _FILE.format(urdf=scenario.urdf, sensor=sensor, serial=own.serial, supports=stands, rest=rest)
    (folder / "planned.toml").write_text(text, encoding="utf-8")
    run = SensorRun(load_experiment(folder / "planned.toml", Purpose.PLANNING), sensor)
    return SensorRun(run.experiment, replace(run.sensor, prior=own.workbench))

# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches on the soles, from force-torque sensors, or from vertical forces alone where only these were logged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.pose import invert_pose, make_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import transform_wrench
from forcetorque.estimation.skin_contacts import clock_stream, uncertainty_of
from forcetorque.estimation.uncertain.estimate import UncertainEstimates, estimate_with_covariance
from forcetorque.estimation.uncertain.uncertainty import Uncertainty
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.file import parse_experiment
from forcetorque.experiment.input_files import Inputs, stated_in
from forcetorque.experiment.intervals import RecordedSpan, read_spans
from forcetorque.experiment.offsets import intervals_in_use
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.streams import read_streams
from forcetorque.locomotion.section import SOLES, ExperimentSole, read_soles, refuse_without_soles
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole, centre_of_pressure, mass_of
from forcetorque.locomotion.standing.interval_balance import BalanceOptions, FootPressure, IntervalBalance
from forcetorque.locomotion.standing.support_phases import support_phases
from forcetorque.locomotion.standing.zero_moment_point import BalanceScene, robot_balance
from forcetorque.recording.alignment import interpolate, require_overlap, seconds_since, usable_samples
from forcetorque.recording.recording import Recording, Use
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.dynamics import body_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class FootForces:
    """The vertical forces of an experiment's feet."""

    name: str
    """Name of the experiment."""
    file: Path
    """Its file."""
    recording: Recording
    """What was measured."""
    soles: tuple[ExperimentSole, ...]
    """Soles in the order of the file, each with a stream."""
    intervals: tuple[RecordedSpan, ...]
    """Intervals in the order of the file."""
    model: RobotModel | None
    """The robot, which gives its weight; None where the file names none."""
    gravity: float
    """Magnitude of gravity; m/s2."""

    def __repr__(self) -> str:
        return f"<FootForces {self.name!r}: {', '.join(sole.sole.frame for sole in self.soles)}>"

    def over(self, span: RecordedSpan) -> tuple[IntArray, dict[str, FloatArray]]:
        """Give the forces over an interval, at the instants of the first sole's stream.

        Args:
            span: The interval.

        Returns:
            Stamps that rise, those of ignored intervals left out, shape (n,), ns; and the vertical force on each sole,
            NaN in gaps, shape (n,) each, N.
        """
        first = self.recording.stream(self.soles[0].stream or "")
        at_ns = first.stamp_ns[usable_samples(first.stamp_ns)]
        at_ns = at_ns[span.holds(at_ns)]
        for other in self.intervals:
            if other.use is Use.IGNORE and other is not span:
                at_ns = at_ns[~other.holds(at_ns)]
        forces = {}
        for sole in self.soles:
            stream = self.recording.stream(sole.stream or "")
            require_overlap(first, stream)
            forces[sole.sole.frame] = interpolate(stream, stream.signal("vertical_force").values, at_ns)[:, 0]
        return at_ns, forces


def has_foot_forces(path: Path | str) -> bool:
    """Check whether an experiment file is about feet whose vertical forces alone were logged.

    Args:
        path: TOML file.

    Returns:
        Whether it has soles and no force-torque sensor.
    """
    parsed = parse_experiment(path)
    return bool(parsed.table(SOLES)) and not parsed.sensor


def load_foot_forces(path: Path | str) -> FootForces:
    """Read the vertical forces of an experiment's feet.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The forces.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file has no sole, or contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    table = parsed.table(SOLES)
    if not table:
        raise ExperimentError(f"{file}: expected [[sole]], a foot with the stream of its vertical_force, got none")
    for index, entry in enumerate(table):
        if entry.stream is None and not parsed.sensor:
            raise ExperimentError(
                f"{file}: sole[{index}]: expected stream with the vertical_force of the ground, or [[sensor]] in the "
                "file, got neither; by joints and IMU alone: --by-motion"
            )
    inputs = Inputs.of(file)
    model = None if parsed.robot is None else read_urdf(inputs.robot(parsed.robot.urdf))
    recording = read_streams(parsed, file, model, inputs)
    return FootForces(
        name=parsed.name,
        file=file,
        recording=recording,
        soles=read_soles(table, file, model, recording, sensed=bool(parsed.sensor)),
        intervals=read_spans(parsed, file, recording),
        model=model,
        gravity=STANDARD_GRAVITY if parsed.robot is None else parsed.robot.gravity,
    )


def balance_of_sensors(
    experiment: Experiment, corrections: Mapping[str, Correction], options: BalanceOptions
) -> Iterator[IntervalBalance]:
    """Find what presses on the soles over every interval that is not to be ignored.

    A reading at the ankle, or further up a leg, is moved to the sole and rid of the weight and inertia in between, as
    contact wrenches are estimated.

    Args:
        experiment: The experiment, with soles.
        corrections: How its sensors are read (`corrections_of`).
        options: What counts as a contact and as a point.

    Yields:
        How the robot stood, in the order of the intervals.

    Raises:
        ExperimentError: If the file has no sole, or every interval is to be ignored.
    """
    refuse_without_soles(experiment)
    for interval in intervals_in_use(experiment):
        with stated_in(f"interval {interval.label!r}"):
            yield _over(BalanceScene.of(experiment, interval), corrections, options)


def _over(scene: BalanceScene, corrections: Mapping[str, Correction], options: BalanceOptions) -> IntervalBalance:
    feet = tuple(_feet(scene, corrections, options))
    forces = {foot.sole.frame: foot.wrench[:, 2] for foot in feet}
    inside = scene.samples.inside
    pushes = [
        np.einsum("nij,nj->ni", scene.root_H_sole(foot.sole)[inside, :3, :3], foot.wrench[:, :3]) for foot in feet
    ]
    phases = support_phases(forces, scene.time_s, options.thresholds(scene.weight_N))
    robot, refused = robot_balance(scene, feet, phases, options)
    return IntervalBalance(
        recording=scene.experiment.name,
        label=scene.interval.label,
        stamp_ns=scene.stamp_ns,
        time_s=scene.time_s,
        weight_N=scene.weight_N,
        forces=forces,
        net_N=np.einsum("ni,ni->n", np.sum(pushes, axis=0), scene.upward()),
        phases=phases,
        feet=feet,
        robot=robot,
        refused=tuple(refused),
    )


def _feet(
    scene: BalanceScene, corrections: Mapping[str, Correction], options: BalanceOptions
) -> Iterator[FootPressure]:
    measured, known = _measured(scene, corrections), _known(scene)
    plain = estimate(scene.question, scene.joints, scene.root, measured=measured, known=known)
    uncertainty = _uncertainty(scene, corrections, measured)
    uncertain: UncertainEstimates | None = None
    if uncertainty.measured:
        uncertain = estimate_with_covariance(
            scene.question,
            scene.joints,
            scene.root,
            measured=measured,
            known=known,
            uncertainty=uncertainty,
            must_be_determined=False,
        )
    least_N, inside = options.least_load_N(scene.weight_N), scene.samples.inside
    for entry in scene.experiment.section(SOLES):
        sole = entry.sole
        sensors = _nearest_sensors(scene, sole)
        wrench = scene.kept(plain.contact(sole.frame))
        covariance = None
        if uncertain is not None and set(sensors) <= uncertainty.measured.keys():
            covariance = uncertain.covariance_of(sole.frame)[inside]
        alone = None
        if len(sensors) == 1:
            on_foot = scene.kept(_reading_alone(scene, sole, sensors[0], measured.of_name(sensors[0])))
            alone = centre_of_pressure(on_foot, least_load_N=least_N).points
        yield FootPressure(
            sole=sole,
            sensors=sensors,
            wrench=wrench,
            covariance=covariance,
            pressure=centre_of_pressure(wrench, least_load_N=least_N, covariance=covariance),
            reading_alone=alone,
        )


def _nearest_sensors(scene: BalanceScene, sole: Sole) -> tuple[str, ...]:
    """Sensors that bound the part of the robot that a sole is on."""
    question = scene.question
    body = question.body_of(sole.contact)
    part = next(part for part in question.parts if body in part.bodies)
    return (*(() if part.sensor is None else (part.sensor,)), *part.outboard_sensors)


def _reading_alone(scene: BalanceScene, sole: Sole, sensor: str, reading: FloatArray) -> FloatArray:
    """The reading as the ground's wrench on the foot, its moment taken as one about the point of the sole below it."""
    # seen from the sole the sensor shows what the foot does to the rest: the ground's doing, but for weight and inertia
    sign = build_tree(scene.experiment.model, sole.frame).cuts[sensor].sign
    cut = scene.tree.cuts[sensor]
    root_H_sensor = body_pose(scene.tree, scene.joints, cut.body) @ cut.body_H_sensor
    sole_H_sensor = invert_pose(scene.root_H_sole(sole)) @ root_H_sensor
    below = sole_H_sensor[:, :3, 3] * [1.0, 1.0, 0.0]
    return transform_wrench(make_pose(sole_H_sensor[:, :3, :3], below), sign * reading)


def _measured(scene: BalanceScene, corrections: Mapping[str, Correction]) -> Wrenches:
    experiment, at_ns = scene.experiment, scene.samples.stamp_ns
    for sensor in experiment.sensors:
        require_overlap(clock_stream(experiment), experiment.recording.stream(sensor.stream))
    return Wrenches.of(
        {
            sensor.name: wrench_at(experiment, sensor, corrections[sensor.name], at_ns, interval=scene.interval)
            for sensor in experiment.sensors
        }
    )


def _known(scene: BalanceScene) -> Wrenches | None:
    recording, wrenches = scene.experiment.recording, {}
    for entry in scene.present:
        if entry.stream is not None:
            stream = recording.stream(entry.stream)
            require_overlap(clock_stream(scene.experiment), stream)
            wrenches[entry.contact.name] = interpolate(stream, stream.signal("wrench").values, scene.samples.stamp_ns)
    return Wrenches.of(wrenches) if wrenches else None


def _uncertainty(scene: BalanceScene, corrections: Mapping[str, Correction], measured: Wrenches) -> Uncertainty:
    """What readings are off by: as their calibration predicts, else as the file states."""
    predicted = uncertainty_of(scene.experiment, corrections, (), measured, label=scene.interval.label).measured
    stated = {sensor.name: _stated(sensor) for sensor in scene.experiment.sensors}
    return Uncertainty(measured={**{name: one for name, one in stated.items() if one is not None}, **predicted})


def _stated(sensor: ExperimentSensor) -> FloatArray | None:
    """Covariance of one reading that the file states: noise, and what it is off all along."""
    if sensor.measurement_noise is None or sensor.measurement_offset_sd is None:
        return None
    return np.diag(sensor.measurement_noise**2 + sensor.measurement_offset_sd**2)


VERTICAL_ONLY: Final = (
    "centre of pressure and zero moment point: only the vertical forces of the feet were logged, and a point takes the "
    "moments too; they are not guessed"
)
"""What vertical forces do not show."""


def balance_of_forces(content: FootForces, options: BalanceOptions) -> Iterator[IntervalBalance]:
    """Find the support phases of every interval that is not to be ignored.

    Args:
        content: The forces.
        options: What counts as a contact.

    Yields:
        How the robot stood, in the order of the intervals.

    Raises:
        ExperimentError: If every interval is to be ignored, or one has no sample.
    """
    spans = [span for span in content.intervals if span.use is not Use.IGNORE]
    if not spans:
        raise ExperimentError(f"experiment {content.name!r}: expected an interval that is not to be ignored")
    model = content.model
    weight_N = None if model is None else content.gravity * mass_of(build_tree(model, model.root_link))
    thresholds = options.thresholds(weight_N)
    for span in spans:
        with stated_in(f"interval {span.label!r}"):
            at_ns, forces = content.over(span)
            if not len(at_ns):
                raise ExperimentError("expected samples of the vertical forces, got none; the log begins later or ends")
            time_s = seconds_since(at_ns, content.recording.start_ns)
            yield IntervalBalance(
                recording=content.name,
                label=span.label,
                stamp_ns=at_ns,
                time_s=time_s,
                weight_N=weight_N,
                forces=forces,
                net_N=np.sum(list(forces.values()), axis=0),
                phases=support_phases(forces, time_s, thresholds),
                refused=(VERTICAL_ONLY,),
            )

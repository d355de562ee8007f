# SPDX-License-Identifier: BSD-3-Clause
"""From experiments to a joint calibration: which parts nothing touches, and what their sensors read.

What touches is what the files say: the support of an interval, and every `[[contact]]` that is there meanwhile.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.analysis.reading import Correction, wrench_at
from forcetorque.arrays import FloatArray
from forcetorque.calibration.joint import JointResult, ModelTolerance, Stretch, UntouchedStretch, fit_stretches
from forcetorque.errors import ExperimentError, SerialNumberError
from forcetorque.estimation.part_equations import joints_of_part, sensors_of, untouched_parts
from forcetorque.estimation.picked import padded_samples
from forcetorque.estimation.root_motion import imu_frame
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.experiment import Experiment
from forcetorque.experiment.contacts import contacts_in
from forcetorque.recording import Interval, MovingSupport, Use
from forcetorque.recording.alignment import require_overlap, seconds_since
from forcetorque.robot import BodyTree, build_tree
from forcetorque.robot.sub_model import SubModel


def calibrate_jointly(
    experiments: Sequence[Experiment],
    sensors: Sequence[str] | None = None,
    *,
    tolerance: ModelTolerance | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> JointResult:
    """Calibrate all sensors of a robot at once, on the calibration intervals of any number of recordings.

    No contact needs to be known: parts of the robot between its sensors that nothing touches give the equations.

    Args:
        experiments: Recordings of one robot; with an IMU as support where no link stands still.
        sensors: Sensors to calibrate, which have a prior matrix or log a wrench; all of the first file if None.
        tolerance: How far the robot model may be off; `ModelTolerance()` if None.
        progress: Called with what is being done.

    Returns:
        The fit: changes of the prior matrices, offsets by session, errors of the model, and spans that were touched.

    Raises:
        ExperimentError: If the files are of different sensors, or in none an untouched part has all joints in the log.
        EstimationError: If every part of an interval is touched.
    """
    names = tuple(sensor.name for sensor in experiments[0].sensors) if sensors is None else tuple(sensors)
    _require_same_sensors(experiments, names)
    stretches = [
        untouched_stretch(experiment, interval, names)
        for experiment in experiments
        for interval in experiment.intervals(Use.CALIBRATION)
    ]
    return fit_stretches(stretches, tolerance, progress=progress)


def untouched_stretch(experiment: Experiment, interval: Interval, sensors: Sequence[str]) -> UntouchedStretch:
    """Take what an interval says of several sensors at once.

    Args:
        experiment: The experiment.
        interval: One of its intervals.
        sensors: Names of its sensors.

    Returns:
        Readings by the prior matrices, at the instants of the first sensor, and the motion of the robot. Parts whose
        joints are not in the log are left out, and named.

    Raises:
        ExperimentError: If the interval has no support, or of no untouched part all joints are in the log.
    """
    support = interval.support
    if support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame or an IMU, got none")
    present = contacts_in(interval, experiment.contacts)
    touched = tuple(dict.fromkeys((support.frame, *(entry.contact.link for entry in present))))
    if isinstance(support, MovingSupport):
        # the motion is known where the IMU is: nothing needs to be carried to another link
        support = replace(support, frame=imu_frame(experiment.model, experiment.recording, support))
    tree = build_tree(experiment.model, support.frame)
    parts, left_out = _logged(experiment, untouched_parts(tree, sensors, touched), tree)
    if not parts:
        raise ExperimentError(
            f"interval {interval.label!r}: of no untouched part are all joints in the log: {'; '.join(left_out)}"
        )
    used = [experiment.sensor(name) for name in sensors if any(name in sensors_of(part) for part in parts)]
    source = experiment.recording.stream(used[0].stream)
    for sensor in used[1:]:
        require_overlap(source, experiment.recording.stream(sensor.stream))
    samples = padded_samples(experiment.recording, source, interval, None)
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        tuple(dict.fromkeys(joint for part in parts for joint in joints_of_part(tree, part))),
        source,
        samples.stamp_ns,
        processing=experiment.processing,
    )
    stretch = Stretch(
        label=interval.label,
        recording=experiment.session_names(None)[0],
        session=experiment.session_names(interval.label)[0],
        time_s=seconds_since(samples.stamp_ns, experiment.recording.start_ns),
        tree=tree,
        joints=joints,
        root=root,
        readings={
            sensor.name: wrench_at(experiment, sensor, Correction.without_offset(sensor), samples.stamp_ns)
            for sensor in used
        },
        touched=touched,
    )
    return UntouchedStretch(stretch=stretch, parts=parts, left_out=left_out)


def _require_same_sensors(experiments: Sequence[Experiment], names: Sequence[str]) -> None:
    """Refuse files of different sensors: one matrix is fitted to all."""
    first, *others = experiments
    for sensor in (first.sensor(name) for name in names):
        for other in others:
            another = other.sensor(sensor.name)
            if sensor.serial != another.serial:
                raise SerialNumberError(
                    f"{other.file}: expected the sensor {sensor.name!r} with the serial number {sensor.serial!r} of "
                    f"{first.file}, got {another.serial!r}; calibrate them apart"
                )
            if not _same(sensor.prior, another.prior):
                raise ExperimentError(
                    f"{other.file}: sensor {sensor.name!r}: expected the prior matrix of {first.file}; state the same"
                )


def _same(one: FloatArray | None, other: FloatArray | None) -> bool:
    return one is other if one is None or other is None else np.array_equal(one, other)


def _logged(
    experiment: Experiment, parts: Sequence[SubModel], tree: BodyTree
) -> tuple[tuple[SubModel, ...], tuple[str, ...]]:
    """Parts whose joints were logged, and of the others what they lack."""
    available = set(experiment.recording.joint_signals("position"))
    logged, lacking = [], []
    for part in parts:
        missing = [joint for joint in joints_of_part(tree, part) if joint not in available]
        if missing:
            lacking.append(f"part {part.name!r} needs the joint(s) {', '.join(missing)}, which the log lacks")
        else:
            logged.append(part)
    return tuple(logged), tuple(lacking)

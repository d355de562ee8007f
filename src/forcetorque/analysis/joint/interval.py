# SPDX-License-Identifier: BSD-3-Clause
"""What an interval says of all sensors at once: which parts nothing touches, and what their sensors read.

What touches is what the files say: the support of an interval, and every `[[contact]]` that is there meanwhile.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from forcetorque.analysis.joint.logged_parts import LoggedParts
from forcetorque.analysis.runs.reading import readings_at
from forcetorque.arrays import FloatArray
from forcetorque.calibration.joint import Stretch, UntouchedStretch, window_means
from forcetorque.errors import ExperimentError
from forcetorque.estimation.part_equations import untouched_parts
from forcetorque.estimation.picked import padded_samples
from forcetorque.estimation.root_motion import imu_frame
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.sample_quality import unusable_in
from forcetorque.recording import Interval, MovingSupport
from forcetorque.recording.alignment import require_overlap, seconds_since
from forcetorque.recording.sample_quality import UnusableCounts
from forcetorque.robot import build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RawWindows:
    """Raw readings of one sensor over the windows of an interval."""

    time_s: FloatArray
    """Mean instants; shape (w,); s."""
    means: FloatArray
    """Mean readings; shape (w, c); counts; NaN where a window has a gap."""
    minimum: FloatArray
    """Smallest reading per channel; shape (c,); counts."""
    maximum: FloatArray
    """Largest reading per channel; shape (c,); counts."""
    samples: int
    """Samples with a reading."""
    missing: int
    """Samples without."""
    unusable: UnusableCounts
    """Samples of the sensor that say nothing of its load, among those of the interval."""

    @classmethod
    def of(cls, stretch: Stretch, raw: FloatArray, unusable: UnusableCounts) -> Self:
        """Average raw readings.

        Args:
            stretch: The stretch that they are of.
            raw: Readings at its instants; shape (n, c); counts; NaN in gaps.
            unusable: Samples of the sensor that say nothing of its load, among those of the interval.

        Returns:
            The same over its windows.
        """
        whole = np.isfinite(raw).all(axis=1)
        nothing = np.full(raw.shape[1], np.nan)
        times, means = window_means(stretch, raw)
        return cls(
            time_s=times,
            means=means,
            minimum=raw[whole].min(axis=0) if whole.any() else nothing,
            maximum=raw[whole].max(axis=0) if whole.any() else nothing,
            samples=int(np.count_nonzero(whole)),
            missing=int(np.count_nonzero(~whole)),
            unusable=unusable,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointInterval:
    """One interval of one recording."""

    interval: Interval
    """The interval."""
    untouched: UntouchedStretch
    """Its equations, and what is needed for them."""
    raw: Mapping[str, RawWindows]
    """Raw readings by the names of the sensors."""


def joint_interval(
    experiment: Experiment,
    interval: Interval,
    sensors: Sequence[str],
    *,
    label: str | None = None,
    recording: str | None = None,
    session: str | None = None,
) -> JointInterval:
    """Take what an interval says of several sensors at once.

    Args:
        experiment: The experiment.
        interval: One of its intervals.
        sensors: Names of its sensors.
        label: Name of the interval among those of other recordings; its label if None.
        recording: Name of the recording among others; that of the experiment if None.
        session: Session that the interval is of, among those of other recordings; by its file if None.

    Returns:
        Readings by the prior matrices, at the instants of the first sensor, and the motion of the robot. Parts whose
        joints are not in the log are left out, and named.

    Raises:
        ExperimentError: If the interval has no support, or of no untouched part all joints are in the log.
    """
    support = interval.support
    if support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame or an IMU, got none")
    model = experiment.model_on(support)
    present = contacts_in(interval, experiment.contacts)
    touched = tuple(dict.fromkeys((support.frame, *(entry.contact.link for entry in present))))
    if isinstance(support, MovingSupport):
        # the motion is known where the IMU is: nothing needs to be carried to another link
        support = replace(support, frame=imu_frame(experiment.model, experiment.recording, support))
    tree = build_tree(model, support.frame)
    logged = LoggedParts.of(experiment, untouched_parts(tree, sensors, touched), tree)
    if not logged.parts and not logged.weighed:
        raise ExperimentError(
            f"interval {interval.label!r}: of no untouched part are all joints in the log: {'; '.join(logged.left_out)}"
        )
    used = [experiment.sensor(name) for name in sensors if name in logged.sensors]
    source = experiment.recording.stream(used[0].stream)
    for sensor in used[1:]:
        require_overlap(source, experiment.recording.stream(sensor.stream))
    samples = padded_samples(experiment.recording, source, interval, None)
    joints, root = robot_motion_at(
        experiment.recording,
        experiment.model,
        support,
        logged.joints(tree),
        source,
        samples.stamp_ns,
        processing=experiment.processing,
    )
    priors = {sensor.name: required_prior(sensor) for sensor in used}
    raw = {sensor.name: readings_at(experiment, sensor, (), samples.stamp_ns).raw for sensor in used}
    stretch = Stretch(
        label=interval.label if label is None else label,
        recording=experiment.session_names(None)[0] if recording is None else recording,
        session=experiment.session_names(interval.label)[0] if session is None else session,
        time_s=seconds_since(samples.stamp_ns, experiment.recording.start_ns),
        tree=tree,
        joints=joints,
        root=root,
        readings={name: raw[name] @ prior.T for name, prior in priors.items()},
        touched=touched,
    )
    return JointInterval(
        interval=interval,
        untouched=UntouchedStretch(
            stretch=stretch, parts=logged.parts, weighed=logged.weighed, left_out=logged.left_out
        ),
        raw={
            name: RawWindows.of(stretch, values, unusable_in(experiment, experiment.sensor(name), interval))
            for name, values in raw.items()
        },
    )


def required_prior(sensor: ExperimentSensor) -> FloatArray:
    """Give the prior matrix of a sensor, which a joint calibration changes.

    Args:
        sensor: The sensor.

    Returns:
        The matrix; shape (6, c); N/count, N m/count.

    Raises:
        ExperimentError: If it has none.
    """
    if sensor.prior is None:
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected a prior matrix, which a joint calibration changes; state the matrix of "
            'its data sheet as `prior`, or "identity" for a log of wrenches'
        )
    return sensor.prior

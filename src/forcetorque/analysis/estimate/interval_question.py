# SPDX-License-Identifier: BSD-3-Clause
"""What the robot is asked over one interval, with all that does not depend on how its sensors are read."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.estimate.answerable import narrowed
from forcetorque.analysis.runs.reading import Correction, wrench_at
from forcetorque.analysis.skin.sources import sources_at
from forcetorque.analysis.skin.wrench import PatchFrames
from forcetorque.arrays import IntArray
from forcetorque.errors import ExperimentError
from forcetorque.estimation import (
    Contact,
    ContactType,
    Estimates,
    MinimumNorm,
    Question,
    TorqueSum,
    estimate,
    moving_joints,
    required_joints_of,
)
from forcetorque.estimation.picked import PaddedSamples
from forcetorque.estimation.samples import robot_motion_at
from forcetorque.estimation.uncertain import SkinSource
from forcetorque.experiment.contacts import contacts_at_sensors, contacts_in
from forcetorque.experiment.content import Experiment, ExperimentContact
from forcetorque.recording import Interval, MovingSupport, Support
from forcetorque.recording.alignment import interpolate, require_overlap
from forcetorque.robot import JointMotion, RootMotion, Wrenches, build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalQuestion:
    """A question over one interval, with the motion of the robot and the wrenches that are known."""

    experiment: Experiment
    """The experiment."""
    interval: Interval
    """The interval."""
    samples: PaddedSamples
    """Its instants, n with those around it."""
    question: Question
    """What is asked, as far as the log allows."""
    left_out: tuple[str, ...]
    """What it does not allow, in words."""
    joints: JointMotion
    """Motion of the joints; n samples."""
    root: RootMotion
    """Motion of the support frame."""
    skin: tuple[SkinSource, ...]
    """Contacts on skin; n samples."""
    known: Wrenches | None
    """Wrenches of known contacts; n samples."""

    @classmethod
    def of(
        cls,
        experiment: Experiment,
        interval: Interval,
        samples: PaddedSamples,
        contacts: Sequence[ExperimentContact],
        *,
        asked: bool | None = None,
        length_scale: float | None = None,
        patches: Sequence[PatchFrames] = (),
    ) -> IntervalQuestion:
        """Ask what touches the robot over an interval.

        Args:
            experiment: The experiment.
            interval: The interval.
            samples: Its instants.
            contacts: Contacts beside the support, of all intervals.
            asked: Whether only the contacts that are named are asked for; where not, whatever touches the part outboard
                of a sensor is, at that sensor. By whether any is named if None.
            length_scale: Moment that weighs as much as one newton, where contacts leave something undetermined; m.
            patches: What patches of skin say.

        Returns:
            The question.

        Raises:
            ExperimentError: If the interval has no support, or a named contact cannot be told.
        """
        support = interval.support
        if support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame")
        present, at_ns = contacts_in(interval, contacts), samples.stamp_ns
        skin = sources_at(experiment, patches, at_ns)
        named = bool(contacts) if asked is None else asked
        question = _question(experiment, support, present, skin, asked=named, length_scale=length_scale)
        available = set(experiment.recording.joint_signals("position"))
        question, left_out = narrowed(question, available, required={entry.contact.name for entry in present})
        source = experiment.clock_stream
        joints, root = robot_motion_at(
            experiment.recording,
            experiment.model,
            support,
            required_joints_of(question),
            source,
            at_ns,
            processing=experiment.processing,
        )
        for stream in (entry.stream for entry in present if entry.stream):
            require_overlap(source, experiment.recording.stream(stream))
        return cls(
            experiment=experiment,
            interval=interval,
            samples=samples,
            question=question,
            left_out=tuple(left_out),
            joints=joints,
            root=root,
            skin=tuple(skin),
            known=_known(experiment, question, present, skin, at_ns),
        )

    def measured(self, corrections: Mapping[str, Correction]) -> Wrenches:
        """Read the sensors.

        Args:
            corrections: How each is read.

        Returns:
            What they measured; n samples.

        Raises:
            RecordingError: If a stream does not overlap the instants.
        """
        experiment, readings = self.experiment, {}
        for sensor in experiment.sensors:
            correction = corrections[sensor.name]
            streams = [sensor.stream, *(sensor.variable(name).source.stream for name in correction.variables)]
            for stream in streams:
                require_overlap(experiment.clock_stream, experiment.recording.stream(stream))
            readings[sensor.name] = wrench_at(
                experiment, sensor, correction, self.samples.stamp_ns, interval=self.interval
            )
        return Wrenches.of(readings) if readings else Wrenches(names=(), values=np.empty((len(self.joints), 0, 6)))

    def estimates(self, measured: Wrenches, *, progress: Callable[[int], None] | None = None) -> Estimates:
        """Answer it.

        Args:
            measured: What the sensors measured; n samples.
            progress: Called with the number of samples done.

        Returns:
            The answer; n samples, not filtered.
        """
        return estimate(self.question, self.joints, self.root, measured=measured, known=self.known, progress=progress)


def _question(
    experiment: Experiment,
    support: Support | MovingSupport,
    present: Sequence[ExperimentContact],
    skin: Sequence[SkinSource],
    *,
    asked: bool,
    length_scale: float | None,
) -> Question:
    tree = build_tree(experiment.model_on(support), support.frame)
    sensors = tuple(sensor.name for sensor in experiment.sensors)
    contacts = [entry.contact for entry in present]
    if support.frame not in [contact.name for contact in contacts]:
        contacts.insert(0, Contact(link=support.frame))
    if not asked:
        contacts += contacts_at_sensors(tree, sensors)
    return Question(
        tree=tree,
        measured=sensors,
        contacts=(*contacts, *(source.contact for source in skin)),
        torques=moving_joints(tree),
        # errors leave nothing in a sub-model that its neighbours' torques would need
        torque_sum=TorqueSum.SUB_MODEL if experiment.force_patches else TorqueSum.WHOLE_TREE,
        expected=sensors,
        minimum_norm=None if length_scale is None else MinimumNorm(length_scale=length_scale),
    )


def _known(
    experiment: Experiment,
    question: Question,
    present: Sequence[ExperimentContact],
    skin: Sequence[SkinSource],
    at_ns: IntArray,
) -> Wrenches | None:
    streams = {e.contact.name: e.stream for e in present if e.stream is not None}
    wrenches = {source.contact.name: source.wrench for source in skin}
    for contact in question.contacts:
        if contact.type is ContactType.KNOWN and contact.name in streams:
            stream = experiment.recording.stream(streams[contact.name])
            wrenches[contact.name] = interpolate(stream, stream.signal("wrench").values, at_ns)
    return Wrenches.of(wrenches) if wrenches else None

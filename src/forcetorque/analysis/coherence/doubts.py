# SPDX-License-Identifier: BSD-3-Clause
"""What makes net contact forces doubtful: who touches, how links stand, and how sensors are read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from forcetorque.analysis.coherence.net_contact import NetContact
from forcetorque.analysis.coherence.reader import Reader
from forcetorque.analysis.coherence.rows import (
    CoherenceSummary,
    policy_words,
)
from forcetorque.analysis.runs.candidate import PRIOR
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import Offset
from forcetorque.robot import Wrenches

FREE_SHARE, DOUBT_SHARE, BEARING_SHARE = 0.06, 0.15, 1.0 / 3.0
"""Share of the weight below which a link that is said to touch is in the air; and of force that nothing explains, from
which a link that is not said to touch may bear the robot, or a matrix err as much, and from which it does bear it."""
LEAN_DEG = 0.5
"""Angle from which it is said that the joints have a link lean that stands on level ground; of half the weight of a
robot of 30 kg it makes 1.3 N."""


def contact_doubts(phases: Sequence[NetContact], readers: Sequence[Reader], weight: float) -> list[str]:
    """Refuse links that are said to touch and do not, or the other way round, whatever reads them.

    Args:
        phases: The phases.
        readers: All that read the sensors with an offset.
        weight: Weight of the robot; N.

    Returns:
        What is doubtful of who touches, in words.

    Raises:
        ExperimentError: If a link that is said to touch bears nothing, or one that is not bears the robot.
    """
    doubts = []
    for phase in phases:
        measured: list[Wrenches] = [phase.asked.measured(reader.corrections) for reader in readers]
        label = phase.asked.interval.label
        borne = [phase.forces(one) for one in measured]
        for name in borne[0] if borne else ():
            most = max(abs(forces[name]) for forces in borne)
            if most < FREE_SHARE * weight:
                raise ExperimentError(
                    f"interval {label!r}: {name!r} is in the air: expected a link that touches to bear at least "
                    f"{FREE_SHARE:.0%} of {weight:.1f} N, got {most:.2f} N; leave it out of touched, [[contact]] or "
                    "support, or state the intervals of the contact"
                )
        left = [phase.unexplained(one) for one in measured]
        for name in left[0] if left else ():
            least = min(forces[name] for forces in left)
            words = (
                f"interval {label!r}: only {', '.join(phase.touching)} may touch, but {least:.1f} of {weight:.1f} N "
                f"act on the robot beyond {name!r}"
            )
            if least > BEARING_SHARE * weight:
                raise ExperimentError(f"{words}; name both feet in touched, or the other in [[contact]]")
            if least > DOUBT_SHARE * weight:
                doubts.append(f"{words}: a sensor errs by as much, or another link touches")
    return doubts


def leans(phases: Sequence[NetContact]) -> Iterator[str]:
    """Say which links stand on level ground and lean by the joints.

    Args:
        phases: The phases.

    Yields:
        A sentence for each.
    """
    for phase in phases:
        for name, angle in phase.leans_deg().items():
            if angle > LEAN_DEG:
                yield (
                    f"interval {phase.asked.interval.label!r}: by the joints {name} leans by {angle:.1f} deg against "
                    "the level ground that [[support]] states; its force is taken upright by what is stated"
                )


def reading_doubts(readers: Sequence[Reader], summary: Sequence[CoherenceSummary]) -> Iterator[str]:
    """Say what makes readings doubtful, and which candidates err more than the prior.

    Args:
        readers: All that read the sensors.
        summary: Their errors.

    Yields:
        A sentence for each.
    """
    uncalibrated = {reader.candidate: reader.by_prior for reader in readers if reader.candidate != PRIOR}
    for candidate, sensors in uncalibrated.items():
        if sensors:
            yield f"{candidate}: has no calibration of {', '.join(sensors)}, which the prior reads here too"
    for reader in readers:
        if reader.policy.offset is Offset.NONE and reader.candidate == PRIOR:
            yield "offset none: no offset removed, so that the errors hold whatever offsets the sensors have"
        if reader.policy.offset is Offset.FITTED:
            for sensor, correction in reader.corrections.items():
                if not correction.removes_offset:
                    yield f"{reader.candidate}, {sensor}: no offset removed, as no calibration interval gives one"
        for sensor, offset in reader.offsets.items():
            if offset.not_logged and reader.candidate == PRIOR:
                yield (
                    f"offset {reader.policy}, {sensor}: {', '.join(offset.not_logged)} are in no stream and are taken "
                    "to be at rest: the offset of forces is known, that of moments is not"
                )
    priors = {(one.offset, one.offset_interval): one.force_error_mean_N for one in summary if one.candidate == PRIOR}
    for one in summary:
        prior = priors.get((one.offset, one.offset_interval))
        mean = one.force_error_mean_N
        if one.candidate != PRIOR and prior is not None and mean is not None and mean > prior:
            yield (
                f"{one.candidate}, offset {policy_words(one.offset, one.offset_interval)}: error {mean:.2f} N, more "
                f"than the {prior:.2f} N of the prior"
            )

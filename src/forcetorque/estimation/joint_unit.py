# SPDX-License-Identifier: BSD-3-Clause
"""Whether positions of joints can be in the unit that is stated: a robot does not turn far beyond its limits."""

from __future__ import annotations

import numpy as np

from forcetorque.errors import RecordingError
from forcetorque.robot import JointMotion, JointType, RobotModel

CHECK_JOINT_UNIT = (
    "check the unit of the joints (degrees or radians, as units of [[recording.stream]] or recording.json state it; "
    "arrays are in radians)"
)
"""What is to be done where joints may be in another unit."""
_FAR = 2.0 * np.pi
"""Beyond its limits by a full turn no joint reads, even one whose encoder counts from another zero; rad."""
_MOST = 0.99
"""Share of samples that says it: single ones may be spikes."""


def require_joints_in_radians(model: RobotModel, motion: JointMotion) -> None:
    """Refuse positions that lie far beyond the limits of the URDF as radians, and within them as degrees.

    Args:
        model: The robot; joints without limits are not judged.
        motion: Positions of its joints.

    Raises:
        RecordingError: If those of a joint do.
    """
    for name, position in zip(motion.names, motion.position.T, strict=True):
        joint = model.joints.get(name)
        limit = None if joint is None or joint.type is not JointType.REVOLUTE else joint.limit
        if limit is None or limit.lower is None or limit.upper is None or not limit.lower < limit.upper:
            continue
        turned = position[np.isfinite(position)]
        far = (turned < limit.lower - _FAR) | (turned > limit.upper + _FAR)
        inside = (np.radians(turned) >= limit.lower) & (np.radians(turned) <= limit.upper)
        if turned.size and far.mean() > 1.0 - _MOST and inside.mean() >= _MOST:
            farthest = turned[np.argmax(np.abs(turned))]
            raise RecordingError(
                f"joint {name!r}: expected positions about the limits of the URDF, {limit.lower:.3g} to "
                f"{limit.upper:.3g} rad, got up to {farthest:.3g} rad, which fits them in degrees; {CHECK_JOINT_UNIT}"
            )

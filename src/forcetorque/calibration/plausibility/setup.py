# SPDX-License-Identifier: BSD-3-Clause
"""Where data come from, a robot or a workbench: how far gains differ there, and where to look for causes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from forcetorque.robot.motion import CHECK_JOINT_UNIT


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """Limits and messages that differ between setups."""

    doubtful_gain: float
    """Change of the gain from that of the prior from which on there is a doubt."""
    gain_causes: tuple[tuple[float, float, str], ...]
    """What gains between two limits point to; small ones are known to some hundredths only."""
    joints_move_too_little: bool
    """Whether a large gain may be that of joints whose degrees were read as radians."""
    check_gain: str
    """Where to look if the gain is wrong."""
    check_sign: str
    """Where to look if the whole reading runs against the loads."""
    check_axes: str
    """Where to look if single axes do."""
    check_moment: str
    """Where to look if moments alone are too small."""
    check_span: str
    """Where to look if the reading does not follow the loads."""
    give_mass: str
    """What to do without any load."""
    move_load: str
    """What to do about a load that stands still, with what it is likely to be."""


ROBOT: Final = Setup(
    doubtful_gain=0.1,  # mounted sensors stay below
    gain_causes=(
        (300.0, 3000.0, "are masses 1000 times too small, or the prior in N per 1000 counts?"),
        (7.0, 14.0, "is the prior in kgf instead of N?"),
        (1.5, 2.6, "does the model have half of the true mass?"),
        (0.4, 0.65, "does the model have twice the true mass?"),
        (0.07, 0.14, "are weights given instead of masses?"),
        (-0.1, 0.02, "are the masses in grams instead of kg?"),
    ),
    joints_move_too_little=True,
    check_gain="check the mass of the links beyond the sensor in the file that urdf of [robot] names, or mass_kg of "
    "[load], and whether prior of [[sensor]] is its own, at the amplifier gains of the recording",
    check_sign="is gravity_direction of [[support]] the direction in which things fall, and measure_direction of "
    "[[sensor]], [load] or the URDF's sensor tag the right way round?",
    check_axes="is gravity_direction of [[support]] given in the axes of its frame, the sensor's frame in the URDF "
    "turned as the sensor is, and prior of [[sensor]] its own?",
    check_moment="are moments logged in N m and stated in another unit? check units of [[recording.stream]], and prior "
    "of [[sensor]]",
    check_span=f"{CHECK_JOINT_UNIT}, frame and gravity_direction of [[support]], and whether stream of [[sensor]] is "
    "its own; a load that is lighter than the sensor's drift needs a heavier one beside it",
    give_mass="so the model has no mass beyond the sensor; give the links of the tool their mass in the file that urdf "
    "of [robot] names, or mass_kg of [load]",
    move_load="as of a limb that stands still; in the experiment file set start_s and end_s of every [[interval]] with "
    'use = "calibration" to where the limb moves, among arrays calibrate',
)
"""A sensor in a robot, whose loads are those of a model."""

WORKBENCH: Final = Setup(
    doubtful_gain=0.5,  # sensors of one type are .7 to 1.4 times their nominal matrix
    gain_causes=(
        (300.0, 3000.0, "is the prior in N per 1000 counts, or are masses in t or forces in kN?"),
        (7.0, 14.0, "is the prior in kgf instead of N, or are forces in kgf?"),
        (0.07, 0.14, "are weights in N given as masses in kg?"),
        (-0.1, 0.02, "are the masses in grams instead of kg?"),
    ),
    joints_move_too_little=False,
    check_gain="check the masses or the units of the known wrenches of the loads, and whether prior of [sensor] is of "
    "this type of sensor, at the amplifier gains of the recording; without prior, loads in all six directions "
    "determine the matrix",
    check_sign="is measure_direction of [sensor] the right way round, and prior of [sensor] in the same sense?",
    check_axes="are the directions of the loads given in the axes of the sensor, and is prior of [sensor] of this type "
    "of sensor?",
    check_moment="check the units of moments, or of the positions of weights, in the loads, and prior of [sensor]",
    check_span="check that the readings are in the order of the loads, files and channels of [readings], and whether "
    "prior of [sensor] is of this type of sensor",
    give_mass="so nothing hangs on the sensor; give the loads their masses, or their wrenches",
    move_load="as of one load; record other loads",
)
"""A sensor on a workbench, under loads that were weighed."""

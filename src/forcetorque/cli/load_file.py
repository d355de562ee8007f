# SPDX-License-Identifier: BSD-3-Clause
"""The file for a robot that several commands write: its options, and what becomes of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.output import Format, refuse_two_on_standard_output
from forcetorque.errors import ForceTorqueError
from forcetorque.exchange.load_format import LoadFormat
from forcetorque.output_file import declare_outputs

if TYPE_CHECKING:
    import logging

    from forcetorque.exchange.load import RobotLoad

LoadFormatOption = Annotated[
    LoadFormat | None, typer.Option("--to", help="Form of the file for a robot: its program, by name.")
]
LoadFileOption = Annotated[
    Path | None, typer.Option("--output", "-o", help="File for a robot, in the form of --to; - for standard output.")
]
WorldFrameOption = Annotated[
    str | None, typer.Option("--world-frame", help="Frame of tf whose z axis points up, for gravity-filter.")
]
SensorPoseOption = Annotated[
    tuple[float, float, float, float, float, float] | None,
    typer.Option(
        "--sensor-pose",
        help="Pose x y z (m) roll pitch yaw (rad) of the sensor in its parent body, as in a URDF, for mc-rtc.",
    ),
]


def refuse_load_file(output: Path | None, to: LoadFormat | None, output_format: Format, *, force: bool) -> None:
    """Say what is wrong with the file before anything is estimated.

    Args:
        output: File to write; None for none.
        to: Its form.
        output_format: Form of the result.
        force: As of `declare_outputs`.

    Raises:
        ForceTorqueError: If one of file and form is missing, or the file cannot be written.
    """
    if (output is None) != (to is None):
        raise ForceTorqueError(
            f"expected both --to, out of {', '.join(LoadFormat)}, and --output, the file, or neither of them"
        )
    if output is not None:
        refuse_two_on_standard_output(output, output_format)
        declare_outputs(output, force=force)


def write_load(
    load: RobotLoad,
    output: Path,
    to: LoadFormat,
    *,
    world_frame: str | None,
    sensor_pose: tuple[float, ...] | None,
    log: logging.Logger,
) -> None:
    """Write the file and say what its program does.

    Args:
        load: The load.
        output: File to write.
        to: Its form.
        world_frame: As of the option.
        sensor_pose: As of the option.
        log: Where that goes.
    """
    from forcetorque.analysis import export_load
    from forcetorque.spatial import make_pose, rotation_from_rpy

    pose = None if sensor_pose is None else make_pose(rotation_from_rpy(sensor_pose[3:]), sensor_pose[:3])
    convention = export_load(load, output, to, world_frame=world_frame, body_H_sensor=pose)
    log.info("%s, for readings of %s: %s", output, load.direction, convention)

# SPDX-License-Identifier: BSD-3-Clause
"""One way to every form of file: the list of them all."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from forcetorque.base.arrays import FloatArray
from forcetorque.base.files import write_bytes_atomically
from forcetorque.payload.robot_files.force_torque_tools import force_torque_tools_text
from forcetorque.payload.robot_files.formats import LoadFormat
from forcetorque.payload.robot_files.ft_tools import ft_tools_text
from forcetorque.payload.robot_files.hrpsys import hrpsys_text
from forcetorque.payload.robot_files.mc_rtc import mc_rtc_text
from forcetorque.payload.robot_files.robot_load import RobotLoad
from forcetorque.payload.robot_files.ros2_control import broadcaster_text, gravity_filter_text

_WITHOUT_COMMENTS = (LoadFormat.MC_RTC, LoadFormat.HRPSYS)


def write_load_file(
    path: Path | str,
    load: RobotLoad,
    form: LoadFormat,
    *,
    world_frame: str | None = None,
    body_H_sensor: FloatArray | None = None,
) -> None:
    """Write a load for a robot; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder; `-` is standard output.
        load: The load.
        form: Form of the file.
        world_frame: For `gravity-filter`, the frame of tf whose z axis points up.
        body_H_sensor: For `mc-rtc`, pose of the sensor in its parent body; shape (4, 4); m.
    """
    texts: dict[LoadFormat, Callable[[], str]] = {
        LoadFormat.ROS2_BROADCASTER: lambda: broadcaster_text(load),
        LoadFormat.GRAVITY_FILTER: lambda: gravity_filter_text(load, world_frame=world_frame),
        LoadFormat.FT_TOOLS: lambda: ft_tools_text(load),
        LoadFormat.FORCE_TORQUE_TOOLS: lambda: force_torque_tools_text(load),
        LoadFormat.MC_RTC: lambda: mc_rtc_text(load, body_H_sensor=body_H_sensor),
        LoadFormat.HRPSYS: lambda: hrpsys_text(load),
    }
    mark = "" if form in _WITHOUT_COMMENTS else f"# forcetorque {form}\n"
    write_bytes_atomically(Path(path), (mark + texts[form]()).encode())

# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque export`: from calibration files to the files that robots and other programs read."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.errors import ForceTorqueError, known_names
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.calibration.export.export import Export
    from forcetorque.experiment.calibration.calibration_file import Calibration


@command(
    None,
    Saved(flags=("--output", "-o"), help="File to write; - for standard output.", required=True, standard_output=True),
)
def export_calibrations(
    calibration: Annotated[
        "Calibration | Mapping[str, Calibration]",
        Option(
            "Calibration files or folders of them; one calibration for icub-matrix, numpy.",
            typed=list[Path],
            reads="forcetorque.results.terminal.command_inputs:read_calibrations",
        ),
    ],
    to: Annotated[
        "ExportFormat | str",
        Option(
            "Matrix file for the sensor's DSP, XML groups for wholebodydynamics, a plain table, the "
            "coefficients of temperature and other variables by themselves, parameters of a ROS 2 node (YAML), or an "
            "archive of NumPy.",
            "--to",
            typed=ExportFormat,
        ),
    ],
    *,
    full_scale: Annotated[
        tuple[int, int, int, int, int, int] | None,
        Option("Six full scales for icub-matrix; N, N m. Default: chosen to hold the matrix."),
    ] = None,
    sensor_name: Annotated[
        str | None, Option("Name of the sensor in the robot's configuration, for wholebodydynamics and ros2.")
    ] = None,
    frame_ids: Annotated[
        Sequence[str],
        Option("Frame of tf that the sensor reads in, for ros2, of each calibration in their order.", "--frame-id"),
    ] = (),
    stream: Annotated[
        "Calibration | None",
        Option(
            "Calibration that the stream is already made with. Default: the prior matrix alone.",
            typed=Path,
            reads="forcetorque.experiment.calibration.calibration_file:read_calibration",
        ),
    ] = None,
    progress: Annotated["Progress", Option("Called with a line on every offset in the file.")] = lambda _: None,
) -> "Export":
    """Write calibrations as files that a robot or another program reads.

    Example: forcetorque export leg.json --to wholebodydynamics -o leg.xml

    Python: `calibration.export_calibrations(calibration, "icub-matrix").save("matrix.txt")`

    Returns:
        What the file holds, to be saved.

    Raises:
        ForceTorqueError: If the form has no place for an option or for several calibrations.
        ExperimentError: If a matrix is not per count, or there is not one frame for each calibration.
        FormatError: If the form has no place for a calibration, or a full scale cannot hold its row.
    """
    from forcetorque.calibration.export.export import exported
    from forcetorque.experiment.calibrations_under_test import named

    if to not in tuple(ExportFormat):
        raise ForceTorqueError(f"no form of files is called {to!r}; {known_names(str(to), ExportFormat)}")
    form, calibrations = ExportFormat(to), named(calibration)
    _require_consistent(
        len(calibrations), to=form, full_scale=full_scale, sensor_name=sensor_name, stream=stream, frame_ids=frame_ids
    )
    result = exported(
        calibrations, form, full_scale=full_scale, sensor_name=sensor_name, frame_ids=frame_ids, stream=stream
    )
    for entry in result.calibrations:
        if entry.offset_stored:
            progress(f"{entry.calibration}: offset {entry.offset_text}: {result.offset_handling}")
    return result


export = export_calibrations
"""The command."""


def _require_consistent(
    count: int,
    *,
    to: ExportFormat,
    full_scale: Sequence[int] | None,
    sensor_name: str | None,
    stream: "Calibration | None",
    frame_ids: Sequence[str],
) -> None:
    if frame_ids and to is not ExportFormat.ROS2:
        raise ForceTorqueError(f"--frame-id: only files of --to {ExportFormat.ROS2} hold frames of tf, not {to}")
    if to in (ExportFormat.ICUB_MATRIX, ExportFormat.NUMPY) and count != 1:
        raise ForceTorqueError(f"--to {to}: a file holds one matrix, got {count} calibrations; export each by itself")
    if full_scale is not None and to is not ExportFormat.ICUB_MATRIX:
        raise ForceTorqueError(
            f"--full-scale: only files of --to {ExportFormat.ICUB_MATRIX} hold full scales, not {to}"
        )
    for_one = "--stream" if stream is not None else None if sensor_name is None else "--sensor-name"
    named = to is ExportFormat.ROS2 and stream is None
    if for_one is not None and not ((named or to is ExportFormat.WHOLEBODYDYNAMICS) and count == 1):
        raise ForceTorqueError(
            f"{for_one}: expected --to {ExportFormat.WHOLEBODYDYNAMICS} and one calibration, got --to {to} and {count}"
        )

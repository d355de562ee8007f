# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque export`: from calibration files to the files that robots and other programs read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.results.terminal.options import DetailsOption, ForceOption, FormatOption
from forcetorque.results.terminal.output import (
    Format,
    refuse_two_on_standard_output,
    show,
    show_warnings,
    start_logging,
)

if TYPE_CHECKING:
    from forcetorque.calibration.export.export import Export


def export(
    calibration: Annotated[
        list[Path], typer.Argument(help="Calibration files or folders of them; one calibration for icub-matrix, numpy.")
    ],
    to: Annotated[
        ExportFormat,
        typer.Option(
            "--to",
            help="Matrix file for the sensor's DSP, XML groups for wholebodydynamics, a plain table, the "
            "coefficients of temperature and other variables by themselves, parameters of a ROS 2 node (YAML), or an "
            "archive of NumPy.",
        ),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="File to write; - for standard output.")],
    full_scale: Annotated[
        tuple[int, int, int, int, int, int] | None,
        typer.Option(
            "--full-scale", help="Six full scales for icub-matrix; N, N m. Default: chosen to hold the matrix."
        ),
    ] = None,
    sensor_name: Annotated[
        str | None,
        typer.Option(
            "--sensor-name", help="Name of the sensor in the robot's configuration, for wholebodydynamics and ros2."
        ),
    ] = None,
    frame_id: Annotated[
        list[str] | None,
        typer.Option("--frame-id", help="Frame of tf that the sensor reads in, for ros2; once for each calibration."),
    ] = None,
    stream: Annotated[
        Path | None,
        typer.Option(
            "--stream", help="Calibration that the stream is already made with. Default: the prior matrix alone."
        ),
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write calibrations as files that a robot or another program reads.

    Example: forcetorque export leg.json --to wholebodydynamics -o leg.xml

    Python: `calibration.export_icub_matrix("arm", calibration, "matrix.txt")`,
    `calibration.export_wholebodydynamics({"arm": calibration}, "arm.xml")`, `calibration.export_table`,
    `calibration.export_coefficients`, `calibration.export_ros2_parameters({"arm": calibration}, "arm.yaml",
    frame_ids=["tool0"])`, `calibration.export_numpy("arm", calibration, "arm.npz")`
    """
    from forcetorque.calibration.export.export import (
        export_coefficients,
        export_icub_matrix,
        export_numpy,
        export_ros2_parameters,
        export_table,
        export_wholebodydynamics,
    )
    from forcetorque.experiment.calibration.artefact import read_calibration
    from forcetorque.results.terminal.reading import read_calibrations

    log = start_logging()
    refuse_two_on_standard_output(output, output_format)
    declare_outputs(output, force=force)
    calibrations = read_calibrations(calibration)
    _require_consistent(
        len(calibrations), to=to, full_scale=full_scale, sensor_name=sensor_name, stream=stream, frame_id=frame_id
    )
    made_with = None if stream is None else read_calibration(stream)
    writers: dict[ExportFormat, Callable[[], Export]] = {
        ExportFormat.ICUB_MATRIX: lambda: export_icub_matrix(
            *next(iter(calibrations.items())), output, full_scale=full_scale
        ),
        ExportFormat.WHOLEBODYDYNAMICS: lambda: export_wholebodydynamics(
            calibrations, output, sensor_name=sensor_name, stream=made_with
        ),
        ExportFormat.CSV: lambda: export_table(calibrations, output),
        ExportFormat.COEFFICIENTS: lambda: export_coefficients(calibrations, output),
        ExportFormat.ROS2: lambda: export_ros2_parameters(
            calibrations, output, frame_ids=frame_id or (), sensor_name=sensor_name
        ),
        ExportFormat.NUMPY: lambda: export_numpy(*next(iter(calibrations.items())), output),
    }
    written = writers[to]()
    for entry in written.calibrations:
        if entry.offset_stored:
            log.info("%s: offset %s: %s", entry.calibration, entry.offset_text, written.offset_handling)
    if output == STANDARD_OUTPUT:  # the file itself went there
        show_warnings(written)
    else:
        show(written, output_format, details=details)


def _require_consistent(
    count: int,
    *,
    to: ExportFormat,
    full_scale: Sequence[int] | None,
    sensor_name: str | None,
    stream: Path | None,
    frame_id: Sequence[str] | None,
) -> None:
    if frame_id and to is not ExportFormat.ROS2:
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

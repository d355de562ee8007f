# SPDX-License-Identifier: BSD-3-Clause
"""Serial numbers and prior matrices of drafted sensors: by the names of matrix files, else questions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.output_file import relative_path
from forcetorque.formats.icub_wrench_steps import full_scales_of_steps, is_in_steps
from forcetorque.formats.prior.prior_file import RawUnit
from forcetorque.formats.prior.registry import holds_prior, read_prior_file
from forcetorque.inspection.draft.sensors_and_supports import DraftedSensor, is_called
from forcetorque.inspection.draft.toml_lines import line, listed, question, remark
from forcetorque.recording.stream import Stream

_SCALES = "of fx fy fz in N and tx ty tz in N m, of its data sheet, as [300, 300, 300, 30, 30, 30]"
_MOST_FILES = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixFile:
    """The calibration that a sensor came with."""

    path: Path
    """The file."""
    serial: str | None
    """Serial number of the sensor; None where the file has none."""
    board_scale: FloatArray | None = None
    """Full scales in whose steps a board sends wrenches; shape (6,); N, N m; None where it sends none."""

    @classmethod
    def of(cls, path: Path) -> MatrixFile:
        """Look at a file, of which another form may need more to be read.

        Returns:
            What it says of the sensor.
        """
        try:
            file = read_prior_file(path)
        except FormatError:
            return cls(path=path, serial=None)
        scale = file.full_scale if file.raw_unit is RawUnit.COUNTS else None
        return cls(path=path, serial=file.serial, board_scale=scale)


def matrix_files(folder: Path) -> tuple[MatrixFile, ...]:
    """Find the calibrations of a folder.

    Args:
        folder: The folder; folders in it are not looked at.

    Returns:
        The files, by name.

    Raises:
        MissingFileError: If there is no such folder.
        FormatError: If no file in it is a calibration.
    """
    if not folder.is_dir():
        raise MissingFileError(f"--matrices {folder}: expected a folder with matrix files, there is none")
    files = [path for path in sorted(folder.iterdir()) if path.is_file() and holds_prior(path)]
    if not files:
        raise FormatError(
            f"--matrices {folder}: expected a folder with matrix files, got one without any; `forcetorque inspect "
            "FILE` says what a file is"
        )
    return tuple(MatrixFile.of(path) for path in files)


def matrix_that_sent(logged: Stream | None, files: Sequence[MatrixFile]) -> MatrixFile | None:
    """Find the matrix by which a board made the wrenches of a stream.

    Args:
        logged: The stream; None where it cannot be read yet.
        files: Calibrations.

    Returns:
        The only one in whose steps the wrenches are; None else.
    """
    if logged is None or "wrench" not in logged.signals:
        return None
    wrench = logged.signal("wrench").values
    sent = [one for one in files if one.board_scale is not None and is_in_steps(wrench, one.board_scale)]
    return sent[0] if len(sent) == 1 and full_scales_of_steps(wrench) is not None else None


def matrix_of(
    sensor: DraftedSensor, sensors: Sequence[DraftedSensor], files: Sequence[MatrixFile]
) -> MatrixFile | None:
    """Find the calibration of a sensor.

    Args:
        sensor: The sensor.
        sensors: All sensors.
        files: Calibrations.

    Returns:
        The only one that is called like the sensor, or the only one for the only sensor; None else.
    """
    named = [file for file in files if is_called(file.path.stem, sensor.name)]
    if len(sensors) == len(files) == 1:
        return files[0]
    return named[0] if len(named) == 1 and not sensor.tags else None


def prior_lines(
    sensor: DraftedSensor,
    sensors: Sequence[DraftedSensor],
    files: Sequence[MatrixFile],
    folder: Path,
    *,
    sent: MatrixFile | None = None,
    on_robot: bool = True,
) -> list[str]:
    """Write serial number, prior and full scale of a `[[sensor]]`.

    Args:
        sensor: The sensor.
        sensors: All sensors.
        files: Calibrations that the user named; none if empty.
        folder: Folder of the experiment file, from which paths count.
        sent: As of `matrix_that_sent`.
        on_robot: Whether there is a robot; the load of a wrist sensor by itself is estimated without full scale.

    Returns:
        Its lines; full scale is a question where a calibration of a single sensor needs it.
    """
    serial = question("serial", "its serial number, or another mark that tells it from others")
    if (matrix := sent or matrix_of(sensor, sensors, files)) is not None:
        if matrix.serial is not None:
            serial = line("serial", matrix.serial, "of its matrix file")
        words = "" if sent is None else "the log is in steps of its full scales, and of those of no other file"
        return [serial, line("prior", relative_path(matrix.path, folder), words)]
    if files:
        names = listed([file.path.name for file in files], _MOST_FILES)
        place = relative_path(files[0].path.parent, folder)
        return [question("prior", f'file of its own matrix, "{place}/" and the name: {names}'), serial]
    if sensor.components:
        words = "where the columns are newtons already; else the matrix file, whose other rows are zeros"
        scales = "largest fx, fy, fz, tx, ty, tz to come, as [500, 500, 1000, 20, 20, 10]: loads that are not measured "
        scales += "disturb it too; N, N m"
        return [serial, line("prior", "identity", words), question("full_scale", scales)]
    if sensor.is_raw:
        words = "file of the maker's calibration: a matrix file of iCub, .dat, .cal, or a table"
        return [serial, question("prior", words)]
    words = "the reading itself takes the place of counts; the file of the matrix that made it is better"
    lines = [serial, line("prior", "identity", words)]
    if len(sensors) == 1 and on_robot:
        return [*lines, question("full_scale", _SCALES)]
    without = "left out: no load is too large" if on_robot else "`payload` needs none, `calibrate` does"
    return [*lines, f"# full_scale = [300, 300, 300, 30, 30, 30]  {remark(f'{_SCALES}; {without}')}"]


def accuracy_lines(sensors: Sequence[DraftedSensor], files: Sequence[MatrixFile]) -> list[str]:
    """Write the accuracy of what several sensors are fitted to, in place of a full scale of each.

    Args:
        sensors: Sensors.
        files: Calibrations that the user named.

    Returns:
        The lines; none where a sensor is alone, or matrices give the sizes of readings.
    """
    if len(sensors) == 1 or files or all(sensor.is_raw for sensor in sensors):
        return []
    words = (
        "of the expected wrench of every sensor without full_scale: a thousandth of full scale, as { force_N = 0.3, "
        "moment_Nm = 0.03 } for 300 N and 30 N m"
    )
    return ["", "[calibration]", question("accuracy", words)]

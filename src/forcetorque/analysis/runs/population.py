# SPDX-License-Identifier: BSD-3-Clause
"""Matrices of other sensors, from matrix files and calibration files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from forcetorque.arrays import FloatArray
from forcetorque.calibration import read_calibration
from forcetorque.errors import FormatError, MissingFileError
from forcetorque.exchange.icub import read_matrix_file, serial_number_in_name


def read_population(paths: Iterable[Path]) -> dict[str, FloatArray]:
    """Read the matrices of a population of sensors.

    Args:
        paths: Calibration files (.json), matrix files named after the serial number, such as `matrix_SN026.txt`, and
            folders, in which every .json is a calibration and every text file of such a name, SN and digits, a matrix.

    Returns:
        Matrices by serial number.

    Raises:
        MissingFileError: If there is no such file or folder, or nothing in the folder.
        FormatError: If a matrix file does not tell whose it is, or two files are of one sensor.
    """
    matrices: dict[str, FloatArray] = {}
    source: dict[str, Path] = {}
    for path in paths:
        for file in _files(path):
            serial, matrix = _read(file)
            if serial in matrices:
                raise FormatError(
                    f"{file}: expected one matrix per sensor, {source[serial]} is of {serial!r} too; give one of them"
                )
            matrices[serial], source[serial] = matrix, file
    return matrices


def _files(path: Path) -> list[Path]:
    if not path.is_dir():
        if not path.is_file():
            raise MissingFileError(f"{path}: expected a matrix file, a calibration or a folder of them, there is none")
        return [path]
    files = sorted(
        file for file in path.iterdir() if file.suffix == ".json" or serial_number_in_name(file.name) is not None
    )
    if not files:
        raise MissingFileError(f"{path}: expected matrix files such as matrix_SN026.txt or calibrations, there is none")
    return files


def _read(file: Path) -> tuple[str, FloatArray]:
    if file.suffix == ".json":
        calibration = read_calibration(file)
        return calibration.sensor.serial, calibration.matrix
    serial = file.stem.removeprefix("matrix_")
    if file.suffix != ".txt" or serial in ("", file.stem):
        # without a serial number nobody could tell the judged sensor from the others
        raise FormatError(f"{file}: expected a calibration (.json), or a name with the serial number, matrix_SN026.txt")
    return serial, read_matrix_file(file).matrix

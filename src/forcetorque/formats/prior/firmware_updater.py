# SPDX-License-Identifier: BSD-3-Clause
"""Files `calibrationDataSN0000.dat` that FirmwareUpdater saves of a board: version 2 (strain) and 3 (strain2).

The matrix is that of a matrix file: codes in Q1.15 of full scale, so counts become N and N m by the same arithmetic.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import FormatError, ShapeError, quoted
from forcetorque.formats.icub_matrix import MatrixFile
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit

_VERSION = "File version:"
_SERIAL = "Serial number:"
_BOARD = "Board type:"
_REGISTERS = "Amplifier registers:"
_OFFSETS = "Offsets:"
_MATRIX = "Calibration matrix:"
_GAIN = "Matrix gain:"
_TARE = "Tare:"
_FULL_SCALE = "Full scale values:"
_CODES = 36
_HEX = re.compile("(?:ffff)?[0-9a-fA-F]{1,4}")
_WHOLE = re.compile("-?[0-9]{1,9}")
_LINE = re.compile("0x[0-9a-f]{2}(?: 0x[0-9a-f]{2}){5}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FirmwareFile:
    """What FirmwareUpdater saves of a board."""

    serial: str
    """Serial number."""
    matrix: MatrixFile
    """Codes, gain and full scale."""
    tare: tuple[int, ...]
    """What the board adds to the six values; as the board has it."""
    registers: tuple[str, ...] | None = None
    """Of a strain2 the registers of the amplifier of each channel, as six bytes in hex; None for a strain."""
    offsets: tuple[int, ...] | None = None
    """Of a strain the offsets of its converters; None for a strain2."""

    def __post_init__(self) -> None:
        if (self.registers is None) == (self.offsets is None):
            raise FormatError("expected registers of a strain2 or offsets of a strain, and not both")
        for name, values in (("tare", self.tare), ("offsets", self.offsets), ("registers", self.registers)):
            if values is not None and len(values) != 6:
                raise ShapeError(f"{name}: expected six values, got {len(values)}")


class FirmwareUpdaterData:
    """Text that begins with the version of the file."""

    sign = "a .dat of FirmwareUpdater (File version:)"

    def recognises(self, path: Path, text: str) -> bool:
        """Look at the first line."""
        return text.lstrip("\ufeff").startswith(_VERSION)

    def read(self, path: Path, text: str) -> PriorFile:
        """Read it."""
        file = parsed_firmware(path, text)
        board = "strain" if file.registers is None else "strain2"
        tare = () if not any(file.tare) else (f"the board adds a tare of {', '.join(map(str, file.tare))}",)
        return PriorFile(
            form=f"FirmwareUpdater file of a {board}",
            matrix=file.matrix.matrix,
            raw_unit=RawUnit.COUNTS,
            full_scale=np.array(file.matrix.full_scale, dtype=np.float64),
            serial=file.serial,
            notes=tare,
        )


class _Lines:
    """Lines of the file, taken one by one."""

    def __init__(self, path: Path, text: str) -> None:
        self.path = path
        self.lines = [line.rstrip("\r").rstrip() for line in text.lstrip("\ufeff").split("\n")]
        while self.lines and not self.lines[-1]:
            self.lines.pop()
        self.next = 0

    def take(self, pattern: re.Pattern[str], what: str) -> str:
        text = self.lines[self.next] if self.next < len(self.lines) else "the end of the file"
        self.next += 1
        if not pattern.fullmatch(text):
            raise FormatError(f"{self.path}:{self.next}: expected {what}, got {quoted(text)}")
        return text

    def label(self, label: str) -> None:
        self.take(re.compile(re.escape(label)), repr(label))

    def whole(self, what: str) -> tuple[int, ...]:
        return tuple(int(self.take(_WHOLE, what)) for _ in range(6))


def parsed_firmware(path: Path, text: str) -> FirmwareFile:
    """Read the text of a file of FirmwareUpdater.

    Args:
        path: File such as `calibrationDataSN0000.dat`, for messages.
        text: What it holds.

    Returns:
        Its content.

    Raises:
        FormatError: If it does not have the form, with the line.
    """
    lines = _Lines(path, text)
    lines.label(_VERSION)
    version = lines.take(re.compile("[23]"), "version 2 or 3")
    if version == "3":
        lines.label(_BOARD)
        lines.take(re.compile("strain2"), "the board strain2")
    lines.label(_SERIAL)
    serial = lines.take(re.compile(r"[!-~][ -~]{0,31}"), "a serial number of at most 32 characters")
    registers = offsets = None
    if version == "3":
        lines.label(_REGISTERS)
        registers = tuple(lines.take(_LINE, "six bytes such as 0x00 0x80 0x02 0x64 0x29 0x62") for _ in range(6))
    else:
        lines.label(_OFFSETS)
        offsets = lines.whole("the offset of a channel")
    lines.label(_MATRIX)
    codes = _codes([lines.take(_HEX, "a coefficient of one to four hex digits") for _ in range(_CODES)])
    lines.label(_GAIN)
    gain = int(lines.take(_WHOLE, "the matrix gain"))
    lines.label(_TARE)
    tare = lines.whole("the tare of a component")
    lines.label(_FULL_SCALE)
    full_scale = lines.whole("a full scale in N or N m")
    if lines.next < len(lines.lines):
        raise FormatError(f"{path}:{lines.next + 1}: expected the end of the file, got more; remove it")
    try:
        matrix = MatrixFile(codes=codes, full_scale=full_scale, gain=gain)
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from error
    return FirmwareFile(serial=serial, matrix=matrix, tare=tare, registers=registers, offsets=offsets)


def _codes(texts: list[str]) -> IntArray:
    unsigned = np.array([int(text, 16) & 0xFFFF for text in texts], dtype=np.int64)
    return np.where(unsigned >= 0x8000, unsigned - 0x10000, unsigned).reshape(6, 6)

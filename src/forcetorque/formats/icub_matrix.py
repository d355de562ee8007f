# SPDX-License-Identifier: BSD-3-Clause
"""Calibration matrix files `matrix_SNxxx.txt` of iCub: fixed-point coefficients, a gain and full scales."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, read_only, require_shape
from forcetorque.base.errors import FormatError, MissingFileError, ShapeError, quoted
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.run_files import declare_input
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS

Q15_ONE = 1 << 15
"""Code that would mean 1 in Q1.15; codes run from -Q15_ONE to Q15_ONE - 1."""
FULL_SCALE_COUNTS = 32767
"""Raw counts that stand for the full scale of a component."""
LARGEST_FULL_SCALE = 0xFFFF
"""The sensor receives a full scale as two bytes (icub-main, canLoaderLib/downloader.cpp)."""

_COEFFICIENTS = 36
_LINES = _COEFFICIENTS + 1 + 6
_HEX = re.compile("[0-9A-F]{1,4}|[0-9a-f]{1,4}")
_FULL_SCALE = re.compile("[1-9][0-9]{0,4}")
_FACTORY_NAME = re.compile(r"matrix_(SN[0-9]+)\.txt")
_FULL_SCALE_RULE = f"an integer from 1 to {LARGEST_FULL_SCALE}"


@dataclass(frozen=True, slots=True, kw_only=True)
class MatrixLayout:
    """How the numbers of a matrix file are typed; the default is that of the factory's files."""

    newline: str = "\r\n"
    """End of every line, CRLF or LF."""
    widths: tuple[int, ...] = (1,) * _COEFFICIENTS
    """Least number of hex digits of each coefficient, row-major; shorter ones are padded with zeros."""
    lower_case: tuple[bool, ...] = (False,) * _COEFFICIENTS
    """Whether the hex digits of each coefficient are lower-case, row-major."""
    final_newlines: int = 1
    """Newlines after the last number: 0 for an unfinished line, 2 for an empty line at the end."""

    def __post_init__(self) -> None:
        if self.newline not in ("\r\n", "\n"):
            raise FormatError(f"newline: expected CRLF or LF, got {self.newline!r}")
        if len(self.widths) != _COEFFICIENTS or not all(1 <= width <= 4 for width in self.widths):
            raise FormatError(f"widths: expected {_COEFFICIENTS} numbers from 1 to 4, got {self.widths}")
        if len(self.lower_case) != _COEFFICIENTS:
            raise FormatError(f"lower_case: expected {_COEFFICIENTS} entries, got {len(self.lower_case)}")
        if self.final_newlines < 0:
            raise FormatError(f"final_newlines: expected 0 or more, got {self.final_newlines}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixFile:
    """What a matrix file holds: the coefficients as the sensor's DSP uses them, and their layout.

    The DSP multiplies raw counts by codes in Q1.15: a wrench component in parts of its full scale
    is the sum of `code / 2^15` times `raw / 32767`.
    """

    codes: IntArray
    """Coefficients in Q1.15, signed, -32768 to 32767; rows fx to tz, columns raw channels; shape (6, 6)."""
    full_scale: tuple[int, ...]
    """Full scale of fx, fy, fz, tx, ty, tz; N, N m."""
    gain: int = 1
    """Matrix gain; only 1 is known, so only 1 is accepted."""
    layout: MatrixLayout = field(default_factory=MatrixLayout)
    """How the file is typed."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "codes", _checked_codes(self.codes))
        object.__setattr__(self, "full_scale", checked_full_scale(self.full_scale))
        if self.gain != 1:
            raise FormatError(f"gain: {_wrong_gain(repr(self.gain))}")

    @property
    def matrix(self) -> FloatArray:
        """Calibration matrix, `C = diag(full_scale) codes / 2^15 / 32767`; shape (6, 6); N/count, N m/count."""
        scale = np.array(self.full_scale, dtype=np.float64)[:, np.newaxis]
        return scale * (self.codes / Q15_ONE) / FULL_SCALE_COUNTS


def checked_full_scale(values: Sequence[int]) -> tuple[int, ...]:
    """Check six full scales.

    Args:
        values: Full scales of fx, fy, fz, tx, ty, tz; N, N m.

    Returns:
        The same as a tuple of integers.

    Raises:
        ShapeError: If there are not six.
        FormatError: If one is not an integer that the sensor can hold.
    """
    if len(values) != 6:
        raise ShapeError(f"full_scale: expected 6 integers (fx, fy, fz, tx, ty, tz), got {len(values)}")
    try:
        scales = tuple(operator.index(value) for value in values)
    except TypeError as error:
        raise FormatError(f"full_scale: expected integers, got {values!r}; round them up") from error
    for row, scale in enumerate(scales):
        if not 1 <= scale <= LARGEST_FULL_SCALE:
            raise FormatError(f"full_scale[{row}]: expected {_FULL_SCALE_RULE}, got {scale}")
    return scales


def read_matrix_file(path: Path | str) -> MatrixFile:
    """Read a calibration matrix file.

    The format has no checksum: a file that is cut within its last number reads as a smaller full scale.

    Args:
        path: File such as `matrix_SN026.txt`.

    Returns:
        Its content; `write_matrix_file` gives the same bytes again.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If the file does not have the form, with the line.
    """
    path = Path(path)
    if not path.is_file():
        raise MissingFileError(f"{path}: expected a calibration matrix file, got no file; check the path")
    declare_input(path)
    return _parsed(path.read_bytes(), where=str(path))


def write_matrix_file(path: Path | str, file: MatrixFile) -> None:
    """Write a calibration matrix file; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder.
        file: Its content.
    """
    layout = file.layout
    lines = [
        _hex_text(code, width=width, lower_case=lower_case)
        for code, width, lower_case in zip(file.codes.ravel().tolist(), layout.widths, layout.lower_case, strict=True)
    ]
    lines += [str(number) for number in (file.gain, *file.full_scale)]
    text = layout.newline.join(lines) + layout.newline * layout.final_newlines
    write_bytes_atomically(Path(path), text.encode("ascii"))


def serial_number_in_name(path: Path | str) -> str | None:
    """Find the serial number of the sensor in the name of a factory file.

    Args:
        path: File; only its name is looked at.

    Returns:
        "SN026" for `matrix_SN026.txt`, None for any other kind of name.
    """
    match = _FACTORY_NAME.fullmatch(Path(path).name)
    return match[1] if match else None


def _checked_codes(values: Any) -> IntArray:
    codes = np.array(values, order="C")
    require_shape(codes, name="codes", shape=(6, 6))
    if codes.dtype.kind not in "iu":
        raise ShapeError(f"codes: expected integers, got {codes.dtype}; use encode_matrix for coefficients")
    if codes.min() < -Q15_ONE or codes.max() >= Q15_ONE:
        raise FormatError(
            f"codes: expected signed numbers from {-Q15_ONE} to {Q15_ONE - 1}, got {codes.min()} to {codes.max()}"
        )
    codes = codes.astype(np.int64)
    codes.setflags(write=False)
    return codes


def _wrong_gain(got: str) -> str:
    return f"expected the matrix gain 1, got {got}; what another gain means is not documented, so it is not decoded"


def _hex_text(code: int, *, width: int, lower_case: bool) -> str:
    text = f"{code & 0xFFFF:0{width}X}"
    return text.lower() if lower_case else text


def _signed(text: str) -> int:
    unsigned = int(text, base=16)
    return unsigned - 2 * Q15_ONE if unsigned >= Q15_ONE else unsigned


def _parsed(data: bytes, *, where: str) -> MatrixFile:
    lines, newline = _split_lines(data, where=where)
    numbers = list(lines)
    while numbers and not numbers[-1]:
        numbers.pop()
    hex_texts = numbers[:_COEFFICIENTS]
    for line, text in enumerate(hex_texts, start=1):
        if not _HEX.fullmatch(text):
            raise FormatError(
                f"{where}:{line}: expected 1 to 4 hex digits, all upper-case or all lower-case, got {quoted(text)}; "
                f"the first {_COEFFICIENTS} lines are 16-bit coefficients"
            )
    _require_line_count(numbers, where=where)
    if numbers[_COEFFICIENTS] != "1":
        raise FormatError(f"{where}:{_COEFFICIENTS + 1}: {_wrong_gain(quoted(numbers[_COEFFICIENTS]))}")
    return MatrixFile(
        codes=np.array([_signed(text) for text in hex_texts], dtype=np.int64).reshape(6, 6),
        full_scale=_parsed_full_scale(numbers, where=where),
        layout=MatrixLayout(
            newline=newline,
            widths=tuple(len(text) for text in hex_texts),
            lower_case=tuple(text != text.upper() for text in hex_texts),
            final_newlines=len(lines) - len(numbers),
        ),
    )


def _split_lines(data: bytes, *, where: str) -> tuple[list[str], str]:
    try:
        lines = data.decode("ascii").split("\n")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise FormatError(
            f"{where}:{line}: expected ASCII text, got the byte 0x{data[error.start]:02X}; save the file as plain text"
        ) from error
    has_crlf = lines[0].endswith("\r")
    for line, text in enumerate(lines[:-1], start=1):
        if text.endswith("\r") is not has_crlf:
            expected, got = ("CRLF", "LF") if has_crlf else ("LF", "CRLF")
            raise FormatError(
                f"{where}:{line}: expected the line to end in {expected} as line 1 does, got {got}; "
                f"convert the file to one kind of line end"
            )
    if not has_crlf:
        return lines, "\n"
    return [*(text[:-1] for text in lines[:-1]), lines[-1]], "\r\n"


def _require_line_count(numbers: list[str], *, where: str) -> None:
    if len(numbers) < _LINES:
        raise FormatError(
            f"{where}:{max(len(numbers), 1)}: expected {_LINES} lines ({_COEFFICIENTS} coefficients, gain, "
            f"6 full scales), got {len(numbers)}; get a complete copy of the file"
        )
    if len(numbers) > _LINES:
        raise FormatError(
            f"{where}:{_LINES + 1}: expected the end of the file after {_LINES} lines, "
            f"got {quoted(numbers[_LINES])}; remove what follows the six full scales"
        )


def _parsed_full_scale(numbers: list[str], *, where: str) -> tuple[int, ...]:
    first = _COEFFICIENTS + 1
    for line, text in enumerate(numbers[first:], start=first + 1):
        if not _FULL_SCALE.fullmatch(text) or int(text) > LARGEST_FULL_SCALE:
            raise FormatError(
                f"{where}:{line}: expected a full scale, {_FULL_SCALE_RULE} in decimal, got {quoted(text)}; "
                f"the last 6 lines are the full scales of fx, fy, fz, tx, ty, tz in N and N m"
            )
    return tuple(int(text) for text in numbers[first:])


def encode_matrix(matrix: Any, *, full_scale: Sequence[int] | None = None) -> MatrixFile:
    """Encode a calibration matrix for the sensor's DSP, in the layout of the factory's files.

    Each coefficient is encoded against the integer full scale that is stored, so that decoding gives
    it back within half a least significant bit, `full_scale / 32767 / 2^16`.

    Without `full_scale`, row i gets `ceil(32767 * sum_j |C_ij|)`, as the factory's files have it: the
    largest value that raw counts within 32767 can give, so that the DSP's sum stays in range up to the
    rounding of codes. A smaller one may be given if every coefficient fits; large wrenches can then saturate.

    Args:
        matrix: Calibration matrix, rows fx to tz, columns raw channels; shape (6, 6); N/count, N m/count.
        full_scale: Full scales to use for fx, fy, fz, tx, ty, tz instead; N, N m.

    Returns:
        The content of the matrix file.

    Raises:
        FormatError: If the matrix is not finite, or if a coefficient does not fit the full scale.
    """
    values = read_only(matrix, name="matrix", shape=(6, 6))
    if not np.isfinite(values).all():
        row, column = np.argwhere(~np.isfinite(values))[0]
        raise FormatError(f"matrix[{row}, {column}]: expected a finite coefficient, got {values[row, column]}")
    coefficients = [[Fraction(value) for value in row] for row in values.tolist()]
    if full_scale is None:
        scales = tuple(_natural_full_scale(row, index=index) for index, row in enumerate(coefficients))
    else:
        scales = checked_full_scale(full_scale)
        for index, (row, scale) in enumerate(zip(coefficients, scales, strict=True)):
            _require_fit(row, scale, index=index)
    codes = [[_code(value, scale) for value in row] for row, scale in zip(coefficients, scales, strict=True)]
    return MatrixFile(codes=np.array(codes, dtype=np.int64), full_scale=scales)


def _code(coefficient: Fraction, full_scale: int) -> int:
    return round(coefficient * FULL_SCALE_COUNTS * Q15_ONE / full_scale)


def _natural_full_scale(row: list[Fraction], *, index: int) -> int:
    ceiling = math.ceil(FULL_SCALE_COUNTS * sum(abs(value) for value in row))
    # A row with one positive coefficient can have it at exactly 1 in parts of the full scale, which is
    # code 32768, one beyond what Q1.15 holds: such a row needs a full scale slightly above its ceiling.
    scale = max(1, ceiling, *(_smallest_full_scale(value) for value in row))
    if scale > LARGEST_FULL_SCALE:
        raise FormatError(
            f"matrix row {index} ({WRENCH_COMPONENTS[index]}): expected coefficients whose full scale is at most "
            f"{LARGEST_FULL_SCALE} {WRENCH_UNITS[index]}, got {_listed(row)}; "
            f"check that they are in {WRENCH_UNITS[index]} per raw count"
        )
    return scale


def _smallest_full_scale(coefficient: Fraction) -> int:
    """Smallest integer full scale with which a coefficient rounds to a code of Q1.15."""
    product = abs(coefficient) * FULL_SCALE_COUNTS * Q15_ONE
    if coefficient > 0:
        # Ties round to the even 32768, which does not fit: product / scale must be below 32767.5.
        return math.floor(product / (Q15_ONE - Fraction(1, 2))) + 1
    # Ties round to the even -32768, which fits.
    return max(1, math.ceil(product / (Q15_ONE + Fraction(1, 2))))


def _require_fit(row: list[Fraction], full_scale: int, *, index: int) -> None:
    smallest = [_smallest_full_scale(value) for value in row]
    if max(smallest) <= full_scale:
        return
    column = smallest.index(max(smallest))
    remedy = (
        f"the smallest full scale that holds it is {max(smallest)}"
        if max(smallest) <= LARGEST_FULL_SCALE
        else f"no full scale up to {LARGEST_FULL_SCALE} holds it; check the units"
    )
    raise FormatError(
        f"matrix[{index}, {column}] ({WRENCH_COMPONENTS[index]}): expected a coefficient within [-1, 1) in parts of "
        f"the full scale {full_scale} per {FULL_SCALE_COUNTS} counts, got {float(row[column])!r}; {remedy}"
    )


def _listed(row: list[Fraction]) -> str:
    return ", ".join(f"{float(value):.6g}" for value in row)

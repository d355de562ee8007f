# SPDX-License-Identifier: BSD-3-Clause
"""Parameters, analog channels and markers of a C3D file [1].

The library `c3d` reads header and parameters; the frames, which it reads one by one, are read here in one pass.

References:
    [1] Motion Lab Systems, The C3D file format user guide; https://www.c3d.org.
"""

from __future__ import annotations

import struct
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, needs_extra
from forcetorque.base.input_file import READ_ERRORS, require_file

_BLOCK = 512
"""Bytes of a block, in which a file is counted."""
_MAGIC = 0x50
_PROCESSORS = {84: "<", 85: "<", 86: ">"}
"""Byte order by the code of the processor: Intel, DEC, SGI."""
_DAMAGED = (*READ_ERRORS, AssertionError, struct.error)
"""What the library raises over files that are damaged or contradict themselves."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class C3dFile:
    """What a C3D file holds."""

    path: Path
    """The file."""
    parameters: Mapping[str, Any]
    """Numbers, shape as the file states it, first index fastest, or texts, by `GROUP:NAME`."""
    frame_rate_hz: float
    """Frames of markers per second."""
    samples_per_frame: int
    """Samples of every analog channel in a frame."""
    analog: FloatArray
    """Analog channels with offset and scale applied; shape (n, c); in `analog_units`."""
    analog_labels: tuple[str, ...]
    """Names of the c channels."""
    analog_units: tuple[str, ...]
    """Unit of each as the file states it; empty texts where it states none."""
    markers: FloatArray
    """Positions of p markers, NaN where one was not seen; shape (f, p, 3); in `length_unit`."""
    marker_labels: tuple[str, ...]
    """Names of the p markers."""
    length_unit: str
    """Unit of lengths as POINT:UNITS states it; empty where it states none."""

    @property
    def analog_rate_hz(self) -> float:
        """Samples of an analog channel per second."""
        return self.frame_rate_hz * self.samples_per_frame

    def numbers(self, name: str, *shape: int | None) -> FloatArray | None:
        """Give a parameter of numbers.

        Args:
            name: `GROUP:NAME`.
            shape: Its lengths, None for any; a last length of 1 that the file left out is added.

        Returns:
            The numbers; None where the file does not have the parameter, or has none in it.

        Raises:
            FormatError: If it has another shape, or holds texts or numbers that are not finite.
        """
        values = self.parameters.get(name)
        if values is None or not len(np.atleast_1d(values)):
            return None
        if isinstance(values, tuple):
            raise FormatError(f"{self.path}: {name}: expected numbers, got texts")
        if values.ndim == len(shape) - 1 and shape[-1] in (1, None):
            values = values[..., None]
        same = values.ndim == len(shape) and all(
            wanted in (None, got) for wanted, got in zip(shape, values.shape, strict=True)
        )
        if not same:
            wanted = ", ".join("n" if length is None else str(length) for length in shape)
            raise FormatError(f"{self.path}: {name}: expected shape ({wanted}), got {values.shape}")
        if not np.isfinite(values).all():
            raise FormatError(f"{self.path}: {name}: expected finite numbers, got {values[~np.isfinite(values)][0]}")
        return np.asarray(values, dtype=np.float64)


def is_c3d(path: Path) -> bool:
    """Check the magic byte of the header and the code of the processor.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether it is a C3D file.
    """
    if not path.is_file():
        return False
    with path.open("rb") as file:
        first = file.read(2)
        if len(first) < 2 or first[1] != _MAGIC or first[0] == 0:
            return False
        file.seek(_BLOCK * (first[0] - 1))
        begins = file.read(4)
    return len(begins) == 4 and begins[3] in _PROCESSORS


def read_c3d(path: Path) -> C3dFile:
    """Read all of a file.

    Args:
        path: The file.

    Returns:
        Its parameters, analog channels and markers.

    Raises:
        MissingExtraError: If the library `c3d` is not installed.
        FormatError: If the file is damaged, cut, or contradicts itself.
    """
    with needs_extra(f"{path}: C3D files are read by c3d", "c3d"):
        import c3d
    require_file(path, "a C3D file")
    content = path.read_bytes()
    if not is_c3d(path):
        raise FormatError(f"{path}: expected a C3D file, whose second byte is 80, got another file")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what it warns of is checked here, or does not matter to analog channels
            reader = c3d.Reader(BytesIO(content))
            return _contents(path, content, reader)
    except FormatError:
        raise
    except _DAMAGED as error:
        words = " ".join(str(error).split()) or type(error).__name__
        raise FormatError(f"{path}: expected a sound C3D file, got one that c3d cannot read: {words}") from error


def _contents(path: Path, content: bytes, reader: Any) -> C3dFile:
    order = "<" if reader.proc_type != "MIPS" else ">"
    parameters = {
        f"{group.name.strip().upper()}:{name.strip().upper()}": _parameter(parameter, order, is_dec=_is_dec(reader))
        for group in reader.group_values()
        for name, parameter in group.param_items()
    }
    header = reader.header
    points, channels = int(header.point_count), _count(path, parameters, "ANALOG:USED")
    per_frame = int(header.analog_per_frame) if channels else 0
    if int(header.analog_count) != channels * per_frame:
        raise FormatError(
            f"{path}: header: expected {channels} channels x {per_frame} samples in a frame, got {header.analog_count}"
        )
    rate = float(header.frame_rate)
    if not 0.0 < rate < np.inf:
        raise FormatError(f"{path}: POINT:RATE: expected frames per second above 0, got {rate:g}")
    frames = _frame_count(path, parameters, header)
    words = _words(path, content, reader, frames, 4 * points + channels * per_frame)
    is_float = header.scale_factor < 0.0
    markers = _markers(words[:, : 4 * points].reshape(frames, points, 4), 1.0 if is_float else header.scale_factor)
    analog = words[:, 4 * points :].astype(np.float64).reshape(frames * per_frame, channels)
    if not is_float and _text(parameters, "ANALOG:FORMAT").upper() == "UNSIGNED":
        analog = analog % 65536.0
    labels, units = (_texts(parameters, f"ANALOG:{key}", channels) for key in ("LABELS", "UNITS"))
    return C3dFile(
        path=path,
        parameters=parameters,
        frame_rate_hz=rate,
        samples_per_frame=per_frame,
        analog=_scaled(path, analog, parameters),
        analog_labels=labels,
        analog_units=units,
        markers=markers,
        marker_labels=_texts(parameters, "POINT:LABELS", points),
        length_unit=_text(parameters, "POINT:UNITS"),
    )


def _is_dec(reader: Any) -> bool:
    return bool(reader.proc_type == "DEC")


def _parameter(parameter: Any, order: str, *, is_dec: bool) -> Any:
    """Numbers with the first index fastest, as the file has them, or texts."""
    data, shape = bytes(parameter.bytes), tuple(int(length) for length in parameter.dimensions)
    size = int(parameter.bytes_per_element)
    if size == -1:
        width = shape[0] if shape else 1
        count = int(np.prod(shape[1:])) if shape else 1
        cut = (data[k * width : (k + 1) * width] for k in range(count if width else 0))
        return tuple(text.split(b"\0")[0].decode("latin-1").strip() for text in cut)
    if size == 4 and is_dec:
        values = _of_dec(np.frombuffer(data, "<u2"))
    else:
        values = np.frombuffer(data, {1: "u1", 2: f"{order}i2", 4: f"{order}f4"}[size]).astype(np.float64)
    return values.reshape(shape, order="F")


def _of_dec(halves: Any) -> FloatArray:
    """Numbers of a PDP-11: the halves are exchanged, and the exponent is larger by 2."""
    swapped = np.ascontiguousarray(halves.reshape(-1, 2)[:, ::-1]).view("<u4").ravel()
    values = swapped.view("<f4").astype(np.float64) / 4.0
    return np.where(swapped & 0x7F800000 == 0, 0.0, values)


def _text(parameters: Mapping[str, Any], name: str) -> str:
    values = parameters.get(name, ())
    return str(values[0]) if isinstance(values, tuple) and values else ""


def _texts(parameters: Mapping[str, Any], name: str, count: int) -> tuple[str, ...]:
    """Texts of a parameter, and of those with a number that continue it, empty where the file has none."""
    texts: list[str] = []
    for key in (name, *(f"{name}{k}" for k in range(2, 10))):
        values = parameters.get(key, ())
        texts += values if isinstance(values, tuple) else ()
    return tuple((texts + [""] * count)[:count])


def _count(path: Path, parameters: Mapping[str, Any], name: str) -> int:
    values = np.ravel(parameters.get(name, 0.0))
    if values.dtype.kind not in "fiu" or len(values) != 1:
        raise FormatError(f"{path}: {name}: expected a number, got {len(values)}")
    return int(values[0]) % 65536


def _frame_count(path: Path, parameters: Mapping[str, Any], header: Any) -> int:
    """Frames of the file; the header has only 16 bits for it."""
    of_header = int(header.last_frame) - int(header.first_frame) + 1
    borders = [np.ravel(parameters.get(f"TRIAL:ACTUAL_{end}_FIELD", ())) for end in ("START", "END")]
    stated = [of_header]
    if all(border.dtype.kind == "f" and len(border) == 2 for border in borders):
        first, last = ((border % 65536.0) @ (1.0, 65536.0) for border in borders)
        stated.append(int(last - first) + 1)
    for name in ("POINT:LONG_FRAMES", "POINT:FRAMES"):
        values = np.ravel(parameters.get(name, ()))
        if values.dtype.kind == "f" and len(values) == 1:
            stated.append(int(values[0]) if values[0] >= 0.0 else int(values[0]) + 65536)
    count = max(stated)
    if count < 1 or any(other not in (count, count % 65536) for other in stated if other > 0):
        raise FormatError(
            f"{path}: header: expected one number of frames, got {' and '.join(map(str, dict.fromkeys(stated)))}"
        )
    return count


def _words(path: Path, content: bytes, reader: Any, frames: int, per_frame: int) -> Any:
    """All numbers of the frames in their own type; shape (frames, per_frame)."""
    is_float = reader.header.scale_factor < 0.0
    order = "<" if reader.proc_type != "MIPS" else ">"
    size, start = (4 if is_float else 2), _BLOCK * (int(reader.header.data_block) - 1)
    whole = (len(content) - start) // (size * per_frame) if per_frame and start > 0 else 0
    if whole < frames:
        raise FormatError(f"{path}: expected {frames} frames, as the header states, got {whole}: the file is cut")
    count = frames * per_frame
    if is_float and _is_dec(reader):
        words = _of_dec(np.frombuffer(content, "<u2", 2 * count, start))
    else:
        words = np.frombuffer(content, f"{order}{'f4' if is_float else 'i2'}", count, start)
    return words.reshape(frames, per_frame)


def _markers(words: Any, scale: float) -> FloatArray:
    """Positions, NaN where the residual is negative; shape (f, p, 3)."""
    return np.where(words[:, :, 3:] < 0, np.nan, words[:, :, :3].astype(np.float64) * scale)


def _scaled(path: Path, analog: FloatArray, parameters: Mapping[str, Any]) -> FloatArray:
    """(raw - OFFSET) x SCALE x GEN_SCALE, of files of floats too, in place; shape (n, c)."""
    channels = analog.shape[1]
    scale, offset = (np.ravel(parameters.get(f"ANALOG:{key}", ())) for key in ("SCALE", "OFFSET"))
    general = np.ravel(parameters.get("ANALOG:GEN_SCALE", 1.0))
    if _text(parameters, "ANALOG:FORMAT").upper() == "UNSIGNED":
        offset = offset % 65536.0
    for key, values, wanted in (("SCALE", scale, channels), ("OFFSET", offset, channels), ("GEN_SCALE", general, 1)):
        if values.dtype.kind != "f" or (channels and len(values) < wanted) or not np.isfinite(values).all():
            raise FormatError(f"{path}: ANALOG:{key}: expected {wanted} finite numbers, got {len(values)}")
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        analog -= offset[:channels]
        analog *= scale[:channels] * general[:1]
    return analog

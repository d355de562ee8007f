# SPDX-License-Identifier: BSD-3-Clause
"""C3D files that are written: analog channels, markers, and parameters such as those of force plates."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, ShapeError
from forcetorque.base.output_file import write_bytes_atomically

Parameter = np.ndarray[Any, np.dtype[Any]] | tuple[str, ...]
"""Numbers, first index fastest in the file, whole ones as 16-bit integers; or texts."""
_BLOCK = 512


@dataclass(frozen=True, slots=True, kw_only=True)
class Processor:
    """How a processor stores numbers."""

    code: int
    """Code in the file."""
    order: str
    """Byte order, `<` or `>`."""
    floats: Callable[[FloatArray], bytes]
    """Bytes of numbers."""


INTEL = Processor(code=84, order="<", floats=lambda values: np.asarray(values, "<f4").tobytes())
"""Processor of all files that are written today."""


def write_c3d(
    path: Path,
    parameters: Mapping[str, Parameter],
    *,
    analog: FloatArray,
    markers: FloatArray,
    frame_rate_hz: float,
    force: bool = False,
) -> None:
    """Write a file of floats.

    Args:
        path: File to write.
        parameters: By `GROUP:NAME`, beside those that the arrays give.
        analog: Analog channels, whole numbers of samples in a frame; shape (n, c); in ANALOG:UNITS.
        markers: Positions, NaN where one is not seen; shape (f, p, 3); in POINT:UNITS.
        frame_rate_hz: Frames per second.
        force: Whether a file that is there may be replaced.

    Raises:
        FormatError: If there is no frame, or a file is there.
        ShapeError: If a frame does not have a whole number of samples.
    """
    if path.exists() and not force:
        raise FormatError(f"{path}: expected no file there, remove it or write to another one")
    write_bytes_atomically(path, c3d_bytes(parameters, analog=analog, markers=markers, frame_rate_hz=frame_rate_hz))


def c3d_bytes(
    parameters: Mapping[str, Parameter],
    *,
    analog: FloatArray,
    markers: FloatArray,
    frame_rate_hz: float,
    processor: Processor = INTEL,
    scale: float = -1.0,
) -> bytes:
    """Make the bytes of a file.

    Args:
        parameters: As of `write_c3d`.
        analog: As of `write_c3d`.
        markers: As of `write_c3d`.
        frame_rate_hz: Frames per second.
        processor: How numbers are stored.
        scale: POINT:SCALE; below 0 for floats, else of markers that are stored as 16-bit integers.

    Returns:
        Header, parameters and frames.

    Raises:
        FormatError: If there is no frame.
        ShapeError: If a frame does not have a whole number of samples.
    """
    frames, points = markers.shape[:2]
    if not frames:
        raise FormatError("C3D: expected at least one frame, got none")
    channels, (per_frame, rest) = analog.shape[1], divmod(len(analog), frames)
    if rest:
        raise ShapeError(f"analog: expected a multiple of {frames} samples, got {len(analog)}")
    every: dict[str, Parameter] = {
        "POINT:USED": np.array(points),
        "POINT:SCALE": np.array(scale, dtype=np.float32),
        "POINT:RATE": np.array(frame_rate_hz, dtype=np.float32),
        "POINT:FRAMES": np.array(frames % 65536),
        "POINT:DATA_START": np.array(0),
        "POINT:DESCRIPTIONS": ("",) * points,
        "ANALOG:USED": np.array(channels),
        "ANALOG:DESCRIPTIONS": ("",) * channels,
        "ANALOG:GEN_SCALE": np.array(1.0, dtype=np.float32),
        "ANALOG:SCALE": np.ones(channels, dtype=np.float32),
        "ANALOG:OFFSET": np.zeros(channels, dtype=np.int64),
        "ANALOG:RATE": np.array(frame_rate_hz * per_frame, dtype=np.float32),
        **parameters,
    }
    blocks = -(-len(_parameter_section(every, processor, 0)) // _BLOCK)
    every["POINT:DATA_START"] = np.array(2 + blocks)
    section = _parameter_section(every, processor, blocks)
    header = struct.pack(
        f"{processor.order}BBHHHHH4sHH4s",
        2,
        0x50,
        points,
        channels * per_frame,
        1,
        frames % 65536,
        10,
        processor.floats(np.array([scale])),
        2 + blocks,
        per_frame,
        processor.floats(np.array([frame_rate_hz])),
    )
    body = _frames(analog.reshape(frames, -1), markers, processor, scale)
    return header.ljust(_BLOCK, b"\0") + section.ljust(_BLOCK * blocks, b"\0") + body + bytes(-len(body) % _BLOCK)


def _frames(analog: FloatArray, markers: FloatArray, processor: Processor, scale: float) -> bytes:
    is_seen = np.isfinite(markers).all(axis=2, keepdims=True)
    positions = np.where(is_seen, markers, 0.0) / (1.0 if scale < 0.0 else scale)
    words = np.concatenate([positions, np.where(is_seen, 0.0, -1.0)], axis=2).reshape(len(markers), -1)
    rows = np.hstack([words, analog])
    if scale < 0.0:
        return processor.floats(rows)
    return np.round(rows).astype(np.int64).astype(f"{processor.order}i2").tobytes()


def _parameter_section(parameters: Mapping[str, Parameter], processor: Processor, blocks: int) -> bytes:
    groups = list(dict.fromkeys(key.partition(":")[0] for key in parameters))
    content = struct.pack("BBBB", 1, 80, blocks, processor.code)
    for number, group in enumerate(groups, start=1):
        content += struct.pack("bb", len(group), -number) + group.encode("ascii")
        content += struct.pack(f"{processor.order}hB", 3, 0)
    for key, values in parameters.items():
        group, _, name = key.partition(":")
        data = _parameter(values, processor)
        content += struct.pack("bb", len(name), groups.index(group) + 1) + name.encode("ascii")
        content += struct.pack(f"{processor.order}h", len(data) + 2) + data
    return content + bytes(2)


def _parameter(values: Parameter, processor: Processor) -> bytes:
    if isinstance(values, tuple):
        return _texts(values)
    shape = struct.pack(f"B{values.ndim}B", values.ndim, *values.shape)
    flat = values.ravel(order="F")
    if values.dtype.kind in "iu":
        return struct.pack("b", 2) + shape + flat.astype(f"{processor.order}i2").tobytes() + b"\0"
    return struct.pack("b", 4) + shape + processor.floats(flat) + b"\0"


def _texts(values: Sequence[str]) -> bytes:
    width = max(map(len, values), default=0)
    data = "".join(text.ljust(width) for text in values).encode("latin-1")
    return struct.pack("bBBB", -1, 2, width, len(values)) + data + b"\0"

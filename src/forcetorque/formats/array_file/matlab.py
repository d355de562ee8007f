# SPDX-License-Identifier: BSD-3-Clause
"""MATLAB files of version 5 to 7: their elements [1], each checked, and numbers by the names of variables.

A file is a header of 128 bytes and one element per variable, which may be packed by zlib. An element is a tag, its type
and its number of bytes, and so many bytes; up to four of them stand in the tag itself. A variable is an element of
elements: flags with its class, dimensions, name, and its numbers, or the elements of its fields. A field of a struct is
`struct.field`. The elements are those of [1] MathWorks, MAT-File Format, R2024a.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import require_file, require_unpacked
from forcetorque.formats.array_file.streams import ArrayContents

MOST_MATRICES = 10_000
"""Variables and fields of a file."""
DEEPEST = 32
"""Structs inside each other."""

_HEADER = 128
_MATRIX, _COMPRESSED = 14, 15
_INTEGERS, _NAME = (5, 6), (1, 16)
"""Types of dimensions and flags, and of names: some programs write the other one."""
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
"""How numbers are stored, by the type of their element, which may be smaller than that of their class."""
_STRUCT, _OBJECT, _OPAQUE = 2, 3, 17
_CLASSES = {1: "cell array", _STRUCT: "struct", _OBJECT: "object", 4: "text", 5: "sparse matrix", 16: "function"}
_NUMERIC = range(6, 16)
_COMPLEX = 0x800
_MOST_DIMENSIONS = 32


@dataclass(frozen=True, slots=True, kw_only=True)
class Matrix:
    """A variable, or a field of a struct as `struct.field`."""

    name: str
    """Its name."""
    shape: tuple[int, ...]
    """Its dimensions."""
    content: str | None
    """What it is where it is no matrix of real numbers; None where it is one."""
    data: bytes | memoryview = b""
    """Its numbers as they are stored, column by column."""
    dtype: str = "<f8"
    """Their type."""

    def values(self) -> FloatArray:
        """Give the numbers.

        Returns:
            Its numbers; shape (rows, columns).
        """
        stored = np.frombuffer(self.data, dtype=self.dtype)
        with np.errstate(invalid="ignore"):  # damaged files hold signalling NaN
            return stored.astype(np.float64).reshape(self.shape, order="F")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Element:
    """An element: its type, its bytes from `start` to `stop`, and where the next one begins."""

    type: int
    start: int
    stop: int
    next: int


def read_matrices(path: Path) -> Iterator[Matrix]:
    """Give the variables of a file and the fields of its structs, one variable in memory at a time.

    Args:
        path: A file of MATLAB 5 to 7.

    Yields:
        Its variables in their order; arrays of structs are not entered.

    Raises:
        FormatError: If the file is damaged or cut off, or unpacks to more than a file may.
    """
    size, unpacked, count = path.stat().st_size, 0, 0
    with path.open("rb") as file:
        order = {b"IM": "<", b"MI": ">"}.get(file.read(_HEADER)[126:])
        if order is None:
            raise FormatError(f"{path}: byte 126: expected the order of bytes, IM or MI, got neither; copy it again")
        at = _HEADER
        while at < size:
            where = f"{path}: variable at byte {at}"
            data, at = _variable(path, file, where, order, at, size, unpacked)
            unpacked += len(data)
            for matrix in _matrices(_Buffer(where, data, order), 0, len(data), "", 0):
                count += 1
                if count > MOST_MATRICES:
                    raise FormatError(f"{path}: expected at most {MOST_MATRICES} variables and fields, got more")
                yield matrix


def _variable(path: Path, file: BinaryIO, where: str, order: str, at: int, size: int, before: int) -> tuple[bytes, int]:
    """The bytes of a variable, unpacked and without its tag, and where the next one begins."""
    file.seek(at)
    element = _element(_Buffer(where, file.read(8), order), 0, size - at)
    file.seek(at + element.start)
    data = file.read(element.stop - element.start)
    if len(data) != element.stop - element.start:
        raise _damaged(where, "the file ends inside it")
    if element.type == _COMPRESSED:
        return _unpacked(path, where, data, order, before), at + element.stop
    if element.type != _MATRIX:
        raise _damaged(where, f"an element of type {element.type}")
    return data, at + element.next


class _Buffer:
    """Bytes of elements, their order, and where they are for messages."""

    def __init__(self, where: str, data: bytes, order: str) -> None:
        self.where, self.data, self.order = where, memoryview(data), order

    def integers(self, start: int, stop: int, kind: str = "I") -> tuple[int, ...]:
        """Read whole numbers of four bytes."""
        if (stop - start) % 4 or stop > len(self.data) or start > stop:
            raise _damaged(self.where, f"{stop - start} bytes for whole numbers")
        return struct.unpack_from(f"{self.order}{(stop - start) // 4}{kind}", self.data, start)

    def text(self, start: int, stop: int) -> str:
        """Read a name, to be shown on one line."""
        characters = bytes(self.data[start:stop]).split(b"\0")[0].decode("utf-8", "backslashreplace")
        return characters if characters.isprintable() else repr(characters)


def _element(buffer: _Buffer, at: int, end: int) -> _Element:
    """The element at a place, which must end before `end`."""
    if end - at < 8:
        raise _damaged(buffer.where, f"{end - at} bytes at its byte {at} for an element")
    first, size = buffer.integers(at, at + 8)
    if first >> 16:
        type_, size, start, behind = first & 0xFFFF, first >> 16, at + 4, at + 8
        if size > 4:
            raise _damaged(buffer.where, f"{size} bytes in a tag at its byte {at}")
    else:
        type_, start = first, at + 8
        behind = start + size + -size % 8
    if start + size > end:
        raise _damaged(buffer.where, f"{size} bytes at its byte {at}, beyond its end")
    return _Element(type=type_, start=start, stop=start + size, next=min(behind, end))


def _unpacked(path: Path, where: str, data: bytes, order: str, before: int) -> bytes:
    """The bytes of a packed variable without its tag."""
    unpacker = zlib.decompressobj()
    try:
        buffer = _Buffer(where, unpacker.decompress(data, 8), order)
        if len(buffer.data) != 8:
            raise _damaged(where, "packed bytes that end early")
        type_, size = buffer.integers(0, 8)
        if type_ != _MATRIX:
            raise _damaged(where, f"a packed element of type {type_}")
        require_unpacked(path, before + size)
        content = unpacker.decompress(unpacker.unconsumed_tail, size) if size else b""
        # the checksum stands behind the last byte
        more = unpacker.decompress(unpacker.unconsumed_tail, 1)
    except zlib.error as error:
        raise _damaged(where, str(error)) from error
    if len(content) != size or more or not unpacker.eof:
        raise _damaged(where, "packed bytes that are not as many as its tag specifies")
    return content


def _matrices(
    buffer: _Buffer, at: int, end: int, before: str, depth: int, field: str | None = None
) -> Iterator[Matrix]:
    """The matrix whose elements stand between two places, or the fields of a struct."""
    if at == end:
        if field is not None:
            yield Matrix(name=before + field, shape=(0, 0), content="empty")
            return
        raise _damaged(buffer.where, "no bytes")
    flags = _typed(buffer, at, end, *_INTEGERS)
    integers = buffer.integers(flags.start, flags.stop)
    if len(integers) != 2:
        raise _damaged(buffer.where, f"{len(integers)} integers of flags")
    kind = integers[0] & 0xFF
    if kind == _OPAQUE:
        named = _typed(buffer, flags.next, end, *_NAME)
        name = before + (field or buffer.text(named.start, named.stop))
        yield Matrix(name=name, shape=(1, 1), content="object")
        return
    sized = _typed(buffer, flags.next, end, *_INTEGERS)
    shape = buffer.integers(sized.start, sized.stop, "i")
    if not 2 <= len(shape) <= _MOST_DIMENSIONS or min(shape) < 0:
        raise _damaged(buffer.where, f"dimensions {shape[:4]}")
    named = _typed(buffer, sized.next, end, *_NAME)
    name = field or buffer.text(named.start, named.stop)
    if not name:  # what functions of MATLAB remember
        return
    name = before + name
    if kind in _NUMERIC:
        yield _numbers(buffer, named.next, end, name, shape, is_complex=bool(integers[0] & _COMPLEX))
    elif kind in (_STRUCT, _OBJECT) and math.prod(shape) == 1:
        at = _typed(buffer, named.next, end, *_NAME).next if kind == _OBJECT else named.next
        yield from _fields(buffer, at, end, name, depth)
    elif kind in _CLASSES:
        size = " x ".join(map(str, shape))
        array = " array" if kind in (_STRUCT, _OBJECT) else ""
        yield Matrix(name=name, shape=shape, content=f"{size} {_CLASSES[kind]}{array}")
    else:
        raise _damaged(buffer.where, f"class {kind}")


def _numbers(buffer: _Buffer, at: int, end: int, name: str, shape: tuple[int, ...], *, is_complex: bool) -> Matrix:
    real = _element(buffer, at, end)
    if real.type not in _NUMBERS:
        raise _damaged(buffer.where, f"numbers of type {real.type}")
    dtype = np.dtype(buffer.order + _NUMBERS[real.type])
    if real.stop - real.start != math.prod(shape) * dtype.itemsize:
        raise _damaged(buffer.where, f"{real.stop - real.start} bytes for {' x '.join(map(str, shape))} numbers")
    content = None
    if is_complex:
        content = f"{' x '.join(map(str, shape))} complex numbers"
    elif not math.prod(shape):
        content = "empty"
    elif len(shape) > 2:
        content = f"{' x '.join(map(str, shape))} numbers"
    return Matrix(name=name, shape=shape, content=content, data=buffer.data[real.start : real.stop], dtype=dtype.str)


def _fields(buffer: _Buffer, at: int, end: int, name: str, depth: int) -> Iterator[Matrix]:
    """The fields of one struct."""
    if depth >= DEEPEST:
        raise FormatError(f"{buffer.where}: expected structs at most {DEEPEST} deep, got more")
    length = _typed(buffer, at, end, *_INTEGERS)
    (longest, *more) = buffer.integers(length.start, length.stop, "i") or (0,)
    names = _typed(buffer, length.next, end, *_NAME)
    if more or longest < 1 or (names.stop - names.start) % longest:
        raise _damaged(buffer.where, f"names of fields of {longest} bytes in {names.stop - names.start}")
    at = names.next
    for start in range(names.start, names.stop, longest):
        element = _typed(buffer, at, end, _MATRIX)
        field = buffer.text(start, start + longest)
        yield from _matrices(buffer, element.start, element.stop, f"{name}.", depth + 1, field)
        at = element.next


def _typed(buffer: _Buffer, at: int, end: int, *wanted: int) -> _Element:
    element = _element(buffer, at, end)
    if element.type not in wanted:
        raise _damaged(buffer.where, f"an element of type {element.type} at its byte {at} in place of {wanted[0]}")
    return element


def _damaged(where: str, reason: str) -> FormatError:
    return FormatError(f"{where}: expected a whole MATLAB file, got {reason}; copy or save it again")


MAGIC = b"MATLAB 5.0 MAT-file"
"""What files of version 5 to 7 begin with."""


def is_matlab_file(path: Path) -> bool:
    """Check whether a file is one of MATLAB, by its first bytes.

    Args:
        path: File or folder; it exists.

    Returns:
        Whether the signature is there.
    """
    if not path.is_file():
        return False
    with path.open("rb") as stream:
        return stream.read(len(MAGIC)) == MAGIC


def matlab_contents(path: Path) -> ArrayContents:
    """List what a file holds.

    Args:
        path: File of version 5 to 7.

    Returns:
        Matrices of real numbers, and what else there is.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or damaged.
    """
    _require_matlab(path)
    shapes: dict[str, tuple[int, int]] = {}
    skipped: dict[str, str] = {}
    for matrix in read_matrices(path):
        if matrix.content is None:
            shapes[matrix.name] = (matrix.shape[0], matrix.shape[1])
        else:
            skipped[matrix.name] = matrix.content
    return shapes, skipped


def read_matlab(path: Path, names: Collection[str]) -> dict[str, FloatArray]:
    """Read matrices of real numbers.

    Args:
        path: File of version 5 to 7.
        names: Those that are wanted; names that are not there are left out.

    Returns:
        Matrices by name; shape (rows, columns).

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or damaged.
    """
    _require_matlab(path)
    return {
        matrix.name: matrix.values()
        for matrix in read_matrices(path)
        if matrix.content is None and matrix.name in names
    }


def _require_matlab(path: Path) -> None:
    require_file(path, "a MATLAB file")
    if not is_matlab_file(path):
        raise FormatError(
            f"{path}: expected a MATLAB file of version 5 to 7, got another file; name the file of the log"
        )

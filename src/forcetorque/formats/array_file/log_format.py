# SPDX-License-Identifier: BSD-3-Clause
"""Files of named arrays as formats of logs, HDF5 among them: every array, column and unit that is read is specified.

MATLAB 7.3 is HDF5 with rows and columns the other way round.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.input_file import require_unpacked
from forcetorque.formats.array_file.matlab import MAGIC, is_matlab_file, matlab_contents, read_matlab
from forcetorque.formats.array_file.npz import is_npz_file, npz_contents, read_npz
from forcetorque.formats.array_file.streams import (
    ArrayContents,
    ArrayLog,
    Hdf5Log,
    MatlabLog,
    NpzLog,
    array_stream,
    wanted_arrays,
)
from forcetorque.formats.hdf5_file import (
    dataset_numbers,
    datasets,
    is_hdf5_file,
    is_numeric,
    members,
    opened_hdf5,
    require_readable,
)
from forcetorque.formats.log_format import (
    LogContext,
    LogDescription,
    LogReading,
    LogSketch,
    SketchedColumns,
    sketched_numbers,
    skipped_text,
)
from forcetorque.formats.robometry.channels import is_robometry_log
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream

MAGIC_73 = b"MATLAB 7.3 MAT-file"
"""What files of MATLAB 7.3 begin with, before the signature of HDF5."""


def is_matlab_73(path: Path) -> bool:
    """Check whether a file is one of MATLAB 7.3, by its first bytes.

    Args:
        path: A file.

    Returns:
        Whether the signature is there.
    """
    with path.open("rb") as file:
        return file.read(len(MAGIC_73)) == MAGIC_73


def hdf5_contents(path: Path, *, matlab: bool) -> ArrayContents:
    """List what a file holds, without reading its numbers.

    Args:
        path: The file.
        matlab: Whether names and shapes are those of MATLAB.

    Returns:
        Arrays of real numbers, and what else there is.
    """
    shapes: dict[str, tuple[int, int]] = {}
    skipped: dict[str, str] = {}
    with opened_hdf5(path) as file:
        for entry in members(file):
            name = _name(entry.path, matlab=matlab)
            reason = entry.not_in_file or _not_read(entry.dataset, matlab=matlab)
            if reason is None:
                shapes[name] = _rows_and_columns(entry.dataset.shape, matlab=matlab)
            else:
                skipped[name] = reason
    return dict(sorted(shapes.items())), dict(sorted(skipped.items()))


def read_hdf5(path: Path, names: Collection[str], *, matlab: bool) -> dict[str, FloatArray]:
    """Read arrays of a file.

    Args:
        path: The file.
        names: Those that are wanted; names that are not there are left out.
        matlab: Whether names, rows and columns are those of MATLAB.

    Returns:
        Arrays by name; shape (rows, columns).
    """
    with opened_hdf5(path) as file:
        wanted = {
            name: entry
            for entry in datasets(file)
            if (name := _name(entry.name, matlab=matlab)) in names and _not_read(entry, matlab=matlab) is None
        }
        require_readable(wanted.values())
        arrays = {name: dataset_numbers(entry) for name, entry in wanted.items()}
    return {name: values.T if matlab else values.reshape(len(values), -1) for name, values in arrays.items()}


def _name(path: str, *, matlab: bool) -> str:
    name = path.strip("/")
    return name.replace("/", ".") if matlab else name


def _not_read(dataset: Any, *, matlab: bool) -> str | None:
    """What a dataset is that is no array of real numbers; None where it is one."""
    size = " x ".join(map(str, (dataset.shape or ())[:: -1 if matlab else 1]))
    # what MATLAB calls empty is stored as its shape
    if dataset.shape is None or not dataset.size or "MATLAB_empty" in dataset.attrs:
        return "empty"
    if not is_numeric(dataset):
        kind = {"O": "cell or struct array", "u": "text or truth values"}.get(dataset.dtype.kind) if matlab else None
        return f"{size} {kind or f'values of {dataset.dtype}'}".strip()
    if len(dataset.shape) not in ((2,) if matlab else range(1, 5)):
        return f"{size} numbers" if dataset.shape else "single value"
    return None


def _rows_and_columns(shape: tuple[int, ...], *, matlab: bool) -> tuple[int, int]:
    if matlab:
        return shape[1], shape[0]
    columns = 1
    for length in shape[1:]:
        columns *= length
    return shape[0], columns


def array_streams(specified: ArrayLog, arrays: Mapping[str, FloatArray], context: LogContext) -> LogReading:
    """Make streams of arrays.

    Args:
        specified: What is specified of them; its path is for messages.
        arrays: Every array that is named there; shape (rows, columns).
        context: What else the experiment file specifies.

    Returns:
        Streams and findings.
    """
    streams: dict[str, Stream] = {}
    findings: list[Finding] = []
    for k, entry in enumerate(specified.stream):
        with context.stated_in(f"stream[{k}]"):
            reading = array_stream(specified.path, entry, arrays, streams)
        streams[entry.name] = reading.stream
        findings += reading.findings
    return LogReading(streams=tuple(streams.values()), findings=tuple(findings))


class _ArrayFormat(ABC):
    """Single files of arrays, which specify no units: they are recognised to report what must be specified."""

    sign: ClassVar[str]

    @abstractmethod
    def recognises(self, path: Path) -> bool:
        """Look at the first bytes."""

    @abstractmethod
    def _contents(self, path: Path) -> ArrayContents:
        """What the file holds, of which no numbers are read."""

    @abstractmethod
    def _arrays(self, path: Path, names: Collection[str]) -> Mapping[str, FloatArray]:
        """Arrays with these names."""

    def sketch(self, path: Path) -> LogSketch:
        """Look at names and shapes of all arrays, and at the numbers of those that may be times."""
        shapes, skipped = self._contents(path)
        if not shapes:
            raise FormatError(
                f"{path}: expected arrays of real numbers, got {skipped_text(skipped) or 'none'}; save each as an "
                "array of rows and columns"
            )
        values = self._read(path, shapes, [name for name, (rows, columns) in shapes.items() if columns == 1 < rows])
        columns = tuple(
            sketched_numbers(name, values[name][:, 0], rows=rows)
            if name in values and np.isfinite(values[name]).all()
            else SketchedColumns(name=name, rows=rows, columns=columns)
            for name, (rows, columns) in shapes.items()
        )
        return LogSketch(path=path, is_table=False, columns=columns, skipped_arrays=skipped)

    def describe(self, path: Path) -> LogDescription:
        """Refuse: nothing is inferred from names or numbers; list which there are."""
        names = [f"{name} ({rows} x {columns})" for name, (rows, columns) in self._contents(path)[0].items()]
        raise FormatError(
            f"{path}: expected a log that specifies what it holds, got the variables {', '.join(names) or 'none'}; "
            "specify their columns and units in an experiment file; `forcetorque init` begins one"
        )

    def read(self, specified: ArrayLog, context: LogContext) -> LogReading:
        """Read every array that is specified."""
        path = context.file(specified.path)
        shapes, skipped = self._contents(path)
        arrays = self._read(path, shapes, wanted_arrays(specified.stream))
        for k, entry in enumerate(specified.stream):
            with context.stated_in(f"stream[{k}]"):
                for name in wanted_arrays((entry,)):
                    if name in skipped:
                        raise FormatError(f"{path}: {name}: expected rows of real numbers, got {skipped[name]}")
                    if name not in arrays:
                        raise FormatError(f"{path}: no variable {name!r}; {known_names(name, shapes)}")
        return array_streams(specified.model_copy(update={"path": path}), arrays, context)

    def _read(
        self, path: Path, shapes: Mapping[str, tuple[int, int]], names: Collection[str]
    ) -> Mapping[str, FloatArray]:
        """Arrays with these names, unless they are more than the file may unpack to."""
        wanted = {name: shapes[name] for name in names if name in shapes}
        size = sum(rows * columns for rows, columns in wanted.values()) * np.dtype(np.float64).itemsize
        require_unpacked(path, size, where=", ".join(wanted)[:100])
        return self._arrays(path, list(wanted))


class MatlabFormat(_ArrayFormat):
    """Files of MATLAB, of version 5 to 7.3."""

    table = MatlabLog
    sign = f"a file that begins with {MAGIC.decode()} or {MAGIC_73.decode()}"

    def recognises(self, path: Path) -> bool:
        """Look at the first bytes; logs of robometry, which are such files too, label themselves."""
        return is_matlab_file(path) or (is_hdf5_file(path) and is_matlab_73(path) and not is_robometry_log(path))

    def _contents(self, path: Path) -> ArrayContents:
        return hdf5_contents(path, matlab=True) if is_hdf5_file(path) else matlab_contents(path)

    def _arrays(self, path: Path, names: Collection[str]) -> Mapping[str, FloatArray]:
        return read_hdf5(path, names, matlab=True) if is_hdf5_file(path) else read_matlab(path, names)


class Hdf5Format(_ArrayFormat):
    """Other files of HDF5."""

    table = Hdf5Log
    sign = "an HDF5 file"

    def recognises(self, path: Path) -> bool:
        """Look for the signature."""
        return is_hdf5_file(path) and not is_matlab_73(path) and not is_robometry_log(path)

    def _contents(self, path: Path) -> ArrayContents:
        return hdf5_contents(path, matlab=False)

    def _arrays(self, path: Path, names: Collection[str]) -> Mapping[str, FloatArray]:
        return read_hdf5(path, names, matlab=False)


class NpzFormat(_ArrayFormat):
    """Arrays that NumPy saved."""

    table = NpzLog
    sign = "a file of NumPy arrays, .npz"

    def recognises(self, path: Path) -> bool:
        """Look at the table of contents."""
        return is_npz_file(path)

    def _contents(self, path: Path) -> ArrayContents:
        return npz_contents(path)

    def _arrays(self, path: Path, names: Collection[str]) -> Mapping[str, FloatArray]:
        return read_npz(path, names)

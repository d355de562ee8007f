# SPDX-License-Identifier: BSD-3-Clause
"""One channel of a file of robometry: samples, their times, and what the file calls elements and units [1].

A channel is a group with `data`, of shape (samples, 1, elements) as h5py sees it, and `timestamps`. Names of
elements and units came with later versions; a unit may stand once for all elements.

References:
    [1] robotology/robometry, README.md and src/librobometry/src/BufferManager.cpp.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.hdf5_file import MOST_OBJECTS, dataset_numbers, datasets, is_member, member, require_readable
from forcetorque.formats.hdf5_layout import elsewhere

DESCRIPTION = "description_list"
"""Names of the joints; the group that holds it is that of the log."""
LATEST_S = 9.2e9
"""Seconds that nanoseconds of 64 bits can count."""

_LONGEST_NAME = 1000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Channel:
    """Samples of one channel."""

    path: str
    """Its path below the group of the log, such as `FTs/l_leg_ft`."""
    values: FloatArray
    """Samples; shape (n, k); in the units of the file."""
    stamp_ns: IntArray
    """Times by the clock of the logger; shape (n,); ns since 1970."""
    elements: tuple[str, ...]
    """Names of the k elements; none in older files."""
    labels: tuple[str, ...]
    """Their units as the file labels them, one for all or k; none in older files."""


def log_group(file: Any) -> Any | None:
    """Find the group of the log: that which names the joints.

    Args:
        file: An open HDF5 file.

    Returns:
        The group, or None if the file is no log of robometry.
    """
    import h5py

    groups = [file, *(member(file, name) for name in file if is_member(file, name) and elsewhere(file, name) is None)]
    return next((group for group in groups if isinstance(group, h5py.Group) and is_member(group, DESCRIPTION)), None)


def channel_paths(group: Any) -> Iterator[str]:
    """Name the channels of a log.

    Args:
        group: The group of the log.

    Yields:
        Paths below the group.
    """
    for dataset in datasets(group):
        parent = dataset.parent
        if dataset.name.rpartition("/")[2] == "data" and is_member(parent, "timestamps"):
            yield parent.name.removeprefix(group.name).strip("/")


def read_channel(group: Any, path: str) -> Channel:
    """Read one channel.

    Args:
        group: The group of the log.
        path: One of `channel_paths`.

    Returns:
        The channel.

    Raises:
        FormatError: If its samples are no vectors, or there are not as many times as samples.
    """
    leaf = member(group, path)
    place = f"{group.file.filename}: {path}"
    data, seconds = dataset_numbers(member(leaf, "data")), dataset_numbers(member(leaf, "timestamps")).ravel()
    samples = len(data) if data.ndim else 0
    if data.ndim not in (2, 3) or data.shape[1] != 1 or samples != len(seconds) or not data.size:
        raise FormatError(
            f"{place}: expected vectors, of shape (samples, 1, elements), and a time for each, got {data.shape} and "
            f"{len(seconds)} times; it is no channel of a sensor"
        )
    bad = np.flatnonzero(~(np.abs(seconds) < LATEST_S))
    if len(bad):
        raise FormatError(f"{place}: sample {bad[0] + 1}: expected a time in s since 1970, got {seconds[bad[0]]:g}")
    return Channel(
        path=path,
        values=data.reshape(samples, -1),
        stamp_ns=np.rint(seconds * 1e9).astype(np.int64),
        elements=texts(member(leaf, "elements_names")) if is_member(leaf, "elements_names") else (),
        labels=texts(member(leaf, "units_of_measure")) if is_member(leaf, "units_of_measure") else (),
    )


def texts(dataset: Any) -> tuple[str, ...]:
    """Read texts of MATLAB: a cell of references to them, or one by itself.

    Args:
        dataset: A dataset of references or of characters.

    Returns:
        The texts.

    Raises:
        FormatError: If it is something else, or longer than names are.
    """
    import h5py

    require_readable([dataset])
    if dataset.dtype.kind in "ui":
        return (_text(dataset),)
    if h5py.check_ref_dtype(dataset.dtype) is not h5py.Reference or dataset.size > MOST_OBJECTS:
        raise FormatError(f"{dataset.file.filename}: {dataset.name}: expected names, got {dataset.dtype}")
    names = (h5py.h5r.get_name(reference, dataset.file.id) for reference in dataset[()].ravel())
    return tuple(_text(member(dataset.file, (name or b"").decode().strip("/"))) for name in names)


def _text(dataset: Any) -> str:
    codes = dataset_codes(dataset)
    if not codes.size or "MATLAB_empty" in dataset.attrs:
        return ""
    return str(codes.astype("<u2").tobytes().decode("utf-16-le", "replace"))


def dataset_codes(dataset: Any) -> Any:
    """Read the characters of a text as MATLAB numbers them.

    Args:
        dataset: A dataset of characters.

    Returns:
        Codes; shape (n,).

    Raises:
        FormatError: If it is no text, or longer than names are.
    """
    require_readable([dataset])
    if dataset.dtype.kind not in "ui" or not dataset.size or dataset.size > _LONGEST_NAME:
        raise FormatError(
            f"{dataset.file.filename}: {dataset.name}: expected a text of at most {_LONGEST_NAME} characters"
        )
    return dataset[()].ravel()

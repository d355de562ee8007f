# SPDX-License-Identifier: BSD-3-Clause
"""Files as loggers of robometry write them: synthetic, after its documentation; no real one is at hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

JOINTS = ("r_hip_pitch", "r_knee", "r_ankle")
HEADER = b"MATLAB 7.3 MAT-file, Platform: GLNXA64"


@dataclass(frozen=True, kw_only=True)
class Leaf:
    """What one channel holds."""

    values: np.ndarray
    elements: Sequence[str] | None = None
    units: Sequence[str] | None = None
    start_s: float = 1_706_000_000.0


def write_log(path: Path, leaves: Mapping[str, Leaf], *, root: str = "robot_logger_device") -> Path:
    """Write a file of MATLAB 7.3 with a header of 512 bytes before HDF5."""
    with h5py.File(path, "w", userblock_size=512) as file:
        group = file.create_group(root)
        _cell(file, group, "description_list", JOINTS)
        _text(group, "yarp_robot_name", "ergoCubSN001")
        for place, leaf in leaves.items():
            _leaf(file, group.create_group(place), leaf)
    with path.open("r+b") as file:
        file.write(HEADER.ljust(512))
    return path


def _leaf(file: h5py.File, group: h5py.Group, leaf: Leaf) -> None:
    count, width = leaf.values.shape
    group["data"] = leaf.values.reshape(count, 1, width)
    group["dimensions"] = np.array([[width], [1], [count]], dtype=np.uint64)
    group["timestamps"] = (leaf.start_s + 0.01 * np.arange(count))[:, None]
    _text(group, "name", group.name.rpartition("/")[2])
    if leaf.elements is not None:
        _cell(file, group, "elements_names", leaf.elements)
    if leaf.units is not None:
        _cell(file, group, "units_of_measure", leaf.units)


def _text(group: h5py.Group, name: str, text: str) -> h5py.Dataset:
    dataset = group.create_dataset(name, data=np.array([[ord(letter)] for letter in text], dtype=np.uint16))
    dataset.attrs["MATLAB_class"] = np.bytes_("char")
    dataset.attrs["MATLAB_int_decode"] = np.int32(2)
    return dataset


def _cell(file: h5py.File, group: h5py.Group, name: str, words: Sequence[str]) -> None:
    store = file.require_group("#refs#")
    references: list[Any] = [_text(store, f"t{len(store)}", word).ref for word in words]
    group.create_dataset(name, data=np.array(references, dtype=h5py.ref_dtype)[:, None], dtype=h5py.ref_dtype)

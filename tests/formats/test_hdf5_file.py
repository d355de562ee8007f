# SPDX-License-Identifier: BSD-3-Clause
"""Of an HDF5 file only what is in it is read: no link, virtual dataset or external storage leads to another file."""

from __future__ import annotations

import os
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.hdf5_file import dataset_numbers, not_in_file, opened_hdf5
from forcetorque.formats.log_format import SketchingFormat
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.robometry.log_format import RobometryFormat
from tests.cases import some_cases
from tests.formats.array_file import test_hdf5_and_npz as arrays
from tests.formats.robometry import test_log_format as robometry
from tests.formats.robometry.logger import write_log

SHAPE = arrays.WRENCHES.shape


def _virtual(source: Path | str) -> Callable[[Any, str], None]:
    def make(group: Any, name: str) -> None:
        layout = h5py.VirtualLayout(SHAPE, "f8")
        layout[:] = h5py.VirtualSource(str(source), name, SHAPE)
        group.create_virtual_dataset(name, layout)

    return make


def _endless(source: Path | str) -> Callable[[Any, str], None]:
    """Of unlimited rows: HDF5 opens the other file where it is asked for the shape."""

    def make(group: Any, name: str) -> None:
        layout = h5py.VirtualLayout(SHAPE, "f8", maxshape=(None, SHAPE[1]))
        endless = h5py.VirtualSource(str(source), name, SHAPE, maxshape=(None, SHAPE[1]))
        layout[: h5py.h5s.UNLIMITED, :] = endless[: h5py.h5s.UNLIMITED, :]
        group.create_virtual_dataset(name, layout)

    return make


def _external(source: Path | str) -> Callable[[Any, str], None]:
    def make(group: Any, name: str) -> None:
        group.create_dataset(name, SHAPE, "f8", external=[(str(source), 0, 8 * SHAPE[0] * SHAPE[1])])

    return make


def _link(link: Any) -> Callable[[Any, str], None]:
    def make(group: Any, name: str) -> None:
        group[name] = link

    return make


OTHER, PIPE = "other.h5", "pipe"
ELSEWHERE: dict[str, tuple[Callable[[Path], Callable[[Any, str], None]], str]] = {
    "virtual of itself": (lambda _: _virtual("."), "virtual dataset"),
    "virtual of another": (lambda folder: _virtual(folder / OTHER), "virtual dataset"),
    "virtual of a pipe": (lambda folder: _endless(folder / PIPE), "virtual dataset"),
    "external": (lambda folder: _external(folder / OTHER), "dataset in external storage"),
    "external pipe": (lambda folder: _external(folder / PIPE), "dataset in external storage"),
    "external link": (lambda folder: _link(h5py.ExternalLink(str(folder / OTHER), "/ft")), "link"),
    "external link to a pipe": (lambda folder: _link(h5py.ExternalLink(str(folder / PIPE), "/ft")), "link"),
    "soft link": (lambda _: _link(h5py.SoftLink("/q")), "link"),
}


@pytest.fixture
def others(tmp_path: Path) -> Path:
    """A folder with another file, and a pipe into which nobody writes."""
    with h5py.File(tmp_path / OTHER, "w") as file:
        file["ft"] = arrays.WRENCHES
    os.mkfifo(tmp_path / PIPE)
    return tmp_path


@pytest.mark.parametrize("name", ["hdf5", "matlab"])
@pytest.mark.parametrize("kind", ELSEWHERE)
def test_what_is_in_another_file_is_not_read(others: Path, name: str, kind: str) -> None:
    """It is named as what cannot be read, refused where it is stated, and the rest of the file is read."""
    make, content = ELSEWHERE[kind]
    path = arrays._write(others, name)
    with h5py.File(path, "r+") as file:
        del file["ft"]
        make(others)(file, "ft")
    known = recognised_format(path)
    assert isinstance(known, SketchingFormat)
    sketch = known.sketch(path)
    assert sketch.skipped_arrays["ft"] == content
    assert [column.name for column in sketch.columns] == ["q", "t"]
    with pytest.raises(FormatError, match=f"ft: expected rows of real numbers, got {content}"):
        arrays._read(path, name, arrays.STREAM)
    (stream,) = arrays._read(path, name, arrays.STREAM | {"signal": arrays.STREAM["signal"][:1]}).streams
    np.testing.assert_allclose(stream.signal("position").values, np.radians(arrays.JOINTS))


@pytest.mark.parametrize("version", ["earliest", "latest"])
def test_the_header_of_any_version_is_read(others: Path, version: str) -> None:
    """With many attributes, which go on in other blocks; a group and sound datasets are no virtual ones."""
    with h5py.File(others / "log.h5", "w", libver=version, userblock_size=512) as file:
        file["whole"] = arrays.WRENCHES
        file.create_dataset("packed", data=arrays.WRENCHES, chunks=(10, 6), compression="gzip", track_times=True)
        file.create_group("group", track_order=True)
        _virtual(".")(file, "virtual")
        _external("x")(file, "external")
        for entry in file.values():
            for k in range(7):
                entry.attrs[f"a{k}"] = np.arange(50)
        expected = {"virtual": "virtual dataset", "external": "dataset in external storage"}
        file.flush()
        assert {name: not_in_file(file, name) for name in file} == dict.fromkeys(file, None) | expected


@pytest.mark.parametrize("size", [0, 4])
def test_chunks_without_room_for_their_checksum_are_refused(tmp_path: Path, size: int) -> None:
    """HDF5 took the length of the checksum from that of the chunk, and ended the process; a sound one is read."""
    path = tmp_path / "log.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset(
            "q", data=arrays.JOINTS, chunks=(len(arrays.JOINTS), 2), compression="gzip", fletcher32=True
        )
        stored = file["q"].id.get_chunk_info(0).size
    with opened_hdf5(path) as file:
        np.testing.assert_array_equal(dataset_numbers(file["q"]), arrays.JOINTS)
    # length, filters that were left out, and place of the first chunk
    key = struct.pack("<IIQ", stored, 0, 0)
    content = path.read_bytes()
    assert content.count(key) == 1
    path.write_bytes(content.replace(key, struct.pack("<IIQ", size, 0, 0)))
    with (
        opened_hdf5(path) as file,
        pytest.raises(FormatError, match=f"log.h5: /q: expected chunks .* got one of {size}"),
    ):
        dataset_numbers(file["q"])


def test_a_dataset_of_the_file_is_read(others: Path) -> None:
    """Negative control: in place of the others."""
    path = arrays._write(others, "hdf5")
    with h5py.File(path, "r+") as file:
        del file["ft"]
        file["ft"] = arrays.WRENCHES
    (stream,) = arrays._read(path, "hdf5", arrays.STREAM).streams
    np.testing.assert_array_equal(stream.signal("wrench").values[:, :3], arrays.WRENCHES[:, :3])


@pytest.mark.parametrize("kind", ELSEWHERE)
@some_cases("part", ["data", "timestamps", "units_of_measure"])
def test_a_log_of_robometry_names_no_other_file(others: Path, part: str, kind: str) -> None:
    """Neither its samples nor its times or labels are followed out of the file, nor the group of a channel."""
    path = write_log(others / "log.mat", robometry.LEAVES)
    make, content = ELSEWHERE[kind]
    with h5py.File(path, "r+") as file:
        group = file["robot_logger_device"][robometry.FT_ENTRY["channel"]]
        del group[part]
        make(others)(group, part)
    reading = RobometryFormat().describe(path).reading
    assert reading.streams
    unread = [finding for finding in reading.findings if finding.kind == "not_read"]
    place = f"{robometry.FT_ENTRY['channel']}/{part}"
    assert f"got a {content}, which is not followed" in next(f.message for f in unread if f.stream == place)
    if part in ("data", "timestamps"):
        assert robometry.FT_ENTRY["channel"] not in {stream.name for stream in reading.streams}
        with pytest.raises(FormatError, match=r"log\.mat"):
            robometry._read(path, robometry.FT_ENTRY)

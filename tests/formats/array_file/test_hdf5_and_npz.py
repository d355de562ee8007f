# SPDX-License-Identifier: BSD-3-Clause
"""HDF5, MATLAB 7.3 and npz are stated in one form, and give the same streams."""

from __future__ import annotations

import io
import sys
import zipfile
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingExtraError, MissingFileError, UnitError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.array_file.log_format import Hdf5Format, MatlabFormat, NpzFormat
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import format_named, recognised_format

ROWS = 40
RNG = np.random.default_rng(8)
TIMES = 100.0 + 0.01 * np.arange(ROWS)
WRENCHES = RNG.normal(size=(ROWS, 6))
JOINTS = RNG.normal(size=(ROWS, 2))
FILES = {"matlab": "log.mat", "hdf5": "log.h5", "npz": "log.npz"}
STREAM: dict[str, Any] = {
    "name": "arm",
    "variable": "q",
    "time": {"variable": "t", "unit": "s"},
    "signal": [
        {"quantity": "position", "columns": [1, 2], "unit": "deg", "names": ["shoulder", "elbow"]},
        {
            "quantity": "wrench",
            "variable": "ft",
            "columns": [1, 6],
            "unit": ["N", "N", "N", "N mm", "N mm", "N mm"],
            "frame": "tool",
        },
    ],
}


def _write(folder: Path, name: str) -> Path:
    arrays = {"t": TIMES, "q": JOINTS, "ft": WRENCHES}
    path = folder / FILES[name]
    if name == "npz":
        np.savez(path, **arrays, note=np.array("a text"))
        return path
    matlab = name == "matlab"
    with h5py.File(path, "w", userblock_size=512 if matlab else 0) as file:
        for key, values in arrays.items():
            file[key] = np.atleast_2d(values.T) if matlab else values
        file["note"] = np.array([[97]], dtype=np.uint16)
        file["note"].attrs["MATLAB_int_decode"] = 2
    if matlab:
        with path.open("r+b") as raw:
            raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512))
    return path


def _read(path: Path, name: str, *streams: dict[str, Any]) -> LogReading:
    known = format_named(name)
    stated = known.table.model_validate({"format": name, "path": path.name, "stream": streams})
    context = ExperimentContext(
        experiment=path.parent / "x.toml", inputs=Inputs(path.parent), sensors={}, joint_units={}
    )
    reading: LogReading = known.read(stated, context)
    return reading


@pytest.mark.parametrize("name", FILES)
def test_all_forms_give_the_same_stream(tmp_path: Path, name: str) -> None:
    """Times, joints and wrenches come from three arrays with the same rows; every column has its own unit."""
    (stream,) = _read(_write(tmp_path, name), name, STREAM).streams
    np.testing.assert_array_equal(stream.stamp_ns, np.rint(TIMES * 1e9))
    assert stream.signal("position").columns == ("shoulder", "elbow")
    np.testing.assert_allclose(stream.signal("position").values, np.radians(JOINTS), rtol=1e-15)
    np.testing.assert_allclose(stream.signal("wrench").values, WRENCHES * [1, 1, 1, 1e-3, 1e-3, 1e-3], rtol=1e-15)


@pytest.mark.parametrize(("name", "kind"), [*zip(FILES, (MatlabFormat, Hdf5Format, NpzFormat), strict=True)])
def test_they_are_recognised_by_content(tmp_path: Path, name: str, kind: type) -> None:
    """Whatever they are called; the message says what is in them, texts left out."""
    path = _write(tmp_path, name).rename(tmp_path / "log.bin")
    known = recognised_format(path)
    assert isinstance(known, kind)
    with pytest.raises(FormatError, match=rf"got the variables .*q \({ROWS} x 2\).*; specify their columns") as error:
        known.describe(path)
    assert "note" not in str(error.value)


@pytest.mark.parametrize("name", FILES)
def test_what_is_not_there_is_refused(tmp_path: Path, name: str) -> None:
    """Arrays by name, rows by number, units by column, a file by its path."""
    path = _write(tmp_path, name)
    with pytest.raises(FormatError, match=r"no variable 'Q'; did you mean \"q\"\?"):
        _read(path, name, STREAM | {"variable": "Q"})
    one_unit = STREAM["signal"][1] | {"unit": "N"}
    with pytest.raises(UnitError, match="column 4: expected a unit of wrench that converts to N m, got 'N'"):
        _read(path, name, STREAM | {"signal": [one_unit]})
    with pytest.raises(MissingFileError):
        _read(path.with_name("other"), name, STREAM)


def test_arrays_of_other_rows_are_refused(tmp_path: Path) -> None:
    """Joints and wrenches of two loggers are two streams."""
    np.savez(tmp_path / "log.npz", t=TIMES, q=JOINTS, ft=WRENCHES[1:])
    with pytest.raises(FormatError, match="expected arrays of the same number of rows"):
        _read(tmp_path / "log.npz", "npz", STREAM)


class _Trap:
    """What runs when it is unpickled."""

    def __reduce__(self) -> tuple[Any, ...]:
        return (sys.exit, ("unpickled",))


def test_a_pickle_is_refused_and_not_run(tmp_path: Path) -> None:
    """An array of objects; NumPy itself would run it if told to."""
    np.savez(tmp_path / "log.npz", t=TIMES, q=np.array([_Trap()], dtype=object))
    with pytest.raises(FormatError, match="got objects of Python: reading these would run code"):
        _read(tmp_path / "log.npz", "npz", STREAM | {"signal": STREAM["signal"][:1]})
    with pytest.raises(SystemExit, match="unpickled"):
        np.load(tmp_path / "log.npz", allow_pickle=True)["q"]


def test_a_header_that_is_cut_is_refused(tmp_path: Path) -> None:
    """In a bracket, where the parser of NumPy finds no end."""
    path = _write(tmp_path, "npz")
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members["q.npy"] = members["q.npy"].replace(b"(40, 2), }", b"(40, 2  }")
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    with pytest.raises(FormatError, match=r"log\.npz: q\.npy: expected a header of \.npy, got one that cannot be read"):
        _read(path, "npz", STREAM)


def test_claims_that_would_fill_the_memory_are_refused(tmp_path: Path) -> None:
    """A shape of 8 TB in a file of a few hundred bytes, by NumPy and by HDF5."""
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<f8", "fortran_order": False, "shape": (10**12, 2)})
    with zipfile.ZipFile(tmp_path / "log.npz", "w") as archive:
        archive.writestr("q.npy", header.getvalue())
    with pytest.raises(FormatError, match="expected 16000000000000 bytes by its shape, got 128 in the file"):
        _read(tmp_path / "log.npz", "npz", STREAM | {"signal": STREAM["signal"][:1], "time": {"unit": "s"}})
    with h5py.File(tmp_path / "log.h5", "w") as file:
        file.create_dataset("q", shape=(10**12, 2), chunks=(1000, 2), dtype="f8")
    with pytest.raises(
        FormatError, match=r"log.h5: q: expected a file that unpacks to at most 512 MiB .* got 15258789 MiB"
    ):
        _read(tmp_path / "log.h5", "hdf5", STREAM | {"signal": STREAM["signal"][:1], "time": {"unit": "s"}})


def test_without_h5py_the_error_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file is recognised all the same."""
    path = _write(tmp_path, "hdf5")
    monkeypatch.setitem(sys.modules, "h5py", None)
    known = recognised_format(path)
    assert isinstance(known, Hdf5Format)
    with pytest.raises(MissingExtraError, match=r"HDF5 is read by h5py: pip install 'forcetorque\[hdf5\]'"):
        known.describe(path)

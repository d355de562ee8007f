# SPDX-License-Identifier: BSD-3-Clause
"""What a run reads it does not write: every reader of a user's file says so, and the writer asks at the end."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import OutputError
from forcetorque.base.output_file import declare_outputs, is_replaceable, refuse_output, write_bytes_atomically
from forcetorque.base.run_files import declare_input, declare_output, files_of_one_run
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.calibration.stored_moments import read_moments
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.named_files import Inputs
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.formats.prior.registry import read_prior_file
from forcetorque.formats.registry import recognised_format
from forcetorque.report.sorted_input_files import sort_sources
from forcetorque.robot.urdf import read_urdf
from forcetorque.skin.layout.formats.icub_skin_gui import read_plan
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import read_patch_calibration
from forcetorque.viewer.meshes import read_mesh
from forcetorque.viewer.scene_builder import view_source

READERS: dict[str, Callable[[Path], Any]] = {
    "experiment.toml": load_experiment,
    "robot.urdf": read_urdf,
    "matrix.txt": read_matrix_file,
    "prior.txt": read_prior_file,
    "calibration.json": read_calibration,
    "moments.json": read_moments,
    "taxels.json": read_patch_calibration,
    "layout.txt": describe_patch,
    "plan.ini": read_plan,
    "a.numbers.json": lambda path: view_source(path, ()),
    "limits.toml": lambda path: sort_sources([path]),
    "link.stl": lambda path: read_mesh(path, (1.0, 1.0, 1.0)),
    "log.csv": recognised_format,
    "stated.csv": lambda path: Inputs(path.parent).file(Path(path.name)),
    "below.csv": lambda path: Inputs(path.parent).below(Path(), "*.csv"),
}


@pytest.mark.parametrize("name", READERS)
def test_every_reader_refuses_an_output(tmp_path: Path, name: str) -> None:
    """The file is never opened, whatever is in it; a link to it is the same file."""
    file, link = tmp_path / name, tmp_path / "link"
    file.write_bytes(b"x\n")
    link.symlink_to(file)
    with files_of_one_run():
        declare_output(link)
        with pytest.raises(OutputError, match=r"link: expected a file to write that is not read"):
            READERS[name](file)


@pytest.mark.parametrize("name", READERS)
def test_what_was_read_is_not_written_over(tmp_path: Path, name: str) -> None:
    """Also where the command did not say what it writes, or swallowed the refusal."""
    file = tmp_path / name
    file.write_bytes(b"x\n")
    with files_of_one_run():
        with suppress(Exception):
            READERS[name](file)
        with pytest.raises(OutputError, match="got an input of this run"):
            write_bytes_atomically(file, b"new")
    assert file.read_bytes() == b"x\n"
    assert sorted(path.name for path in tmp_path.iterdir()) == [name]
    write_bytes_atomically(file, b"new")  # control: the next run may


def test_files_below_a_folder_that_is_read_are_inputs(tmp_path: Path) -> None:
    """A log may be a folder of folders."""
    (tmp_path / "log/port").mkdir(parents=True)
    (tmp_path / "log/port/data.log").write_bytes(b"x")
    with files_of_one_run():
        declare_outputs(tmp_path / "log/port/data.log", force=True)
        with pytest.raises(OutputError, match="got an input"):
            declare_input(tmp_path / "log")


def test_a_result_of_an_input_is_refused_by_content(tmp_path: Path) -> None:
    """A result knows its inputs by their hashes, wherever they lie; a calibration of ours is one as well."""
    file = tmp_path / "a.json"
    file.write_bytes(b'{"schema": "forcetorque/calibration/4"}')
    refuse_output(file, inputs_sha256={"0" * 64})
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    for force in (False, True):
        with pytest.raises(OutputError, match="got an input of the result"):
            refuse_output(file, inputs_sha256={digest}, force=force)


@pytest.mark.parametrize("head", [b"", b"\x89PNG\r\n\x1a\n", b"%PDF-1.7", b"<!DOCTYPE html>", b"\0\0\0\x20ftypisom"])
def test_figures_pages_and_films_may_be_replaced(tmp_path: Path, head: bytes) -> None:
    """Known by their first bytes, not by their name."""
    (tmp_path / "file.out").write_bytes(head + bytes(10) if head else b"")
    assert is_replaceable(tmp_path / "file.out")


def test_a_damaged_parquet_file_is_no_result(tmp_path: Path) -> None:
    """Its end says nothing, or something absurd."""
    rng = np.random.default_rng(1)
    for _ in range(200):
        (tmp_path / "a.parquet").write_bytes(b"PAR1" + rng.bytes(int(rng.integers(0, 40))))
        assert not is_replaceable(tmp_path / "a.parquet")

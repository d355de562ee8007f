# SPDX-License-Identifier: BSD-3-Clause
"""A compensated copy: what is left is noise, the official loader's demands hold, a killed run goes on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError, FormatError, OutputError, UnitError
from forcetorque.dataset import added_features, check_dataset, compensate, compensate_dataset
from forcetorque.dataset.compensate import Measurement
from forcetorque.dataset.force_fields import orientation_field, wrench_field
from forcetorque.dataset.tool_load import Tool
from forcetorque.formats.lerobot.dataset import read_dataset
from tests.dataset.loader import require_loadable
from tests.formats.lerobot.datasets import FPS, tool_episodes, write_dataset
from tests.scenes.calibrations import make_calibration

NOISE = np.repeat([0.05, 0.002], 3)
STATED: dict[str, Any] = {
    "sense": "sensor_to_world",
    "direction": "child_to_parent",
    "force_unit": "N",
    "moment_unit": "N m",
}
ADDED = "observation.wrench_compensated"
EPISODES = tool_episodes([100, 80, 120], seed=1)


@pytest.fixture(scope="module")
def tool(tmp_path_factory: pytest.TempPathFactory) -> tuple[Tool, int]:
    """The tool of `EPISODES`, identified once: that takes seconds."""
    folder = tmp_path_factory.mktemp("tool")
    found: list[tuple[Tool, int]] = []
    with pytest.MonkeyPatch.context() as patch:
        original = compensate._identified
        patch.setattr(compensate, "_identified", lambda *args: found.append(original(*args)) or found[0])
        compensate_dataset(write_dataset(folder / "d", EPISODES), folder / "out", **STATED)
    return found[0]


@pytest.fixture
def known(tool: tuple[Tool, int], monkeypatch: pytest.MonkeyPatch) -> Tool:
    """Takes that tool for what is identified."""
    monkeypatch.setattr(compensate, "_identified", lambda *args: tool)
    return tool[0]


def _digests(root: Path) -> dict[str, str]:
    return {
        path.relative_to(root).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(root.rglob("*"))
        if path.is_file()
    }


@pytest.mark.parametrize("version", ["v2.1", "v3.0"])
def test_what_is_left_is_noise_in_a_loadable_copy(tmp_path: Path, known: Tool, version: str) -> None:
    """Tool, bias and noise of the truth; every demand of the loader; the dataset itself stays as it was."""
    root = write_dataset(tmp_path / "d", EPISODES, version=version, per_file=2)
    video = root / "videos" / "camera" / "chunk-000" / "file-000.mp4"
    video.parent.mkdir(parents=True)
    video.write_bytes(b"not looked at")
    before = _digests(root)
    require_loadable(root)
    (load,) = compensate_dataset(root, tmp_path / "out", **STATED).loads
    assert _digests(root) == before
    assert video.is_file()
    check = check_dataset(tmp_path / "out", sense="sensor_to_world")
    assert (check.fields, check.findings) == (("observation.wrench", ADDED), ())
    frames = require_loadable(tmp_path / "out")
    left, deviation = frames[ADDED], frames[f"{ADDED}_std"]
    np.testing.assert_allclose(left.std(axis=0), NOISE, rtol=0.2)  # of 300 samples, beside the error of the tool
    np.testing.assert_allclose(deviation.mean(axis=0), NOISE, rtol=0.2)
    assert (np.abs(left.mean(axis=0)) < 5.0 * NOISE / np.sqrt(len(left)) + 0.2 * NOISE).all()
    assert load.mass_kg is not None
    assert load.mass_half_width_95_kg is not None
    assert abs(load.mass_kg - 0.8) < 2.0 * load.mass_half_width_95_kg
    assert load.mass_half_width_95_kg < 0.005
    copied = tmp_path / "out" / video.relative_to(root)
    assert copied.read_bytes() == b"not looked at"
    assert not (tmp_path / "out.part").exists()


def test_world_axes_and_another_frame(tmp_path: Path, known: Tool) -> None:
    """A push along the world's x is there along x; about another origin the moment has its lever."""
    episodes = tool_episodes([150], seed=2, noise=(1e-4, 1e-5))
    from scipy.spatial.transform import Rotation

    turned = Rotation.from_quat(episodes[0]["observation.ee_quat"])
    pushed = slice(140, 150)
    force = turned.inv().apply([3.0, 0.0, 0.0])[pushed]
    episodes[0]["observation.wrench"][pushed, :3] += force
    root = write_dataset(tmp_path / "d", episodes)
    compensate_dataset(root, tmp_path / "world", **STATED, frame="world")
    left = require_loadable(tmp_path / "world")[ADDED][pushed]
    np.testing.assert_allclose(left[:, :3], np.tile([3.0, 0.0, 0.0], (10, 1)), atol=0.05)
    compensate_dataset(root, tmp_path / "moved", **STATED, pose=(0.0, 0.0, 0.1, 0.0, 0.0, 0.0))
    moved = require_loadable(tmp_path / "moved")[ADDED][pushed]
    np.testing.assert_allclose(moved[:, :3], force, atol=0.05)
    np.testing.assert_allclose(moved[:, 3:], np.cross([0.0, 0.0, 0.1], force), atol=0.05)


@pytest.mark.long
def test_each_episode_has_its_bias(tmp_path: Path) -> None:
    """Biases of sessions differ by 3 N: one bias for all warns and leaves them, one of each takes them off."""
    bias = np.zeros((6, 6))
    bias[:, 0] = [0.0, 3.0, 0.0, -3.0, 1.0, 0.0]
    root = write_dataset(tmp_path / "d", tool_episodes([80] * 6, seed=3, bias=bias))
    one = compensate_dataset(root, tmp_path / "one", **STATED)
    assert any("--bias episode" in warning for warning in one.warnings)
    compensate_dataset(root, tmp_path / "each", **STATED, bias="episode")
    left = require_loadable(tmp_path / "each")[ADDED]
    np.testing.assert_allclose(left.std(axis=0), NOISE, rtol=0.3)
    assert require_loadable(tmp_path / "one")[ADDED][:, 0].std() > 1.0


def _load_file(path: Path, mass: float) -> Path:
    load = {
        "load": "tool",
        "estimated": True,
        "mass_kg": mass,
        "mass_half_width_95_kg": 0.002,
        "centre_of_mass_m": [0.01, -0.02, 0.05],
        "centre_of_mass_half_width_95_m": [1e-4] * 3,
    }
    path.write_text(json.dumps({"schema": "forcetorque/payload/3", "serial": "1", "loads": [load]}), encoding="utf-8")
    return path


@pytest.mark.long
def test_a_load_that_was_identified_before(tmp_path: Path) -> None:
    """Its interval is in the standard deviation; the bias is that of the dataset."""
    root = write_dataset(tmp_path / "d", EPISODES)
    result = compensate_dataset(root, tmp_path / "out", **STATED, load=_load_file(tmp_path / "l.json", 0.8))
    assert result.load_from == "result"
    np.testing.assert_allclose(require_loadable(tmp_path / "out")[ADDED].std(axis=0), NOISE, rtol=0.2)
    with pytest.raises(FormatError, match="schema 'forcetorque/payload/3'"):
        compensate_dataset(root, tmp_path / "x", **STATED, load=root / "meta" / "info.json")


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"force_unit": None}, UnitError, "--force-unit"),
        ({"moment_unit": "kgf"}, UnitError, "'N m'"),
        ({"orientation": "observation.state"}, FormatError, "--form"),
        ({"feature": "observation.state"}, FormatError, "expected one wrench"),
        ({"name": "observation.state"}, OutputError, "there already"),
    ],
)
def test_what_is_not_stated_is_refused(
    tmp_path: Path, changes: dict[str, Any], error: type[Exception], message: str
) -> None:
    """Units, signs and features; nothing is left of the output."""
    root = write_dataset(tmp_path / "d", EPISODES[:1])
    with pytest.raises(error, match=message):
        compensate_dataset(root, tmp_path / "out", **(STATED | changes))
    assert [path.name for path in tmp_path.iterdir()] == ["d"]


@pytest.mark.long
def test_a_turned_sensor_is_named_and_identified(tmp_path: Path) -> None:
    """The orientation is that of a flange from which the sensor is turned by 0.5 rad about z."""
    from scipy.spatial.transform import Rotation

    episodes = tool_episodes([150, 150], seed=1)
    for episode in episodes:
        turned = Rotation.from_quat(episode["observation.ee_quat"]) * Rotation.from_euler("z", 0.5)
        episode["observation.ee_quat"] = turned.as_quat()
    root = write_dataset(tmp_path / "d", episodes)
    wrong = compensate_dataset(root, tmp_path / "wrong", **STATED)
    assert any("turned mount" in warning and "--unknown-mount" in warning for warning in wrong.warnings)
    right = compensate_dataset(root, tmp_path / "right", **STATED, mount=True)
    assert right.mount_rad is not None
    np.testing.assert_allclose(np.array(right.mount_rad, dtype=float), [0.0, 0.0, 0.5], atol=0.005)
    np.testing.assert_allclose(require_loadable(tmp_path / "right")[ADDED].std(axis=0), NOISE, rtol=0.2)


@pytest.mark.long
def test_a_wrong_sign_is_named(tmp_path: Path) -> None:
    """The mass is below zero."""
    with pytest.raises(FitError, match="expected a mass above 0 kg"):
        compensate_dataset(
            write_dataset(tmp_path / "d", EPISODES), tmp_path / "out", **(STATED | {"direction": "parent_to_child"})
        )


@pytest.mark.parametrize("place", ["d", "d/in/it", "."])
def test_an_output_is_beside_the_dataset(tmp_path: Path, place: str) -> None:
    """Neither itself, nor in it, nor around it."""
    root = write_dataset(tmp_path / "d", EPISODES[:1])
    with pytest.raises(OutputError, match="in it or around it"):
        compensate_dataset(root, tmp_path / place, **STATED)


def test_units_of_names_are_taken(tmp_path: Path) -> None:
    """`fx_mN` states its unit; another one beside it is a contradiction."""
    names = [f"f{axis}_mN" for axis in "xyz"] + [f"t{axis}_Nmm" for axis in "xyz"]
    dataset = read_dataset(write_dataset(tmp_path / "d", EPISODES[:1], names={"observation.wrench": names}))
    field, turned = wrench_field(dataset, None), orientation_field(dataset, None, "sensor_to_world")
    for unit, contradicts in ((None, False), ("mN", False), ("N", True)):
        measurement = Measurement(
            field=field, orientation=turned, force_unit=unit, moment_unit=None, calibration=None, serial=None
        )
        if contradicts:
            with pytest.raises(UnitError, match="as its name has"):
                measurement.factors()
        else:
            np.testing.assert_allclose(measurement.factors(), 1e-3)


@pytest.mark.parametrize("form", ["rotation_vector", "euler", "quaternion"])
def test_forms_of_unknown_units_are_refused_by_their_name(tmp_path: Path, form: str) -> None:
    """Not by the number of their elements, which may be right."""
    dataset = read_dataset(write_dataset(tmp_path / "d", EPISODES[:1]))
    with pytest.raises(FormatError, match=f"expected the form quat_xyzw, .*matrix_columns, got {form}"):
        orientation_field(dataset, "observation.state", "sensor_to_world", form)


RAW = "observation.raw"
MATRIX = np.random.default_rng(5).normal(size=(6, 6)) + 4.0 * np.eye(6)
"""Of the sensor; N/count, N m/count."""
ERROR = np.eye(6) + np.outer([0.0, 0.0, 0.3, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
"""What a calibration makes of a wrench whose matrix has a wrong gain of fz."""
COUNTS = {key: value for key, value in STATED.items() if "unit" not in key} | {"feature": RAW, "serial": "SN1"}


def _counts(root: Path) -> Path:
    """The dataset of `EPISODES` with counts in place of wrenches."""
    episodes = [{key: value for key, value in one.items() if "wrench" not in key} for one in EPISODES]
    for counts, one in zip(episodes, EPISODES, strict=True):
        counts[RAW] = np.linalg.solve(MATRIX, np.asarray(one["observation.wrench"], dtype=float).T).T
    return write_dataset(root, episodes, names={RAW: [f"channel_{k}" for k in range(6)]})


def _calibration(file: Path, matrix: FloatArray) -> Path:
    make_calibration(serial="SN1", matrix=matrix, prior=None, offset=np.zeros(6)).save(file)
    return file


def test_a_calibration_gives_the_wrenches_of_counts(tmp_path: Path, known: Tool) -> None:
    """What is left is that of a dataset of wrenches, and differs by an error of the matrix times the wrench."""
    compensate_dataset(write_dataset(tmp_path / "d", EPISODES), tmp_path / "direct", **STATED)
    direct = require_loadable(tmp_path / "direct")
    root = _counts(tmp_path / "counts")
    true, wrong = _calibration(tmp_path / "a.json", MATRIX), _calibration(tmp_path / "b.json", ERROR @ MATRIX)
    assert compensate_dataset(root, tmp_path / "true", calibration=true, **COUNTS).calibrated_by == "SN1"
    left = require_loadable(tmp_path / "true")["observation.wrench"]
    np.testing.assert_allclose(left, direct[ADDED], atol=1e-5)
    compensate_dataset(root, tmp_path / "wrong", calibration=wrong, **COUNTS)
    other = require_loadable(tmp_path / "wrong")["observation.wrench"]
    wrench = direct["observation.wrench"]
    np.testing.assert_allclose(other - left, wrench @ (ERROR - np.eye(6)).T, atol=1e-5)
    assert np.abs(other - left).max() > 0.5


def test_a_calibration_is_not_contradicted(tmp_path: Path) -> None:
    """Another sensor, none at all, another direction and a unit beside it are refused."""
    root, file = _counts(tmp_path / "d"), _calibration(tmp_path / "a.json", MATRIX)
    for changed, message in (
        ({"serial": None}, "expected --serial, the serial number of the sensor of the dataset"),
        ({"serial": "SN2"}, "SN2"),
        ({"direction": "parent_to_child"}, "--direction: expected child_to_parent, in which the calibration of sensor"),
        ({"force_unit": "N"}, "expected none beside --calibration, which gives N and N m, got 'N'"),
    ):
        with pytest.raises(ForceTorqueError, match=message):
            compensate_dataset(root, tmp_path / "out", calibration=file, **(COUNTS | changed))


@pytest.mark.long
def test_an_error_of_the_matrix_is_seen(tmp_path: Path) -> None:
    """With the right matrix the tool is that of the truth; a wrong gain is named with its size."""
    root = _counts(tmp_path / "d")
    true, wrong = (
        compensate_dataset(root, tmp_path / name, calibration=_calibration(tmp_path / f"{name}.json", matrix), **COUNTS)
        for name, matrix in (("true", MATRIX), ("wrong", ERROR @ MATRIX))
    )
    (load,) = true.loads
    assert load.mass_kg is not None
    assert load.mass_half_width_95_kg is not None
    assert abs(load.mass_kg - 0.8) < 2.0 * load.mass_half_width_95_kg
    assert (true.warnings, true.contradicted) == ((), False)
    (warning,) = wrong.warnings
    assert "gain of an axis: fz changes by 1.29" in warning or "gain of an axis: fz changes by 1.30" in warning
    assert wrong.residual_rms[2] > 10.0 * true.residual_rms[2]


def _stopping(original: Callable[..., None], after: int) -> Callable[..., None]:
    calls = []

    def write(*args: Any) -> None:
        calls.append(1)
        if len(calls) > after:
            raise KeyboardInterrupt
        original(*args)

    return write


def test_a_killed_run_goes_on(tmp_path: Path, known: Tool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files that are there are not written again, and the copy is that of one run; other options are refused."""
    root = write_dataset(tmp_path / "d", EPISODES, per_file=1)
    compensate_dataset(root, tmp_path / "whole", **STATED)
    original = added_features._write_frames
    monkeypatch.setattr(added_features, "_write_frames", _stopping(original, 2))
    with pytest.raises(KeyboardInterrupt):
        compensate_dataset(root, tmp_path / "out", **STATED)
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(added_features, "_write_frames", original)
    with pytest.raises(OutputError, match="got that of others"):
        compensate_dataset(root, tmp_path / "out", **STATED, frame="world")
    result = compensate_dataset(root, tmp_path / "out", **STATED)
    assert result.resumed_files == 2
    assert _digests(tmp_path / "out") == _digests(tmp_path / "whole")


def test_frames_without_a_measurement_are_refused(tmp_path: Path, known: Tool) -> None:
    """A policy cannot learn from NaN: the episode and frame are named."""
    episodes = tool_episodes([80, 80], seed=4)
    episodes[1]["observation.wrench"][17, 2] = np.nan
    root = write_dataset(tmp_path / "d", episodes)
    with pytest.raises(FormatError, match="episode 1: frame 17"):
        compensate_dataset(root, tmp_path / "out", **STATED)


def test_the_checker_refuses_what_the_loader_does(tmp_path: Path) -> None:
    """Negative control: a column that info.json lacks, and statistics of other values."""
    root = write_dataset(tmp_path / "d", EPISODES[:1])
    require_loadable(root)
    file = root / "data" / "chunk-000" / "file-000.parquet"
    table = pq.read_table(file)
    pq.write_table(table.append_column("more", pa.array(np.zeros(len(table)))), file)
    with pytest.raises(AssertionError):
        require_loadable(root)
    pq.write_table(table.set_column(0, "observation.state", table.column("observation.state").combine_chunks()), file)
    require_loadable(root)
    stats = json.loads((root / "meta" / "stats.json").read_text(encoding="utf-8"))
    stats["observation.wrench"]["mean"][0] += 1.0
    (root / "meta" / "stats.json").write_text(json.dumps(stats), encoding="utf-8")
    with pytest.raises(AssertionError):
        require_loadable(root)


@pytest.mark.real_data
@pytest.mark.parametrize("name", ["wrench_v21", "wrench_v30", "wrench_v30_added"])
def test_the_checker_passes_official_datasets(data_dir: Path, name: str) -> None:
    """What the official writer and loader of 0.4.4 wrote and read."""
    frames = require_loadable(data_dir / "lerobot_wrench" / name, pooled=name != "wrench_v30_added")
    assert len(frames["index"]) == 525


@pytest.mark.real_data
@pytest.mark.parametrize("name", [pytest.param("wrench_v21", marks=pytest.mark.long), "wrench_v30"])
def test_official_datasets(data_dir: Path, tmp_path: Path, name: str) -> None:
    """The tool of the truth within its interval; what is left is noise but for the frames that are stuck."""
    source = data_dir / "lerobot_wrench"
    truth = json.loads((source / "truth.json").read_text(encoding="utf-8"))
    result = compensate_dataset(source / name, tmp_path / "out", **STATED, gravity=truth["gravity"])
    (load,) = result.loads
    assert load.mass_kg is not None
    assert abs(load.mass_kg - truth["mass_kg"]) < 2.0 * (load.mass_half_width_95_kg or 0.0)
    left = require_loadable(tmp_path / "out")[ADDED][:425]
    np.testing.assert_allclose(left.std(axis=0), NOISE, rtol=0.2)
    assert result.left_out_frames == 100
    assert truth["fps"] == FPS

# SPDX-License-Identifier: BSD-3-Clause
"""Load cells on a bench: sensors of fewer than six components, without a prior matrix."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, UnitError
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.workbench.bench_recording import read_bench
from forcetorque.workbench.calibrate import workbench
from forcetorque.workbench.known_loads import BenchLoads
from forcetorque.workbench.position_means import Bench
from forcetorque.workbench.result import Workbench
from forcetorque.workbench.sensor_fit import changing_offset
from tests.app.outcome import Run

CELL = """schema = "forcetorque/bench/1"

[sensor]
name = "cell"
serial = "C1"
measure_direction = "child_to_parent"
full_scale = 1e6
components = {components}
load_full_scale = [20.0, 20.0, 20.0, 1.0, 1.0, 1.0]

[measurements]
format = "rows"
file = "{table}"
channels = {channels}
known = {known}
known_units = {units}
"""
_GRAM_FORCE_N = 9.80665e-3
_NOISE_COUNTS = 20.0
_RESPONSE = np.array([[5e4, 2e3, -1e3], [1e3, 6e4, 500.0], [-800.0, 3e3, 4e4]])
"""Counts per N of three channels."""
_FACTORS = {"N": 1.0, "N m": 1.0, "gf": 1.0 / _GRAM_FORCE_N}


def _cell(
    folder: Path,
    components: Sequence[str],
    loads: dict[str, FloatArray],
    response: FloatArray,
    *,
    unit: str = "N",
    stated: Sequence[str] | None = None,
) -> Path:
    """A bench whose cell answers to loads by name, N or N m, by a response; shape (channels, loads)."""
    rng = np.random.default_rng(7)
    known = list(loads if stated is None else stated)
    values = np.column_stack(list(loads.values()))
    raw = values @ response.T + 3e3 + _NOISE_COUNTS * rng.normal(size=(len(values), len(response)))
    channels = [f"raw{k}" for k in range(len(response))]
    units = [unit if name.startswith("f") else "N m" for name in known]
    columns = [loads[name] * _FACTORS[own] for name, own in zip(known, units, strict=True)]
    np.savetxt(
        folder / "cell.csv",
        np.column_stack([raw, *columns]),
        delimiter=",",
        header=",".join([*channels, *known]),
        comments="",
    )
    text = CELL.format(
        components=list(components), table="cell.csv", channels=channels, known=known, units=units
    ).replace("'", '"')
    path = folder / "cell.toml"
    path.write_text(text, encoding="utf-8")
    return path


def _fitted(path: Path) -> tuple[Workbench, Calibration]:
    result = workbench([read_bench(path)], code_version="0", created="2026-01-01")
    (calibration,) = result.calibrations
    return result, calibration


def _axis_by_axis(count: int = 3) -> dict[str, FloatArray]:
    """One force after the other, up to 10 N."""
    steps = np.linspace(0.0, 10.0, 6)
    return {f"f{'xyz'[k]}": np.concatenate([steps * (j == k) for j in range(count)]) for k in range(count)}


def test_a_cell_of_three_axes_without_a_prior(tmp_path: Path) -> None:
    """Its matrix is that of the cell, in grams of force as in newtons; its moments are rows of zeros."""
    matrices = []
    for unit in ("N", "gf"):
        result, calibration = _fitted(_cell(tmp_path, ["fx", "fy", "fz"], _axis_by_axis(), _RESPONSE, unit=unit))
        matrices.append(calibration.matrix)
    np.testing.assert_allclose(matrices[0], matrices[1], rtol=1e-9)
    # by noise: 20 counts over loads of 10 N leave some 2 counts/N of 5e4
    np.testing.assert_allclose(calibration.matrix[:3] @ _RESPONSE, np.eye(3), atol=5e-4)
    assert not calibration.matrix[3:].any()
    (row,) = result.sensors
    assert (row.rank, row.components, row.unmoved) == (3, ("fx", "fy", "fz"), ())
    assert row.held_out is not None
    expected = _NOISE_COUNTS * np.linalg.norm(np.linalg.inv(_RESPONSE), axis=1)
    np.testing.assert_allclose(row.held_out[:3], expected, rtol=0.6)
    (answer,) = result.answers()
    assert answer.verdict == "FITTED, fx, fy, fz"
    assert "N m" not in answer.why[0]
    assert any("no position loads tx, ty, tz" in warning for warning in calibration.warnings)
    assert any("faults of the bench are not searched" in warning for warning in result.warnings)
    assert "no fault of the bench" not in result.details(100)


def test_a_load_that_is_not_measured_disturbs_and_is_fitted_where_it_is_stated(tmp_path: Path) -> None:
    """A force off the axis adds a moment; without its column the force is wrong by what it adds."""
    rng = np.random.default_rng(3)
    force = rng.uniform(0.0, 10.0, 20)
    loads = {name: np.zeros(20) for name in ("fx", "fy", "fz", "tx", "ty", "tz")}
    loads |= {"fz": force, "ty": -force * rng.uniform(0.02, 0.06, 20)}
    response = np.zeros((1, 6))
    response[0, 2], response[0, 4] = 5e4, 2e5
    _, stated = _fitted(_cell(tmp_path, ["fz"], loads, response))
    assert stated.matrix[2, 0] == pytest.approx(1.0 / 5e4, rel=2e-3)
    assert stated.posterior is not None
    assert stated.posterior.mean[0, 4] == pytest.approx(2e5, rel=2e-2)
    _, alone = _fitted(_cell(tmp_path, ["fz"], loads, response, stated=["fz"]))
    assert alone.matrix[2, 0] * 5e4 > 1.1


@pytest.mark.parametrize(
    ("old", "new", "kind", "message"),
    [
        ("load_full_scale", "# load_full_scale", ForceTorqueError, "fewer than six components need load_full_scale"),
        ('components = ["fx", "fy", "fz"]', "", ExperimentError, "expected at least 6, one for each component, got 3"),
        ('["fx", "fy", "fz"]\nload', '["fy", "fx", "fz"]\nload', ForceTorqueError, "in the order fx to tz"),
        ('["N", "N", "N"]', '["N", "N", "N m"]', UnitError, "'fz': expected a unit that converts to N, got 'N m'"),
        ('["N", "N", "N"]', '["N", "N"]', ForceTorqueError, "known_units: expected one for each column of known"),
        ('["fx", "fy", "fz"]\nload', '["fx", "fy"]\nload', ExperimentError, r"that are measured \(fx, fy\), got 3"),
        ("full_scale = 1e6", 'full_scale = 1e6\nprior = "p.txt"', ExperimentError, "expected rows that are zero just"),
    ],
)
def test_what_does_not_fit_is_refused(
    tmp_path: Path, old: str, new: str, kind: type[ForceTorqueError], message: str
) -> None:
    """By name, with what was expected."""
    path = _cell(tmp_path, ["fx", "fy", "fz"], _axis_by_axis(), _RESPONSE)
    _, calibration = _fitted(path)
    matrix = calibration.model_copy(update={"matrix": np.ones((6, 3))})
    matrix.save(tmp_path / "p.json")
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1).replace("p.txt", "p.json"), encoding="utf-8")
    with pytest.raises(kind, match=message):
        read_bench(path)


def _single(folder: Path, *, gain_of_last: float = 1.0) -> Path:
    """A cell of one component with three series from zero, the last of another gain."""
    force = np.tile(np.linspace(0.0, 10.0, 6), 3)
    gains = np.repeat([1.0, 1.0, gain_of_last], 6)
    path = _cell(folder, ["fz"], {"fz": force * gains}, np.array([[5e4]]))
    table = np.loadtxt(folder / "cell.csv", delimiter=",", skiprows=1)
    table[:, 1] /= gains
    np.savetxt(folder / "cell.csv", table, delimiter=",", header="raw0,fz", comments="")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('format = "rows"', 'format = "rows"\nseries_from_zero = true'), encoding="utf-8")
    return path


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize(("gain", "count"), [(1.0, 0), (3.0, 1)])
def test_a_series_that_the_others_do_not_predict_is_named(tmp_path: Path, gain: float, count: int) -> None:
    """By the ratio over the measured components; those of one gain are predicted."""
    result, _ = _fitted(_single(tmp_path, gain_of_last=gain))
    named = [warning for warning in result.warnings if "the other series do not predict 'from line 14'" in warning]
    assert len(named) == count
    assert all(np.isfinite(row.ratio) for row in result.series)


@pytest.mark.parametrize(
    ("table", "limits", "message"),
    [
        ("workbench", {"faults": 0}, r"\[workbench\] cannot be evaluated: workbench.faults was not measured"),
        ("workbench", {"invalid_blocks": 0}, "workbench.invalid_blocks was not measured"),
        ("workbench", {"held_out": {"tx": 0.1}}, "workbench.held_out.tx was not measured"),
        ("uncertainty", {"offset": {"fx": 0.1}}, "uncertainty.offset.fx was not measured"),
        ("matrix", {"condition": 3.0}, r"\[matrix\] cannot be evaluated: expected a sensor of six components"),
    ],
)
def test_limits_for_what_is_not_measured_are_refused(
    tmp_path: Path, table: str, limits: dict[str, object], message: str
) -> None:
    """Whether or not zero would keep them; those of the measured component are judged."""
    recording = read_bench(_single(tmp_path))
    stated = {"workbench": {"held_out": {"fz": 10.0}}, "uncertainty": {"matrix_relative": 0.5}}
    accepted, refused = (
        AcceptanceFile.model_validate({"schema": "forcetorque/acceptance/1", "name": "cell", **tables})
        for tables in (stated, {table: limits})
    )
    result = workbench([recording], code_version="0", created="2026-01-01", spec=accepted)
    assert {row.criterion: row.passed for row in result.criteria} == {
        "uncertainty.matrix_relative": True,
        "workbench.held_out.fz": True,
    }
    with pytest.raises(ExperimentError, match=message):
        workbench([recording], code_version="0", created="2026-01-01", spec=refused)


def test_a_calibration_without_a_figure_is_written_with_a_warning(run: Run, tmp_path: Path) -> None:
    """Forces of one component lie on no sphere."""
    path, written, figure = _single(tmp_path), tmp_path / "new.json", tmp_path / "new.png"
    outcome = run("bench", "workbench", path, "-o", written, "--figure", figure)
    assert outcome.code == 0
    assert "not drawn: --figure" in outcome.err
    assert written.exists()
    assert not figure.exists()


def test_blank_rows_are_no_positions(tmp_path: Path) -> None:
    """As a spreadsheet leaves them below its table, whose other components are zeros."""
    path = _single(tmp_path)
    with (tmp_path / "cell.csv").open("a", encoding="utf-8") as table:
        table.write(",\n,\n")
    assert len(read_bench(path).loads) == 15  # three rows without load are biases
    result, _ = _fitted(path)
    assert result.sensors[0].without_load == ()


def test_an_axis_that_no_position_loads_is_named(tmp_path: Path) -> None:
    """Without a prior matrix there is no matrix then."""
    loads = {**_axis_by_axis(2), "fz": np.zeros(12)}
    result = workbench(
        [read_bench(_cell(tmp_path, ["fx", "fy", "fz"], loads, _RESPONSE))], code_version="0", created="2026-01-01"
    )
    (row,) = result.sensors
    assert row.unmoved == ("fz",)
    assert "the loads move 2 of 3 directions, not fz" in row.reason
    with pytest.raises(FitError, match="all 3 directions, got 2, not fz"):
        workbench([read_bench(tmp_path / "cell.toml")], code_version="0", created="2026-01-01", full_matrix=True)


@pytest.mark.real_data
@pytest.mark.parametrize(("cell", "error_N"), [(1, 0.017), (2, 0.017), (3, 0.083), (4, 0.013)])
def test_measured_cells(data_dir: Path, tmp_path: Path, cell: int, error_N: float) -> None:
    """Positions left out one by one, as a plain regression predicts them; one row of cell 3 is 0.3 N off."""
    table = data_dir / "fareke_6axis" / f"3axisCell{cell}CalibrationData.csv"
    if not table.is_file():
        pytest.skip(f"no {table}")
    text = CELL.format(
        components=["fx", "fy", "fz"],
        table=table.as_posix(),
        channels=[f"corrected_{axis}" for axis in "xyz"],
        known=[f"force_{axis}" for axis in "xyz"],
        units=["gf"] * 3,
    ).replace("'", '"')
    (tmp_path / "cell.toml").write_text(text.replace("1e6", "8388608.0"), encoding="utf-8")
    result, _ = _fitted(tmp_path / "cell.toml")
    held_out = result.sensors[0].held_out
    assert held_out is not None
    rows = np.genfromtxt(table, delimiter=",", skip_header=1, usecols=range(9))
    force, raw = rows[:, :3] * _GRAM_FORCE_N, rows[:, 6:9]
    design = np.column_stack([force, np.ones(len(force))])
    hat = design @ np.linalg.pinv(design)
    left = (raw - hat @ raw) / (1.0 - np.diag(hat))[:, None]
    response = np.linalg.lstsq(design, raw, rcond=None)[0][:3].T
    plain = np.sqrt(((left @ np.linalg.inv(response).T) ** 2).mean(axis=0))
    np.testing.assert_allclose(held_out[:3], plain, rtol=1e-2)
    assert np.linalg.norm(held_out) < error_N
    assert not any("series_from_zero" in warning for warning in result.warnings)
    raw_columns = (tmp_path / "cell.toml").read_text(encoding="utf-8").replace("corrected_", "sensor_")
    for key, largest_N, count in (("", 0.56, 1), ("series_from_zero = true", 1.2 * error_N, 0)):
        (tmp_path / "cell.toml").write_text(raw_columns + key, encoding="utf-8")
        result, _ = _fitted(tmp_path / "cell.toml")
        assert result.sensors[0].held_out is not None
        assert np.linalg.norm(result.sensors[0].held_out) < largest_N
        assert sum("series_from_zero" in warning for warning in result.warnings) == count


def _with_series_offsets(folder: Path) -> Path:
    """Three series from zero, between which the offset of the cell changes by some 0.6 N."""
    path = _single(folder)
    table = np.loadtxt(folder / "cell.csv", delimiter=",", skiprows=1)
    table[:, 0] += np.repeat([0.0, 3e4, -2e4], 6)
    np.savetxt(folder / "cell.csv", table, delimiter=",", header="raw0,fz", comments="")
    return path


def test_every_series_has_its_own_offset_and_a_file_without_the_key_is_told_so(tmp_path: Path) -> None:
    """With the key the error is that of two noisy rows; a cell of one offset, the negative control, has no warning."""
    path = _with_series_offsets(tmp_path)
    result, calibration = _fitted(path)
    (row,) = result.sensors
    assert row.held_out is not None
    assert row.held_out[2] < 2.5 * _NOISE_COUNTS / 5e4
    assert row.positions == 15
    last_zero = np.loadtxt(tmp_path / "cell.csv", delimiter=",", skiprows=1)[12, 0]
    assert calibration.matrix[2, 0] * last_zero + calibration.offset[2] == pytest.approx(0.0, abs=2e-3)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("series_from_zero = true\n", ""), encoding="utf-8")
    result, _ = _fitted(path)
    assert any("series_from_zero = true" in warning for warning in result.warnings)
    assert [answer.verdict for answer in result.answers()] == ["FITTED, OFFSET CHANGES"]
    path.write_text(_single(tmp_path).read_text(encoding="utf-8").replace("series_from_zero = true\n", ""))
    assert not any("series_from_zero" in warning for warning in _fitted(path)[0].warnings)


def test_a_series_without_a_row_to_begin_with_is_refused(tmp_path: Path) -> None:
    """Its offset is not known."""
    path = _single(tmp_path)
    lines = (tmp_path / "cell.csv").read_text(encoding="utf-8").splitlines()
    (tmp_path / "cell.csv").write_text("\n".join([lines[0], *lines[2:]]), encoding="utf-8")
    with pytest.raises(ExperimentError, match="expected the first row of cell.csv to be without load, got line 2"):
        read_bench(path)


@pytest.mark.long
def test_how_often_an_offset_is_said_to_change() -> None:
    """At most 0.3 % of cells with one offset; 95 % of those whose series differ by 6 standard deviations of noise."""
    wrench = np.zeros((15, 6))
    for k in range(3):
        wrench[5 * k + 1 : 5 * k + 5, k] = [2.0, 4.0, 6.0, 8.0]
    loads = BenchLoads(names=tuple(map(str, range(15))), wrench=wrench, series=("all",) * 15)
    found = np.zeros(2, dtype=int)
    for seed in range(50_000, 54_000):
        rng = np.random.default_rng(seed)
        one = 10.0 * wrench[:, :3] @ rng.normal(size=(3, 3)) + rng.normal(size=(15, 3))
        several = one + np.repeat(6.0 * rng.normal(size=(3, 3)), 5, axis=0)
        for k, raw in enumerate((one, several)):
            bench = Bench(
                sensor="cell",
                serial="C1",
                loads=loads,
                raw=raw,
                full_scale=np.full(3, 1e3),
                measured=np.arange(6) < 3,
                load_full_scale=np.full(6, 10.0),
            )
            found[k] += bool(changing_offset(bench))
    assert found[0] <= 12
    assert found[1] >= 3800

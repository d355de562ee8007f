# SPDX-License-Identifier: BSD-3-Clause
"""Sensors on a workbench: a measured plate, simulated ones, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, FormatError, UnitError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.workbench.bench_recording import BenchRecording, read_bench
from forcetorque.workbench.calibrate import workbench
from forcetorque.workbench.result import Workbench
from forcetorque.workbench.simulated_benches import BenchFaults
from tests.cases import some_cases
from tests.scenes.benches import write_bench
from tests.workbench.trials import simulated_benches

PLATE = """schema = "forcetorque/bench/1"

[sensor]
name = "plate"
serial = "PLATE{suffix}"
measure_direction = "child_to_parent"
full_scale = [25.0, 25.0, 25.0, 4.0, 4.0, 4.0]
prior = "identity"

[measurements]
format = "rows"
file = "{table}"
channels = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
known = ["known_Fx", "known_Fy", "known_Fz", "Known_Mx", "Known_My", "known_Mz"]
known_units = ["N", "N", "N", "N m", "N m", "N m"]
series_from_zero = true
"""
LEFT_OUT_N = [0.050, 0.060, 0.060]
"""Error of single rows of the plate that are left out; N; before calibration .27 .11 .46."""
SHUFFLED_N = [0.056, 0.066, 0.066]
"""The same of a fifth at a time, mean of twenty partitions: a few hundredths more, by which rows are left."""


def run_workbench(*paths: Path, **options: bool) -> Workbench:
    """The result for files."""
    return workbench([read_bench(path) for path in paths], code_version="0", created="2026-01-01", **options)


@pytest.fixture
def plate(data_dir: Path, tmp_path: Path) -> Callable[..., Path]:
    """Workbench files of the measured plate."""
    source = data_dir / "fareke_6axis"
    if not source.is_dir():
        pytest.skip(f"no {source}")

    def written(suffix: str, *changes: tuple[str, str]) -> Path:
        text = PLATE.format(suffix=suffix, table=source / f"calibrationReadings{suffix}.csv")
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / f"plate{suffix}.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.mark.long
@pytest.mark.real_data
def test_rows_of_the_plate_are_predicted_and_series_are_not(plate: Callable[..., Path]) -> None:
    """One row at a time, a fifth with its range over partitions, and no whole series."""
    result = run_workbench(plate(""))
    (row,) = result.sensors
    assert (row.positions, row.rank, row.without_load) == (54, 6, ())
    assert row.held_out is not None
    assert row.folds_mean is not None
    assert row.folds_largest is not None
    assert row.prior is not None
    assert (row.held_out[:3] <= LEFT_OUT_N).all()
    assert (row.folds_mean[:3] <= SHUFFLED_N).all()
    assert (row.folds_largest[:3] > row.folds_mean[:3]).all()
    assert (row.prior[:3] > [0.2, 0.1, 0.4]).all()  # before calibration
    assert len(result.series) == 6
    assert max(series.largest_force_N or 0.0 for series in result.series) > 1.0
    assert sum("do not predict" in message for message in result.warnings) >= 5


@pytest.mark.long
@pytest.mark.real_data
def test_a_series_of_the_plate_is_not_determined_without_a_prior(plate: Callable[..., Path]) -> None:
    """The reason names the direction that it alone moves."""
    result = run_workbench(plate("", ('prior = "identity"\n', "")))
    reasons = [series.reason for series in result.series]
    assert all(reasons)
    assert any("not fz" in reason for reason in reasons)


@pytest.mark.long
@pytest.mark.real_data
def test_swapped_lines_of_the_plate_are_named(plate: Callable[..., Path]) -> None:
    """Lines 17 and 18 in fy, first of all; line 61 lacks one moment."""
    result = run_workbench(plate("_1"))
    first = result.faults[0]
    assert (first.fault, first.positions, first.component) == ("swapped", ("17", "18"), "fy")
    assert result.sensors[0].without_load == ("61 (no tx)",)
    assert any("61 (no tx)" in message for message in result.warnings)
    assert not any(row.fault == "swapped" for row in run_workbench(plate("")).faults)  # negative control


@pytest.mark.long
@pytest.mark.real_data
def test_five_directions_of_the_plate_are_named(plate: Callable[..., Path]) -> None:
    """Without references in twenty lines fz is never loaded: the prior is kept there, and a full matrix refused."""
    path = plate("_2")
    result = run_workbench(path)
    (row,) = result.sensors
    assert (row.rank, row.unmoved, row.fitted) == (5, ("fz",), True)
    assert row.without_load == tuple(str(line) for line in range(52, 72))
    np.testing.assert_allclose(result.calibrations[0].matrix[:, 2], np.eye(6)[2], atol=1e-9)
    assert (result.faults[0].fault, result.faults[0].positions) == ("swapped", ("17", "18"))
    with pytest.raises(FitError, match="got 5, not fz; hang a load there"):
        run_workbench(path, full_matrix=True)
    bare = run_workbench(plate("_2", ('prior = "identity"\n', "")))
    assert (bare.sensors[0].fitted, bare.calibrations) == (False, ())
    assert "not fz" in bare.sensors[0].reason
    with pytest.raises(FitError, match=r"plate_2.toml: expected a matrix to write .* not used: 52, 53"):
        bare.save(path.with_suffix(".json"))


@pytest.mark.real_data
@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        (
            (
                '["known_Fx", "known_Fy", "known_Fz", "Known_Mx", "Known_My", "known_Mz"]',
                '["Known_Mx", "Known_My", "known_Mz", "known_Fx", "known_Fy", "known_Fz"]',
            ),
            ExperimentError,
            "got what the prior matrix measures as moment",
        ),
        (('"N m"]', '"N"]'), UnitError, "'known_Mz': expected a unit of wrench that converts to N m, got 'N'"),
        (('"Mz"]\nknown', '"Mw"]\nknown'), FormatError, "no column 'Mw'"),
    ],
    ids=["halves swapped", "units mixed", "no such column"],
)
def test_tables_that_contradict_the_file(
    plate: Callable[..., Path], change: tuple[str, str], kind: type[Exception], message: str
) -> None:
    """Refused, with the column."""
    path = plate("", change)
    with pytest.raises(kind, match=message):
        run_workbench(path)


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Files of a undamaged sensor."""
    return write_bench(tmp_path_factory.mktemp("bench"))[0]


@pytest.fixture(scope="module")
def undamaged(bench: Path) -> Workbench:
    """What it says."""
    return run_workbench(bench)


def test_a_calibration_reads_the_true_load(bench: Path, undamaged: Workbench, tmp_path: Path) -> None:
    """Written, read again and held against the true response; the offset is that of the last bias."""
    result, (_, simulated) = undamaged, write_bench(tmp_path)
    result.save(tmp_path / "new.json")
    calibration = read_calibration(tmp_path / "new.json")
    error = calibration.matrix @ simulated.response - np.eye(6)
    assert np.abs(error[:3, :3]).max() < 0.003  # 0.1 degrees and 0.1 % at each of a few positions
    assert np.abs(error[3:, 3:]).max() < 0.01  # 0.5 mm of 140 mm
    last = np.loadtxt(bench.parent / "SIM001_output24.dat")[:40, 1:].mean(axis=0)
    wrench = calibration.apply(last, serial="SIM001")
    np.testing.assert_allclose(wrench, result.calibrations[0].offset + calibration.matrix @ last)
    assert np.abs(wrench[:3]).max() < 0.5
    assert result.next == "all 24 positions are valid"
    assert result.faults == ()


def test_the_guide_names_the_next_position(tmp_path: Path) -> None:
    """By what there is; a position that was taken for another is to be recorded again."""
    path, _ = write_bench(tmp_path, positions=6)
    result = run_workbench(path, only_next=True)
    assert result.sensors == ()
    assert result.next is not None
    assert result.next.startswith("next: position 7 (heavy): 25 kg and the structure of 0.2 kg at (0, 0, 5) mm")
    empty = write_bench(tmp_path, serial="SIM002", positions=0)[0]
    assert (run_workbench(empty).next or "").startswith("next: position 1 ")
    swapped = write_bench(tmp_path, serial="SIM003", faults=BenchFaults(swapped=(3, 8)))[0]
    assert (run_workbench(swapped, only_next=True).next or "").startswith("again: position 4 ")


@some_cases("factor", [2.0, 3.0, 0.1, -1.0])
def test_a_prior_that_no_sensor_differs_by_is_refused_or_warned_of(factor: float, tmp_path: Path) -> None:
    """As `calibrate` refuses it, in words of a workbench; twice the forces alone are messages, and fitted all right."""
    path, simulated = write_bench(tmp_path, positions=24)
    assert simulated.bench.prior is not None
    prior = simulated.bench.prior * np.repeat([factor, 1.0], 3)[:, None]
    write_matrix_file(tmp_path / "nominal.txt", encode_matrix(prior))
    result = run_workbench(path)
    if factor == 2.0:
        error = result.calibrations[0].matrix @ simulated.response - np.eye(6)
        assert np.abs(error[:3, :3]).max() < 0.003
        (warning,) = (message for message in result.calibrations[0].warnings if "the gain changed by +" in message)
        assert f"SIM001: {warning}" in result.warnings
        return
    assert (result.calibrations, result.sensors[0].fitted) == ((), False)
    wrong = "the force by the prior matrix is opposite" if factor < 0.0 else "the prior's reading"
    messages = [message for message in result.warnings if wrong in message]
    assert messages == [f"SIM001: {result.sensors[0].reason}"]
    assert "[sensor]" in messages[0]
    assert "[robot]" not in messages[0] + result.sensors[0].reason
    assert not result.faults  # loads of rank 6 are held against each other without a prior
    with pytest.raises(FitError, match=wrong):
        run_workbench(path, full_matrix=True)


@some_cases("positions", [2, 7])
def test_an_undamaged_sensor_raises_no_warning(positions: int, undamaged: Workbench, tmp_path: Path) -> None:
    """Negative control, of few positions and of all: sensors are up to a fifth off the nominal matrix."""
    for seed in range(3):
        result = run_workbench(write_bench(tmp_path, seed=seed, positions=positions)[0])
        assert result.calibrations[0].warnings == ()
    assert undamaged.calibrations[0].warnings == ()


def test_readings_in_another_order_than_their_loads_are_refused(bench: Path, tmp_path: Path) -> None:
    """Such as files that were named in another order; two that are swapped are named instead."""
    for k in range(24):
        (tmp_path / f"SIM001_output{24 - k}.dat").write_bytes((bench.parent / f"SIM001_output{k + 1}.dat").read_bytes())
    for name in ("nominal.txt", "SIM001.toml"):
        (tmp_path / name).write_bytes((bench.parent / name).read_bytes())
    (row,) = run_workbench(tmp_path / "SIM001.toml").sensors
    assert "check that the readings are in the order of the loads" in row.reason


@pytest.mark.long
def test_five_directions_are_named_as_they_come(tmp_path: Path) -> None:
    """After seven positions the prior is kept in two directions; a full matrix is refused."""
    path, _ = write_bench(tmp_path, positions=7)
    (row,) = run_workbench(path).sensors
    assert row.rank == 4
    assert len(row.unmoved) == 2
    with pytest.raises(FitError, match="excite all 6 directions, got 4"):
        run_workbench(path, full_matrix=True)


@pytest.mark.long
@pytest.mark.parametrize("unit", ["s", "iso8601"])
def test_a_log_with_intervals_is_read_as_blocks(bench: Path, undamaged: Workbench, tmp_path: Path, unit: str) -> None:
    """The same samples as one log with time, in seconds or as dates."""
    rows, intervals = [], []
    for k in range(24):
        block = np.loadtxt(bench.parent / f"SIM001_output{k + 1}.dat")[:, 1:]
        start = 10.0 * k
        time = start + 0.1 * np.arange(len(block))
        rows.append(np.column_stack([time, block]))
        for position, begin, end in (("bias", start - 0.05, start + 3.95), (str(k + 1), start + 3.95, start + 7.95)):
            intervals.append(f'[[measurements.block]]\nposition = "{position}"\nstart_s = {begin}\nend_s = {end}\n')
    names = ["t", *(f"ch{k}" for k in range(6))]
    table = np.concatenate(rows)
    times = [f"{time:.4f}" for time in table[:, 0]]
    if unit == "iso8601":
        times = [str(np.datetime64("2026-11-23T10:00:00.000") + round(1e3 * time)) for time in table[:, 0]]
    lines = (
        f"{time},{','.join(f'{count:.4f}' for count in row)}\n" for time, row in zip(times, table[:, 1:], strict=True)
    )
    (tmp_path / "log.csv").write_text(f"{','.join(names)}\n{''.join(lines)}", encoding="utf-8")
    head, _, _ = bench.read_text(encoding="utf-8").partition("[measurements]")
    channels = ", ".join(f'"{name}"' for name in names[1:])
    (tmp_path / "nominal.txt").write_bytes((bench.parent / "nominal.txt").read_bytes())
    (tmp_path / "log.toml").write_text(
        f'{head}[measurements]\nformat = "log"\nfile = "log.csv"\ntime = "t"\ntime_unit = "{unit}"\n'
        f"channels = [{channels}]\n" + "".join(intervals),
        encoding="utf-8",
    )
    by_log, by_files = run_workbench(tmp_path / "log.toml").calibrations[0], undamaged.calibrations[0]
    difference = by_log.matrix @ np.linalg.inv(by_files.matrix) - np.eye(6)
    assert np.abs(difference[:3, :3]).max() < 0.002  # slow noise of the log is shared by blocks, of files it is not


@pytest.mark.long
def test_thirty_sensors_separate_the_bench_from_the_sensor() -> None:
    """Scatter by all of them; positions, spheres and unusual matrices."""
    drawn, _ = simulated_benches(30, 77)
    benches = [replace(simulated.bench, placement=None) for simulated in drawn]
    recordings = [BenchRecording.of(bench, measure_direction=MeasureDirection.CHILD_TO_PARENT) for bench in benches]
    result = workbench(recordings, code_version="0", created="2026-01-01")
    assert len(result.sensors) == len(result.unusual) == 30
    assert {row.scatter for row in result.sensors} == {"by 30 sensors"}
    assert [sphere.positions for sphere in result.spheres] == [16, 8]
    assert len(result.positions) == 24
    assert "matrices compared with the others" in result.text()


@pytest.mark.long
def test_acceptance_is_by_the_criteria_of_accept(bench: Path, tmp_path: Path) -> None:
    """Of the matrix and of the bench; what needs a robot is refused, and `accept` refuses the bench."""
    spec = tmp_path / "limits.toml"
    spec.write_text(
        'schema = "forcetorque/acceptance/1"\nname = "bench"\n[workbench]\nrank = 6\nfaults = 0\ninvalid_blocks = 0\n'
        "held_out = { fx = 0.001, fz = 5.0 }\n[matrix]\ncondition = 20.0\n[uncertainty]\nmatrix_relative = 0.05\n",
        encoding="utf-8",
    )
    result = workbench([read_bench(bench)], code_version="0", created="2026-01-01", spec=read_acceptance(spec))
    verdicts = {criterion.criterion: criterion.passed for criterion in result.criteria}
    assert verdicts == {
        "matrix.condition": True,
        "uncertainty.matrix_relative": True,
        "workbench.held_out.fx": False,
        "workbench.held_out.fz": True,
        "workbench.rank": True,
        "workbench.faults": True,
        "workbench.invalid_blocks": True,
    }
    spec.write_text(
        'schema = "forcetorque/acceptance/1"\nname = "robot"\n[evaluate]\nforce_error_mean_N = 1.0\n', encoding="utf-8"
    )
    with pytest.raises(ExperimentError, match=r"\[evaluate\] cannot be evaluated on a workbench"):
        workbench([read_bench(bench)], code_version="0", created="2026-01-01", spec=read_acceptance(spec))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("block_rows = 40", "block_rows = 50", "expected a block of 50 rows without load"),
        ('table = "thesis-6.1"', 'table = "none.csv"', "expected a table of loads"),
        ("[loads]\n", '[loads]\nleave_out = ["25"]\n', "loads.leave_out: no position '25'"),
        ('"ch5"]\nblock', '"ch6"]\nblock', "no column 'ch6'"),
        ("full_scale = 32767.0", "full_scale = [1.0, 2.0]", "a number for each of 6 channels, got 2"),
        ("_output{}.dat", "_output.dat", "for the number of the position"),
        ('prior = "nominal.txt"', 'prior = "none.txt"', "expected a calibration matrix file"),
        ("[sensor]", "[sensr]", "unknown key 'sensr'"),
        ("angle_deg = 0.1", "angle_deg = -0.1", "placement.angle_deg"),
    ],
)
def test_workbench_files_that_are_wrong(bench: Path, old: str, new: str, message: str) -> None:
    """Refused, with file and key."""
    text = bench.read_text(encoding="utf-8")
    assert old in text
    path = bench.with_name("wrong.toml")
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ForceTorqueError, match="wrong.toml") as refused:
        run_workbench(path)
    assert message in str(refused.value)


def test_two_files_of_one_sensor_are_refused(bench: Path) -> None:
    """And none at all."""
    with pytest.raises(ExperimentError, match="expected one file per sensor"):
        run_workbench(bench, bench)
    with pytest.raises(ExperimentError, match="at least one"):
        run_workbench()

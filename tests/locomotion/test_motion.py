# SPDX-License-Identifier: BSD-3-Clause
"""Motions are told by files and by arrays alike: oscillation, settling and tracking of any column."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, RecordingError, UnitError
from forcetorque.experiment.robot_and_streams import load_recorded
from forcetorque.locomotion.logged_signals import motion_signals, motion_signals_of_arrays
from forcetorque.locomotion.motion_quality import Motion, motion
from forcetorque.recording.named_columns import find_column
from tests.page_scripts import unmarked
from tests.scenes.swaying import OFFSET_NM, STEP_RAD, STEP_S, SWAY_HZ, SWAY_M, TORQUE_NM, write_swaying

ROOT = Path(__file__).resolve().parents[2]
REAL = ROOT / "examples" / "24_icub_com_sinusoid.toml"


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A robot that sways, without a force-torque sensor."""
    return write_swaying(tmp_path_factory.mktemp("swaying"))


@pytest.fixture(scope="module")
def swaying(log: Path) -> Motion:
    """What its columns do."""
    columns, desired = ["robot.position.knee", "robot.torque.knee"], ["position.knee_desired", "torque.knee_desired"]
    signals = motion_signals(log, ["com_x", "com_y"])
    signals += motion_signals(log, columns, desired=[f"robot.{name}" for name in desired])
    return motion(signals)


def test_a_swaying_column_is_told_from_one_that_does_not(swaying: Motion) -> None:
    """1.3 Hz and 4 mm in their intervals; no oscillation of x, with what would have been seen."""
    x, y = swaying.oscillations[:2]
    assert (x.column, x.oscillates, x.frequency_hz) == ("com_x", False, None)
    assert 0.0 < x.seen_amplitude < 0.004
    assert (y.column, y.oscillates, y.unit) == ("com_y", True, "m")
    assert y.frequency_hz == pytest.approx(SWAY_HZ, abs=y.frequency_half_width_95_hz)
    assert y.amplitude == pytest.approx(SWAY_M, abs=y.amplitude_half_width_95)
    assert y.damping == pytest.approx(0.0, abs=y.damping_half_width_95)
    text = str(swaying)
    assert "com_x: no oscillation from 0.11 to 49.83 Hz; a steady one of" in text


def test_a_step_of_the_command_is_found_and_its_settling_told(swaying: Motion) -> None:
    """exp(-3 t) about 0.3 rad: within 5 % after 0.91 s; with nothing left."""
    (row,) = swaying.settling
    assert (row.step_at_s, row.column) == (pytest.approx(STEP_S, abs=0.011), "robot.position.knee")
    assert row.step == pytest.approx(STEP_RAD, abs=0.002)
    late = np.arange(0.0, 5.0, 1e-3)
    left = np.abs(np.exp(-3.0 * late) * (np.cos(6.0 * late) + 0.5 * np.sin(6.0 * late)))
    true = late[np.flatnonzero(left > 0.05)[-1]]
    assert row.earliest_s <= true + 0.02
    assert row.latest_s is not None
    assert row.latest_s >= true - 0.02
    assert row.left_error == pytest.approx(0.0, abs=0.002)


def test_a_tracking_error_is_told_and_the_command_is_no_oscillation(swaying: Motion) -> None:
    """The torque swings because it should; its error does not, and has its root mean square."""
    tracked = next(row for row in swaying.tracking if row.column == "robot.torque.knee")
    assert tracked.rms_lower_95 < np.hypot(TORQUE_NM, OFFSET_NM) < tracked.rms_upper_95
    assert tracked.mean_error == pytest.approx(OFFSET_NM, abs=0.15)
    assert tracked.effective_samples < 0.2 * tracked.samples
    rows = {row.column: row for row in swaying.oscillations}
    assert rows["robot.torque.knee"].frequency_hz == pytest.approx(1.7 / (2.0 * np.pi), abs=0.01)
    assert not rows["robot.torque.knee - robot.torque.knee_desired"].oscillates
    assert any("no settling time" in words and "goes in steps" in words for words in swaying.warnings)


def test_arrays_give_the_same_as_the_file(log: Path, swaying: Motion) -> None:
    """No file is needed."""
    table = np.genfromtxt(log.parent / "log.csv", delimiter=",", names=True)
    signals = motion_signals_of_arrays(table["t"], {"com_y": table["com_y"]}, {"com_y": "m"})
    row = motion(signals).oscillations[0]
    assert row.frequency_hz == pytest.approx(swaying.oscillations[1].frequency_hz, rel=1e-9)
    assert row.amplitude == pytest.approx(swaying.oscillations[1].amplitude, rel=1e-6)
    assert {line["kind"] for line in swaying.records()} == {"oscillation", "settling", "tracking"}


def test_a_column_goes_by_the_shortest_name_that_is_its_own(log: Path) -> None:
    """`com_y`, `robot.com_y`, `robot.scalar.com_y`; `knee` is two."""
    recording = load_recorded(log).recording
    sources = {find_column(recording, name) for name in ("com_y", "robot.com_y", "robot.scalar.com_y")}
    assert len(sources) == 1
    with pytest.raises(
        RecordingError, match=r"expected one column, got robot.position.knee, robot.torque.knee; choose"
    ):
        find_column(recording, "knee")
    with pytest.raises(RecordingError, match=r"no column 'com_z'; did you mean .* known: .*robot.com_x \(m\)"):
        find_column(recording, "com_z")


@pytest.mark.parametrize(
    ("columns", "options", "message"),
    [
        (["still"], {}, "stand: still: expected a column that changes, got 0.1 in all of 3000 samples"),
        (["com_z"], {}, r"no column 'com_z'; did you mean"),
        ([], {}, r"expected a column, got none; known: robot.com_x \(m\), robot.com_y \(m\)"),
        (["com_y"], {"desired": ["torque.knee_desired"]}, "no column"),
        (["com_y"], {"desired": ["robot.torque.knee_desired"]}, "expected m, the unit of 'com_y', got N m"),
        (["com_y", "com_x"], {"desired": ["com_x"]}, "expected a column for each of com_y, com_x, or none, got com_x"),
        (["com_y"], {"intervals": ["walk"]}, "no interval is labelled 'walk'; known: stand"),
    ],
)
def test_what_is_not_there_is_refused(
    log: Path, columns: list[str], options: dict[str, list[str]], message: str
) -> None:
    """By name, with what there is and in which unit."""
    with pytest.raises(ForceTorqueError, match=message):
        motion(motion_signals(log, columns, **options))  # type: ignore[arg-type]


def test_bad_steps_and_arrays_are_refused(log: Path) -> None:
    """A step outside, a column without unit, something wanted of a column that is not there."""
    with pytest.raises(ExperimentError, match="step at 99 s: expected an instant within an interval"):
        motion(motion_signals(log, ["com_y"]), steps_s=[99.0])
    with pytest.raises(ExperimentError, match="expected a column at least"):
        motion([])
    with pytest.raises(UnitError, match="column 'x': expected its unit"):
        motion_signals_of_arrays([0.0], {"x": [0.0]}, {})
    with pytest.raises(ExperimentError, match="desired: no column 'y'"):
        motion_signals_of_arrays([0.0], {"x": [0.0]}, {"x": "m"}, desired={"y": [0.0]})


@pytest.mark.real_data
def test_a_real_robot_sways_with_one_frequency(data_dir: Path) -> None:
    """iCub: 0.199 Hz in the share of weight and in the base, 34 mm; no ZMP, as only vertical forces were logged."""
    if not (data_dir / "icub_genova04_walking_ramadoss").is_dir():
        pytest.skip("no recording of the sway")
    result = motion(motion_signals(REAL, ["share.l_sole", "base.y"]))
    share, base = result.oscillations  # one each
    for row in (share, base):
        assert row.frequency_hz == pytest.approx(0.199, abs=row.frequency_half_width_95_hz)
        assert row.frequency_half_width_95_hz < 0.006
        assert abs(row.damping) < row.damping_half_width_95
    # (left - right) / (left + right) is twice as much as left / (left + right)
    assert 2.0 * share.amplitude == pytest.approx(0.147, abs=2.0 * share.amplitude_half_width_95)
    assert base.amplitude == pytest.approx(0.034, abs=base.amplitude_half_width_95)
    assert any("the clock is uneven" in words for words in result.warnings)
    with pytest.raises(ExperimentError, match=r"no column 'zmp.y'; .*only the vertical forces .* not guessed"):
        motion_signals(REAL, ["zmp.y"])


def test_the_script_of_the_page_runs(log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """motion.md: a column of a file, and arrays."""
    monkeypatch.chdir(log.parent)
    (code,) = unmarked((ROOT / "docs" / "locomotion" / "motion.md").read_text(encoding="utf-8"))
    names: dict[str, object] = {}
    exec(compile(code, "motion.md", "exec"), names)
    assert isinstance(names["answer"], Motion)

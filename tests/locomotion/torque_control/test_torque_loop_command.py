# SPDX-License-Identifier: BSD-3-Clause
"""`torque_loop`: rows by size of error, the same again from the same seed, refusals of the file."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import ControlError, FormatError
from forcetorque.locomotion.commands import torque_loop
from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile, read_torque_loop
from forcetorque.locomotion.torque_control.torque_loop_study import TorqueLoopStudy
from tests.app.outcome import Run
from tests.page_scripts import unmarked

pytest.importorskip("mujoco")

SMALL = """\
schema = "forcetorque/torque_loop_file/1"
seeds = 2
scales = [2.0]
tilt_deg = [0.0]
errors = { workbench = 0.054 }
[motion]
hold_s = 0.1
shift_s = 0.8
single_s = 0.3
lift_m = 0.02
"""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short motion, two draws of one error."""
    path = tmp_path_factory.mktemp("loop") / "loop.toml"
    path.write_text(SMALL, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def loop(file: Path) -> TorqueLoopStudy:
    """Its result."""
    return torque_loop(read_torque_loop(file))


@pytest.mark.long
def test_errors_cost_tracking(loop: TorqueLoopStudy) -> None:
    """The robot without E tracks better than the one with; rows say of what size it is under the weight."""
    none, some = loop.rows
    assert (none.errors, none.scale, none.force_error_N, none.runs) == ("none", 0.0, 0.0, 2)
    assert some.force_error_N == pytest.approx(2.0 * 0.054 * loop.weight_N)
    assert some.tracking_rms_Nm > 2.0 * none.tracking_rms_Nm
    assert none.falls == 0
    assert [row.support for row in loop.onsets] == ["both feet", "the left foot", "the right foot"]
    assert all(row.least_scale is None or row.least_scale > 0.5 for row in loop.onsets)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("seeds = 1\n", "seeds"),
        ("[estimator]\ndelay_s = 0.0015\n", "expected a whole number of periods of the controller, 1 ms, got 1.5"),
        ("[estimator]\ndelay_s = 1e306\n", "loop.toml: estimator.delay_s"),
        ("[estimator]\nrate_hz = 1e-306\n", "loop.toml: estimator.rate_hz"),
        ("tilt_deg = [30.0]\n", "tilt_deg"),
        ("[drive]\nstiction = 1.0\n", "stiction"),
    ],
)
def test_a_wrong_file_is_one_line(tmp_path: Path, text: str, message: str) -> None:
    """Too few draws, steps that are none, soles steeper than ankles go, unknown keys."""
    path = tmp_path / "loop.toml"
    path.write_text('schema = "forcetorque/torque_loop_file/1"\n' + text, encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        read_torque_loop(path)


@pytest.mark.long
def test_gains_that_are_unstable_alone_are_refused() -> None:
    """By the linear loop, before anything is simulated."""
    with pytest.raises(ControlError, match="unstable without any sensor error"):
        torque_loop(TorqueLoopFile(gain_factors=(6.0,)))


@pytest.mark.long
def test_it_is_typed(
    loop: TorqueLoopStudy, run: Run, file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The command asks what Python asks, shows it and draws it."""
    asked = []

    def answer(content: TorqueLoopFile, *_: object) -> TorqueLoopStudy:
        asked.append(content)
        return loop

    monkeypatch.setattr("forcetorque.locomotion.torque_control.torque_loop_study.study_torque_loop", answer)
    typed = run("robot", "torque-loop", file, "--figure", tmp_path / "loop.png", "--format", "json")
    assert asked == [read_torque_loop(file)]
    assert len(typed.result()["rows"]) == len(loop.rows)
    assert (tmp_path / "loop.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.long
def test_the_script_of_the_page_runs() -> None:
    """As it stands."""
    (code,) = unmarked(
        (Path(__file__).resolve().parents[3] / "docs" / "locomotion" / "torque_loop.md").read_text(encoding="utf-8")
    )
    exec(compile(code, "torque_loop.md", "exec"), {})

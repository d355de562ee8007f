# SPDX-License-Identifier: BSD-3-Clause
"""`oscillation-causes`: stiff springs change nothing; causes are counted where small errors hardly oscillate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ControlError
from forcetorque.locomotion.commands import oscillation_causes
from forcetorque.locomotion.torque_control.balancing_controller import Phase, standing
from forcetorque.locomotion.torque_control.biped_in_mujoco import JOINTS, SENSORS, Biped
from forcetorque.locomotion.torque_control.linear_robot import linear_robot, massless_drives, with_springs
from forcetorque.locomotion.torque_control.oscillation_causes import (
    TORQUES,
    CauseRow,
    OscillationCauses,
    _Cause,
    _row,
    study_causes,
)
from forcetorque.locomotion.torque_control.stability import Stability
from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile, read_torque_loop
from forcetorque.locomotion.torque_control.torque_loop_study import share_interval
from forcetorque.results.answer import Concern
from tests.app.outcome import Run


def cause_row(
    cause: str, larger: int, *, in_file: int = 0, loop: str = TORQUES, frequency_hz: float = 15.0, draws: int = 20
) -> CauseRow:
    """A cause with so many of 20 draws."""
    return CauseRow(
        loop=loop,
        tilt_deg=0.0,
        cause=cause,
        value=1.0,
        limit=26.0,
        at=20.0,
        larger=larger,
        larger_least_percent=share_interval(larger, draws)[0],
        larger_most_percent=share_interval(larger, draws)[1],
        smaller=1,
        smaller_most_percent=share_interval(1, draws)[1],
        draws=draws,
        in_file=in_file,
        median_limit=18.0,
        frequency_hz=frequency_hz,
    )


def causes_of(*rows: CauseRow) -> OscillationCauses:
    """A result."""
    return OscillationCauses(name="loop", larger="workbench", smaller="in situ", rows=rows)


def test_the_cause_that_tells_errors_apart_comes_first() -> None:
    """With both counts; the others follow; a loop in which none does says so."""
    causes = causes_of(
        cause_row("gains", 12),
        cause_row("friction", 3),
        cause_row("delay, ms", 15),
        cause_row("K_zmp", 0, loop="point"),
    )
    first, second = causes.answers()
    assert first.verdict == "OSCILLATES: 15 of 20 at delay 20 ms with errors 'workbench', 1 with 'in situ'"
    assert first.why[1] == "then 12 of 20 at gains 20"
    assert second.verdict.startswith("NO CAUSE makes errors 'workbench' oscillate")
    assert {first.concern, second.concern} == {Concern.NONE}
    (answer,) = causes_of(cause_row("delay, ms", 15, in_file=2)).answers()
    assert answer.concern is Concern.UNCERTAIN


def test_a_mode_without_a_frequency_is_a_fall() -> None:
    """What grows without swinging does not oscillate."""
    (answer,) = causes_of(cause_row("gains", 15, frequency_hz=0.0)).answers()
    assert answer.verdict.startswith("FALLS: 15 of 20 at gains 20")


def test_one_size_of_errors_is_refused() -> None:
    """There is nothing to compare."""
    with pytest.raises(ControlError, match="expected at least two sizes to compare, got bench"):
        study_causes(TorqueLoopFile(errors={"bench": 0.01}), lambda _: None)


def test_a_whole_value_is_counted_where_it_is_reported() -> None:
    """Draws that are stable up to 20 ms, and unstable from 21 ms on, are not counted at 20 ms."""

    def stability(value: float, matrix: np.ndarray) -> Stability:
        return Stability(growth=value - (matrix[0, 0, 0] or 25.5), frequency_hz=5.0)

    cause = _Cause(
        loop=TORQUES, name="delay, ms", value=1.0, grid=np.arange(1.0, 31.0), stability=stability, whole=True
    )
    sizes = [np.full((20, 4, 6, 6), value) for value in (10.5, 20.5)]
    row = _row(cause, 0.0, larger=sizes[0], smaller=sizes[1], chosen=sizes[1])
    assert (row.limit, row.at, row.larger, row.smaller) == (26.0, 20.0, 20, 0)


@pytest.mark.long
def test_stiff_springs_are_no_springs() -> None:
    """The slowest mode is that of rigid joints; springs of 300 N m/rad are unstable."""
    pytest.importorskip("mujoco")
    biped, file = Biped.on_soles(), TorqueLoopFile()
    setting = file.setting(biped, 1.0)
    still = standing(biped, Phase.LEFT, 2, 0.03, setting.period_s)
    none = np.zeros((len(SENSORS), 6, 6))
    rigid = linear_robot(biped, setting, still, 0).stability(none)
    links = massless_drives(biped, setting, still, 0)
    stiff = with_springs(links, np.full(len(JOINTS), 1e6)).stability(none)
    assert stiff.growth == pytest.approx(rigid.growth, rel=2e-4)
    assert stiff.frequency_hz == pytest.approx(rigid.frequency_hz, rel=2e-4)
    assert not with_springs(links, np.full(len(JOINTS), 300.0)).stability(none).stable


@pytest.mark.long
def test_causes_are_counted_below_the_limit() -> None:
    """A delay near the limit is a cause, the compensation of friction is not; with the values of the file it stands."""
    pytest.importorskip("mujoco")
    causes = oscillation_causes(TorqueLoopFile(seeds=10, tilt_deg=(0.0,)))
    rows = {row.cause: row for row in causes.rows}
    delay, friction = rows["delay of the estimate, ms"], rows["compensation of viscous friction"]
    assert delay.at is not None
    assert delay.limit is not None
    assert delay.value < delay.at <= delay.limit
    assert delay.larger > delay.smaller
    assert delay.larger > friction.larger
    assert sum(row.in_file for row in causes.rows) == 0


def test_it_is_typed(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The command asks what Python asks, shows it and draws it."""
    path, asked = tmp_path / "loop.toml", []
    path.write_text('schema = "forcetorque/torque_loop_file/1"\nseeds = 12\n', encoding="utf-8")
    causes = causes_of(cause_row("delay, ms", 15))

    def answer(content: TorqueLoopFile, *_: object) -> OscillationCauses:
        asked.append(content)
        return causes

    monkeypatch.setattr("forcetorque.locomotion.torque_control.oscillation_causes.study_causes", answer)
    figure = tmp_path / "causes.png"
    typed = run("robot", "oscillation-causes", path, "--figure", figure, "--format", "json").result()
    assert asked == [read_torque_loop(path)]
    assert typed["rows"] == causes.model_dump(mode="json")["rows"]
    assert figure.read_bytes().startswith(b"\x89PNG")


@pytest.mark.long
def test_a_loop_that_is_unstable_alone_is_refused() -> None:
    """By its own limit: there is nothing to worsen."""
    pytest.importorskip("mujoco")
    with pytest.raises(ControlError, match="stable without any sensor error"):
        oscillation_causes(TorqueLoopFile.model_validate({"seeds": 2, "walking": {"sway_hz": 8.0}}))

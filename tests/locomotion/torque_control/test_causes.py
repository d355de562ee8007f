# SPDX-License-Identifier: BSD-3-Clause
"""`oscillation-causes`: stiff springs change nothing; causes are counted where small errors hardly oscillate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ControlError
from forcetorque.locomotion.commands import oscillation_causes
from forcetorque.locomotion.torque_control.balancing import Phase, standing
from forcetorque.locomotion.torque_control.causes import TORQUES, CauseRow, OscillationCauses
from forcetorque.locomotion.torque_control.elastic_joints import massless_drives, with_springs
from forcetorque.locomotion.torque_control.file import TorqueLoopFile, read_torque_loop
from forcetorque.locomotion.torque_control.linear_robot import linear_robot
from forcetorque.locomotion.torque_control.world import JOINTS, SENSORS, Biped
from forcetorque.results.answer import Concern
from tests.app.outcome import Run


def cause_row(cause: str, larger: int, *, in_file: int = 0, loop: str = TORQUES) -> CauseRow:
    """A cause with so many of 20 draws."""
    return CauseRow(
        loop=loop,
        tilt_deg=0.0,
        cause=cause,
        value=1.0,
        limit=26.0,
        at=20.0,
        larger=larger,
        larger_least_percent=1.0,
        larger_most_percent=90.0,
        smaller=1,
        smaller_most_percent=25.0,
        draws=20,
        in_file=in_file,
        median_limit=18.0,
        frequency_hz=15.0,
    )


def causes_of(*rows: CauseRow) -> OscillationCauses:
    """A result."""
    return OscillationCauses(name="loop", larger="workbench", smaller="in situ", rows=rows)


def test_the_cause_that_tells_errors_apart_comes_first() -> None:
    """With both counts; the others follow; a loop in which none does says so."""
    causes = causes_of(cause_row("gains", 3), cause_row("delay, ms", 15), cause_row("K_zmp", 0, loop="point"))
    first, second = causes.answers()
    assert first.verdict == "OSCILLATES: 15 of 20 at delay 20 ms with errors 'workbench', 1 with 'in situ'"
    assert first.why[1] == "then 3 of 20 at gains 20"
    assert second.verdict.startswith("NO CAUSE makes errors 'workbench' oscillate")
    assert {first.concern, second.concern} == {Concern.NONE}
    (answer,) = causes_of(cause_row("delay, ms", 15, in_file=2)).answers()
    assert answer.concern is Concern.UNCERTAIN


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

    monkeypatch.setattr("forcetorque.locomotion.torque_control.causes.study_causes", answer)
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

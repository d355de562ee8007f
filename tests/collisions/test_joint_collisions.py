# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of an arm by joint torques: the observer against MuJoCo, pushes, free motion, refusals, the command."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.collisions.collisions_by_joint_torques import find_joint_collisions
from forcetorque.collisions.momentum_observer import ArmMotion, external_torque, low_passed
from forcetorque.collisions.result import JointCollisions, TorqueContactRow
from forcetorque.experiment.loading import Purpose, load_experiment
from tests.app.outcome import Run

pytest.importorskip("mujoco")

from tests.collisions.simulated_franka import (
    LINKS,
    PUSH_S,
    Push,
    pushes,
    true_torques,
    write_arm,
)

FREE_S, DURATION_S = 48.0, 59.0
PLANTED = (
    Push(start_s=50.0, link="link7", force_N=15.0),
    Push(start_s=53.0, link="link4", force_N=25.0),
    Push(start_s=56.0, link="link5", force_N=15.0),
)


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Friction that no model states, masses that are off by 2 %, noise, and three pushes."""
    return write_arm(tmp_path_factory.mktemp("arm"), 3, DURATION_S, PLANTED, free_s=FREE_S)


def _found(file: Path, alarms_per_hour: float = 1.0) -> JointCollisions:
    experiment = load_experiment(file, Purpose.MOTION)
    return find_joint_collisions(experiment, ("watched",), ("free",), alarms_per_hour)


@pytest.fixture(scope="module")
def result(arm: Path) -> JointCollisions:
    """What is found."""
    return _found(arm)


def _of(push: Push, contacts: tuple[TorqueContactRow, ...]) -> list[TorqueContactRow]:
    return [row for row in contacts if row.start_s < push.start_s + PUSH_S + 0.2 and row.end_s > push.start_s]


def test_the_observer_gives_the_torques_of_the_push(tmp_path: Path) -> None:
    """Without friction, noise and wrong masses: J^T F by MuJoCo, filtered alike; within 2 % of the largest."""
    push = Push(start_s=3.0, link="link6", force_N=20.0)
    file = write_arm(tmp_path, 4, 5.0, (push,), free_s=2.0, mass_error=0.0, friction=0.0, noise=0.0)
    experiment = load_experiment(file, Purpose.MOTION)
    watched = next(one for one in experiment.recording.intervals if one.label == "watched")
    motion = ArmMotion.of(experiment, watched)
    observed = external_torque(motion, 15.0)
    time_s, truth = true_torques(tmp_path)
    # the observer takes the mean of the ends of each step
    means = np.vstack([truth[:1], 0.5 * (truth[1:] + truth[:-1])])
    expected = low_passed(time_s, means, 15.0)[np.searchsorted(time_s, motion.time_s - 1e-6)]
    assert np.abs(expected).max() > 5.0
    assert observed[20:] == pytest.approx(expected[20:], abs=0.02 * np.abs(expected).max())
    # negative control: without the slope of the kinetic energy or with its sign turned it is no longer so at rest
    quiet = np.abs(expected).max(axis=1) < 1e-9
    quiet[:20] = False
    turned = replace(motion, torque=motion.torque - 2.0 * motion.energy_slope())
    assert np.abs(external_torque(turned)[quiet]).max() > 10.0 * np.abs(observed[quiet]).max()


def test_pushes_are_noticed_on_their_link_or_before_it(result: JointCollisions) -> None:
    """Each is one contact; the outermost joint that shows it is not beyond the link that was pushed."""
    assert len(result.contacts) == len(PLANTED)
    for push in PLANTED:
        (row,) = _of(push, result.contacts)
        assert LINKS.index(row.link) <= LINKS.index(push.link)
        assert row.over_threshold > 1.0
        assert abs(row.torque_Nm) > row.half_width_95_Nm


@pytest.mark.long
def test_a_higher_rate_of_alarms_has_lower_thresholds(arm: Path, result: JointCollisions) -> None:
    """Of every joint; with thousands an hour there are contacts beside the pushes, the negative control."""
    loose = _found(arm, 3600.0)
    assert all(a.threshold_Nm > b.threshold_Nm for a, b in zip(result.joints, loose.joints, strict=True))
    assert len(loose.contacts) > len(PLANTED)


def test_friction_is_explained_and_not_noticed(result: JointCollisions) -> None:
    """It is several times what is left over, joint by joint."""
    joints = result.joints
    assert len(joints) == 7
    assert all(row.explained_Nm > 2.0 * row.noise_Nm for row in joints)


def test_what_cannot_be_computed_is_refused(arm: Path, tmp_path: Path) -> None:
    """No torque, too little free time, a base that moves, a wrong rate, no such interval."""
    text = arm.read_text(encoding="utf-8")
    log, urdf = (arm.parent / name for name in ("log.csv", "arm.urdf"))
    for name in (log, urdf):
        (tmp_path / name.name).write_bytes(name.read_bytes())
    line = next(line for line in text.splitlines() if 'quantity = "torque"' in line)
    cases = (
        (text.replace(line + "\n", ""), "expected joint torques"),
        (text.replace(f"end_s = {FREE_S}", "end_s = 10.0"), "expected at least 45 s in which nothing touches"),
    )
    for changed, message in cases:
        file = tmp_path / "arm.toml"
        file.write_text(changed, encoding="utf-8")
        with pytest.raises(ExperimentError, match=message):
            _found(file)
    experiment = load_experiment(arm, Purpose.MOTION)
    with pytest.raises(ExperimentError, match="alarms per hour: expected a number above 0"):
        find_joint_collisions(experiment, (), (), 0.0)
    with pytest.raises(ExperimentError, match="no interval is labelled 'nowhere'"):
        find_joint_collisions(experiment, ("nowhere",), (), 1.0)


def test_the_command(arm: Path, run: Run, tmp_path: Path) -> None:
    """The count and the clearest contact first, and a figure."""
    words = ("robot", "joint-collisions", arm, "--interval", "watched", "--free", "free")
    shown = run(*words, "--figure", tmp_path / "torques.png", "--details")
    assert shown.code == 0, shown.err
    assert "3 CONTACTS in" in shown.out
    assert (tmp_path / "torques.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.long
def test_rates_of_pushes_and_of_false_alarms(tmp_path: Path) -> None:
    """Four arms that were not used for development, two minutes each with pushes and without: both kinds of errors."""
    sizes = (2.0, 5.0, 10.0, 20.0, 40.0)
    noticed, planted, right = dict.fromkeys(sizes, 0), dict.fromkeys(sizes, 0), 0
    false, watched_s = dict.fromkeys((1.0, 60.0, 360.0), 0), 0.0
    for seed in range(21, 25):
        drawn = pushes(seed, 120.0, 62.0, sizes)
        result = _found(write_arm(tmp_path / "pushed", seed, 120.0, drawn, free_s=60.0))
        for push in drawn:
            rows = _of(push, result.contacts)
            planted[push.force_N] += 1
            noticed[push.force_N] += bool(rows)
            right += bool(rows) and LINKS.index(rows[0].link) <= LINKS.index(push.link)
        file = write_arm(tmp_path / "free", seed, 120.0, (), free_s=60.0)
        for rate in false:
            free = _found(file, rate)
            false[rate] += len(free.contacts)
        watched_s += free.looked_at_s
    text = f"{noticed} of {planted}, {right} right, {false} false in {watched_s:.0f} s"
    assert list(planted.values()) == [12, 12, 12, 12, 8], text
    assert list(noticed.values()) == [7, 10, 12, 12, 8], text
    assert right == sum(noticed.values()), text
    # 0.07, 3.9 and 23.6 are expected at the stated rates, in 0.065 h
    assert false == {1.0: 0, 60.0: 1, 360.0: 23}, text

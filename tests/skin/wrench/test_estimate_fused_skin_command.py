# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate --fuse` with skin, as a user writes the file: all sources, some of them, and a broken one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import summarise_estimates
from forcetorque.estimation.skin_contacts import clock_stream, frames_of_patches
from forcetorque.estimation.torque.experiment_fusion import fuse_experiment
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.skin.section import force_patches
from forcetorque.skin.wrench.skin_wrench import PatchFrames
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.moving_leg import CURRENT, DRIVEN, FILE, FT, RATE_HZ, SKIN, Faults, changed, write_moving_leg

HOT_COUNTS = 5.0
"""What heat of some 4 degrees takes from the taxels of one side."""
ERROR_NM = 0.35
"""Largest root mean square error of a sound source: skin lags by 0.2 s while an object of 20 N is put down in 0.5 s."""

OFFSET = "samples of a calibration interval, and the offset of knee_ft is taken there as if nothing touched"

Leg = tuple[Path, Simulation]


@pytest.fixture(scope="module", name="sound")
def sound_leg(tmp_path_factory: pytest.TempPathFactory) -> Leg:
    """A leg whose sources are as stated, and its truth."""
    folder = tmp_path_factory.mktemp("sound")
    return folder, write_moving_leg(folder)


@pytest.fixture(scope="module", name="patches")
def read_patches(sound: Leg) -> Sequence[PatchFrames]:
    """What its skin says; read once, as surfaces are built slowly."""
    return frames_of_patches(load_experiment(sound[0] / FILE, Purpose.FORCES))


def test_all_sources_stand_beside_each_other_and_together(run: Run, sound: Leg) -> None:
    """Each tells the torques of the hip; together they are not in conflict."""
    folder, truth = sound
    output = folder / "torques.parquet"
    outcome = run("estimate", str(folder / FILE), "--fuse", "-o", str(output), "--format", "json")
    result = outcome.result()
    assert not any(OFFSET in line for line in outcome.log)
    judged = [row for row in result["fusion"]["sources"] if row["interval"] == "judge"]
    assert [row["source"] for row in judged] == ["ft", "skin", "current"]
    assert {row["verdict"] for row in judged} == {"used"}
    table = pq.read_table(output)
    late = np.array(table["interval"]) == "judge"
    rows = np.rint(np.array(table["time_s"])[late] * RATE_HZ).astype(int)
    checked = 0
    for name in ("ft", "skin", "current", "fused"):
        for joint in DRIVEN:
            told = np.array(table[f"torque_{name}.{joint}"])[late]
            assert np.sqrt(np.nanmean((told - truth.torque(joint)[rows]) ** 2)) < ERROR_NM
            checked += 1
    assert checked == 8
    # negative control: what is told differs by far more over the interval
    assert np.ptp(truth.torque("hip_pitch")[rows]) > 10.0 * ERROR_NM


@some_cases(
    ("without", "names"),
    [
        ((CURRENT,), ("ft", "skin")),
        ((SKIN,), ("ft", "current")),
        ((FT,), ("skin", "current")),
    ],
    ids=["FT and skin", "FT and current", "skin and current"],
)
def test_any_two_sources_are_fused(
    without: tuple[str, ...], names: tuple[str, ...], sound: Leg, patches: Sequence[PatchFrames]
) -> None:
    """What the file does not state is not asked: friction of motors is fitted to skin where no sensor is."""
    folder, truth = sound
    experiment = load_experiment(changed(folder, "some.toml", *((text, "") for text in without)), Purpose.FORCES)
    own = patches if "skin" in names else ()
    (_, judge), _ = fuse_experiment(experiment, corrections_of(experiment, {}), patches=own)
    assert tuple(source.name for source in judge.sources) == names
    assert not judge.fusion.conflict.is_there
    column = judge.fusion.joints.index("hip_pitch")
    rows = np.searchsorted(clock_stream(experiment).stamp_ns, judge.fusion.stamp_ns)
    error = judge.fusion.torque[:, column] - truth.torque("hip_pitch")[rows]
    assert np.sqrt(np.nanmean(error**2)) < ERROR_NM


def test_a_contact_where_the_offset_is_taken_is_warned_of(sound: Leg, patches: Sequence[PatchFrames]) -> None:
    """Nothing may touch in a calibration interval unless a calibration gives the offset of the sensor."""
    folder, _ = sound
    spans = ("end_s = 9.0", "end_s = 11.0"), ("start_s = 9.0", "start_s = 11.0")
    experiment = load_experiment(changed(folder, "touched.toml", *spans), Purpose.FORCES)
    corrections = corrections_of(experiment, {})
    spans_told = estimate_experiment(experiment, corrections, patches=patches)
    warnings = summarise_estimates(experiment, corrections, spans_told).warnings
    assert any(line.startswith("fit: skin is touched in ") and OFFSET in line for line in warnings)


@pytest.mark.long
def test_hot_skin_is_named(run: Run, tmp_path: Path) -> None:
    """In the interval in which it is hot, and left out of it; others are used."""
    write_moving_leg(tmp_path, faults=Faults(hot_counts=HOT_COUNTS))
    output = tmp_path / "torques.parquet"
    result = run("estimate", str(tmp_path / FILE), "--fuse", "-o", str(output), "--format", "json")
    verdicts = {(row["interval"], row["source"]): row["verdict"] for row in result.result()["fusion"]["sources"]}
    assert verdicts.pop(("judge", "skin")) == "in conflict, left out"
    assert len(verdicts) == 5
    assert set(verdicts.values()) == {"used"}
    assert any("judge: source skin is in conflict, left out" in words for words in result.log)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ((("friction = 0.1\n", ""),), "contact 'shank 1': expected friction"),
        ((("[fusion]\nmodel_deviation = 0.02\n", ""),), r"expected \[fusion\] with model_deviation"),
        (((FT, ""), (CURRENT, "")), "expected two sources of joint torques at least, got skin"),
        (((SKIN, SKIN + '\n[[contact]]\nframe = "foot"\n'),), "skin determines torques of joints only if it feels all"),
    ],
)
def test_what_skin_lacks_as_a_source_is_asked_for(
    changes: tuple[tuple[str, str], ...], words: str, sound: Leg, patches: Sequence[PatchFrames]
) -> None:
    """By its key in the file, with the interval that it is about."""
    experiment = load_experiment(changed(sound[0], "lacking.toml", *changes), Purpose.FORCES)
    own = [replace(frames, patch=patch) for frames, patch in zip(patches, force_patches(experiment), strict=True)]
    with pytest.raises(ForceTorqueError, match=words):
        fuse_experiment(experiment, corrections_of(experiment, {}), patches=own)

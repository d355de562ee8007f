# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate` with skin: what it finds, also without a sensor, and what it refuses."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import Loading
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.robot.mechanics.simulated import Simulation
from tests.scenes.skinned_leg import FILE, write_leg

Leg = tuple[Sequence[ContactTruth], Simulation]
START_S = 3.0
"""Beginning of the interval."""


@pytest.fixture(scope="module", name="made")
def made_folder(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Leg]:
    """Folder with a leg that objects rest on."""
    folder = tmp_path_factory.mktemp("leg")
    return folder, write_leg(folder)


@pytest.fixture(name="leg")
def calibrated(made: tuple[Path, Leg], run: Run, monkeypatch: pytest.MonkeyPatch) -> Leg:
    """The truth; the calibration of the skin is beside the recording, in the working folder."""
    folder, leg = made
    monkeypatch.chdir(folder)
    if not (folder / "shank.json").exists():
        assert run("skin", "calibrate", "bag.toml", "-o", "shank.json").code == 0
    return leg


def _changed(name: str, *changes: tuple[str, str]) -> str:
    text = Path(FILE).read_text(encoding="utf-8")
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    Path(name).write_text(text, encoding="utf-8")
    return name


WITHOUT_SENSOR = (
    ('[[sensor]]\nname = "knee_ft"\nstream = "knee_ft"\nserial = "F1"\nprior = "identity"\n', ""),
    ('[[contact]]\nframe = "foot"\n', ""),
)


@some_cases("changes", [(), WITHOUT_SENSOR], ids=["one sensor", "no sensor"])
def test_torques_are_told_with_and_without_a_sensor(
    changes: tuple[tuple[str, str], ...], run: Run, leg: Leg, tmp_path: Path
) -> None:
    """While objects rest, the hip bears what it truly does; where nothing is pressed no cell claims a contact."""
    file = tmp_path / "estimates.parquet"
    result = run("estimate", _changed("tried.toml", *changes), "-o", str(file), "--format", "json").result()
    table = pq.read_table(file)
    truths, simulation = leg
    rows = slice(150, 150 + len(table))  # the interval begins 3 s after the recording, at 50 messages a second
    hip, true = np.array(table["torque.hip"]), simulation.torque("hip")[rows]
    assert table["time_s"][0].as_py() == pytest.approx(START_S)
    looked = 0
    loading = Loading()
    for number, truth in enumerate(truths):
        middle = loading.rest_s + number * loading.turn_s + loading.ramp_s + loading.hold_s / 2.0
        row = round((middle - START_S) * 50)
        assert not changes or 0.0 < np.array(table["sd.torque.hip"])[row] < 0.1
        # the object's moment about the hip is some newton metres
        assert hip[row] == pytest.approx(true[row], abs=0.15 * abs(true[row] - true[0]) + 0.05)
        there = [k for k in (1, 2) if table.column_names.count(f"centre.shank {k}.x")]
        for axis, push in zip(("fx", "fy", "fz"), truth.wrench[:3], strict=True):
            told = sum(np.array(table[f"contact.shank {k}.{axis}"])[row] for k in there)
            assert told == pytest.approx(push, abs=0.2 * truth.load_N)
        looked += 1
    assert looked == len(truths)
    assert {row["contact"] for row in result["skin"]} >= {"shank 1"}
    assert all(table["determined"].to_pylist())
    # the sensor is stated without errors; without it nothing but the model says what an untouched leg bears
    touched = np.any([table[f"centre.shank {k}.x"].is_valid() for k in (1, 2)], axis=0)
    unknown = np.array([deviation is None for deviation in table["sd.torque.hip"].to_pylist()])
    assert unknown.all() if not changes else unknown.any() and not unknown[touched].any(), unknown.sum()
    numbers = [np.array(table[f"identity.shank {k}"].drop_null()) for k in (1, 2)]
    assert table["identity.shank 1"].null_count == table["centre.shank 1.x"].null_count
    # every object is a contact of its own, and what it was when it was put down as long as it rests
    assert len(truths) <= len(np.unique(np.concatenate(numbers))) <= len(truths) + 2
    assert (np.diff(numbers[0]) >= 0).all()
    empty = table["centre.shank 1.x"].null_count
    assert 0 < empty < len(table)


@pytest.mark.long
def test_friction_widens_what_is_told(run: Run, leg: Leg) -> None:
    """A coefficient gives wider intervals; without one, and something else at the foot, those cells are empty."""
    sharp = run("estimate", FILE, "-o", "sharp.parquet", "--format", "json").result()
    wide = run(
        "estimate",
        _changed("wide.toml", ("friction = 0.0", "friction = 0.3")),
        "-o",
        "wide.parquet",
        "--format",
        "json",
    ).result()
    assert wide["skin"][0]["force_sd_N"] > 2.0 * sharp["skin"][0]["force_sd_N"]
    free = _changed("free.toml", ("friction = 0.0\n", ""))
    outcome = run("estimate", free, "-o", "free.parquet", "--format", "json")
    assert outcome.result()["skin"][0]["force_mean_N"] is None
    assert any("not determined in" in words and "at 'foot'" in words for words in outcome.log)
    table = pq.read_table("free.parquet")
    told, foot = np.array(table["determined"]), np.array(table["contact.foot.fx"])
    assert (np.isnan(foot) == ~told).all()
    assert 0 < told.sum() < len(told)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('name = "shank"', 'name = "shank"\nlink = "shin"', "patch 'shank': expected the link .* got 'shin'"),
        ("friction = 0.0", "friction = -0.1", "friction"),
        ("friction = 0.0", "friction = 0.0\noldest_s = 0.05", "at most 0.05 s older than the pose, got 0.19 s"),
        ("start_s = 3.0", "start_s = 0.0", "expected a frame of pressures before sample 0"),
        ('table = "shank.json"', 'table = "none.json"', "none.json: expected a calibration of taxels"),
    ],
)
def test_what_cannot_be_is_refused(old: str, new: str, words: str, run: Run, leg: Leg) -> None:
    """In one line that says where and what to do."""
    name = _changed("refused.toml", (old, new))
    error = run("estimate", name, "-o", "refused.parquet").error()
    assert words.split(" .* ")[0] in error
    assert words.split(" .* ")[-1] in error
    assert name in error or "none.json" in error
    assert not Path("refused.parquet").exists()


@pytest.mark.long
def test_a_message_beyond_the_range_is_said(run: Run, leg: Leg) -> None:
    """A calibration up to a low pressure makes every contact doubtful."""
    assert run("skin", "calibrate", "bag.toml", "-o", "low.json", "--highest-kpa", "7").code == 0
    low = run("estimate", _changed("low.toml", ("shank.json", "low.json")), "-o", "low.parquet", "--format", "json")
    assert low.result()["skin"][0]["beyond_range"] > 0
    assert any("presses a taxel beyond what it was calibrated for" in words for words in low.log)

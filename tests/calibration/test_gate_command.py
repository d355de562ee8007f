# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate` on models that are wrong: refused, with nothing written, or doubted."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit, snapshot

Damage = Callable[[Path], object]


def _masses(factor: float) -> Damage:
    def damage(arm: Path) -> None:
        urdf = arm / "arm.urdf"
        pattern = r"""(?<=<mass value=["'])[^"']*"""
        text, count = re.subn(pattern, lambda match: repr(factor * float(match[0])), urdf.read_text(encoding="utf-8"))
        assert count == 7
        urdf.write_text(text, encoding="utf-8")

    return damage


def _recorded(change: Callable[[Recording], Recording]) -> Damage:
    def damage(arm: Path) -> None:
        recording = change(read_recording(arm / "recording"))
        shutil.rmtree(arm / "recording")
        write_recording(arm / "recording", recording)

    return damage


def _joints_times(factor: float) -> Damage:
    def change(recording: Recording) -> Recording:
        joints = recording.streams["joints"]
        signals = {name: replace(signal, values=factor * signal.values) for name, signal in joints.signals.items()}
        return replace(recording, streams={**recording.streams, "joints": replace(joints, signals=signals)})

    return _recorded(change)


def _sensor_later(seconds: float) -> Damage:
    def change(recording: Recording) -> Recording:
        sensor = recording.streams["arm_ft"]
        later = replace(sensor, stamp_ns=sensor.stamp_ns + round(seconds * 1e9))
        return replace(recording, streams={**recording.streams, "arm_ft": later})

    return _recorded(change)


REFUSED: dict[str, tuple[Damage, str]] = {
    "masses in grams": (_masses(1e3), r"are the masses in grams .* urdf of \[robot\]"),
    "half the mass": (_masses(0.5), r"does the model have half of the true mass\? .* urdf of \[robot\]"),
    "massless": (_masses(0.0), r"the model has no mass beyond the sensor"),
    "joints in degrees called radians": (_joints_times(np.degrees(1.0)), r"check the unit of the joints \(degrees or"),
    "joints in radians called degrees": (_joints_times(np.radians(1.0)), r"are joints in radians read as degrees"),
    "joints that stand still": (_joints_times(0.0), r"as of a limb that stands still"),
    "gravity reversed": (
        lambda arm: edit(arm / PARQUET, "gravity_direction = [0.0, 0.0, -1.0]", "gravity_direction = [0.0, 0.0, 1.0]"),
        r"is opposite to the expected force, .*gravity_direction of \[\[support\]\]",
    ),
    "gravity sideways": (
        lambda arm: edit(arm / PARQUET, "gravity_direction = [0.0, 0.0, -1.0]", "gravity_direction = [1.0, 0.0, 0.0]"),
        r"explains \d+%; .*gravity_direction of \[\[support\]\]",
    ),
    "direction reversed": (
        lambda arm: edit(arm / "arm.urdf", "child_to_parent", "parent_to_child"),
        r"is opposite to the expected force, .*measure_direction of .* the URDF's sensor tag",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
@some_cases("regularisation", ["held-out", "1000"])
def test_a_wrong_model_is_refused(arm: Path, run: Run, name: str, regularisation: str) -> None:
    """Exit code 2, nothing written, and one line that names the likely cause."""
    damage, words = REFUSED[name]
    damage(arm)
    before = snapshot(arm)
    made = run("calibrate", PARQUET, "-o", "made.json", "--lambda", regularisation)
    assert re.search(rf"^error: parquet.toml: sensor 'arm_ft': .*{words}", made.error())
    assert snapshot(arm) == before


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_the_intact_experiment_raises_no_doubt(arm: Path, run: Run) -> None:
    """The negative control of all the others: no warning, and a verdict "good"."""
    made = run("calibrate", PARQUET, "-o", "made.json", "--details")
    assert (made.code, [line for line in made.log if line.startswith("WARNING")]) == (0, [])
    assert read_calibration(arm / "made.json").warnings == ()
    assert "good" in {tone for tone, _ in _verdict(run)}


DOUBTED: dict[str, tuple[Damage, str]] = {
    "heavier": (_masses(1.2), "the gain changed by -1"),
    "later": (_sensor_later(0.1), "the reading comes 100 ms later than the reference"),
}


@pytest.mark.usefixtures("blank_pictures")
@some_cases("name", DOUBTED)
def test_a_doubtful_model_is_said_and_never_called_good(arm: Path, run: Run, name: str) -> None:
    """A warning of `calibrate`, the doubt in the file, and no verdict "good" of `report` on the same recording."""
    damage, words = DOUBTED[name]
    damage(arm)
    made = run("calibrate", PARQUET, "-o", "made.json", "--details")
    (doubt,) = read_calibration(arm / "made.json").warnings
    assert (made.code, f"WARNING: arm_ft: {doubt}" in made.log, doubt.startswith(words)) == (0, True, True)
    lines = _verdict(run)
    assert any(doubt in text for _, text in lines)
    assert "good" not in {tone for tone, _ in lines}


def _verdict(run: Run) -> list[tuple[str, str]]:
    """Tone and text of what `report` says of the calibration."""
    report = run("report", PARQUET, "made.json", "-o", "report.html", "--format", "json").result()
    ((sensor,),) = [experiment["sensors"] for experiment in report["experiments"]]
    return [(line["tone"], line["text"]) for line in sensor["verdict"]]


def test_a_kept_prior_needs_no_gate(arm: Path, run: Run) -> None:
    """With infinite lambda no matrix is fitted, and the offset of a limb at rest is told."""
    _joints_times(0.0)(arm)
    assert run("calibrate", PARQUET, "-o", "made.json", "--lambda", "inf").code == 0

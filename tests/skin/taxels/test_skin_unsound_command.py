# SPDX-License-Identifier: BSD-3-Clause
"""`skin wrench` on recordings whose forces would be too low: dead, stuck or touched taxels, and heat on late pads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.simulation.temperature import Warmth
from tests.app.outcome import Outcome, Run
from tests.scenes.warmed import WARM_UP, WarmShank, counts_of, late_pads, with_counts, write_log, write_warmed

PUSHED = Warmth(inside_K=0.0, rest_s=5.0, hold_s=15.0, after_s=5.0)
"""An object, without heat, at ten messages a second."""
ROWS = np.arange(250)


@pytest.fixture(scope="module", name="folder")
def calibrated_folder(tmp_path_factory: pytest.TempPathFactory, run: Run) -> tuple[Path, WarmShank]:
    """Folder with a patch and its calibration, without a warm-up."""
    folder = tmp_path_factory.mktemp("unsound")
    shank = write_warmed(folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert run("skin", "calibrate", "bag.toml", "-o", "shank.json").code == 0
    return folder, shank


@pytest.fixture(name="shank")
def patch_in_its_folder(folder: tuple[Path, WarmShank], monkeypatch: pytest.MonkeyPatch) -> WarmShank:
    """The patch; its folder is the working folder."""
    monkeypatch.chdir(folder[0])
    return folder[1]


def _looked(run: Run, shank: WarmShank, counts: FloatArray) -> Outcome:
    write_log(Path(), "pushed", with_counts(shank.recorded(PUSHED, touched=True), counts))
    return run("skin", "wrench", "pushed.toml", "--table", "shank.json", "--format", "json")


def _pushed(shank: WarmShank) -> FloatArray:
    return counts_of(shank.recorded(PUSHED, touched=True))[1]


def _some(shank: WarmShank, share: float) -> FloatArray:
    """Columns of so many taxels, anywhere."""
    order = np.random.default_rng(0).permutation(shank.layout.taxels)
    return order[: round(share * len(order))]


def test_a_sound_recording_says_nothing_of_this(run: Run, shank: WarmShank) -> None:
    """Neither dead, stuck nor touched taxels."""
    log = " ".join(_looked(run, shank, _pushed(shank)).log)
    assert not any(words in log for words in ("left out", "were touched", "one number", "times as fast"))


def test_many_dead_taxels_are_said_and_more_are_refused(run: Run, shank: WarmShank) -> None:
    """With 30 % of them the force is 15 % too low; with 60 % there is no answer, where 7.6 N were told of 10.1."""
    counts = _pushed(shank)
    counts[:, _some(shank, 0.3)] = 0.0
    assert any("over 20 %: forces are too low" in line for line in _looked(run, shank, counts).log)
    counts[:, _some(shank, 0.6)] = 0.0
    error = _looked(run, shank, counts).error()
    assert "expected at least half of 280 taxels to be live, got 112" in error
    assert "168 are at a rail" in error


def test_stuck_taxels_are_said(run: Run, shank: WarmShank) -> None:
    """They send 240 under a load of 10 N."""
    counts = _pushed(shank)
    counts[:, _some(shank, 0.6)] = 240.0
    assert any("168 taxels send one number in all messages" in line for line in _looked(run, shank, counts).log)


@pytest.mark.parametrize("ahead_s", [4.0, 6.0])
def test_a_contact_while_rest_is_taken_is_said(run: Run, shank: WarmShank, ahead_s: float) -> None:
    """It comes after a second, or was there before; 1.5 N would be told of 10."""
    counts = _pushed(shank)[np.minimum(ROWS + round(10.0 * ahead_s), len(ROWS) - 1)]
    (said,) = [line for line in _looked(run, shank, counts).log if "were touched in the first 2 s" in line]
    assert int(said.split()[1]) > 5


@pytest.mark.long
def test_late_pads_are_said_and_made_up_for(run: Run, shank: WarmShank) -> None:
    """Through the commands: hardly a contact where nothing touches the patch; faster heat is said when it is read."""
    write_log(Path(), "late", late_pads(shank, WARM_UP, 15.0))
    learned = run("skin", "calibrate", "bag.toml", "-o", "late.json", "--warm-up", "late.toml", "--format", "json")
    assert learned.result()["warm_up"]["lag_s"] == pytest.approx(15.0, abs=1.0)
    assert any("56 of 56 thermal pads feel heat later than their taxels" in line for line in learned.log)
    for name, inside_s, frames, fast in (("idle", 150.0, 3, False), ("fast", 80.0, 10, True)):
        warmth = Warmth(hold_s=150.0, inside_s=inside_s)
        write_log(Path(), name, late_pads(shank, warmth, 15.0, seed=11))
        read = run("skin", "wrench", f"{name}.toml", "--table", "late.json", "--format", "json")
        assert any("times as fast as in the warm-up" in line for line in read.log) is fast
        assert read.result()["frames_with_contact"] <= frames
        assert read.result()["largest_force_N"] < (1.5 if fast else 0.6)

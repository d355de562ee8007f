# SPDX-License-Identifier: BSD-3-Clause
"""`skin calibrate --warm-up` and `skin wrench` with heat: what they write, show and refuse."""

from __future__ import annotations

from contextlib import chdir
from pathlib import Path

import numpy as np
import pytest

from forcetorque.skin.taxels.patch_calibration_and_pressure_table import read_patch_calibration
from tests.app.outcome import Outcome, Run
from tests.cases import some_cases
from tests.scenes.warmed import MASS_KG, WARM_UP, WarmShank, counts_of, with_counts, write_log, write_warmed

CALIBRATE = ("skin", "calibrate", "bag.toml", "-o", "shank.json", "--warm-up")
OPTIONS = ("--table", "shank.json", "--average", "40")
HELD = ("skin", "wrench", "held.toml", *OPTIONS)
HAND = ("skin", "wrench", "hand.toml", *OPTIONS)
LOAD_N = 9.81 * MASS_KG


@pytest.fixture(scope="module", name="folder")
def warmed_folder(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, WarmShank]:
    """Folder with a chamber log, a warm-up and recordings of an object."""
    folder = tmp_path_factory.mktemp("warm")
    return folder, write_warmed(folder)


@pytest.fixture(scope="module")
def calibrated(folder: tuple[Path, WarmShank], run: Run) -> Outcome:
    """Calibrate the patch; its calibration is beside its recordings."""
    with chdir(folder[0]):
        return run(*CALIBRATE, "warm.toml", "--format", "json")


@pytest.fixture(name="shank")
def calibrated_patch(folder: tuple[Path, WarmShank], calibrated: Outcome, monkeypatch: pytest.MonkeyPatch) -> WarmShank:
    """The patch; the folder with its calibration and its recordings is the working folder."""
    assert calibrated.code == 0
    monkeypatch.chdir(folder[0])
    return folder[1]


def test_the_calibration_carries_gains(calibrated: Outcome, shank: WarmShank) -> None:
    """Two pads for each taxel, the row of the warm-up, and its files among the inputs."""
    row = calibrated.result()["warm_up"]
    assert (row["pads"], row["dead_pads"], row["taxels"]) == (len(shank.layout.thermal_pads), 0, len(shank.layout))
    assert row["gain"] == pytest.approx(1.0, abs=0.1)
    kept = read_patch_calibration("shank.json")
    assert kept.warm_up is not None
    assert {len(heat.gains) for heat in kept.warm_up.taxels} == {2}
    assert any(name.startswith("warm: ") for name in kept.provenance.inputs_sha256)


@pytest.mark.long
def test_rules_are_chosen_by_name(run: Run, shank: WarmShank) -> None:
    """As learned by default; the firmware's rule and none see contacts that are none, and have no limit."""
    learned = run(*HELD, "--format", "json").result()
    assert learned["temperature"] == "learned"
    assert learned["largest_force_N"] == pytest.approx(LOAD_N, abs=0.7)
    assert all(row["drift_limit_N"] >= 0.0 for row in learned["contacts"])
    for rule in ("firmware", "none"):
        other = run(*HELD, "--temperature", rule, "--format", "json")
        result = other.result()
        assert result["temperature"] == rule
        assert result["largest_force_N"] > LOAD_N + 3.0
        assert {row["drift_limit_N"] for row in result["contacts"]} == {None}
        assert any("no limit of drift is known" in line for line in other.log)


@pytest.mark.long
def test_a_re_tare_is_offered_on_release(run: Run, shank: WarmShank) -> None:
    """And done where that is asked for."""
    offered = run(*HAND, "--details")
    assert "offered" in offered.out
    assert "--re-tare takes what was left as rest" in " ".join(offered.out.split())
    assert any("heat through them, which no thermal pad measures" in line for line in offered.log)
    (release,) = run(*HAND, "--re-tare", "--format", "json").result()["releases"]
    assert release["re_tare"] == "done"
    assert 0.0 < release["left_N"] <= release["drift_limit_N"]


@pytest.mark.long
def test_bad_warm_ups_are_refused_by_file(run: Run, shank: WarmShank) -> None:
    """A contact in it, pads that never warm, two intervals, another patch, no layout."""
    write_log(Path(), "pressed", shank.recorded(WARM_UP, touched=True, seed=3))
    error = run(*CALIBRATE, "pressed.toml").error()
    assert "pressed.toml: patch 'shank': warm-up: expected a warm-up without contact" in error
    write_log(Path(), "cold", shank.recorded(type(WARM_UP)(inside_K=0.0, hold_s=200.0)))
    assert "cold.toml: patch 'shank': warm-up: thermal pads: expected to change" in run(*CALIBRATE, "cold.toml").error()
    text = Path("warm.toml").read_text(encoding="utf-8")
    Path("other.toml").write_text(text.replace('"S1"', '"S2"'), encoding="utf-8")
    assert "expected the patch that is calibrated, with serial 'S1'" in run(*CALIBRATE, "other.toml").error()
    Path("judged.toml").write_text(text.replace('"calibration"', '"validation"'), encoding="utf-8")
    assert 'with use = "calibration", the warm-up, got 0' in run(*CALIBRATE, "judged.toml").error()
    assert "no.toml" in run(*CALIBRATE, "no.toml").error()


@pytest.mark.long
@some_cases("stated", [False, True])
def test_what_is_added_to_a_warm_up_is_said(run: Run, shank: WarmShank, stated: bool) -> None:
    """A rate of rows that have no time, once and by the name of the warm-up; of one as it was logged, nothing."""
    seconds, counts = counts_of(shank.recorded(WARM_UP))
    np.savez("timed.npz", counts=counts if stated else np.column_stack([seconds, counts]))
    first = 1 if stated else 2
    time = f"rate_hz = {1.0 / np.median(np.diff(seconds))}\nstart_s = 0.0"
    stream = f"""[[recording.stream]]
name = "counts"
variable = "counts"
{time if stated else 'time = { column = 1, unit = "s" }'}
signal = [{{ quantity = "taxel_counts", columns = [{first}, {counts.shape[1] + first - 1}], unit = "counts" }}]

[[patch]]"""
    text = Path("warm.toml").read_text(encoding="utf-8").replace('name = "warm"', 'name = "timed"')
    log = text.replace('"parquet"', '"npz"').replace('path = "warm"', 'path = "timed.npz"')
    Path("timed.toml").write_text(log.replace("[[patch]]", stream), encoding="utf-8")
    answer = run("skin", "calibrate", "bag.toml", "-o", "timed.json", "--warm-up", "timed.toml", "--format", "json")
    assert answer.code == 0
    said = [line for line in answer.log if "no time is logged" in line]
    assert [line.partition(": no time")[0] for line in said] == ["WARNING: warm-up 'timed': counts"] * stated


@pytest.mark.long
def test_dead_pads_are_named(run: Run, shank: WarmShank) -> None:
    """In the warm-up, where others are learned, and in a recording, where the other pad of the module is enough."""
    recording = shank.recorded(WARM_UP)
    counts = counts_of(recording)[1]
    counts[:, shank.layout.thermal_pads[:2]] = 0.0
    write_log(Path(), "dead", with_counts(recording, counts))
    ended = run("skin", "calibrate", "bag.toml", "-o", "dead.json", "--warm-up", "dead.toml", "--format", "json")
    assert ended.result()["warm_up"]["dead_pads"] == 2
    pads = ", ".join(map(str, shank.layout.thermal_pads[:2]))
    assert any(f"2 thermal pads are dead ({pads})" in line for line in ended.log)
    ended = run("skin", "wrench", "dead.toml", *OPTIONS, "--format", "json")
    own = shank.layout.taxels[shank.layout.modules == shank.layout.thermal_modules[0]]
    assert ended.result()["left_out"] == own.tolist()
    assert any(f"2 thermal pads are dead in this recording: {pads}" in line for line in ended.log)
    assert any("10 taxels are left out because no working thermal pad measures" in line for line in ended.log)
    counts[:, shank.layout.thermal_pads] = 255.0
    write_log(Path(), "none", with_counts(recording, counts))
    assert (
        "none.toml: patch 'shank': thermal pads: expected one that is alive, got none of 56"
        in run("skin", "wrench", "none.toml", *OPTIONS).error()
    )


@pytest.mark.long
def test_rules_that_lack_a_warm_up_are_refused(run: Run, shank: WarmShank) -> None:
    """By name, with what to do; without a rule the same calibration leaves heat in."""
    assert run("skin", "calibrate", "bag.toml", "-o", "bare.json").code == 0
    bare = ("skin", "wrench", "held.toml", "--table", "bare.json", "--average", "40")
    assert "expected a calibration with a warm-up" in run(*bare, "--temperature", "learned").error()
    assert "re-tare: expected the rule 'learned', got 'none'" in run(*bare, "--re-tare").error()
    assert run(*bare, "--format", "json").result()["temperature"] == "none"


def test_numbers_are_numbers(run: Run, shank: WarmShank) -> None:
    """CSV has the limit of every contact."""
    rows = run(*HELD, "--format", "csv").rows()
    limits = np.array([float(row["drift_limit_N"]) for row in rows])
    assert limits.max() > 10.0 * limits[:2].max()

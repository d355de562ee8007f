# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque view` and `report` of skin alone: patches without a sensor, and contacts that a skinManager saw."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.viewer.scene import SkinEventSeries
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene, scene_of
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.skin_alone import EVENTS, HEURISTIC, MESSAGES, PERIOD_S, TOUCHED, write_events
from tests.scenes.touched import write_table, write_touched

REAL = {"left": (9, 597), "both": (384, 439), "right": (718, 0), "rightleftforearmshands": (924, 1045)}
"""Contacts of the right and the left forearm in the logs of a real robot, counted in their lines."""
REPEATED = 60
"""Messages whose stamp repeats the one before have no instant of their own: 32 at most, of up to two contacts."""


def _report(run: Run, file: Path) -> tuple[dict[str, Any], str]:
    output = file.with_suffix(".html")
    result: dict[str, Any] = run("report", str(file), "-o", str(output), "--format", "json").result()
    return result, output.read_text(encoding="utf-8")


def _drawn(built: BuiltScene, events: SkinEventSeries) -> dict[float, list[list[float]]]:
    """Heuristics by time, of messages with a contact."""
    first, force = (read_array(built.block, one) for one in (events.contacts.first, events.contacts.force))
    times = read_array(built.block, events.contacts.time_s)
    spans = zip(times.tolist(), first[:-1].tolist(), first[1:].tolist(), strict=True)
    return {time: force[start:end].tolist() for time, start, end in spans if end > start}


def test_contacts_of_a_skin_manager_are_shown_alone(run: Run, tmp_path: Path) -> None:
    """At the times of their sender, in no newtons; the dumper's clock appears in words only."""
    file = write_events(tmp_path)
    page = tmp_path / "page.html"
    outcome = run("view", str(file), "-o", str(page), "--format", "json")
    shown = outcome.result()
    assert (shown["sensors"], tuple(shown["skin"]), shown["samples"]) == ([], EVENTS, MESSAGES)
    assert sum("heuristic, not newtons" in note for note in shown["notes"]) == 2
    assert any("no [robot]: links with skin are drawn side by side" in note for note in shown["notes"])
    assert any("the dumper's clock is +169382480 s from the one that stamped" in words for words in outcome.log)
    built = scene_of(file, load_experiment(file, Purpose.DISPLAY), {})
    right, left = built.scene.skin_events
    drawn = _drawn(built, right)
    np.testing.assert_allclose(list(drawn), np.array(TOUCHED) * PERIOD_S, atol=1e-6)
    assert set(map(tuple, (force for forces in drawn.values() for force in forces))) == {HEURISTIC}
    assert _drawn(built, left) == {}
    # whatever is placed in time lies within the seconds of the sender
    assert read_array(built.block, built.scene.time_s).max() < MESSAGES * PERIOD_S


def test_a_report_of_contacts_alone(run: Run, tmp_path: Path) -> None:
    """Its title is about skin, and the heuristic is named one."""
    result, page = _report(run, write_events(tmp_path))
    assert result["title"] == "Contacts on skin: touched arms"
    (experiment,) = result["experiments"]
    assert [row["messages_with_contact"] for row in experiment["skin_events"]] == [len(TOUCHED), 0]
    assert "the heuristic is not newtons" in page
    assert "no sensor" not in page
    assert "2 patches in 1 recording" in page


def test_a_patch_without_a_table_is_refused(run: Run, tmp_path: Path) -> None:
    """Where nothing else is there to show, in place of a page of nothing, with the command that makes a table."""
    write_touched(tmp_path, along=3)
    file, page = tmp_path / "touched.toml", tmp_path / "page.html"
    error = run("view", str(file), "-o", str(page)).error()
    assert "nothing to show: patch 'shank' is not shown: [[patch]] states no table" in error
    assert "`forcetorque skin calibrate`" in error
    assert not page.exists()
    reported = run("report", str(file), "--viewer", "-o", str(page))
    assert reported.code == 0
    (warning,) = (line for line in reported.err.splitlines() if "could not be made" in line)
    assert warning.startswith("WARNING: Posture and forces: touched: The viewer could not be made: ")
    assert "The viewer could not be made: experiment" in page.read_text(encoding="utf-8")


@pytest.mark.long
def test_a_patch_alone_is_shown_and_reported(run: Run, tmp_path: Path) -> None:
    """With a table and neither robot nor sensor."""
    write_touched(tmp_path, along=3)
    write_table(tmp_path)
    file = tmp_path / "touched.toml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("[[interval]]", 'table = "shank.json"\n\n[[interval]]'), encoding="utf-8")
    shown = run("view", str(file), "-o", str(tmp_path / "page.html"), "--format", "json").result()
    assert (shown["sensors"], shown["skin"]) == ([], ["shank"])
    assert scene_of(file, load_experiment(file, Purpose.DISPLAY), {}).scene.robot.shapes == ()
    result, page = _report(run, file)
    assert len(result["experiments"][0]["skin"][0]["contacts"]) > 20
    assert "shank: contacts, force ± standard deviation" in page


@pytest.mark.real_data
@some_cases("name", REAL)
def test_logs_of_a_real_robot_open(data_dir: Path, tmp_path: Path, name: str) -> None:
    """All contacts with an instant of their own are drawn, in no newtons, on one clock."""
    file = write_events(tmp_path)
    port = tmp_path / "dumper" / "skin_events"
    shutil.rmtree(port)
    port.mkdir()
    for kind in ("data", "info"):
        (port / f"{kind}.log").symlink_to(data_dir / "icub_skin_events_pps" / f"{name}_{kind}.log")
    built = scene_of(file, load_experiment(file, Purpose.DISPLAY), {})
    drawn = [events.contacts.force.shape[0] for events in built.scene.skin_events]
    for logged, shown in zip(REAL[name], drawn, strict=True):
        assert logged - REPEATED <= shown <= logged
    assert sum(drawn) > 0
    assert all(events.contacts.spread is None for events in built.scene.skin_events)
    assert sum("heuristic, not newtons" in note for note in built.scene.notes) == 2
    two_clocks = [finding for finding in built.scene.findings if finding.kind == "two_clocks"]
    assert bool(two_clocks) == (name != "rightleftforearmshands")
    assert read_array(built.block, built.scene.time_s).max() < 100.0


def test_what_patches_share_is_found_once(run: Run, tmp_path: Path) -> None:
    """One port sends the contacts of both arms: its lost messages are named once, with both."""
    file = write_events(tmp_path)
    log = tmp_path / "dumper" / "skin_events" / "data.log"
    lines = log.read_text(encoding="utf-8").splitlines(keepends=True)
    log.write_text("".join(lines[:20] + lines[25:]), encoding="utf-8")
    findings = run("inspect", file, "--format", "json").result()["findings"]
    lost = [finding for finding in findings if finding["kind"] == "lost_messages"]
    assert [(finding["stream"], finding["count"]) for finding in lost] == [("right forearm", 5)]
    assert lost[0]["message"].endswith("; the same of left forearm")

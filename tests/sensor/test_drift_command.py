# SPDX-License-Identifier: BSD-3-Clause
"""`drift` names what changed between sessions, draws it, and refuses one session."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.scenes.wrist_sessions import SECOND_OFFSET, write_sessions


@pytest.fixture(scope="module")
def days(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two sessions of a wrist sensor whose fz moves by 2 N between them."""
    return write_sessions(tmp_path_factory.mktemp("days"))


def test_the_change_is_named_shown_and_drawn(days: Path, run: Run) -> None:
    """The answer has fz and nothing else; JSON has the number; the figure is a PNG; CSV a line per session."""
    figure = days.parent / "drift.png"
    result = run("bench", "drift", days, "--figure", figure, "--format", "json").result()
    assert result["schema"] == "forcetorque/drift/1"
    (sensor,) = result["sensors"]
    assert sensor["sessions"] == ["monday", "friday"]
    changed = [row for row in sensor["changes"] if row["beyond_noise"]]
    assert [(row["component"], row["quantity"]) for row in changed] == [("fz", "offset")]
    assert abs(changed[0]["change"] - SECOND_OFFSET[2]) < changed[0]["half_width_95"]
    assert figure.read_bytes().startswith(b"\x89PNG")
    text = run("bench", "drift", days).out
    assert "DRIFT BEYOND NOISE" in text
    assert "drift of fz 2.0" in text
    lines = run("bench", "drift", days, "--format", "csv").out.splitlines()
    assert len(lines) == 1 + 6 * 2


def test_one_session_is_refused(days: Path, run: Run, tmp_path: Path) -> None:
    """With what to do."""
    alone = tmp_path / "alone.toml"
    alone.write_text(days.read_text(encoding="utf-8").replace('session = "friday"', 'session = "monday"'))
    (tmp_path / "log.csv").write_bytes((days.parent / "log.csv").read_bytes())
    outcome = run("bench", "drift", alone)
    assert (outcome.code, outcome.out) == (2, "")
    assert "intervals of two sessions or more, got 'monday' alone" in outcome.err

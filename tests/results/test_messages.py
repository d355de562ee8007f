# SPDX-License-Identifier: BSD-3-Clause
"""What commands write to standard error: their own messages."""

from __future__ import annotations

import logging

import pytest

from forcetorque.base.errors import SensorError
from forcetorque.results.terminal.command_output import refusal_lines, start_logging


def test_matplotlib_does_not_report_its_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    """It warned, in front of a report, of a folder that cannot be written; its errors are still shown."""
    ours, theirs = logging.getLogger("forcetorque"), logging.getLogger("matplotlib.font_manager")
    monkeypatch.setattr(ours, "handlers", [])
    monkeypatch.setattr(ours, "level", ours.level)
    monkeypatch.setattr(logging.getLogger("matplotlib"), "level", logging.NOTSET)
    theirs.manager._clear_cache()  # type: ignore[attr-defined]
    assert theirs.isEnabledFor(logging.WARNING), "control: before a command logs"
    start_logging()
    assert not theirs.isEnabledFor(logging.WARNING)
    assert theirs.isEnabledFor(logging.ERROR)
    assert ours.isEnabledFor(logging.INFO)


def test_a_reason_of_several_sensors_is_said_once() -> None:
    """Each sensor is named; another reason of the same sensor is said in full."""
    reason = "no stream holds the position of joint 'torso'; known: hip: knee"
    refusals = [SensorError(f"walk.toml: sensor {name!r}: {reason}") for name in ("left", "right")]
    refusals.append(SensorError("walk.toml: sensor 'right': it stands still"))
    assert refusal_lines(refusals) == [
        f"error: walk.toml: sensor 'left': {reason}",
        "error: walk.toml: sensor 'right': the same",
        "error: walk.toml: sensor 'right': it stands still",
    ]

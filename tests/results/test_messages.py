# SPDX-License-Identifier: BSD-3-Clause
"""What commands write to standard error: their own messages."""

from __future__ import annotations

import logging

import pytest

from forcetorque.results.terminal.output import start_logging


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

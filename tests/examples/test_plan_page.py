# SPDX-License-Identifier: BSD-3-Clause
"""What docs/planning.md shows can be typed, and comes to the figures that stand there."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.app.outcome import typed

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "planning.md").read_text(encoding="utf-8")
LAST_DIGIT = 0.51
"""Units of the last digit that a printed figure may be off, and its rounding."""


def _printed(number: int) -> list[str]:
    (line,) = [line for line in PAGE.splitlines() if line.startswith(f"| {number} | ")]
    return [cell.strip() for cell in line.strip("|").split("|")][1:]


@pytest.mark.long
def test_the_example_comes_to_the_figures_of_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tools and errors of three recordings; without the tools, the direction that stays with the prior."""
    folder = tmp_path / "simulated"
    assert typed("simulate", "wrist", "-o", folder).code == 0
    monkeypatch.chdir(folder)
    (block,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (folder / "new.toml").write_text(block, encoding="utf-8")
    assert typed("plan", "new.toml", "-o", "next").code == 0
    planned = json.loads((folder / "next" / "plan.json").read_text(encoding="utf-8"))
    for row in planned["recordings"]:
        tool, *figures = _printed(row["recording"])
        assert tool == row["tool"]
        values = [
            row[f"{kind}_{when}_{unit}"]
            for kind, unit in (("force", "N"), ("moment", "Nm"))
            for when in ("before", "after", "after_at_most")
        ]
        for figure, value in zip(figures, values, strict=True):
            digits = len(figure.partition(".")[2])
            assert float(figure) == pytest.approx(value, abs=LAST_DIGIT * 10.0**-digits)
    (folder / "stiff.toml").write_text(block.partition("[[plan.tool]]")[0], encoding="utf-8")
    assert typed("plan", "stiff.toml", "-o", "stiff").code == 0
    advice = json.loads((folder / "stiff" / "plan.json").read_text(encoding="utf-8"))["advice"]
    (quoted,) = re.findall(r"`(tz stays with [^`]*)`", PAGE)
    assert advice.endswith("; " + " ".join(quoted.split()))

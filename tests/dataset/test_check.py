# SPDX-License-Identifier: BSD-3-Clause
"""Faults of forces in a dataset are found by episode and component, and a sound dataset has none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.dataset import check_dataset
from forcetorque.dataset.checks_over_episodes import changes, kendall
from forcetorque.dataset.result import DatasetCheck, Kind, episodes_text
from tests.formats.lerobot.datasets import tool_episodes, write_dataset

WRENCH = "observation.wrench"
NUMBER = 10
Change = Callable[[list[dict[str, Any]]], None]


def _checked(folder: Path, change: Change | None = None, **stated: Any) -> DatasetCheck:
    made = {key: stated.pop(key) for key in ("mass", "bias") if key in stated}
    episodes = tool_episodes([70] * NUMBER, seed=5, **made)
    if change is not None:
        change(episodes)
    root = write_dataset(folder / "d", episodes, per_file=4)
    return check_dataset(root, **({"sense": "sensor_to_world"} | stated))


def _only(check: DatasetCheck, kind: Kind) -> tuple[str | None, tuple[int, ...]]:
    """Component and episodes of the only finding."""
    assert [finding.kind for finding in check.findings] == [kind], [finding.text for finding in check.findings]
    (finding,) = check.findings
    return finding.component, finding.episodes


def test_a_sound_dataset_has_no_finding(tmp_path: Path) -> None:
    """Negative control: noise and motion are none; all was examined, and the weight is that of the tool."""
    check = _checked(tmp_path, mass_kg=0.8)
    assert (check.findings, check.not_checked, check.passed) == ((), (), True)
    weights = [row.weight for row in check.records_of_episodes if row.field == WRENCH]
    np.testing.assert_allclose(np.array(weights, dtype=float), 0.8 * 9.80665, rtol=0.01)
    assert len(weights) == NUMBER


def _dead(episodes: list[dict[str, Any]]) -> None:
    episodes[3][WRENCH][:] = 0.0


def _stuck(episodes: list[dict[str, Any]]) -> None:
    episodes[2][WRENCH][30:60, 4] = episodes[2][WRENCH][30, 4]


def _saturated(episodes: list[dict[str, Any]]) -> None:
    for k in (1, 6):
        episodes[k][WRENCH][20:40, 2] = 25.0


def _missing(episodes: list[dict[str, Any]]) -> None:
    episodes[9][WRENCH][5, 1] = np.nan


def _noisy(episodes: list[dict[str, Any]]) -> None:
    episodes[4][WRENCH][:, 0] += np.random.default_rng(1).normal(size=70).astype(np.float32)


def _late(episodes: list[dict[str, Any]]) -> None:
    for episode in episodes:
        episode[WRENCH][4:] = episode[WRENCH][:-4]
        episode[WRENCH][:4] = episode[WRENCH][4]


@pytest.mark.parametrize(
    ("change", "kind", "component", "episodes"),
    [
        (_dead, Kind.DEAD, None, (3,)),
        (_stuck, Kind.STUCK, "ty", (2,)),
        (_saturated, Kind.SATURATED, "fz", (1, 6)),
        (_missing, Kind.MISSING, "fy", (9,)),
        (_noisy, Kind.NOISY, "fx", (4,)),
        (_late, Kind.LATE, None, tuple(range(NUMBER))),
    ],
)
def test_faults_of_episodes(
    tmp_path: Path, change: Change, kind: Kind, component: str | None, episodes: tuple[int, ...]
) -> None:
    """Each alone: kind, component and episodes, and nothing else; noise alone is a remark."""
    check = _checked(tmp_path, change)
    assert _only(check, kind) == (component, episodes)
    assert check.passed == (kind is Kind.NOISY)
    if kind is Kind.LATE:
        assert check.findings[0].size == 4.0
        assert "no true times" in check.findings[0].message


def test_another_tool(tmp_path: Path) -> None:
    """From episode 6 on it weighs 0.3 kg more: the first episode with it is named."""
    check = _checked(tmp_path, mass=[0.8] * 6 + [1.1] * 4)
    assert _only(check, Kind.TOOL_CHANGE) == (None, (6,))


def test_a_bias_of_one_episode(tmp_path: Path) -> None:
    """3 N along y in episode 4, as after a tare under load."""
    bias = np.zeros((NUMBER, 6))
    bias[4, 1] = 3.0
    assert _only(_checked(tmp_path, bias=bias), Kind.BIASED) == ("fy", (4,))


def test_a_drift_over_the_dataset(tmp_path: Path) -> None:
    """4 N along x from the first to the last episode; harm only where gravity was separated from it."""
    bias = np.zeros((NUMBER, 6))
    bias[:, 0] = np.linspace(0.0, 4.0, NUMBER)
    check = _checked(tmp_path, bias=bias)
    kinds = {finding.kind: finding for finding in check.findings}
    assert set(kinds) == {Kind.DRIFTING}
    assert kinds[Kind.DRIFTING].component == "fx"
    assert kinds[Kind.DRIFTING].size == pytest.approx(3.1, abs=0.3)  # medians of the outer thirds


@pytest.mark.parametrize(
    ("force", "moment", "words"),
    [(1.0, 1e3, "in N mm"), (1e3, 1.0, "in mN"), (1.0 / 9.80665, 1.0 / 9.80665, "in kgf"), (1e3, 1e3, "in mN")],
)
def test_units(tmp_path: Path, force: float, moment: float, words: str) -> None:
    """By the lever of moments, and by the weight of a tool of known mass."""

    def scaled(episodes: list[dict[str, Any]]) -> None:
        for episode in episodes:
            episode[WRENCH] = (episode[WRENCH] * np.repeat([force, moment], 3)).astype(np.float32)

    check = _checked(tmp_path, scaled, mass_kg=0.8)
    assert any(finding.kind is Kind.UNITS and words in finding.message for finding in check.findings)


def test_what_is_not_stated_is_not_checked(tmp_path: Path) -> None:
    """Without the sense nothing is held against gravity, and the answer says what is lacking."""
    check = _checked(tmp_path, sense=None)
    assert "add --sense" in check.not_checked[0]
    assert all(row.weight is None for row in check.records_of_episodes)
    text = "".join(f"{answer.subject} {answer.verdict} {answer.why}" for answer in check.answers())
    assert "NO HARM FOUND" in text
    assert "--sense" in text


def test_fields_are_found_by_names(tmp_path: Path) -> None:
    """A wrench inside a state, efforts, and no command; a dataset without a force is refused."""
    rng = np.random.default_rng(0)
    frames = {
        "observation.state": rng.normal(size=(40, 8)).astype(np.float32),
        "observation.effort": rng.normal(size=(40, 3)).astype(np.float32),
        "action.force": rng.normal(size=(40, 3)).astype(np.float32),
    }
    names = {"observation.state": ["grip", *(f"left_{one}_N" for one in ("fx", "fy", "fz", "tx", "ty", "tz")), "x"]}
    check = check_dataset(write_dataset(tmp_path / "d", [frames], names=names))
    assert check.fields == ("observation.state.left", "observation.effort")
    with pytest.raises(FormatError, match="name it with --feature"):
        check_dataset(write_dataset(tmp_path / "e", [{"observation.state": frames["observation.state"]}]))


def test_page_and_csv(tmp_path: Path) -> None:
    """The page has the verdict and every finding; records have the keys of the columns."""
    from forcetorque.dataset.check import write_page

    check = _checked(tmp_path, _stuck)
    write_page(check, tmp_path / "check.html")
    page = (tmp_path / "check.html").read_text(encoding="utf-8")
    assert "HARM: stuck" in page
    assert "ty repeats" in page
    (record,) = check.records()
    assert list(record) == check.columns()
    assert record["episodes"] == "episode 2"


def test_episodes_are_named_by_ranges() -> None:
    """Ranges, and of many the first."""
    assert episodes_text([0, 1, 2, 7]) == "episodes 0-2, 7"
    assert episodes_text([5]) == "episode 5"
    assert episodes_text(range(0, 40, 2)) == "episodes 0, 2, 4, 6, 8, 10 and 14 more"


def test_changes_and_trends_of_series() -> None:
    """A step is found where it is; noise has neither step nor trend, by chance of one in thousands."""
    rng = np.random.default_rng(3)
    noise = rng.normal(size=200)
    assert changes(10.0 + 0.1 * noise, np.full(200, 0.1), share=0.05) == []
    assert changes(10.0 + 0.1 * noise + 3.0 * (np.arange(200) >= 120), np.full(200, 0.1), share=0.05) == [120]
    statistics = [kendall(rng.normal(size=30)) for _ in range(200)]
    assert np.std(statistics) == pytest.approx(1.0, abs=0.15)
    assert kendall(np.arange(1000.0)) > 20.0

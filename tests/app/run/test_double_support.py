# SPDX-License-Identifier: BSD-3-Clause
"""Phases in which several links bear the robot contradict calibrations that bear its weight worse than the priors."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from forcetorque.app.run import double_support as module
from forcetorque.app.run.double_support import contradiction, double_support
from forcetorque.app.run.run import run
from forcetorque.locomotion.net_force.result import Coherence, PhaseForce

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def _row(candidate: str, phase: str, error: float, *touching: str, evidence: bool = True) -> PhaseForce:
    none = (None, None, None)
    values: dict[str, Any] = {
        "phase": phase,
        "contact_links": touching or ("l_sole", "r_sole"),
        "calibration": candidate,
        "offset": "one-link-fixed-frame",
        "offset_interval": "left",
        "samples": 100,
        "force_N": (0.0, 0.0, 324.0 + error),
        "force_error_N": (0.0, 0.0, error),
        "force_half_width_95_N": none,
        "force_deviation_N": none,
        "force_smallest_N": (0.0, 0.0, error),
        "force_largest_N": (0.0, 0.0, error),
        "evidence": evidence,
    }
    moments = ("error", "half_width_95", "deviation", "smallest", "largest")
    return PhaseForce.model_validate(values | {f"moment_{name}_Nm": None for name in moments})


def _coherence(*rows: PhaseForce) -> Coherence:
    return Coherence(experiment="x", mass_kg=33.0, weight_N=324.0, rows=rows, offsets=(), summary=())


def test_feet_that_bear_the_weight_worse_than_with_the_priors_are_named_with_both_errors() -> None:
    """Over the phases of both alone; one on one foot, or that was fitted, is no evidence of them."""
    prior = [_row("prior", "double", 4.5), _row("prior", "again", -1.5)]
    text = contradiction(_coherence(*prior, _row("new", "double", 14.1), _row("new", "again", 12.8)))
    assert text is not None
    assert "('double', 'again'), the net force errs by 13 N with the calibrations and 3 N with the priors" in text
    alone = (_row("prior", "left", 0.1, "l_sole"), _row("new", "left", 90.0, "l_sole"))
    fitted = (_row("prior", "fit", 0.1), _row("new", "fit", 90.0, evidence=False))
    assert contradiction(_coherence(*alone, *fitted)) is None


@pytest.mark.parametrize(("before", "after"), [(14.0, 4.0), (10.0, 12.4), (1.0, 4.2)])
def test_feet_that_bear_it_as_well_or_better_are_not(before: float, after: float) -> None:
    """Nor where both err by less than a hundredth of the weight more."""
    assert contradiction(_coherence(_row("prior", "double", before), _row("new", "double", after))) is None


def test_an_experiment_without_such_a_phase_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """No force is computed."""
    monkeypatch.setattr(module, "net_force_errors", None)
    experiment: Any = SimpleNamespace(recording=SimpleNamespace(intervals=()), contacts=())
    assert double_support(experiment, {}) is None


@pytest.mark.real_data
@pytest.mark.long
def test_a_joint_calibration_that_a_robot_on_both_feet_contradicts_is_doubted(data_dir: Path, tmp_path: Path) -> None:
    """An iCub fitted while it stands on one foot: 8 N against 3 N on both; verdicts and files say so."""
    text = (EXAMPLES / "23_icub_yoga_switching.toml").read_text(encoding="utf-8")
    text = text.replace("../../shared/data", data_dir.as_posix())
    left = 'label = "left"\nstart_s = 25.0\nend_s = 58.0\nuse = "validation"'
    assert text.count(left) == 1
    path = tmp_path / "switching.toml"
    path.write_text(text.replace(left, 'label = "left"\nstart_s = 31.5\nend_s = 45.0\nuse = "calibration"'))
    result = run(path, tmp_path / "out", override="a test", with_report=False)
    words = "the net force errs by 8 N with the calibrations and 3 N with the priors"
    assert any(words in why for answer in result.final for why in answer.why)
    assert not any(use.decision == "use" for use in result.load_cases)
    stored = [file.read_text() for file in (tmp_path / "out").glob("*_SN*.json")]
    assert len(stored) == 4
    assert all(words in one for one in stored)

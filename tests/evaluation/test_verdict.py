# SPDX-License-Identifier: BSD-3-Clause
"""What the verdict says of numbers that were made up."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Literal

import pytest

from forcetorque.base.noise.paired_comparison import Conclusion
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.summary import InformationGain
from forcetorque.evaluation.evaluation import CalibrationErrors
from forcetorque.evaluation.load_cases.validation_evidence import PriorComparison
from forcetorque.experiment.validation_offset import Offset
from forcetorque.report.sensor_assessment import Assessment, verdict

BETTER: Conclusion = "better"
WORSE: Conclusion = "worse"
ALIKE: Conclusion = "no difference"
UNTOLD: Conclusion = "inconclusive"
INTERVALS: dict[str, tuple[float, float]] = {
    BETTER: (0.4, 0.6),
    WORSE: (1.5, 2.5),
    ALIKE: (0.9, 1.1),
    UNTOLD: (0.6, 1.4),
}


def _row(candidate: str) -> CalibrationErrors:
    return CalibrationErrors(
        sensor="leg_ft", serial="S1", calibration=candidate, offset=Offset.JUDGED_MEAN, offset_source="", samples=100,
        rmse=[1.0] * 6, bias=[0.0] * 6, largest=[1.0] * 6, force_error_mean_N=1.0, force_error_standard_error_N=0.1,
        force_error_largest_N=2.0, moment_error_mean_Nm=0.1, moment_error_standard_error_Nm=0.01,
        moment_error_largest_Nm=0.2, force_error_half_width_95_N=0.2, moment_error_half_width_95_Nm=0.02,
        independent=50.0, excitation_N=20.0, excitation_Nm=2.0, load_N=30.0, load_Nm=3.0,
        prior=None if candidate.startswith("prior") else "prior",
    )  # fmt: skip


def _comparison(quantity: Literal["force", "moment"], conclusion: Conclusion, **other: Any) -> PriorComparison:
    low, high = INTERVALS[conclusion]
    given = {"sensor": "leg_ft", "calibration": "new.json", "prior": "prior", "offset": Offset.JUDGED_MEAN} | {
        "ratio": 0.5 * (low + high), "ratio_low": low, "ratio_high": high, "segments": 10,
    } | other  # fmt: skip
    return PriorComparison(
        **given, quantity=quantity, unit="N" if quantity == "force" else "N m", samples=100, mean=1.0,
        prior_mean=2.0, conclusion=conclusion, constant=0.3,
    )  # fmt: skip


def _fitted(doubts: tuple[str, ...] = ()) -> SimpleNamespace:
    """What matters to the verdict of a calibration."""
    return SimpleNamespace(validity=SimpleNamespace(excited=(True,) * 6), warnings=doubts, posterior=None)


def _report(comparisons: list[PriorComparison], **other: Any) -> Assessment:
    lists = "independence contact_forces best joint_torques spheres static criteria warnings left_out"
    empty: dict[str, Any] = dict.fromkeys(lists.split(), ())
    given = empty | {"calibrations": {"new.json": _fitted()}, "not_evaluated": {}} | other
    judged = {"evaluation": (_row("prior"), _row("new.json")), "comparisons": tuple(comparisons)}
    return Assessment.model_construct(sensor="leg_ft", serial="S1", verdict=(), **judged | given)


@pytest.mark.parametrize(
    ("force", "moment", "tone"),
    [
        (BETTER, BETTER, "good"),
        (BETTER, ALIKE, "good"),
        (BETTER, WORSE, "bad"),
        (WORSE, BETTER, "bad"),
        (ALIKE, ALIKE, "caution"),
        (BETTER, UNTOLD, "good"),
        (UNTOLD, UNTOLD, "caution"),
    ],
)
def test_a_better_force_does_not_hide_a_worse_moment(force: Conclusion, moment: Conclusion, tone: str) -> None:
    """Both are named, and the worse of the two gives the tone."""
    (line,) = verdict(_report([_comparison("force", force), _comparison("moment", moment)]))
    assert line.tone == tone
    assert f"force error 1.00 N against 2.00 N with the prior ({force}: " in line.text
    assert f"moment error 1.000 N m against 2.000 N m with the prior ({moment}: " in line.text


def test_a_calibration_in_doubt_is_never_good() -> None:
    """A wrong reference flatters what was fitted to it: the doubt is told, and what is bad stays bad."""
    doubted = {"calibrations": {"new.json": _fitted(("the gain changed by +69%",))}}
    for gain, tone in ((BETTER, "caution"), (WORSE, "bad")):
        first, second = verdict(_report([_comparison(q, gain) for q in ("force", "moment")], **doubted))
        assert (first.tone, second.tone) == (tone, "caution")
        assert second.text.endswith("has a warning from before it was fitted: the gain changed by +69%")
    passed = (SimpleNamespace(calibration="new.json", passed=True, criterion="force"),)
    for calibrations, tone in ((doubted, "caution"), ({}, "good")):
        assert verdict(_report([], criteria=passed, **calibrations))[0].tone == tone


def _learnt(*shares: float) -> tuple[InformationGain, ...]:
    return tuple(
        InformationGain(
            direction=name, uncertainty_reduction=share, force_error_before_N=1.0, force_error_after_N=1.0 - share,
            moment_error_before_Nm=1.0, moment_error_after_Nm=1.0 - share,
        )
        for name, share in zip(WRENCH_COMPONENTS, shares, strict=True)
    )  # fmt: skip


def test_what_a_generative_fit_did_not_learn_is_said_and_raw_directions_are_not() -> None:
    """A direction below half is a caution with what to do; with none there is no sentence; others as they were."""
    shy = SimpleNamespace(validity=SimpleNamespace(excited=(True, False) * 3), warnings=(), posterior="known")
    both = [_comparison(quantity, BETTER) for quantity in ("force", "moment")]
    given = {
        "calibrations": {"new.json": shy},
        "information_gain": {"new.json": _learnt(0.9, 0.9, 0.97, 0.8, 0.8, 0.04)},
    }
    _, line = verdict(_report(both, **given))
    assert line.tone == "caution"
    assert (
        "new.json: information gained: fx 90 %, fy 90 %, fz 97 %, tx 80 %, ty 80 %, tz 4 %; for tz the prior decides"
        in line.text
    )
    (_,) = verdict(_report(both, **given | {"information_gain": {"new.json": _learnt(*[0.9] * 6)}}))
    shy.posterior = None
    _, line = verdict(_report(both, calibrations={"new.json": shy}))
    assert "the fitted loads moved 3 of 6 raw directions" in line.text


def test_an_own_offset_is_called_one_draw() -> None:
    """The constant part is stated, and that intervals do not hold the change of offset."""
    fitted = [_comparison(q, BETTER, offset=Offset.FITTED) for q in ("force", "moment")]
    report = _report(fitted)
    judged = tuple(row.model_copy(update={"offset": Offset.FITTED}) for row in report.evaluation)
    first, second = verdict(report.model_copy(update={"evaluation": judged}))
    assert "0.30 N is constant" in first.text
    assert (second.tone, "one draw" in second.text) == ("note", True)


def test_what_was_not_judged_comes_last() -> None:
    """With its reason."""
    *_, last = verdict(_report([_comparison("force", BETTER)], not_evaluated={"spheres": "no grid"}))
    assert (last.tone, last.text) == ("unknown", "not evaluated: spheres: no grid")


def test_what_was_left_out_is_said() -> None:
    """After what was not judged, word by word."""
    *_, last = verdict(_report([_comparison("force", BETTER)], left_out=("torque of l_knee: no stream holds it",)))
    assert (last.tone, last.text) == ("unknown", "left out: torque of l_knee: no stream holds it")


def test_the_interval_stands_beside_the_judgement() -> None:
    """As a share of the prior's error."""
    (line,) = verdict(_report([_comparison("force", BETTER)]))
    assert line.text.endswith("with the prior (better: 0.50 of it, 0.40 to 0.60 over 10 segments)")


@pytest.mark.parametrize(
    ("ends", "stretches", "words"),
    [
        ((None, None), 1, "the errors repeat themselves, and are worth 1 segment only"),
        ((0.01, 20.0), 3, "3 segments are too few, or too unlike"),
        ((0.3, 1.7), 4, "1.00 of it, 0.30 to 1.70 over 4 segments"),
        ((1.0, 1.0), 10, "the same in every sample"),
    ],
)
def test_an_interval_that_says_nothing_is_words(
    ends: tuple[float | None, float | None], stretches: int, words: str
) -> None:
    """None, or one whose ends are more than ten times apart."""
    low, high = ends
    row = _comparison("force", UNTOLD, ratio=1.0, ratio_low=low, ratio_high=high, segments=stretches)
    assert row.against(row.prior_mean, "the prior").endswith(f"({UNTOLD}: {words})")


def test_a_prior_that_nothing_gave_an_offset_is_called_so() -> None:
    """By its field, whatever the words about its source are."""
    alone = _row("prior").model_copy(update={"offset": Offset.NONE, "offset_source": "x"})
    line = verdict(_report([], calibrations={}, evaluation=(alone,)))[0]
    assert line.text.startswith("prior with no offset removed, 100 samples")

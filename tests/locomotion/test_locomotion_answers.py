# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `torque-loop` and `coherence`: at which error the robot falls, by how much the weight is missed."""

from __future__ import annotations

from forcetorque.experiment.validation_offset import Offset
from forcetorque.locomotion.net_force.result import Coherence, CoherenceSummary
from forcetorque.locomotion.torque_control.torque_loop_study import NO_ERROR, TorqueLoopRow, TorqueLoopStudy
from forcetorque.results.answer import Concern


def _row(errors: str, force: float, falls: int) -> TorqueLoopRow:
    return TorqueLoopRow(
        tilt_deg=0.0,
        gain_factor=1.0,
        errors=errors,
        scale=force / 10.0,
        force_error_N=force,
        runs=20,
        tracking_rms_Nm=1.0 + force / 10.0,
        tracking_half_width_95_Nm=0.5,
        centre_rms_mm=3.0,
        falls=falls,
        falls_least_percent=1.0,
        falls_most_percent=32.0,
        oscillating=falls,
        oscillating_least_percent=0.0,
        oscillating_most_percent=20.0,
        amplitude_mm=None,
    )


def _study(*rows: TorqueLoopRow) -> TorqueLoopStudy:
    return TorqueLoopStudy(name="loop", weight_N=300.0, duration_s=20.0, delay_s=0.001, rows=rows, onsets=())


def test_the_smallest_error_with_a_fall_is_the_verdict() -> None:
    """With the interval of the share; what a robot without errors does stands beside the tracking error."""
    (answer,) = _study(_row(NO_ERROR, 0.0, 0), _row("matrix", 40.0, 9), _row("matrix", 20.0, 2)).answers()
    assert answer.verdict == "FALLS: 2 of 20 (95 %: 1 to 32 %) at a force error of 20 N"
    assert answer.why[0] == (
        "torque tracking error 5 N m (95 %: 5.5 N m) at 40 N of force error, 1 N m (95 %: 1.5 N m) without"
    )
    assert answer.concern is Concern.UNCERTAIN


def test_no_fall_is_said_up_to_the_largest_error() -> None:
    """Beyond it nothing is known."""
    (answer,) = _study(_row("matrix", 20.0, 0)).answers()
    assert (answer.verdict, answer.concern) == ("NO FALL up to a force error of 20 N", Concern.NONE)


def test_the_candidate_with_least_error_comes_first() -> None:
    """One without evidence comes last, and asks for attention."""
    summary = [
        CoherenceSummary(
            calibration=name,
            offset=Offset.FITTED,
            offset_interval=None,
            phases=0 if mean is None else 2,
            force_error_mean_N=mean,
            force_error_largest_N=mean,
        )
        for name, mean in (("prior", None), ("b.json", 3.0), ("a.json", 1.0))
    ]
    coherence = Coherence(
        experiment="walk", mass_kg=30.0, weight_N=300.0, rows=(), offsets=(), summary=tuple(summary), figure="a.png"
    )
    answers = list(coherence.answers())
    assert [answer.verdict for answer in answers] == [
        "net force error 1 N (largest 1 N)",
        "net force error 3 N (largest 3 N)",
        "NO EVIDENCE",
    ]
    assert [answer.concern for answer in answers] == [Concern.NONE, Concern.NONE, Concern.UNCERTAIN]
    assert answers[0].written == ("a.png",)

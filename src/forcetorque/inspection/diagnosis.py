# SPDX-License-Identifier: BSD-3-Clause
"""The fault of the experiment file, URDF or log that best explains why a sensor disagrees with the robot model.

Nothing is compared where the expected wrench does not move. A fault counts if it explains the measurements far better
than the errors of a mounted sensor and what the model usually has wrong; faults that explain them nearly as well are
named with it, since the log does not separate them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison, compared, robot_of
from forcetorque.inspection.fault_messages import fault_size, fault_text, remedy
from forcetorque.inspection.plausibility.evidence import Evidence, Fit
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation, explanations, senses
from forcetorque.inspection.plausibility.sense_gain_and_unit_checks import require_moving_load
from forcetorque.recording.recording import Finding

_ROUNDS = 3
"""How often weights and deviation follow the best explanation."""
GAIN: Final = 12.0
"""Logarithm of the ratio of likelihoods from which on a fault explains measurements far better than none: a heuristic,
chosen on simulated logs without faults."""
_WORTH_A_REFIT = GAIN / 2.0
"""Gain of the best explanation below which none is fitted again: no fault comes near to what counts."""
_REFITTED = 6
"""How many of the best explanations are fitted again with the weights that they give."""
_PARAMETER = 2.0
"""Evidence that a fitted parameter costs."""
_LEAST_EXPLAINED = 0.5
"""Share of the residual of force or of moment that a fault explains at least: less has other causes too."""
_MOST_WORSE = 1.2
"""Factor by which a fault may increase the residual of force or moment."""
_STABILITY: Final = 1e-3
"""Drift of a good sensor in a log, relative to its full scale."""
_AS_GOOD = 4.0
"""Difference in evidence below which two faults explain measurements alike."""
_LEAST: Final = {"mass": 0.1, "mount": 0.035, "gravity": 0.035, "joint_offset": 0.026, "delay": 0.015}
"""Parameters below which a fault is within what robots and mounts have: share, rad, s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Diagnosis:
    """What explains the measurements of a sensor."""

    nothing: Fit
    """How well the model as it is does."""
    evidence: Evidence
    """The measurements, with the weights of the best explanation."""
    faults: tuple[Explanation, ...]
    """Faults that explain them far better, alike, the best first; none where nothing is wrong."""


def diagnosed(comparison: Comparison, *, only_sense: bool = False) -> Diagnosis | None:
    """Find the faults that best explain the measurements of a sensor.

    Args:
        comparison: Measured and expected wrenches.
        only_sense: Whether only reversed senses are looked for, which takes no evaluation of the robot model.

    Returns:
        The diagnosis; None where the expected wrench does not move.
    """
    sensor, expected = comparison.run.sensor, comparison.expected
    try:
        require_moving_load(Moments.of(comparison.measured, expected))
    except FitError:
        return None
    seconds = (comparison.at_ns - comparison.at_ns[0]) * 1e-9
    prior = None if sensor.prior_source == "identity" else sensor.prior
    evidence = Evidence.of(comparison.measured, expected, seconds, prior)
    robot = None if only_sense else robot_of(comparison)
    found: Sequence[Explanation] = ()
    nothing = evidence.fit(expected)
    for _ in range(_ROUNDS):
        nothing = evidence.fit(expected)
        if only_sense:
            found = tuple(senses(evidence, expected))
        elif not found:
            found = tuple(explanations(evidence, expected, robot, is_raw=sensor.quantity == "raw"))
        else:
            found = tuple(_again(evidence, one) for one in found)
        best = max((one.fit for one in found), key=lambda fit: fit.evidence)
        evidence = evidence.reweighted(best if best.evidence > nothing.evidence + GAIN else nothing)
    nothing = evidence.fit(expected)
    if max(map(_worth, found)) < nothing.evidence + _WORTH_A_REFIT:
        return Diagnosis(nothing=nothing, evidence=evidence, faults=())
    if not only_sense:
        top = sorted(found, key=lambda one: -_worth(one))[:_REFITTED]
        again = {(one.kind, one.about) for one in top}
        found = tuple(explanations(evidence, expected, robot, is_raw=sensor.quantity == "raw", only=again))
    nothing = evidence.fit(expected)
    ranked = sorted(found, key=lambda one: -_worth(one))
    shortest = 0.0 if robot is None else robot.shortest_delay_s
    stability = stability_of(sensor)
    counted = [
        one
        for one in ranked
        if _counts(evidence, nothing, one, shortest) and _shown(evidence, nothing, one, stability) is not None
    ]
    faults = [one for one in counted if _worth(one) > _worth(counted[0]) - _AS_GOOD]
    return Diagnosis(nothing=nothing, evidence=evidence, faults=tuple(faults))


def _again(evidence: Evidence, explanation: Explanation) -> Explanation:
    return replace(explanation, fit=evidence.fit(explanation.expected, explanation.turn))


def _worth(explanation: Explanation) -> float:
    return explanation.fit.evidence - _PARAMETER * explanation.parameters


_OF_LOG: Final = ("reversed", "component_reversed", "columns", "moment_unit", "mass", "joint_unit")
"""Faults so large that they show beside any error of a matrix."""


def _counts(evidence: Evidence, nothing: Fit, one: Explanation, shortest_delay_s: float) -> bool:
    """Whether a fault explains the measurements far better than none, and is beyond what robots have."""
    if _worth(one) < nothing.evidence + GAIN or not evidence.follows(one.fit):
        return False
    if one.value is None or one.half_width is None:
        return True
    off = abs(one.value - 1.0) if one.kind == "mass" else abs(one.value)
    return off - one.half_width > _LEAST.get(one.kind, 0.0) and (one.kind != "delay" or off >= shortest_delay_s)


def _shown(
    evidence: Evidence, nothing: Fit, one: Explanation, stability: FloatArray | None
) -> tuple[bool, FloatArray, FloatArray] | None:
    """What a fault leaves of the residual, where it explains most of that of force or moment and worsens neither.

    What it removes is more than the sensor drifts by itself; of a delay, which no drift looks like, more than noise.

    Returns:
        Whether errors of the matrix are taken out, and the residuals without the fault and with it; shape (2,); N, N m;
        None where the fault does not show.
    """
    noise = np.array([np.linalg.norm(evidence.deviation[own]) for own in FORCE_AND_MOMENT])
    least = noise
    if stability is not None and one.kind != "delay":
        least = np.maximum(noise, [np.linalg.norm(stability[own]) for own in FORCE_AND_MOMENT])
    for beside_matrix in (False,) if one.kind in _OF_LOG else (False, True):
        before, after = (evidence.left(fit, beside_matrix=beside_matrix) for fit in (nothing, one.fit))
        is_worse = after > _MOST_WORSE * np.maximum(before, noise)
        explains = (after < (1.0 - _LEAST_EXPLAINED) * before) & (before**2 - after**2 > least**2)
        if explains.any() and not is_worse.any():
            return beside_matrix, before, after
    return None


def stability_of(sensor: ExperimentSensor) -> FloatArray | None:
    """Give the drift in a log that any sensor of its range has.

    Args:
        sensor: The sensor; its range is what the file specifies, else by the limit of the counts.

    Returns:
        Per component; shape (6,); N, N m; None where neither is known.
    """
    full_scale = sensor.full_scale
    if full_scale is None:
        if sensor.prior is None or sensor.prior_source == "identity":
            return None
        full_scale = sensor.limit_counts * np.linalg.norm(sensor.prior, axis=1)
    return np.asarray(_STABILITY * full_scale)


def fault_finding(comparison: Comparison, diagnosis: Diagnosis) -> Finding:
    """Make the finding of a diagnosis that has faults.

    Args:
        comparison: Measured and expected wrenches.
        diagnosis: The diagnosis.

    Returns:
        The best fault, what to change, and those that the log does not separate from it.

    Raises:
        ValueError: If there is no fault that the measurements show.
    """
    # gravity upwards is found as a sense and as a direction: the likelier of the two is named
    distinct: dict[tuple[str, str], Explanation] = {}
    for one in diagnosis.faults:
        distinct.setdefault((one.kind, one.about), one)
    best, *others = distinct.values()
    stability = stability_of(comparison.run.sensor)
    shown = _shown(diagnosis.evidence, diagnosis.nothing, best, stability)
    if shown is None:
        raise ValueError(f"expected a fault that the measurements show, got {best.kind}")
    beside_matrix, before, after = shown
    beside = " beside errors of the matrix" if beside_matrix else ""
    message = (
        f"{fault_text(comparison, best)}: residual{beside} {before[0]:.2g} -> {after[0]:.2g} N, "
        f"{before[1]:.2g} -> {after[1]:.2g} N m; {remedy(comparison, best)}"
    )
    if others:
        listed = "; or ".join(f"{fault_text(comparison, one)} ({remedy(comparison, one)})" for one in others)
        message += f"; this log does not separate it from: {listed}"
    if not best.changes_every_instant_alike:
        message += "; steps, contacts and drift are looked for once that is put right"
    size, unit = fault_size(best)
    return Finding(
        stream=comparison.run.sensor.stream,
        kind=best.kind,
        message=message,
        count=sum(len(part.samples) for part in comparison.parts),
        channel=best.about if best.kind in ("joint_sign", "joint_offset") else None,
        size=size,
        unit=unit,
    )


def reversed_sensors(experiment: Experiment, corrections: Mapping[str, Correction]) -> Iterator[str]:
    """Warn of sensors, or components, that measure the opposite of the expected wrench.

    Args:
        experiment: The experiment.
        corrections: How its sensors are read, by name.

    Yields:
        A sentence per sensor; none where nothing moves, or something touches the robot beyond the sensor.
    """
    for name, correction in corrections.items():
        run = SensorRun(experiment, name)
        try:
            comparison = compared(run, correction.bare)
        except ForceTorqueError:
            continue  # what the model lacks is no news of the sense
        diagnosis = None if comparison is None else diagnosed(comparison, only_sense=True)
        if comparison is not None and diagnosis is not None and diagnosis.faults:
            best = diagnosis.faults[0]
            yield f"{name}: {fault_text(comparison, best)}; {remedy(comparison, best)}; see `forcetorque inspect`"

# SPDX-License-Identifier: BSD-3-Clause
"""The fault of the experiment file, URDF or log that best explains why a sensor disagrees with the robot model.

Nothing is compared where the expected wrench does not move. A fault counts if it explains the measurements far better
than the errors of a mounted sensor and what the model usually has wrong; faults that explain them nearly as well are
named with it, since the log does not separate them. A message states its size, and the line of the file to change.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison, compared, robot_of
from forcetorque.inspection.plausibility.evidence import Evidence, Fit
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation, explanations, senses
from forcetorque.inspection.plausibility.gravity_sense_gain_and_unit_checks import require_moving_load
from forcetorque.recording.alignment import ClockShift
from forcetorque.recording.recording import Finding


def fault_size(one: Explanation) -> tuple[float | None, str | None]:
    """Give the size of a fault, for its finding.

    Returns:
        Size and unit; None each for a fault without a parameter.
    """
    if one.value is None:
        return None, None
    if one.kind in ("mount", "gravity", "joint_offset"):
        return float(np.rad2deg(one.value)), "deg"
    return (one.value, "s") if one.kind == "delay" else (one.value, "times")


def _interval(one: Explanation, factor: float = 1.0, digits: str = ".3g") -> str:
    """Value with its 95 % interval."""
    value = (one.value or 0.0) * factor
    if one.half_width is None:
        return f"{value:{digits}}"
    half = one.half_width * abs(factor)
    return f"{value:{digits}} (95 %: {value - half:{digits}} to {value + half:{digits}})"


def fault_text(comparison: Comparison, one: Explanation) -> str:
    """Say what is wrong, with its size.

    Args:
        comparison: The compared samples.
        one: The fault.

    Returns:
        A clause.
    """
    degrees = float(np.rad2deg(1.0))
    if one.kind == "reversed":
        return "the sensor measures the opposite of the expected wrench"
    if one.kind == "component_reversed":
        return f"{one.about} has the opposite sign, the rest of the wrench has not"
    if one.kind == "gravity":
        return f"gravity is off the specified direction by {_interval(one, degrees)} deg"
    if one.kind == "mass":
        return f"the sensor measures {_interval(one)} times the expected wrench"
    if one.kind == "joint_sign":
        return f"joint {one.about!r} turns the other way"
    if one.kind == "joint_offset":
        across = " in the mean over readings that jump" if _jumps(comparison, one.about) else ""
        return f"the zero of joint {one.about!r} is off by {_interval(one, degrees)} deg{across}"
    if one.kind == "joint_unit":
        return f"positions of the joints are in {one.about}"
    if one.kind == "columns":
        return one.about
    if one.kind == "moment_unit":
        return f"moments are in {one.about}, read as N m"
    if one.kind == "delay":
        return _delay_text(comparison, one)
    vector = np.zeros(3) if one.vector is None else one.vector
    return f"the sensor is turned by {_interval(one, degrees)} deg about {_axis_text(vector)} against the URDF"


def _jumps(comparison: Comparison, joint: str) -> bool:
    """Whether compared samples lie on both sides of a jump of a joint, so that no one zero is right for all."""
    recording, at_ns = comparison.run.experiment.recording, comparison.at_ns
    return any(
        len(np.unique((at_ns >= jump.start_ns) & (at_ns <= jump.end_ns))) == 2
        for jump in recording.findings
        if jump.kind == "joint_jump" and jump.channel == joint and jump.start_ns is not None and jump.end_ns is not None
    )


def _delay_text(comparison: Comparison, one: Explanation) -> str:
    later = (one.value or 0.0) > 0.0
    amount = f"{_interval(one, 1e3 if later else -1e3, '.0f')} ms {'later' if later else 'earlier'}"
    if one.about:
        return f"stream {one.about!r} of joints comes {amount} than the others"
    recording = comparison.run.experiment.recording
    what = "the joints" if recording.joint_signals("position") else "its pose"
    wrench = "the wrench of " if len(set(late_and_kept(comparison, one))) == 1 else ""
    return f"{wrench}stream {comparison.run.sensor.stream!r} comes {amount} than {what}"


def late_and_kept(comparison: Comparison, one: Explanation) -> tuple[str, str]:
    """Name the streams of a delay.

    Args:
        comparison: The compared samples.
        one: The delay.

    Returns:
        The stream that is late, and that whose clock is kept; the same where one stream has wrench and motion.
    """
    run = comparison.run
    if one.about:
        return one.about, run.sensor.stream
    holders = run.experiment.recording.joint_signals("position")
    support = comparison.parts[0].interval.support
    poses: Sequence[str] = getattr(support, "motion_streams", ())
    motion = dict.fromkeys([*(stream.name for stream, _ in holders.values()), *poses])
    return run.sensor.stream, next(iter(motion), run.sensor.stream)


def _axis_text(vector: FloatArray) -> str:
    largest = int(np.argmax(np.abs(vector)))
    if abs(vector[largest]) > 0.97:
        return "xyz"[largest]
    return f"({', '.join(f'{value:.2f}' for value in vector)})"


def remedy(comparison: Comparison, one: Explanation) -> str:
    """Name the line of the experiment file or URDF to change.

    Args:
        comparison: The compared samples.
        one: The fault.

    Returns:
        A clause in the imperative.
    """
    run = comparison.run
    name, support = run.sensor.name, comparison.parts[0].interval.support
    frame = "" if support is None else support.frame
    if one.kind == "reversed":
        return (
            f"turn <measure_direction> of the sensor tag {name!r} in the URDF, or measure_direction of [[sensor]], or "
            "gravity_direction of [[support]], the other way round"
        )
    if one.kind == "component_reversed":
        return (
            f"check the sign of {one.about} in columns of [[recording.stream]] {run.sensor.stream!r} and in prior of "
            f"[[sensor]] {name!r}"
        )
    if one.kind == "gravity":
        vector = np.zeros(3) if one.vector is None else one.vector
        listed = ", ".join(f"{value:.3g}" for value in np.round(vector, 3) + 0.0)
        return f'write gravity_direction = [{listed}] of [[support]] frame = "{frame}"'
    if one.kind == "mass":
        return (
            f"check the mass of the links beyond {name!r} in the file that urdf of [robot] names, mass_kg of [load], "
            f"and prior of [[sensor]] {name!r}, at the amplifier gains of the recording"
        )
    if one.kind in ("joint_offset", "joint_sign") and _jumps(comparison, one.about):
        return "leave what is beyond the jump out by an [[interval]] that `forcetorque inspect` states"
    if one.kind == "joint_sign":
        return f"turn the sign of its column in [[recording.stream]], or <axis> of joint {one.about!r} in the URDF"
    if one.kind == "joint_offset":
        return (
            f"add it to the column of {one.about!r} in [[recording.stream]], or turn <origin rpy> of the joint in the "
            "URDF about its axis by it"
        )
    if one.kind == "joint_unit":
        unit = "deg" if one.about.startswith("degrees") else "rad"
        return f'write "{unit}" in units of [[recording.stream]] for the joints'
    if one.kind == "columns":
        return (
            f"put columns of [[recording.stream]] {run.sensor.stream!r} in the order fx, fy, fz, tx, ty, tz, raw "
            "channels in that of the prior"
        )
    if one.kind == "moment_unit":
        return (
            f'write "{one.about}" in units of [[recording.stream]] {run.sensor.stream!r}, or check prior of [[sensor]] '
            f"{name!r}"
        )
    if one.kind == "delay":
        late, other = late_and_kept(comparison, one)
        shifts, delay_s = run.experiment.recording.clocks, one.value or 0.0
        if late != other and any(shift.stream == late for shift in shifts):
            return f"add {delay_s:.3f} to delay_s of [[clock]] {late!r}"
        clock, is_first = clock_of_division(late, delay_s, shifts)
        if late != other:
            clock |= {"to": other}
        keys = f'stream = "{clock["stream"]}", to = "{clock["to"]}", delay_s = {clock["delay_s"]:.3f}'
        keys += "".join(f", drift = {clock[key]:g}" for key in clock if key == "drift")
        write = f"write [[clock]] {keys}" + (", in front of the others" if is_first else "")
        if late != other:
            return write
        return (
            "of a table list the signals of the motion in a [[recording.stream]] of their own, name = "
            f'"{motion_name(late)}", with the same file and stamp, and {write}; `forcetorque init --resume` proposes '
            "both, and writes them where the stream has a header [[recording.stream]] and no comment stands within "
            "signal = [...]"
        )
    return f"turn <origin rpy> of the fixed joint of {name!r} in the URDF, or mount the sensor as the URDF has it"


def clock_of_division(stream: str, delay_s: float, shifts: Sequence[ClockShift]) -> tuple[dict[str, Any], bool]:
    """Give the `[[clock]]` that brings wrench and motion of one table together, once they are two streams.

    Args:
        stream: The stream, which the motion leaves.
        delay_s: By how much the stamps of the sensor's signals are late; s.
        shifts: What the clocks that the file has did.

    Returns:
        Its keys, and whether it stands in front of the others. A stream is brought to a clock once, before others are
        brought to its: where the stream is brought to one, the motion is brought to the stream.
    """
    known = next((one for one in shifts if one.stream == stream), None)
    if known is None:
        clock = {"stream": stream, "to": motion_name(stream), "delay_s": round(delay_s, 4)}
        return clock, any(one.to == stream for one in shifts)
    clock = {"stream": motion_name(stream), "to": stream, "delay_s": round(known.delay_s - delay_s, 4)}
    return clock | ({"drift": known.drift} if known.drift else {}), False


def motion_name(stream: str) -> str:
    """Name the stream that the signals of a motion are divided from another as."""
    return f"{stream}_motion"


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

# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong, with its size, and the line of the experiment file or URDF to change."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.inspection.comparison_with_model import Comparison
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation
from forcetorque.recording.alignment import ClockShift


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
            "both, and writes them"
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

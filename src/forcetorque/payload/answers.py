# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `payload` and `tare`: mass and centre of a load, and the offset that keeps its weight."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.formats.arm_log import BAG
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.load_warnings import reason_to_withhold, samples_disagree, torque_doubt
from forcetorque.payload.result import FROM_FIRST_TO_LAST, fitted_drifts, gravity_words, mount_words, tilt_words
from forcetorque.results.answer import EXPERIMENT, FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import amount, plus_minus
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.payload.load_by_joint_torques import TorqueLoad
    from forcetorque.payload.result import LoadRow, WeighedLoad
    from forcetorque.payload.tare_offset import Tare


_PROGRAMS = {"ur_rtde": LoadFormat.UR, "franka": LoadFormat.FRANKA}
"""Program that reads the load of an arm, by the format of its log."""
_FILES = {LoadFormat.UR: "load.script", LoadFormat.FRANKA: "load.py"}
"""Usual names of files of such programs."""


def payload_answers(weighed: WeighedLoad) -> Iterator[Answer]:
    """Give the answer for every load.

    Yields:
        One answer each.
    """
    contradicted = any(row.severity == "contradiction" for row in weighed.hypotheses)
    contradicted |= any(arm.contradictions for arm in weighed.arms)
    written = weighed.robot_file is not None and not contradicted  # the file is what would come next
    step, command = ("", "") if written else _payload_step(weighed)
    for load in weighed.loads:
        name = "" if load.load == "load" else f", {load.load}"
        doubtful = bool(contradicted or weighed.undetermined or load.mass_kg is None or samples_disagree(weighed))
        yield Answer(
            subject=f"{weighed.sensor} ({weighed.serial}){name}",
            verdict=_load_verdict(load),
            why=(*_reasons(weighed), *_assumed(weighed)),
            step=step,
            command=command,
            written=(weighed.robot_file,),
            concern=Concern.BAD if contradicted else Concern.UNCERTAIN if doubtful else Concern.NONE,
        )


def torque_answers(held: TorqueLoad) -> Iterator[Answer]:
    """Give the answer for the load that joint torques hold.

    Yields:
        One answer.
    """
    doubt, is_written = torque_doubt(held.load), held.robot_file is not None
    more = "record more postures that turn the wrist"
    controller = held.arms[-1].controller
    specified = [word for entry in held.arms[-1].specified for word in ("--recording", entry)]
    write = _write(LoadFormat(controller), *specified)
    yield Answer(
        subject="joint torques",
        verdict=_load_verdict(held.load),
        why=(
            f"{held.postures} postures at rest; the largest bias of a joint is {_largest_bias(held)}",
            *(f"assumed: {words}" for words in dict.fromkeys("; ".join(arm.assumed) for arm in held.arms)),
        ),
        step=more if doubt else "" if is_written else "write it to a file that the robot reads",
        command="" if doubt or is_written else write,
        written=(held.robot_file,),
        concern=Concern.UNCERTAIN if doubt else Concern.NONE,
    )


def _largest_bias(held: TorqueLoad) -> str:
    row = max(held.joints, key=lambda row: abs(row.bias_Nm))
    return f"{row.bias_Nm:.3g} N m, of {row.joint}"


def _load_verdict(load: LoadRow) -> str:
    if load.mass_kg is None:
        return "MASS NOT IDENTIFIABLE"
    known = [1e3 * value for value in load.centre_of_mass_m if value is not None]
    halves = [1e3 * value for value in load.centre_of_mass_half_width_95_m if value is not None]
    if not load.estimated:
        centre = f" at ({', '.join(f'{value:.4g}' for value in known)}) mm" if len(known) == len("xyz") else ""
        return f"{load.mass_kg:.4g} kg{centre}, as stated"
    mass = plus_minus(load.mass_kg, load.mass_half_width_95_kg, "kg")
    if len(known) < len("xyz"):
        return f"{mass}, centre of mass not identifiable"
    return f"{mass} at {plus_minus(known, max(halves) if len(halves) == len(known) else None, 'mm')}"


def _reasons(weighed: WeighedLoad) -> tuple[str, ...]:
    if samples_disagree(weighed):
        first = reason_to_withhold(weighed.model_copy(update={"hypotheses": ()})) or ""
        return (first, *_turned(weighed), _bias(weighed), *_drift(weighed), _bias_elsewhere(weighed))
    samples = () if weighed.arms else (_samples(weighed),)  # what is assumed of a log takes their place
    return (*_turned(weighed), _bias(weighed), *_drift(weighed), _bias_elsewhere(weighed), *samples)


def _turned(weighed: WeighedLoad) -> Iterator[str]:
    """Mount and tilt, where the file asks for them."""
    if weighed.mount_rad is not None:
        yield mount_words(weighed.mount_rad, weighed.mount_half_width_rad)
    if weighed.tilt_rad is not None:
        yield tilt_words(weighed.tilt_rad, weighed.tilt_half_width_rad)


def _assumed(weighed: WeighedLoad) -> Iterator[str]:
    """What was taken from the format of logs without an experiment file."""
    for words in dict.fromkeys("; ".join(arm.assumed) for arm in weighed.arms):
        yield f"assumed: {words}"


def _worst_session(weighed: WeighedLoad) -> str | None:
    """The session of which most samples disagree; None where there is one only, or none disagree."""
    names = [row.session for row in weighed.disagreeing]
    shares = {row.session: names.count(row.session) / row.observations for row in weighed.sessions if row.observations}
    return max(shares, key=lambda name: shares[name]) if names and len(shares) > 1 else None


def _drift(weighed: WeighedLoad) -> Iterator[str]:
    """The component of a bias whose drift is furthest beyond its half-width."""
    beyond = [
        (abs(drift) / half, session.session, f"{name} by {plus_minus(drift, half, unit)}")
        for session in weighed.sessions
        for name, unit, drift, half in fitted_drifts(session)
        if abs(drift) > half > 0.0
    ]
    if beyond:
        _, session, text = max(beyond)
        of = f" of {session!r}" if len(weighed.sessions) > 1 else ""
        yield f"the bias{of} drifts {FROM_FIRST_TO_LAST}: {text}"


def _bias(weighed: WeighedLoad) -> str:
    """The sign of a bias is what people get wrong: it is what is measured without load."""
    last, parts = weighed.sessions[-1], []
    for first, unit in ((0, "N"), (3, "N m")):
        bias = [value for value in last.bias[first : first + 3] if value is not None]
        halves = [value for value in last.bias_half_width_95[first : first + 3] if value is not None]
        if len(bias) == len(halves) == len("xyz"):
            parts.append(plus_minus(bias, max(halves), unit))
    of = (
        "" if len(weighed.sessions) == 1 else f" of {last.session!r}, the last of {len(weighed.sessions)} power cycles,"
    )
    return f"bias{of} to be subtracted from measurements: {', '.join(parts) or 'not identifiable'}"


def _bias_elsewhere(weighed: WeighedLoad) -> str:
    """The interval of a bias knows noise within a recording, and not what another day or power cycle changes."""
    between = [test.largest_difference for test in weighed.bias_tests if test.of == "sessions"]
    moved = [value for value in between[0] if value is not None] if between else []
    if len(moved) < len(WRENCH_COMPONENTS):
        return "the interval of the bias holds in this recording, not on another day: tare before use"
    within = [max(moved[part]) <= _largest_half_width(weighed, part) for part in FORCE_AND_MOMENT]
    if all(within):
        return "power cycles moved the bias by no more than its interval"
    force, moment = (max(moved[part]) for part in FORCE_AND_MOMENT)
    return f"power cycles moved the bias by up to {amount(force, 'N')}, {amount(moment, 'N m')}: tare before use"


def _largest_half_width(weighed: WeighedLoad, part: slice) -> float:
    return max((value or 0.0 for value in list(weighed.sessions[-1].bias_half_width_95)[part]), default=0.0)


def _samples(weighed: WeighedLoad) -> str:
    disagreeing = len(weighed.disagreeing)
    count = f"{weighed.observations} samples" + (
        f", {disagreeing} disagree with the others and count less" if disagreeing else ""
    )
    text = f"{count}; the loads move {weighed.spanned_directions} of 6 directions of wrench"
    gravity = weighed.assumed_gravity_m_per_s2
    return text if gravity is None else f"{text}; assumed: {gravity_words(gravity)}"


def _payload_step(weighed: WeighedLoad) -> tuple[str, str]:
    if contradictions := [words for arm in weighed.arms for words in arm.contradictions]:
        return contradictions[0], ""
    if weighed.hypotheses:
        first = weighed.hypotheses[0]
        return f"check for {first.name}: {first.description}", ""
    if samples_disagree(weighed):
        worst = _worst_session(weighed)
        which = "what disagrees, in --details" if worst is None else f"{worst!r}, which disagrees"
        words = f"look at {which}: contact is the likely cause; leave that out of the fit, and repeat"
        return words, typed("inspect", FIRST_EXPERIMENT)
    if weighed.undetermined:
        return "record more postures, which turn the load about other axes", ""
    if weighed.no_robot_file:
        return f"no file for a robot holds it: {weighed.no_robot_file}", ""
    step = "write it to a file that the robot reads"
    specified = [word for arm in weighed.arms[-1:] for entry in arm.specified for word in ("--recording", entry)]
    if not weighed.arms and weighed.log_format in _PROGRAMS:
        return step, _write(_PROGRAMS[weighed.log_format])
    if not weighed.arms or weighed.arms[-1].controller == BAG:
        return step, typed("payload", EXPERIMENT, *specified, "--to", LoadFormat.FT_TOOLS.value, "-o", "load.yaml")
    return step, _write(LoadFormat(weighed.arms[-1].controller), *specified)


def _write(form: LoadFormat, *specified: str) -> str:
    """The command that writes a load for the program of an arm."""
    return typed("payload", EXPERIMENT, *specified, "--to", form.value, "-o", _FILES[form])


def tare_answers(tare: Tare) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        tare: Offsets of sensors.

    Yields:
        One answer each.
    """
    for row in tare.sensors:
        name = short_names([row.wrench_source])[row.wrench_source]
        force, moment = (
            plus_minus(list(row.offset[part]), float(max(row.half_width_95[part])), unit)
            for part, unit in zip(FORCE_AND_MOMENT, ("N", "N m"), strict=True)
        )
        moves = row.load_moves
        weighs = "the load " if moves else f"the load weighs {amount(row.weight_N, 'N')} and "
        yield Answer(
            subject=f"{row.sensor} ({row.serial}), {name}",
            verdict="THE LOAD MOVES" if moves else f"force offset {force}",
            why=(
                f"moment offset {moment}; {'force offset ' + force + '; ' if moves else ''}to be added to measurements",
                f"{weighs}moves by {amount(row.load_moves_N, 'N')} in {row.samples} samples of {row.interval!r}",
            ),
            step="add an [[interval]] in which nothing moves, and name it by --interval" if moves else "",
            written=(tare.figure_file,) if row is tare.sensors[-1] else (),
            concern=Concern.UNCERTAIN if moves else Concern.NONE,
        )

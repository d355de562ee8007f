# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `balance`, `coherence`, `motion`, `torque-loop` and `oscillation-causes` in a few lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.locomotion.torque_control.torque_loop_study import NO_ERROR
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, bounded, plus_minus, within
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.locomotion.motion_quality import Motion, OscillationRow
    from forcetorque.locomotion.net_force.result import Coherence, CoherenceSummary
    from forcetorque.locomotion.standing.balance import Balance
    from forcetorque.locomotion.standing.result import SupportPhaseRow
    from forcetorque.locomotion.standing.sole_limits import SoleEventRow
    from forcetorque.locomotion.torque_control.oscillation_causes import CauseRow, OscillationCauses
    from forcetorque.locomotion.torque_control.torque_loop_study import TorqueLoopRow, TorqueLoopStudy

_NAMED = 3
"""Phases or phenomena that are named; tables have all."""
_EVENTS = {
    "slip": "slips, or holds more than its friction",
    "slip_risk": "may slip",
    "outside": "pressed outside its outline, which the ground cannot do",
    "pulls": "pulled, which the ground cannot do",
}


def balance_answer(balance: Balance) -> Answer:
    """Say which feet bear the robot, and where.

    Args:
        balance: Phases and centres of pressure.

    Returns:
        The answer.
    """
    phases = sorted(balance.phases, key=lambda row: -row.duration_s)
    whole = sum(row.duration_s for row in phases)
    shares = ", ".join(f"{row.phase} {100.0 * row.duration_s / (whole or 1.0):.0f} %" for row in phases[:_NAMED])
    weight = "" if balance.weight_N is None else f", weight {amount(balance.weight_N, 'N')}"
    return Answer(
        subject=f"{', '.join(balance.experiments)}{weight}",
        verdict=f"DOWN: {shares} of {whole:.3g} s" if phases else "NO FOOT IS DOWN",
        why=(*([_net_force(phases[0])] if phases else []), *_pressure(balance), *event_texts(balance.events)),
        concern=Concern.UNCERTAIN if balance.refused or balance.events or not phases else Concern.NONE,
    )


def _net_force(row: SupportPhaseRow) -> str:
    if row.net_N is None:
        return f"net force on {row.phase}: not known"
    less = "" if row.from_weight_N is None else f", less the weight {row.from_weight_N:+.1f} N"
    return f"net force on {row.phase}: {plus_minus(row.net_N, row.half_width_95_N, 'N')}{less}, {row.samples} samples"


def _pressure(balance: Balance) -> Iterator[str]:
    """Centre of pressure of the robot, else of its feet, else why there is none."""
    for row in balance.robot[:1]:
        if row.x_mm is not None and row.y_mm is not None:
            halves = [half for half in (row.half_width_x_mm, row.half_width_y_mm) if half is not None]
            centre = plus_minus((row.x_mm, row.y_mm), max(halves, default=None), "mm")
            yield f"centre of pressure in {row.interval}: (x, y) = {centre} on {row.frame}"
            return
    yield from balance.refused[:1]


def event_texts(events: Sequence[SoleEventRow]) -> Iterator[str]:
    """Name the longest time of each kind in which a sole bears what the ground cannot do, or may slip.

    Args:
        events: The events.

    Yields:
        One line per kind.
    """
    for kind, text in _EVENTS.items():
        rows = [row for row in events if row.kind == kind]
        if rows:
            row = max(rows, key=lambda row: row.end_s - row.start_s)
            more = f", and {len(rows) - 1} more" if len(rows) > 1 else ""
            yield f"{text}: {row.sole} from {row.start_s:.2f} to {row.end_s:.2f} s{_size(row)}{more}"


def _size(row: SoleEventRow) -> str:
    if row.beyond_mm is not None:
        return f", by {plus_minus(row.beyond_mm, row.beyond_half_width_95_mm, 'mm')}"
    if row.used_percent is not None:
        return f", {plus_minus(row.used_percent, row.used_half_width_95_percent, '%')} of its friction"
    return f", {amount(row.normal_N, 'N')}"


def coherence_answers(coherence: Coherence) -> Iterator[Answer]:
    """Say by how much the net contact force misses the weight, for every candidate and offset.

    Args:
        coherence: Net contact forces.

    Yields:
        One answer each, those with less error first.
    """
    names = short_names([row.calibration for row in coherence.summary])
    rows = sorted(coherence.summary, key=lambda row: (row.force_error_mean_N is None, row.force_error_mean_N or 0.0))
    for row in rows:
        offset = row.offset.value if row.offset_interval is None else f"{row.offset}:{row.offset_interval}"
        counted = f"{row.phases} phase{'s' * (row.phases != 1)}"
        yield Answer(
            subject=f"{coherence.experiment}, {names[row.calibration]}, {offset} offset",
            verdict=_net_error(row),
            why=(
                f"net contact force of {counted} less the weight, {amount(coherence.weight_N, 'N')}: mean of the norm, "
                f"and the largest{_against_prior(row)}",
                *_predicted(row),
                "phases that gave offset or matrix are not counted; forces of one foot against the other cancel",
            ),
            written=(coherence.figure_file,),
            concern=Concern.BAD if row.worse_than_prior else Concern.NONE if row.phases else Concern.UNCERTAIN,
        )


def _against_prior(row: CoherenceSummary) -> str:
    if row.prior_force_error_mean_N is None or row.common_force_error_mean_N is None:
        return ""
    return (
        f"; over the {row.common_phases} phase(s) that are evidence for both: "
        f"{amount(row.common_force_error_mean_N, 'N')}, prior {amount(row.prior_force_error_mean_N, 'N')}"
    )


def _predicted(row: CoherenceSummary) -> Iterator[str]:
    if row.force_predicted_N is None:
        return
    predicted = (
        f"predicted of the {'prior ' * (row.common_phases is None)}matrices: {amount(row.force_predicted_N, 'N')}"
    )
    remedy = "; fit these contacts too, or state how good the prior is (prior_uncertainty_percent)"
    yield predicted + remedy * bool(row.worse_than_prior)


def _net_error(row: CoherenceSummary) -> str:
    if row.force_error_mean_N is None or row.force_error_largest_N is None:
        return "NO EVIDENCE"
    error = f"net force error {amount(row.force_error_mean_N, 'N')} (largest {amount(row.force_error_largest_N, 'N')})"
    return f"WORSE THAN PRIOR: {error}" if row.worse_than_prior else error


def motion_answers(motion: Motion) -> Iterator[Answer]:
    """Say of every interval and column whether it oscillates.

    Args:
        motion: Oscillations, settling times and tracking errors.

    Yields:
        One answer each.
    """
    for interval, column in dict.fromkeys((row.interval, row.column) for row in motion.oscillations):
        rows = [row for row in motion.oscillations if (row.interval, row.column) == (interval, column)]
        yield Answer(
            subject=f"{interval}: {column}",
            verdict=_oscillation(rows[0]),
            why=(_amplitude(rows), *_course(motion, interval, column)),
            written=(motion.figure_file,),
            concern=Concern.UNCERTAIN if rows[0].oscillates else Concern.NONE,
        )


def _oscillation(row: OscillationRow) -> str:
    if not row.oscillates or row.frequency_hz is None:
        return "NO OSCILLATION"
    return f"OSCILLATES at {plus_minus(row.frequency_hz, row.frequency_half_width_95_hz, 'Hz')}"


def _amplitude(rows: Sequence[OscillationRow]) -> str:
    first = rows[0]
    if not first.oscillates or first.amplitude is None:
        return (
            f"from {first.lowest_hz:.3g} to {first.highest_hz:.4g} Hz; an amplitude of {first.seen_amplitude:.3g} "
            f"{first.unit} or more would be seen"
        )
    damping = "" if first.damping is None else f", damping {plus_minus(first.damping, first.damping_half_width_95, '')}"
    more = f"; {len(rows) - 1} more" if len(rows) > 1 else ""
    return f"amplitude {plus_minus(first.amplitude, first.amplitude_half_width_95, first.unit)}{damping}{more}"


def _course(motion: Motion, interval: str, column: str) -> Iterator[str]:
    """How it settles after its first step, and how it tracks what was wanted."""
    words = []
    for step in motion.settling:
        if (step.interval, step.column) == (interval, column):
            time = step.settling_s
            settles = "does not settle" if time is None else f"settles in {bounded(time, step.latest_s, 's')}"
            at, overshoot = f"{step.step_at_s:.3g} s", f"{step.overshoot_percent:.0f} %"
            words.append(f"after the step at {at} it {settles}, overshoot {overshoot}")
            break
    for row in motion.tracking:
        if (row.interval, row.column) == (interval, column):
            words.append(f"tracking error {bounded(row.rms, row.rms_upper_95, row.unit)}, root mean square")
    if words:
        yield "; ".join(words)


def torque_loop_answers(study: TorqueLoopStudy) -> Iterator[Answer]:
    """Say from which force error on a robot falls, for every robot, gains and kind of errors.

    Args:
        study: Simulated runs.

    Yields:
        One answer each.
    """
    wrong = [row for row in study.rows if row.errors != NO_ERROR]
    for key in dict.fromkeys((row.tilt_deg, row.gain_factor, row.errors) for row in wrong):
        tilt, gain, errors = key
        rows = [row for row in study.rows if (row.tilt_deg, row.gain_factor, row.errors) == key]
        rows.sort(key=lambda row: row.force_error_N)
        last = rows[-1]
        exact = [row for row in study.rows if (row.tilt_deg, row.gain_factor, row.errors) == (tilt, gain, NO_ERROR)]
        beside = f", {_tracking(exact[0])} without" if exact else ""
        own = [row for row in study.onsets if (row.tilt_deg, row.gain_factor, row.errors) == key]
        onsets = [row.median_force_error_N for row in own if row.median_force_error_N is not None]
        linear = f"; the linear loop is unstable from {amount(min(onsets), 'N')} on, median" if onsets else ""
        yield Answer(
            subject=f"soles {tilt:g} deg, gains times {gain:g}, errors {errors}",
            verdict=_falls(rows),
            why=(
                f"torque tracking error {_tracking(last)} at {amount(last.force_error_N, 'N')} of force error{beside}",
                f"{last.oscillating} of {last.runs} runs go on swinging after a push{linear}",
            ),
            written=(study.figure_file,),
            concern=Concern.UNCERTAIN if any(row.falls for row in rows) else Concern.NONE,
        )


def _falls(rows: Sequence[TorqueLoopRow]) -> str:
    first = next((row for row in rows if row.falls), None)
    if first is None:
        return f"NO FALL up to a force error of {amount(rows[-1].force_error_N, 'N')}"
    share = f"{first.falls} of {first.runs} (95 %: {first.falls_least_percent:.0f} to {first.falls_most_percent:.0f} %)"
    return f"FALLS: {share} at a force error of {amount(first.force_error_N, 'N')}"


def _tracking(row: TorqueLoopRow) -> str:
    return within(row.tracking_rms_Nm, row.tracking_half_width_95_Nm, "N m")


def oscillation_causes_answers(causes: OscillationCauses) -> Iterator[Answer]:
    """Say which cause lets the larger errors oscillate most where the smaller ones hardly do, per loop and sole.

    Args:
        causes: Limits of both loops.

    Yields:
        One answer each.
    """
    for loop, tilt_deg in dict.fromkeys((row.loop, row.tilt_deg) for row in causes.rows):
        rows = sorted(
            (row for row in causes.rows if (row.loop, row.tilt_deg) == (loop, tilt_deg)), key=lambda row: -row.share
        )
        hit = [row for row in rows if row.tells_apart]
        first = hit[0] if hit else rows[0]
        in_file = first.in_file
        verdict = f"NO CAUSE makes errors '{causes.larger}' oscillate surely more than '{causes.smaller}'"
        if hit:
            grows = "OSCILLATES" if first.frequency_hz else "FALLS"
            verdict = f"{grows}: {_hit(first)} with errors '{causes.larger}', {first.smaller} with '{causes.smaller}'"
        yield Answer(
            subject=f"{loop}, sole {tilt_deg:g} deg",
            verdict=verdict,
            why=(
                f"with the values of the file {in_file} of {first.draws} draws oscillate",
                f"then {', '.join(_hit(row) for row in hit[1:_NAMED])}" if hit[1:] else "by no other cause",
            ),
            written=(causes.figure_file,),
            concern=Concern.UNCERTAIN if in_file else Concern.NONE,
        )


def _hit(row: CauseRow) -> str:
    return f"{row.larger} of {row.draws} at {row.cause.partition(',')[0]} {row.at:.3g}{row.cause.partition(',')[2]}"

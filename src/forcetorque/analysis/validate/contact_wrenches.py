# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches that the candidates of a sensor report where nothing touches, sample by sample (thesis 4.1.3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.runs.candidate import JudgedCandidate
from forcetorque.analysis.runs.free_sub_model import FreeSubModel
from forcetorque.analysis.runs.judged_instants import gap_words, nothing_left
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation import ContactForceValidation, Offset
from forcetorque.evaluation import contact_forces as forces_of_readings
from forcetorque.experiment.inputs import stated_in
from forcetorque.noise import one_after_another
from forcetorque.recording import Interval, Use
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import Wrenches


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactWrenches:
    """Wrenches at the sensor over all judged intervals, in the order of time."""

    sub_model: str
    """Sub-model that nothing touches, by the sensor at its base or the root link."""
    candidates: tuple[JudgedCandidate, ...]
    """The candidates."""
    wrenches: Mapping[tuple[int, Offset], FloatArray]
    """Wrenches by the place of the candidate, because a calibration may be called `prior` too, and by the offset that
    is asked for; shape (n, 6) each; N, N m; NaN in gaps."""
    time_s: Mapping[tuple[int, Offset], FloatArray]
    """Instants of these, since the start of the recording; shape (n,) each; s."""
    expected: FloatArray
    """Readings with which there would be no contact, at the judged instants; shape (n, 6); N, N m; NaN in gaps."""
    left_out: tuple[str, ...]
    """What could not be judged of the intervals, in words."""


def contact_wrenches(free: FreeSubModel, calibrations: Mapping[str, Calibration]) -> ContactWrenches:
    """Read a sensor by every candidate, and carry the contact wrench of the free sub-model to the sensor.

    Args:
        free: The sub-model; the validation intervals are judged.
        calibrations: Calibrations of the sensor by name.

    Returns:
        The wrenches with the candidate's own offset and with that of each interval's first second.

    Raises:
        ExperimentError: If there is no interval to judge, or one has no support.
    """
    run = free.run
    candidates = run.candidates(calibrations)
    wrenches: dict[tuple[int, Offset], list[FloatArray]] = {}
    times: dict[tuple[int, Offset], list[FloatArray]] = {}
    expected: list[FloatArray] = []
    left_out: dict[str, None] = {}
    name = ""
    for interval in run.intervals(Use.VALIDATION):
        with stated_in(f"interval {interval.label!r}"):
            sub_model = free.seen_from_support(interval)
            name = sub_model.part.name
            instants = run.instants(interval)
            short = nothing_left(instants, interval)
            if short is not None:
                left_out[short] = None
                continue
            over, without = _over(free, interval, sub_model, candidates)
        expected.append(instants.judged(without))
        for index, wrench in enumerate(over):
            judged = instants.judged_with_both(wrench)
            words = gap_words(f"contact force by {candidates[index].name}", interval, judged)
            left_out |= {} if words is None else {words: None}
            for offset, errors in judged.items():
                times.setdefault((index, offset), []).append(
                    seconds_since(instants.judged_ns, run.experiment.recording.start_ns)
                )
                wrenches.setdefault((index, offset), []).append(errors)
    return ContactWrenches(
        sub_model=name,
        candidates=candidates,
        wrenches={key: np.concatenate(pieces) for key, pieces in wrenches.items()},
        time_s={key: np.concatenate(pieces) for key, pieces in times.items()},
        expected=np.concatenate(expected) if expected else np.empty((0, 6)),
        left_out=tuple(left_out),
    )


def pooled_contacts(recordings: Mapping[str, ContactWrenches]) -> ContactWrenches:
    """Put together what several recordings say.

    Args:
        recordings: Wrenches by name of the recording, candidates in the same order.

    Returns:
        All of them, one recording after the other; the same where there is one.
    """
    first = next(iter(recordings.values()))
    if len(recordings) == 1:
        return first
    pieces: dict[tuple[int, Offset], list[FloatArray]] = {}
    times: dict[tuple[int, Offset], list[FloatArray]] = {}
    for contacts in recordings.values():
        for key, wrenches in contacts.wrenches.items():
            pieces.setdefault(key, []).append(wrenches)
            times.setdefault(key, []).append(contacts.time_s[key])
    return ContactWrenches(
        sub_model=first.sub_model,
        candidates=first.candidates,
        wrenches={key: np.concatenate(several) for key, several in pieces.items()},
        time_s={key: one_after_another(several) for key, several in times.items()},
        expected=np.concatenate([contacts.expected for contacts in recordings.values()]),
        left_out=tuple(f"{name}: {words}" for name, contacts in recordings.items() for words in contacts.left_out),
    )


def _over(
    free: FreeSubModel,
    interval: Interval,
    sub_model: ContactForceValidation,
    candidates: tuple[JudgedCandidate, ...],
) -> tuple[list[FloatArray], FloatArray]:
    """Contact wrench at the sensor by every candidate and its own offset, and the reading without any; not filtered."""
    joints, root = free.run.motion(interval, sub_model.required_joints)
    measured = free.measured(sub_model.others if free.corrections else (), interval)
    # by their places, because a calibration may be called `prior` too
    readings = {str(k): free.run.measured(interval, candidate.correction) for k, candidate in enumerate(candidates)}
    forces = forces_of_readings(sub_model, joints, root, readings, measured=Wrenches.of(measured) if measured else None)
    return [forces.of(place) for place in readings], forces.free_reading

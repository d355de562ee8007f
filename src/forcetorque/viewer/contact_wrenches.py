# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches over time, and residuals of link groups without contact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.joint.robust_fit import PartResidual
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.calibration.joint.windows import WINDOW_S
from forcetorque.estimation.estimate import IntervalEstimates, estimate_experiment
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.contacts import contact_in_words, contacts_at_sensors
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.validation_offset import OffsetPolicy
from forcetorque.recording.alignment import gap_limit_ns, seconds_since
from forcetorque.recording.recording import Use
from forcetorque.robot.contacts import Contact
from forcetorque.robot.tree import build_tree
from forcetorque.viewer.posture import Posture
from forcetorque.viewer.robot_shapes import flat
from forcetorque.viewer.scene import ContactSeries, Sensor, WrenchSeries
from forcetorque.viewer.scene_arrays import Block, Priors, SceneDraft, peak


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactOptions:
    """How contacts are estimated, as the options of `forcetorque estimate` have it."""

    contacts: Sequence[str] | None = None
    """`FRAME`, `FRAME:force` or `FRAME:force_along:x,y,z` each, in place of the experiment's; its own if None."""
    length_scale: float | None = None
    """Moment that weighs as much as one newton, in place of the experiment's; m."""
    offset: OffsetPolicy | str | None = None
    """Where the offsets of all sensors come from; None for those that are shown."""


def scene_contacts(
    experiment: Experiment,
    groups: Mapping[str, Mapping[str, Calibration]],
    posture: Posture,
    priors: Priors,
    draft: SceneDraft,
    options: ContactOptions,
) -> tuple[ContactSeries, ...]:
    """Estimate what the world does to the robot: at the contacts of the experiment, else at its sensors; and support.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        groups: Calibrations by sensor and name; of each sensor the first is used.
        posture: The instants.
        priors: How sensors are read without a calibration.
        draft: Takes the arrays, what is missing and where the rest comes from.
        options: Contacts, length scale and offsets in place of those of the experiment.

    Returns:
        Contacts, NaN outside intervals; none where the log does not allow to estimate them.
    """
    try:
        if options.contacts is not None:
            named = tuple(contact_in_words(text, experiment.model) for text in options.contacts)
            experiment = replace(experiment, contacts=named)
        if options.offset is None:
            corrections = _first_corrections(experiment, groups, priors)
        else:
            corrections = corrections_of(experiment, _first(groups), offset=options.offset)
        spans = estimate_experiment(experiment, corrections, length_scale=options.length_scale)
    except ForceTorqueError as error:
        draft.notes.append(f"no contact wrenches: {error}")
        return ()
    read = "; ".join(f"{sensor}: {correction.source}" for sensor, correction in corrections.items())
    what = "that are named" if options.contacts else "that the experiment states"
    what = what if experiment.contacts else "at the sensors"
    draft.sources.append(f"contact wrenches {what} are estimated with {read}")
    draft.notes.extend(
        dict.fromkeys(
            f"contacts: left out {text}"
            for span in spans
            for text in span.left_out
            if text.startswith("sub-model")  # torques and expected readings are not shown from here
        )
    )
    wrenches: dict[str, FloatArray] = {}
    for span in spans:
        # its instants are those of the experiment's first sensor, which need not be shown
        at = np.searchsorted(span.stamp_ns, posture.stamp_ns, side="right") - 1
        inside = span.interval.holds(posture.stamp_ns) & (at >= 0)
        inside &= posture.stamp_ns - span.stamp_ns[at] <= gap_limit_ns(span.stamp_ns)  # a gap stays a gap
        for name in span.estimates.layout.contacts:
            values = wrenches.setdefault(name, np.full((len(posture.stamp_ns), 6), np.nan))
            values[inside] = span.estimates.contact(name)[at[inside]]
    places = _places(experiment, spans)
    return tuple(
        ContactSeries(
            name=name,
            link=places[name].link,
            link_H_contact=flat(places[name].link_H_contact),
            values=draft.block.add(values, "float32"),
        )
        for name, values in wrenches.items()
    )


def _first_corrections(
    experiment: Experiment, groups: Mapping[str, Mapping[str, Calibration]], priors: Priors
) -> dict[str, Correction]:
    """How every sensor is read where one way is needed: by its first calibration, else its prior."""
    calibrated = replace(experiment, sensors=tuple(s for s in experiment.sensors if s.name in groups))
    corrections = corrections_of(calibrated, _first(groups))
    return {sensor.name: corrections.get(sensor.name) or priors.of(sensor) for sensor in experiment.sensors}


def _first(groups: Mapping[str, Mapping[str, Calibration]]) -> dict[str, Calibration]:
    """The first calibration of every sensor by its name."""
    return dict(next(iter(group.items())) for group in groups.values())


def _places(experiment: Experiment, spans: Sequence[IntervalEstimates]) -> dict[str, Contact]:
    """Contacts by name: the support at its own origin, and those of the experiment or at its sensors."""
    stated = [entry.contact for entry in experiment.contacts]
    places: dict[str, Contact] = {}
    supports = {span.interval.support.frame for span in spans if span.interval.support is not None}
    for frame in sorted(supports):
        tree = build_tree(experiment.model, frame)
        at_sensors = contacts_at_sensors(tree, [sensor.name for sensor in experiment.sensors])
        places |= {contact.name: contact for contact in (Contact(link=frame), *(stated or at_sensors))}
    return places


_BEFORE, _AFTER = "prior", "calibrations"
"""Names of the two series of a part."""


def scene_parts(
    experiment: Experiment,
    groups: Mapping[str, Mapping[str, Calibration]],
    posture: Posture,
    draft: SceneDraft,
) -> tuple[Sensor, ...]:
    """Collect what is left of the equation of every part between two sensors or more that are calibrated.

    A part with one sensor says no more than that sensor's expected wrench.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        groups: Calibrations by sensor and name; of each sensor the first is used.
        posture: The instants.
        draft: Takes the arrays, and what the series are.

    Returns:
        The parts, shown as sensors are: what is left is a wrench at the link whose motion is known.
    """
    first = {sensor: next(iter(group.values())) for sensor, group in groups.items() if group}
    if len(first) < 2:
        return ()
    residuals = [
        residual
        for use in (Use.CALIBRATION, Use.VALIDATION)
        for residual in part_residuals(experiment, first, use)
        if len(residual.sensors) > 1
    ]
    if residuals:
        draft.sources.append(
            f"parts that nothing touches: what is left of their equations, means of {WINDOW_S:g} s, by the prior "
            "matrices with the offsets that suit best, and by the first calibration of every sensor"
        )
    seconds = seconds_since(posture.stamp_ns, experiment.recording.start_ns)
    places = dict.fromkeys((residual.part, residual.root_link) for residual in residuals)
    return tuple(
        _part(place, [one for one in residuals if (one.part, one.root_link) == place], seconds, draft.block)
        for place in places
    )


def _part(place: tuple[str, str], residuals: Sequence[PartResidual], seconds: FloatArray, block: Block) -> Sensor:
    name, link = place
    before, after = np.full((2, len(seconds), 6), np.nan)
    for residual in residuals:
        window, inside = _windows_at(residual.time_s, seconds)
        rows = np.where(residual.rows > 0, 1.0, np.nan)
        before[inside] = residual.before[window] * rows
        after[inside] = residual.after[window] * rows
    return Sensor(
        name=f"left over: {name}",
        serial="",
        link=link,
        link_H_sensor=flat(np.eye(4)),
        acting=None,
        acted_on=name,
        wrenches=tuple(
            WrenchSeries(
                name=series,
                role="measured",
                calibrated=series == _AFTER,
                peak=peak(values),
                values=block.add(values, "float32"),
                deviation=None,
                reference_force=None,
                reference_moment=None,
                ellipsoid_force=None,
                ellipsoid_moment=None,
            )
            for series, values in ((_BEFORE, before), (_AFTER, after))
        ),
    )


def _windows_at(time_s: FloatArray, seconds: FloatArray) -> tuple[IntArray, BoolArray]:
    """Windows that instants lie in, and which instants lie in one."""
    nearest = np.clip(np.searchsorted((time_s[1:] + time_s[:-1]) / 2.0, seconds), 0, len(time_s) - 1)
    inside = np.abs(seconds - time_s[nearest]) <= WINDOW_S / 2.0
    return nearest[inside], inside

# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches over the intervals of an experiment, at the instants that are shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.analysis import (
    Correction,
    IntervalEstimates,
    corrections_of,
    estimate_experiment,
)
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ForceTorqueError
from forcetorque.estimation import Contact
from forcetorque.experiment import Experiment
from forcetorque.experiment.contacts import contacts_at_sensors
from forcetorque.recording.alignment import gap_limit_ns
from forcetorque.robot import build_tree
from forcetorque.viewer.draft import SceneDraft
from forcetorque.viewer.geometry import flat
from forcetorque.viewer.instants import Posture
from forcetorque.viewer.once import Priors
from forcetorque.viewer.scene import ContactSeries


def scene_contacts(
    experiment: Experiment,
    groups: Mapping[str, Mapping[str, Calibration]],
    posture: Posture,
    priors: Priors,
    draft: SceneDraft,
) -> tuple[ContactSeries, ...]:
    """Estimate what the world does to the robot: at the contacts of the experiment, else at its sensors; and support.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        groups: Calibrations by sensor and name; of each sensor the first is used.
        posture: The instants.
        priors: How sensors are read without a calibration.
        draft: Takes the arrays, what is missing and where the rest comes from.

    Returns:
        Contacts, NaN outside intervals; none where the log does not allow to estimate them.
    """
    try:
        corrections = _first_corrections(experiment, groups, priors)
        spans = estimate_experiment(experiment, corrections)
    except ForceTorqueError as error:
        draft.notes.append(f"no contact wrenches: {error}")
        return ()
    read = "; ".join(f"{sensor}: {correction.source}" for sensor, correction in corrections.items())
    what = "that the experiment states" if experiment.contacts else "at the sensors"
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
    first = dict(next(iter(group.items())) for group in groups.values())
    calibrated = replace(experiment, sensors=tuple(s for s in experiment.sensors if s.name in groups))
    corrections = corrections_of(calibrated, first)
    return {sensor.name: corrections.get(sensor.name) or priors.of(sensor) for sensor in experiment.sensors}


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

# SPDX-License-Identifier: BSD-3-Clause
"""Which intervals have the contacts of another: a filter takes nothing from those that have not."""

from __future__ import annotations

import numpy as np

from forcetorque.experiment.contacts import contacts_in, touched_otherwise
from forcetorque.experiment.experiment import ExperimentContact
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.robot.contacts import Contact
from tests.recording.recordings import even_stamps, recording, signal, stream

SUPPORT = Support(frame="base", gravity_direction=np.array([0.0, 0.0, -1.0]))
ALWAYS = ExperimentContact(contact=Contact(link="hand"))
ONCE = ExperimentContact(contact=Contact(link="elbow"), intervals=("touched",))


def _log(*labels: str) -> Recording:
    stamps = even_stamps(100)
    spans = [
        Interval(label=label, start_ns=int(stamps[k]), end_ns=int(stamps[k + 1]), use=Use.VALIDATION, support=SUPPORT)
        for k, label in enumerate(labels)
    ]
    return recording(stream(stamps, signal("scalar", np.zeros((100, 1)), ("a",)), name="board"), intervals=spans)


def test_intervals_with_other_contacts_are_named() -> None:
    """A contact of one interval sets it apart from the others, one of all intervals does not."""
    log = _log("free", "touched", "free again")
    free, touched, _ = log.intervals
    assert contacts_in(free, [ALWAYS, ONCE]) == [ALWAYS]
    assert touched_otherwise(free, log, [ALWAYS, ONCE]) == ("touched",)
    assert touched_otherwise(touched, log, [ALWAYS, ONCE]) == ("free", "free again")
    assert touched_otherwise(free, log, [ALWAYS]) == ()

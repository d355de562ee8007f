# SPDX-License-Identifier: BSD-3-Clause
"""The contacts of an experiment: from its file, from words, and those that need no naming."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.pose import invert_pose
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.experiment import ExperimentContact
from forcetorque.experiment.named_files import stated_in
from forcetorque.recording.recording import Interval, Recording
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import BodyTree


def read_contacts(
    parsed: schema.ExperimentFile, file: Path, model: RobotModel, recording: Recording
) -> tuple[ExperimentContact, ...]:
    """Match the contacts of a file to the robot and the recording.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        model: The robot.
        recording: Streams and intervals.

    Returns:
        The contacts in the order of the file.

    Raises:
        ExperimentError: If a frame, stream or interval is not there, or a name comes twice.
    """
    labels = [interval.label for interval in recording.intervals]
    contacts: list[ExperimentContact] = []
    for index, entry in enumerate(parsed.contact):
        where = f"{file}: contact[{index}]"
        for label in entry.intervals or ():
            require_known(label, labels, ExperimentError, f"{where}: no interval is labelled {label!r}")
        with stated_in(where):
            point = np.zeros(3) if entry.position_m is None else entry.position_m
            contact = Contact.at_point(
                entry.frame, point, name=entry.name or "", type=entry.type, direction=entry.direction
            )
            _require_link(contact, model)
            if entry.stream is not None:
                _require_wrench(entry.stream, entry.frame, recording)
        if contact.name in [earlier.contact.name for earlier in contacts]:
            raise ExperimentError(f"{where}: the contact {contact.name!r} is listed twice; give each its own name")
        noise, deviation = (None if v is None else np.array(v) for v in (entry.wrench_noise, entry.wrench_deviation))
        contacts.append(
            ExperimentContact(
                contact=contact, stream=entry.stream, intervals=entry.intervals, noise=noise, deviation=deviation
            )
        )
    return (*contacts, *_touched_beside(parsed, contacts))


def _touched_beside(
    parsed: schema.ExperimentFile, specified: Sequence[ExperimentContact]
) -> Iterator[ExperimentContact]:
    """Links that intervals name as touched beside the first, which stands for the support, and no contact states."""
    spans: dict[str, list[str]] = {}
    for span in parsed.interval:
        own = {entry.contact.link for entry in specified if entry.intervals is None or span.label in entry.intervals}
        for link in dict.fromkeys((span.contact_links or ())[1:]):
            if link not in own:
                spans.setdefault(link, []).append(span.label)
    names = {entry.contact.name for entry in specified}
    for link, labels in spans.items():
        name = link if link not in names else f"{link} touched"
        yield ExperimentContact(contact=Contact(link=link, name=name), intervals=tuple(labels))


def contact_in_words(text: str, model: RobotModel) -> ExperimentContact:
    """Understand a contact as the command line has it: `FRAME`, `FRAME:TYPE` or `FRAME:force_along:x,y,z`.

    Returns:
        The contact, at the origin of the frame and in all intervals.

    Raises:
        ExperimentError: If it is not of that form or the robot has no such frame.
    """
    frame, *rest = text.split(":")
    word = rest[0] if rest else ContactType.WRENCH.value
    kinds = [kind.value for kind in ContactType if kind is not ContactType.KNOWN]
    require_known(word, kinds, ExperimentError, f"contact {text!r}: no type is called {word!r}")
    direction = None
    if len(rest) > 1:
        try:
            direction = np.array([float(number) for number in rest[1].split(",")])
        except ValueError as error:
            raise ExperimentError(f"contact {text!r}: expected a direction x,y,z, got {rest[1]!r}") from error
    if len(rest) > 2:
        raise ExperimentError(f"contact {text!r}: expected FRAME, FRAME:TYPE or FRAME:force_along:x,y,z")
    with stated_in(f"contact {text!r}"):
        contact = Contact(link=frame, type=ContactType(word), direction=direction)
        _require_link(contact, model)
    return ExperimentContact(contact=contact)


def contacts_in(interval: Interval, contacts: Iterable[ExperimentContact]) -> list[ExperimentContact]:
    """Tell which contacts are there in an interval.

    Args:
        interval: The interval.
        contacts: Contacts of an experiment, or in their place.

    Returns:
        Those of all intervals and of this one.
    """
    return [entry for entry in contacts if entry.intervals is None or interval.label in entry.intervals]


def touched_otherwise(
    interval: Interval, recording: Recording, contacts: Sequence[ExperimentContact]
) -> tuple[str, ...]:
    """Tell in which intervals the contacts of another do not hold: a filter of that one takes nothing from them.

    Args:
        interval: The interval whose contacts are meant.
        recording: The recording with all intervals.
        contacts: Contacts of the experiment, or in their place.

    Returns:
        Labels of the intervals with other contacts.
    """
    mine = contacts_in(interval, contacts)
    return tuple(other.label for other in recording.intervals if contacts_in(other, contacts) != mine)


def contacts_at_sensors(tree: BodyTree, sensors: Iterable[str]) -> tuple[Contact, ...]:
    """Give what touches the part outboard of each sensor at the sensor itself (thesis 4.1).

    Args:
        tree: Robot rooted at the support.
        sensors: Sensors that it is cut at.

    Returns:
        A full wrench per sensor, in the sensor's frame, under its name.
    """
    contacts = []
    for sensor in sensors:
        cut = tree.cuts[sensor]
        link = tree.bodies[cut.body].links[0]
        link_H_sensor = invert_pose(tree.frames[link][1]) @ cut.body_H_sensor
        contacts.append(Contact(link=link, name=sensor, link_H_contact=link_H_sensor))
    return tuple(contacts)


def _require_link(contact: Contact, model: RobotModel) -> None:
    require_known(contact.link, model.links, ExperimentError, f"robot {model.name!r} has no link {contact.link!r}")


def _require_wrench(name: str, frame: str, recording: Recording) -> None:
    signal = recording.stream(name).signal("wrench")
    if signal.frame != frame:
        raise ExperimentError(f"stream {name!r}: expected the wrench in the frame {frame!r}, it is in {signal.frame!r}")

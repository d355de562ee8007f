# SPDX-License-Identifier: BSD-3-Clause
"""Contacts, their duration and release, heat, and events of a skinManager, as records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Stream
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import AxisValues, FloatOrNull, Row, Shown, WrenchValues
from forcetorque.skin.contact.contact_clusters import SkinContacts, lobes
from forcetorque.skin.contact.contact_tracking import ContactLife, followed_places
from forcetorque.skin.contact.pressure_frame import PressureFrame
from forcetorque.skin.temperature.taxel_temperature_drift import HeatRule
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressures_over_recording import SkinFrames


class SkinContactRow(Row):
    """One contact at one time."""

    time_s: Annotated[float, Shown("time", "s", digits=2)]
    """Middle of the messages that are averaged, since the start of the recording."""
    contact: Annotated[int, Shown("contact")]
    """Number of the contact, from 1, which it keeps from its first frame to its last."""
    force_N: Annotated[float, Shown("force", "N", digits=2, error="force_sd_N")]
    """Norm of the force, (7.4)."""
    force_sd_N: FloatOrNull
    """Its standard deviation, from noise, calibration and what is between taxels; none for methods that have none."""
    hysteresis_N: Annotated[float, Shown("hysteresis", "N", digits=2)]
    """How much more the same load reads while it is taken off than while it is put on."""
    drift_limit_N: Annotated[float | None, Shown("drift limit", "N", digits=1)]
    """Heat that may have come through it: time in contact times the rate of the warm-up; none without one."""
    normal_force_N: Annotated[float, Shown("normal force", "N", digits=2)]
    """Integral of the pressure, (7.12); on a bent patch it is larger than the norm of the force."""
    wrench: WrenchValues
    """What the contact does to the link, in its frame and about its origin; N, N m."""
    centre_of_pressure_m: AxisValues
    """Mean position by pressure, in the frame of the link."""
    centroid_m: AxisValues
    """Middle of its area, in the frame of the link."""
    normal: AxisValues
    """Mean outward unit normal of its area."""
    area_mm2: Annotated[float, Shown("area", "mm2", digits=0)]
    """Area of its active taxels."""
    peak_kPa: Annotated[float, Shown("peak", "kPa", digits=1)]
    """Largest pressure of a taxel."""
    active: Annotated[int, Shown("taxels")]
    """Active taxels."""
    lobes: Annotated[int, Shown("hills")]
    """Hills of its pressure: more than one may be as many contacts that touch each other."""
    beyond_range: Annotated[bool, Shown("beyond range")]
    """Whether a taxel reads more than it was calibrated for."""
    edge_share: Annotated[float, Shown("at edge", digits=2)]
    """Share of the normal force at the edge of the patch; beyond it pressure is not felt."""
    taxels: tuple[int, ...]
    """Columns of its active taxels."""

    def flat(self) -> dict[str, object]:
        """Give the row as one line of a table, with one cell for the taxels.

        Returns:
            Values by key.
        """
        flat = Row.flat(self.model_copy(update={"taxels": ()}))
        return {**flat, "taxels": " ".join(map(str, self.taxels))}


def contact_rows(
    patch: SkinPatch, frame: PressureFrame, contacts: SkinContacts, time_s: float
) -> tuple[SkinContactRow, ...]:
    """Write the contacts of a frame down.

    Args:
        patch: The patch.
        frame: The frame.
        contacts: Its contacts.
        time_s: Its time.

    Returns:
        A row per contact.
    """
    hills = lobes(patch.surface, contacts, frame.pressures)
    taxels = [contacts.taxels(number) for number in range(len(contacts))]
    return tuple(
        SkinContactRow(
            time_s=time_s,
            contact=int(contacts.identity[number]),
            force_N=float(contacts.force_N[number]),
            force_sd_N=float(contacts.force_sd_N[number]),
            hysteresis_N=float(contacts.hysteresis_N[number]),
            drift_limit_N=finite_or_none(contacts.drift_limit_N[number]),
            normal_force_N=float(contacts.normal_force_N[number]),
            wrench=contacts.wrench[number],
            centre_of_pressure_m=contacts.centre_of_pressure[number],
            centroid_m=contacts.centroid[number],
            normal=contacts.normal[number],
            area_mm2=1e6 * float(contacts.area_m2[number]),
            peak_kPa=1e-3 * float(contacts.peak_Pa[number]),
            active=len(taxels[number]),
            lobes=int(hills[number]),
            beyond_range=bool(contacts.beyond_range[number]),
            edge_share=float(contacts.edge_share[number]),
            taxels=tuple(patch.layout.taxels[taxels[number]].tolist()),
        )
        for number in range(len(contacts))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinWrenchPicture:
    """A recording of a patch: its forces and pressures over time."""

    patch: str
    """Name of the patch."""
    seconds: FloatArray
    """Times; shape (k,); s."""
    forces: Mapping[str, FloatArray]
    """Forces over time by their names; shape (k,) each; N."""
    places: FloatArray
    """Taxels, laid flat; shape (n, 2); m."""
    triangles: IntArray
    """Facets between them; shape (m, 3)."""
    pressures: FloatArray
    """Pressure on each taxel that belongs to a contact, else 0; shape (k, n); Pa."""
    strongest: int
    """Index of the time at which the force was largest."""


class ContactLifeRow(Row):
    """One contact."""

    contact: Annotated[int, Shown("contact")]
    """Its number."""
    from_s: Annotated[float, Shown("from", "s", digits=2)]
    """Time of its first frame."""
    to_s: Annotated[float, Shown("to", "s", digits=2)]
    """Time of its last frame."""
    largest_force_N: Annotated[float, Shown("largest force", "N", digits=2)]
    """Largest norm of its force."""
    split_from: int | None
    """Contact that it was part of before; none if it began by itself."""
    merged_into: int | None
    """Contact that it is part of since; none if it was let go, or the recording ends with it."""
    course: Annotated[str, Shown("course")]
    """The same in words."""


def life_rows(lives: Sequence[ContactLife], contacts: Sequence[SkinContactRow]) -> tuple[ContactLifeRow, ...]:
    """Write the lives of contacts down.

    Args:
        lives: The lives.
        contacts: Contacts of every frame.

    Returns:
        A row per contact.
    """
    largest: dict[int, float] = {}
    for row in contacts:
        largest[row.contact] = max(largest.get(row.contact, 0.0), row.force_N)
    return tuple(
        ContactLifeRow(
            contact=life.identity,
            from_s=life.begun_s,
            to_s=life.seen_s,
            largest_force_N=largest[life.identity],
            split_from=life.split_from,
            merged_into=life.merged_into,
            course=_course(life),
        )
        for life in lives
    )


def _course(life: ContactLife) -> str:
    begun = None if life.split_from is None else f"split from {life.split_from}"
    ended = None if life.merged_into is None else f"merged into {life.merged_into}"
    return ", ".join(words for words in (begun, ended) if words is not None)


class SkinEventRow(Row):
    """Contacts of one patch, as a skinManager shows them."""

    stream: Annotated[str, Shown("stream")]
    """Stream."""
    messages: Annotated[int, Shown("messages")]
    """Messages."""
    messages_with_contact: Annotated[int, Shown("with a contact")]
    """Messages with a contact."""
    contacts: Annotated[int, Shown("contacts")]
    """Contacts of all messages."""
    most: Annotated[int, Shown("most at once")]
    """Contacts of the message with the most."""
    followed: Annotated[int, Shown("followed")]
    """Contacts, where what is at one place in successive messages is one: a skinManager numbers them anew each time."""
    largest_heuristic: Annotated[float, Shown("largest heuristic", digits=2)]
    """Largest sum of norms of what a message calls forces: a heuristic, not newtons."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinEventPicture:
    """The heuristic of one stream over time."""

    stream: str
    """Stream."""
    seconds: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    heuristic: FloatArray
    """Sum of the norms of the contacts' heuristics, 0 without a contact; shape (n,); not newtons."""


def skin_event_rows(recording: Recording) -> tuple[tuple[SkinEventRow, ...], tuple[SkinEventPicture, ...]]:
    """Sum up every stream of skin events on a clock that other streams have too, or of a recording of nothing else.

    Args:
        recording: The recording.

    Returns:
        A row per stream, and what is drawn of it.
    """
    others = [stream.clock for stream in recording.streams.values() if "skin_event" not in stream.signals]
    clocks = others or [stream.clock for stream in recording.streams.values()]
    summaries = [
        _summary(stream, recording.start_ns)
        for stream in recording.streams.values()
        if "skin_event" in stream.signals and stream.clock in clocks
    ]
    return tuple(row for row, _ in summaries), tuple(picture for _, picture in summaries)


def _summary(stream: Stream, start_ns: int) -> tuple[SkinEventRow, SkinEventPicture]:
    signal, rows = stream.signal("skin_event"), usable_samples(stream.stamp_ns)
    columns = [k for k, name in enumerate(signal.columns) if ".heuristic_" in name]
    vectors = signal.values[rows][:, columns].reshape(len(rows), -1, 3)
    sizes = np.linalg.norm(vectors, axis=2)  # (n, contacts), NaN where a message has fewer
    counts = np.count_nonzero(np.isfinite(sizes), axis=1)
    heuristic: FloatArray = np.nansum(sizes, axis=1)
    seconds = seconds_since(stream.stamp_ns[rows], start_ns)
    pressed = [k for k, name in enumerate(signal.columns) if ".pressed_" in name]
    places = signal.values[rows][:, pressed].reshape(len(rows), -1, 3)
    identities = followed_places(seconds, [one[np.isfinite(one).all(axis=1)] for one in places])
    row = SkinEventRow(
        stream=stream.name,
        messages=len(rows),
        messages_with_contact=int(np.count_nonzero(counts)),
        contacts=int(counts.sum()),
        most=int(counts.max(initial=0)),
        followed=int(np.concatenate([[0], *identities]).max()),
        largest_heuristic=float(heuristic.max(initial=0.0)),
    )
    return row, SkinEventPicture(stream=stream.name, seconds=seconds, heuristic=heuristic)


HEATING: Final = 1.25
"""Heat that comes faster than in the warm-up by more is said: the limits of drift are determined from its steepest
minute."""


def heat_warnings(frames: SkinFrames, rows: Sequence[SkinContactRow], *, has_pads: bool) -> tuple[str, ...]:
    """Give warnings about heat on the skin.

    Args:
        frames: Frames of a recording.
        rows: Its contacts.
        has_pads: Whether the patch has thermal pads.

    Returns:
        Sentences.
    """
    hot = sum(row.drift_limit_N is not None and row.drift_limit_N > row.force_N for row in rows)
    warnings = (
        (
            has_pads and frames.rule is not HeatRule.LEARNED and len(rows) > 0,
            "no limit of drift is known: heat reads as force; `forcetorque skin calibrate --warm-up` learns how much",
        ),
        (
            hot > 0,
            f"{hot} of {len(rows)} contacts lasted so long that heat through them, which no thermal pad measures, may "
            "be all of their force; take rest anew where they are let go",
        ),
        (
            frames.heating > HEATING,
            f"heat came {frames.heating:.1f} times as fast as in the warm-up: limits of drift do not hold, and what "
            "pads do not measure in time may read as contacts; learn from a warm-up that is as fast",
        ),
        (
            len(frames.dead_pads) > 0,
            f"{len(frames.dead_pads)} thermal pads are dead in this recording: {_listed(frames)}",
        ),
        (
            len(frames.without_pad) > 0,
            f"{len(frames.without_pad)} taxels are left out because no working thermal pad measures their heat",
        ),
    )
    return tuple(warning for holds, warning in warnings if holds)


def _listed(frames: SkinFrames, most: int = 8) -> str:
    more = ", ..." if len(frames.dead_pads) > most else ""
    return ", ".join(map(str, frames.dead_pads[:most])) + more

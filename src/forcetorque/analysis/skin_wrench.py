# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on a patch of skin and their wrenches, over a recording."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.analysis.skin_contact_rows import SkinContactRow, SkinWrenchPicture, contact_rows
from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.errors import ExperimentError, SkinError
from forcetorque.exchange.skin import describe_patch
from forcetorque.experiment import ExperimentPatch, PatchExperiment, load_patches
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.result import Result, Table, table_of
from forcetorque.skin import PatchCalibration, PressureTable, SkinLayout, read_patch_calibration, rebuilt_normals
from forcetorque.skin.contact import PatchReader, PressureFrame, SkinContacts, find_contacts
from forcetorque.skin.surface import unrolled
from forcetorque.skin.taxels import Ailment, taxel_ailments
from forcetorque.skin.wrench import SkinPatch, WrenchMethod

REST_S: Final = 2.0
"""Time at the beginning in which nothing touches the patch."""
AVERAGED: Final = 10
"""Messages that are averaged to one frame."""
_SHOWN: Final = 12
"""Contacts of the table; JSON and CSV have all."""
_SICK: Final = (Ailment.WRAPS, Ailment.RAILS, Ailment.NOISE)
"""What makes a taxel useless in a recording of contacts; jumps may be blows, and many are never touched."""


class SkinWrench(Result):
    """Contacts on a patch over a recording."""

    schema_name: Literal["forcetorque/skin_wrench/1"] = Field(default="forcetorque/skin_wrench/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    patch: str
    """Name of the patch."""
    link: str
    """Frame of the wrenches: they are about its origin."""
    method: str
    """How pressures between taxels are told."""
    taxels: int
    """Pressure taxels."""
    left_out: tuple[int, ...]
    """Columns of taxels without a table, or useless in this recording."""
    frames: int
    """Means of messages that were looked at."""
    touched: int
    """How many of them have a contact."""
    averaged: int
    """Messages of each."""
    largest_force_N: float
    """Largest norm of the force of all contacts together."""
    mean_force_N: float
    """Its mean while there is a contact; 0 without any."""
    figure: str | None = None
    """File of the figure."""
    contacts: tuple[SkinContactRow, ...]
    """Contacts, in time."""
    picture: SkinWrenchPicture = Field(exclude=True, repr=False)
    """Forces over time and a field of pressure, for figures."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the first contacts, and sentences about all.

        Yields:
            A table and sentences.
        """
        if self.contacts:
            yield table_of(self.contacts[:_SHOWN], f"{self.patch}: contacts, force ± standard deviation")
        if len(self.contacts) > _SHOWN:
            yield f"{len(self.contacts) - _SHOWN} more; --format csv or json has all, with wrenches and places"
        yield (
            f"{self.patch} on {self.link}, method {self.method}: {self.taxels - len(self.left_out)} of {self.taxels} "
            f"taxels; touched in {self.touched} of {self.frames} means of {self.averaged} messages, with "
            f"{self.mean_force_N:.2f} N on average and {self.largest_force_N:.2f} N at most"
        )
        if self.figure is not None:
            yield f"drawn to {self.figure}"

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a contact, also where there is none.
        """
        return super().columns() or list(SkinContactRow.model_fields)


@dataclass(frozen=True, kw_only=True)
class WrenchChoice:
    """How the wrench is told, and of which messages."""

    method: str = WrenchMethod.KRIGING
    """One of `WrenchMethod`."""
    taxel_area_mm2: float | None = None
    """Area of a taxel, for the simple method."""
    plan: Path | None = None
    """Drawing of the patch, for the method of the thesis."""
    written_normals: bool = False
    """Whether to take the normals that the layout has, and not those of the surface through its taxels."""
    rest_s: float = REST_S
    """Time at the beginning in which nothing touches the patch."""
    averaged: int = AVERAGED
    """Messages that are averaged to one frame."""


def skin_wrench(
    experiment: Path | str | PatchExperiment,
    calibration: Path | str | PatchCalibration,
    *,
    patch: str | None = None,
    choice: WrenchChoice | None = None,
) -> SkinWrench:
    """Find the contacts on a patch in a recording, and their wrenches on the link.

    Args:
        experiment: Experiment file with the patch, or what was read of it.
        calibration: Calibration of its taxels, or its file.
        patch: Name of the patch; None for the only one.
        choice: How the wrench is told; by kriging if None.

    Returns:
        Every contact of every frame.
    """
    content = load_patches(experiment) if isinstance(experiment, (Path, str)) else experiment
    chosen = WrenchChoice() if choice is None else choice
    return _answer(content, patch_frames(content, calibration, patch=patch, choice=chosen), chosen)


@dataclass(frozen=True, kw_only=True, eq=False)
class PatchFrames:
    """A patch, and what its taxels say over a recording."""

    patch: ExperimentPatch
    """The patch in the experiment."""
    skin: SkinPatch
    """Its surface and wrenches."""
    reader: PatchReader
    """What turned its counts into pressures."""
    looked: tuple[tuple[float, PressureFrame, SkinContacts], ...]
    """Time in the middle of each mean of messages, s since the start of the recording; its pressures and contacts."""


def patch_frames(
    content: PatchExperiment,
    calibration: Path | str | PatchCalibration,
    *,
    patch: str | None = None,
    choice: WrenchChoice | None = None,
) -> PatchFrames:
    """Turn the counts of a patch into pressures and contacts, over a recording.

    Args:
        content: Experiment with the patch.
        calibration: Calibration of its taxels, or its file.
        patch: Name of the patch; None for the only one.
        choice: How the wrench is told; by kriging if None.

    Returns:
        Pressures and contacts of every mean of messages.

    Raises:
        ExperimentError: If the file does not say where the taxels are.
    """
    chosen = WrenchChoice() if choice is None else choice
    own = content.patch(patch)
    curves = read_patch_calibration(calibration) if isinstance(calibration, (Path, str)) else calibration
    with stated_in(f"{content.file}: patch {own.name!r}"):
        if own.layout is None:
            raise ExperimentError("layout: expected the file that says where the taxels are, got none")
        table = curves.table()
        table.require_patch(own.name, columns=own.columns, serial=own.serial)
        skin = _skin(own.layout, chosen)
        seconds, counts = _messages(content, own)
        reader = _reader(table, seconds, counts, chosen)
        reader.require_layout(skin.layout)
        looked = [
            (middle, frame, find_contacts(skin, frame)) for middle, frame in _frames(reader, seconds, counts, chosen)
        ]
    return PatchFrames(patch=own, skin=skin, reader=reader, looked=tuple(looked))


def _skin(layout: Path, chosen: WrenchChoice) -> SkinPatch:
    """The patch, with what its method needs."""
    described = describe_patch(layout)
    normals = None if chosen.written_normals else rebuilt_normals(described.positions, described.modules)
    sound = described.layout(normals)
    return SkinPatch.of(
        sound,
        chosen.method,
        taxel_area_m2=None if chosen.taxel_area_mm2 is None else 1e-6 * chosen.taxel_area_mm2,
        plane=None if chosen.plan is None else _places(chosen.plan, sound),
    )


def _places(plan: Path, layout: SkinLayout) -> FloatArray:
    """Places of the taxels in a drawing; m."""
    drawn = describe_patch(plan)
    missing = np.setdiff1d(layout.taxels, drawn.taxels)
    if len(missing):
        raise SkinError(
            f"{plan}: expected a drawing of all {len(layout)} taxels of {layout.name!r}, got none of taxel "
            f"{missing[0]} ({len(missing)} such); it is of another patch"
        )
    order = np.argsort(drawn.taxels)
    return drawn.positions[order[np.searchsorted(drawn.taxels, layout.taxels, sorter=order)], :2]


def _messages(content: PatchExperiment, patch: ExperimentPatch) -> tuple[FloatArray, FloatArray]:
    """Times and counts of all messages."""
    stream = content.recording.stream(patch.counts)
    rows = usable_samples(stream.stamp_ns)
    counts = stream.signal("taxel_counts").values[rows]
    empty = np.flatnonzero(~(np.nan_to_num(counts).any(axis=1) & np.isfinite(counts).all(axis=1)))
    if len(empty):
        raise SkinError(
            f"row {rows[empty[0]]} of {patch.counts!r}: expected counts, got a message of zeros or with gaps "
            f"({len(empty)} such of {len(counts)}): the board had no power or the message was lost; leave it out"
        )
    return seconds_since(stream.stamp_ns[rows], content.recording.start_ns), counts


def _reader(table: PressureTable, seconds: FloatArray, counts: FloatArray, chosen: WrenchChoice) -> PatchReader:
    """Rest and noise from the beginning, and which taxels are useless in this recording."""
    resting = seconds < seconds[0] + chosen.rest_s
    own = counts[:, table.taxels]
    never_judged = np.full(len(table), np.inf)
    # noise is judged at rest: under a hand that moves every taxel is noisy
    told = zip(taxel_ailments(own, never_judged), taxel_ailments(own[resting], never_judged), strict=True)
    sick = np.array([_is_sick(whole, rest) for whole, rest in told])
    return PatchReader.at_rest(table, counts[resting], live=table.live & ~sick)


def _is_sick(whole: Sequence[Ailment], resting: Sequence[Ailment]) -> bool:
    return any(one in _SICK for one in resting) or any(one in _SICK for one in whole if one is not Ailment.NOISE)


def _frames(
    reader: PatchReader, seconds: FloatArray, counts: FloatArray, chosen: WrenchChoice
) -> Iterator[tuple[float, PressureFrame]]:
    if chosen.averaged < 1:
        raise SkinError(f"averaged: expected at least 1 message for a frame, got {chosen.averaged}")
    for start in range(0, len(counts) - chosen.averaged + 1, chosen.averaged):
        rows = slice(start, start + chosen.averaged)
        yield float(seconds[rows].mean()), reader.frame(counts[rows])


def _answer(content: PatchExperiment, frames: PatchFrames, chosen: WrenchChoice) -> SkinWrench:
    own, skin, reader, looked = frames.patch, frames.skin, frames.reader, frames.looked
    if not looked:
        raise SkinError(f"{content.file}: patch {own.name!r}: expected {chosen.averaged} messages or more, got fewer")
    seconds = np.array([middle for middle, _, _ in looked])
    force = np.array([np.linalg.norm(contacts.wrench[:, :3].sum(axis=0)) for _, _, contacts in looked])
    touched = np.array([len(contacts) > 0 for _, _, contacts in looked])
    rows = [row for middle, frame, contacts in looked for row in contact_rows(skin, frame, contacts, middle)]
    return SkinWrench(
        experiment=content.name,
        patch=own.name,
        link=own.link or skin.layout.frame,
        method=skin.method.value,
        taxels=len(skin.layout),
        left_out=tuple(skin.layout.taxels[~reader.live].tolist()),
        frames=len(looked),
        touched=int(touched.sum()),
        averaged=chosen.averaged,
        largest_force_N=float(force.max()),
        mean_force_N=float(force[touched].mean()) if touched.any() else 0.0,
        contacts=tuple(rows),
        picture=_picture(own.name, skin, seconds, force, looked),
        warnings=_warnings(rows, reader.live),
    )


def _picture(
    name: str,
    skin: SkinPatch,
    seconds: FloatArray,
    force: FloatArray,
    looked: Sequence[tuple[float, PressureFrame, SkinContacts]],
) -> SkinWrenchPicture:
    strongest = int(force.argmax())
    normal_force = np.array([contacts.normal_force_N.sum() for _, _, contacts in looked])
    return SkinWrenchPicture(
        patch=name,
        seconds=seconds,
        forces={f"{skin.method}, norm of the force": force, f"{skin.method}, sum of the pressure": normal_force},
        places=unrolled(skin.surface),
        triangles=skin.surface.triangles,
        pressures=np.where(looked[strongest][2].contact >= 0, looked[strongest][1].pressures, 0.0),
        pressed_s=float(seconds[strongest]),
    )


def _warnings(rows: Sequence[SkinContactRow], live: BoolArray) -> tuple[str, ...]:
    """What makes contacts doubtful."""
    beyond = sum(row.beyond_range for row in rows)
    at_edge = sum(row.edge_share > 0.1 for row in rows)
    several = sum(row.lobes > 1 for row in rows)
    dead = int((~live).sum())
    sentences = (
        (
            beyond,
            f"{beyond} of {len(rows)} contacts press a taxel beyond what it was calibrated for",
        ),
        (
            at_edge,
            f"{at_edge} of {len(rows)} contacts have over 10 % of their force at the edge: some is not felt",
        ),
        (several, f"{several} of {len(rows)} contacts have several hills of pressure: they may be contacts that touch"),
        (dead, f"{dead} of {len(live)} taxels are left out; what they would read is told by those around them"),
    )
    return tuple(sentence for number, sentence in sentences if number)

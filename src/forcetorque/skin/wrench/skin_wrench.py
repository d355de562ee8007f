# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on a patch of skin and their wrenches over a recording."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, SkinError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import added_to, with_recording_notes
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, optional_table, table_of
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.contact_tracking import OFFERED, ReleaseRow
from forcetorque.skin.contact.pressure_frame import PressureFrame
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.layout.normals import patch_normals
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.section import load_patches
from forcetorque.skin.surface import unrolled
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PatchCalibration, read_patch_calibration
from forcetorque.skin.wrench.known_weight import KnownWeight, known_weight
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressure_to_wrench import WrenchMethod
from forcetorque.skin.wrench.pressures_over_recording import FrameChoice, SkinFrames, patch_messages, skin_frames
from forcetorque.skin.wrench.result import (
    ContactLifeRow,
    SkinContactRow,
    SkinWrenchPicture,
    contact_rows,
    heat_warnings,
    life_rows,
)


@dataclass(frozen=True, kw_only=True)
class WrenchChoice(FrameChoice):
    """How the wrench is computed, and from which messages."""

    method: str = WrenchMethod.KRIGING
    """One of `WrenchMethod`."""
    taxel_area_mm2: float | None = None
    """Area of a taxel: the simple method needs it; beside another one it is drawn for comparison."""
    plan: Path | None = None
    """Drawing of the patch, for the method of the thesis."""
    weight_kg: float | None = None
    """Mass of a known weight that was put on the patch, kept level; None for none."""
    written_normals: bool = False
    """Whether to take the normals that the layout has, and not those of the surface through its taxels."""


def chosen_layout(file: Path, choice: WrenchChoice) -> SkinLayout:
    """Read where the taxels are.

    Args:
        file: File with the layout.
        choice: Whether its normals are taken as they are written.

    Returns:
        The layout.
    """
    described = describe_patch(file)
    normals = None if choice.written_normals else patch_normals(described)
    return described.layout(normals)


def chosen_patch(layout: SkinLayout, choice: WrenchChoice) -> SkinPatch:
    """Prepare a patch, with what its method needs.

    Args:
        layout: Where its taxels are.
        choice: Its method.

    Returns:
        The patch.
    """
    if choice.method == WrenchMethod.SIMPLE and choice.taxel_area_mm2 is not None:
        return SkinPatch.of(layout, choice.method, taxel_area_m2=1e-6 * choice.taxel_area_mm2)
    return SkinPatch.of(layout, choice.method, plane=None if choice.plan is None else _places(choice.plan, layout))


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


MANY_LEFT_OUT: Final = 0.2
"""Share of taxels left out above which forces are too low: by 15 % of a contact at 30 %, by 25 % at 60 %."""
_SHOWN: Final = 12
"""Contacts of the table; JSON and CSV have all."""


class SkinWrench(DrawnResult):
    """Contacts on a patch over a recording."""

    answered_by: ClassVar[str | None] = "forcetorque.skin.answers:skin_wrench_answer"
    drawn_by: ClassVar[str] = "forcetorque.skin.figures:skin_wrench_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("picture",)

    schema_name: Literal["forcetorque/skin_wrench/2"] = Field(default="forcetorque/skin_wrench/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    patch: str
    """Name of the patch."""
    link: str
    """Frame of the wrenches: they are about its origin."""
    method: str
    """How pressures are interpolated between taxels."""
    temperature: str
    """How heat was taken out of readings."""
    taxels: int
    """Pressure taxels."""
    left_out: tuple[int, ...]
    """Columns of taxels without a table, or useless in this recording."""
    frames: int
    """Means of messages that were evaluated."""
    frames_with_contact: int
    """How many of them have a contact."""
    averaged: int
    """Messages of each."""
    largest_force_N: float
    """Largest norm of the force of all contacts together."""
    mean_force_N: float
    """Its mean while there is a contact; 0 without any."""
    contacts: tuple[SkinContactRow, ...]
    """Contacts, in time."""
    lives: tuple[ContactLifeRow, ...]
    """The same contacts from their first frame to their last."""
    releases: tuple[ReleaseRow, ...]
    """Contacts that were let go, and what their taxels still read; none where heat was not followed."""
    weight: KnownWeight | None = None
    """A known weight against what the patch reads of it; null without one."""
    output_file: str | None = Field(default=None, exclude=True, repr=False)
    """File of the contacts; None where none was written."""
    film_file: str | None = Field(default=None, exclude=True, repr=False)
    """File of the film; None where none was written."""
    picture: SkinWrenchPicture = Field(exclude=True, repr=False)
    """Forces over time and a field of pressure, for figures."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the first contacts, and warnings about all.

        Yields:
            A table and warnings.
        """
        yield from optional_table(self.contacts[:_SHOWN], f"{self.patch}: contacts, force ± standard deviation")
        if len(self.contacts) > _SHOWN:
            yield f"{len(self.contacts) - _SHOWN} more; --output or --format json has all, with wrenches and places"
        yield from optional_table(self.lives[:_SHOWN], "from first to last")
        if len(self.lives) > _SHOWN:
            yield f"{len(self.lives) - _SHOWN} more contacts"
        yield (
            f"{self.patch} on {self.link}, method {self.method}: {self.taxels - len(self.left_out)} of {self.taxels} "
            f"taxels; touched in {self.frames_with_contact} of {self.frames} means of {self.averaged} messages, with "
            f"{self.mean_force_N:.2f} N on average and {self.largest_force_N:.2f} N at most; heat: {self.temperature}"
        )
        if self.weight is not None:
            yield table_of(self.weight.placements, f"{self.patch}: a weight of {self.weight.weight_N:.2f} N")
        yield from optional_table(self.releases[:_SHOWN], "released, and what was left")
        if any(row.re_tare == OFFERED for row in self.releases):
            yield "where nothing touched the patch after a release, --re-tare takes what was left as rest"

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a contact, also where there is none.
        """
        return super().columns() or list(SkinContactRow.model_fields)


def save_contacts(result: SkinWrench, path: Path) -> None:
    """Write every contact of every frame as CSV.

    Args:
        result: The contacts.
        path: File to write or to replace.
    """
    write_bytes_atomically(path, result.csv_text().encode())


@with_recording_notes
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
        choice: How the wrench is computed; by kriging if None.

    Returns:
        Every contact of every frame.
    """
    content = load_patches(experiment) if isinstance(experiment, (Path, str)) else experiment
    chosen = WrenchChoice() if choice is None else choice
    return _result(content, patch_frames(content, calibration, patch=patch, choice=chosen), chosen)


@dataclass(frozen=True, kw_only=True, eq=False)
class PatchFrames:
    """A patch, and what its taxels say over a recording."""

    patch: ExperimentPatch
    """The patch in the experiment."""
    skin: SkinPatch
    """Its surface and wrenches."""
    read: SkinFrames
    """Its frames, and what they were read by."""


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
        choice: How the wrench is computed; by kriging if None.

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
        curves.table().require_patch(own.name, columns=own.columns, serial=own.serial)
        skin = chosen_patch(chosen_layout(own.layout, chosen), chosen)
        seconds, counts = patch_messages(content, own)
        frames = skin_frames(skin, curves, seconds, counts, chosen)
    return PatchFrames(patch=own, skin=skin, read=frames)


def _result(content: PatchExperiment, frames: PatchFrames, chosen: WrenchChoice) -> SkinWrench:
    own, skin, read = frames.patch, frames.skin, frames.read
    if not read.frames:
        raise SkinError(f"{content.file}: patch {own.name!r}: expected {chosen.averaged} messages or more, got fewer")
    seconds = np.array([middle for middle, _, _ in read.frames])
    force = np.array([np.linalg.norm(contacts.wrench[:, :3].sum(axis=0)) for _, _, contacts in read.frames])
    touched = np.array([len(contacts) > 0 for _, _, contacts in read.frames])
    rows = [row for middle, frame, contacts in read.frames for row in contact_rows(skin, frame, contacts, middle)]
    return SkinWrench(
        experiment=content.name,
        patch=own.name,
        link=own.link or skin.layout.frame,
        method=skin.method.value,
        temperature=read.rule.value,
        taxels=len(skin.layout),
        left_out=tuple(skin.layout.taxels[~read.reader.live].tolist()),
        frames=len(read.frames),
        frames_with_contact=int(touched.sum()),
        averaged=chosen.averaged,
        largest_force_N=float(force.max()),
        mean_force_N=float(force[touched].mean()) if touched.any() else 0.0,
        contacts=tuple(rows),
        lives=life_rows(read.lives, rows),
        releases=read.releases,
        weight=None if chosen.weight_kg is None else known_weight(chosen.weight_kg, seconds, force, touched),
        picture=_picture(own.name, skin, seconds, force, read.frames, chosen),
        warnings=(
            *_warnings(rows, read, chosen),
            *heat_warnings(read, rows, has_pads=len(skin.layout.thermal_pads) > 0),
            *added_to(content.recording),
        ),
    )


def _picture(
    name: str,
    skin: SkinPatch,
    seconds: FloatArray,
    force: FloatArray,
    read: Sequence[tuple[float, PressureFrame, SkinContacts]],
    chosen: WrenchChoice,
) -> SkinWrenchPicture:
    normal_force = np.array([contacts.normal_force_N.sum() for _, _, contacts in read])
    forces = {f"{skin.method}: norm of the force": force, f"{skin.method}: integral of the pressure": normal_force}
    if chosen.taxel_area_mm2 is not None and skin.method is not WrenchMethod.SIMPLE:
        simple = SkinPatch.of(skin.layout, WrenchMethod.SIMPLE, taxel_area_m2=1e-6 * chosen.taxel_area_mm2)
        simple_force = [find_contacts(simple, frame).wrench[:, :3].sum(axis=0) for _, frame, _ in read]
        forces[f"simple, {chosen.taxel_area_mm2:g} mm2: norm of the force"] = np.linalg.norm(simple_force, axis=1)
    return SkinWrenchPicture(
        patch=name,
        seconds=seconds,
        forces=forces,
        places=unrolled(skin.surface),
        triangles=skin.surface.triangles,
        pressures=np.stack([np.where(contacts.contact >= 0, frame.pressures, 0.0) for _, frame, contacts in read]),
        strongest=int(force.argmax()),
    )


def _warnings(rows: Sequence[SkinContactRow], read: SkinFrames, chosen: WrenchChoice) -> tuple[str, ...]:
    """What limits the accuracy of contacts."""
    beyond = sum(row.beyond_range for row in rows)
    at_edge = sum(row.edge_share > 0.1 for row in rows)
    several = sum(row.lobes > 1 for row in rows)
    live, touched = read.reader.live, read.touched_at_rest
    dead = int((~live).sum())
    many = dead > MANY_LEFT_OUT * len(live)
    warnings = (
        (
            beyond,
            f"{beyond} of {len(rows)} contacts press a taxel beyond what it was calibrated for",
        ),
        (
            at_edge,
            f"{at_edge} of {len(rows)} contacts have over 10 % of their force at the edge: some is not felt",
        ),
        (several, f"{several} of {len(rows)} contacts have several hills of pressure: they may be contacts that touch"),
        (
            len(read.stuck),
            f"{len(read.stuck)} taxels send one number in all messages while others are noisy, the first in column "
            f"{read.stuck[0] if len(read.stuck) else None}: they feel nothing, and forces on them are missed",
        ),
        (
            len(touched),
            f"{len(touched)} taxels, the first in column {touched[0] if len(touched) else None}, were touched in the "
            f"first {chosen.rest_s:g} s, from which rest is taken: they read too little; begin without contact",
        ),
        (
            dead,
            f"{dead} of {len(live)} taxels are left out; "
            + (
                f"over {100.0 * MANY_LEFT_OUT:g} %: forces are too low, and small contacts are missed"
                if many
                else "their pressure is interpolated from the taxels around them"
            ),
        ),
    )
    return tuple(warning for number, warning in warnings if number)

# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin of an experiment, matched to their streams, also without a robot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import IntArray
from forcetorque.base.errors import ExperimentError, MissingFileError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import make_pose
from forcetorque.base.toml_file import Positive, Table, Text
from forcetorque.experiment.experiment_file import ExperimentFile
from forcetorque.experiment.intervals import RecordedSpan, read_spans
from forcetorque.experiment.named_files import Inputs, stated_in
from forcetorque.experiment.section import Loading
from forcetorque.recording.alignment import require_overlap
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import Joint, JointType, RobotModel


class Patch(Table):
    """A patch of artificial skin."""

    name: Text
    """Name of the patch."""
    counts: Text
    """Stream of the recording that holds its `taxel_counts`."""
    pressure: Text | None = None
    """Stream with the `pressure` of the chamber or bag that it was calibrated in."""
    pressure_of: Literal["chamber", "bag"] = "chamber"
    """`bag`: the gauge is inside a vacuum bag, and the skin feels by how much it falls below its level at rest."""
    serial: Text | None = None
    """Serial number, or another mark that distinguishes it from patches of the same name."""
    layout: Path | None = None
    """File that says where its taxels are; every column of the counts is one if left out."""
    link: Text | None = None
    """Link that it is mounted on; that of the layout if left out."""
    table: Path | None = None
    """Calibration of its taxels, as `forcetorque skin calibrate` writes it; where it is specified, contacts are
    shown."""
    friction: Annotated[float, Field(ge=0.0)] | None = None
    """Coefficient that bounds the tangential force, which skin does not measure; without one it is unknown."""
    oldest_s: Positive | None = None
    """How much older than a pose the frame of pressures that belongs to it may be; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentPatch:
    """A patch of skin, matched to its streams."""

    name: str
    """Name."""
    serial: str | None
    """Serial number, if it has one."""
    counts: str
    """Stream of the counts."""
    pressure: str | None
    """Stream of the pressure that it was calibrated with."""
    in_bag: bool = False
    """Whether that is the pressure inside a vacuum bag, which falls as that on the skin rises."""
    layout: Path | None
    """File with its layout."""
    link: str | None
    """Link that it is mounted on, where the file says so."""
    table: Path | None = None
    """File with the calibration of its taxels, where the file says so."""
    friction: float | None = None
    """Coefficient that bounds the tangential force; None where nothing is known of it."""
    oldest_s: float | None = None
    """How much older than a pose its frame may be, where the file says so; s."""
    columns: int
    """Numbers in one message of counts."""
    taxels: IntArray
    """Columns of the pressure taxels; shape (n,)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class PatchExperiment:
    """The patches of an experiment, and what was measured with them."""

    name: str
    """Name of the experiment."""
    file: Path
    """Its file."""
    recording: Recording
    """What was measured."""
    patches: tuple[ExperimentPatch, ...]
    """Patches in the order of the file."""
    intervals: tuple[RecordedSpan, ...]
    """Intervals in the order of the file."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""

    def __repr__(self) -> str:
        patches = ", ".join(f"{patch.name} ({len(patch.taxels)} taxels)" for patch in self.patches)
        return f"<PatchExperiment {self.name!r}: {patches}>"

    def patch(self, name: str | None) -> ExperimentPatch:
        """Find a patch.

        Args:
            name: Its name; None for the only one.

        Returns:
            The patch.

        Raises:
            ExperimentError: If there is none of that name, or no name is given and there are several.
        """
        known = [patch.name for patch in self.patches]
        if name is None and len(known) > 1:
            raise ExperimentError(f"{self.file}: expected the name of a patch, one of {', '.join(known)}")
        for patch in self.patches:
            if name in (None, patch.name):
                return patch
        raise ExperimentError(f"{self.file}: no patch is called {name!r}; {known_names(name or '', known)}")


def match_patches(
    patches: Iterable[Patch], parsed: ExperimentFile, file: Path, recording: Recording, inputs: Inputs
) -> PatchExperiment:
    """Match the patches of a file to their streams.

    Args:
        patches: Patches of the file.
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The recording.
        inputs: Keeps track of the files that are read.

    Returns:
        The patches in the order of the file.

    Raises:
        ExperimentError: If a name comes twice, or a patch contradicts its stream.
    """
    table = tuple(patches)
    names = [entry.name for entry in table]
    for index, name in enumerate(names):
        if name in names[:index]:
            raise ExperimentError(f"{file}: patch[{index}]: {name!r} is listed twice; keep one")
    matched = tuple(_patch(f"{file}: patch[{k}]", entry, recording, inputs) for k, entry in enumerate(table))
    return PatchExperiment(
        name=parsed.name,
        file=file,
        recording=recording,
        patches=matched,
        intervals=read_spans(parsed, file, recording),
        inputs_sha256=inputs.sha256(),
    )


def skin_of_robot(patches: Iterable[Patch], loading: Loading) -> PatchExperiment:
    """Give the patches of a robot, those with a calibration of their taxels each on a link: they are sources of force.

    Args:
        patches: Patches of the file.
        loading: Robot and recording.

    Returns:
        The patches.

    Raises:
        MissingFileError: If a table is not there.
        ExperimentError: If a patch is on no link of the robot, or the file does not say which.
    """
    parsed, file, model, inputs = loading.parsed, loading.file, loading.model, loading.inputs
    for table in (entry.table for entry in patches if entry.table is not None):
        if not inputs.file(table).is_file():
            raise MissingFileError(
                f"{inputs.folder / table}: expected a calibration of taxels, there is none; `forcetorque skin "
                "calibrate` makes one"
            )
    skin = match_patches(patches, parsed, file, loading.recording, inputs)
    return replace(
        skin, patches=tuple(patch if patch.table is None else _on_link(file, patch, model) for patch in skin.patches)
    )


def _on_link(file: Path, patch: ExperimentPatch, model: RobotModel) -> ExperimentPatch:
    """The patch with its link, that of the layout where the file does not say."""
    from forcetorque.skin.layout.formats.registry import describe_patch  # here because most experiments have no skin

    link = patch.link
    if link is None and patch.layout is not None:
        link = describe_patch(patch.layout).frame
    if link not in model.links:
        raise ExperimentError(
            f"{file}: patch {patch.name!r}: expected the link that it is mounted on, got {link!r}, and robot "
            f"{model.name!r} has none such; {known_names(link or '', model.links)}; state link in [[patch]]"
        )
    return replace(patch, link=link)


def _patch(where: str, entry: Patch, recording: Recording, inputs: Inputs) -> ExperimentPatch:
    with stated_in(where):
        stream = recording.stream(entry.counts)
        columns = len(stream.signal("taxel_counts").columns)
        if entry.pressure is not None:
            chamber = recording.stream(entry.pressure)
            chamber.signal("pressure")
            require_overlap(stream, chamber)
        taxels = np.arange(columns)
        if entry.layout is not None:
            from forcetorque.skin.layout.formats.registry import describe_patch

            layout = describe_patch(inputs.file(entry.layout))
            if layout.columns != columns:
                raise ExperimentError(
                    f"expected counts of {layout.columns} columns, as {entry.layout} has them, got {columns} in the "
                    f"stream {entry.counts!r}; the log is of another patch"
                )
            taxels = layout.taxels
    return ExperimentPatch(
        name=entry.name,
        serial=entry.serial,
        counts=entry.counts,
        pressure=entry.pressure,
        in_bag=entry.pressure_of == "bag",
        layout=None if entry.layout is None else inputs.folder / entry.layout,
        link=entry.link,
        table=None if entry.table is None else inputs.folder / entry.table,
        friction=entry.friction,
        oldest_s=entry.oldest_s,
        columns=columns,
        taxels=taxels,
    )


BESIDE_M: Final = 0.4
"""From one link to the next: limbs of a humanoid do not touch; m."""
ROOT: Final = "side by side"
"""Link in place of a robot."""


def skin_frames_of(patches: Iterable[Patch], recording: Recording, inputs: Inputs) -> tuple[str, ...]:
    """Name the links that patches and contacts of a skinManager are on.

    Args:
        patches: Patches of the file.
        recording: The recording.
        inputs: Keeps track of the files that are read.

    Returns:
        Each of them once.
    """
    return tuple(dict.fromkeys((*_of_patches(patches, inputs), *_of_events(recording))))


def _of_patches(patches: Iterable[Patch], inputs: Inputs) -> Iterator[str]:
    from forcetorque.skin.layout.formats.registry import describe_patch  # here because most experiments have no skin

    for patch in patches:
        link = patch.link
        if link is None and patch.layout is not None:
            link = describe_patch(inputs.file(patch.layout)).frame
        if link:
            yield link


def _of_events(recording: Recording) -> Iterator[str]:
    for stream in recording.streams.values():
        frame = stream.signals["skin_event"].frame if "skin_event" in stream.signals else None
        if frame:
            yield frame


def links_side_by_side(links: Iterable[str]) -> RobotModel:
    """Make a model of links without a robot.

    Args:
        links: Their names.

    Returns:
        Links without mass, each fixed to a root.
    """
    names = tuple(links)
    joints = {
        name: Joint(
            name=name,
            type=JointType.FIXED,
            parent=ROOT,
            child=name,
            parent_H_child=make_pose(np.eye(3), np.array([BESIDE_M * place, 0.0, 0.0])),
            axis=np.array([1.0, 0.0, 0.0]),  # a fixed joint has none
        )
        for place, name in enumerate(names)
    }
    masses = {name: Inertia.zero() for name in (ROOT, *names)}
    return RobotModel(name="links side by side, no robot", links=masses, joints=joints, sensors={})


def is_skin_alone(model: RobotModel) -> bool:
    """Check whether links are a row of separate links rather than a robot.

    Args:
        model: A robot.

    Returns:
        Whether `links_side_by_side` made it.
    """
    return model.root_link == ROOT

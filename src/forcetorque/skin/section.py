# SPDX-License-Identifier: BSD-3-Clause
"""The section `patch` of an experiment file: patches of skin, with or without a robot."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.named_files import Inputs
from forcetorque.experiment.robot_and_streams import read_streams
from forcetorque.experiment.section import Loading, Section, StandIn
from forcetorque.skin.patches_of_experiment import (
    ExperimentPatch,
    Patch,
    PatchExperiment,
    links_side_by_side,
    match_patches,
    skin_frames_of,
    skin_of_robot,
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchSection(Section[tuple[Patch, ...], PatchExperiment | None]):
    """The patches of an experiment; links that carry skin stand side by side where the file names no robot."""

    def gives_forces(self, table: tuple[Patch, ...]) -> bool:  # noqa: D102
        return any(patch.table for patch in table)

    def stand_in(self, table: tuple[Patch, ...], loading: Loading) -> StandIn | None:  # noqa: D102
        if loading.parsed.sensor:
            return None
        frames = skin_frames_of(table, loading.recording, loading.inputs)
        return StandIn(model=links_side_by_side(frames)) if frames else None


def _read(table: tuple[Patch, ...], loading: Loading) -> PatchExperiment | None:
    if not table:
        return None
    return skin_of_robot(table, loading)


PATCHES = PatchSection(
    key="patch",
    type=Annotated[tuple[Patch, ...], Field(min_length=1)],
    default=(),
    description="Patches of artificial skin; without these and sensors a file is about contacts that a skinManager "
    "saw.",
    read=_read,
    empty=None,
    of_robot=False,
    without_sensors=("patches of skin only", "`forcetorque skin`, `inspect`, `view` and `report` read such a file"),
)


def load_patches(path: Path | str) -> PatchExperiment:
    """Read the patches of an experiment file, and their recording.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The patches.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file has no patch, or contradicts itself or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    table = parsed.table(PATCHES)
    if not table:
        raise ExperimentError(f"{file}: expected [[patch]], a patch of skin, got none")
    inputs = Inputs.of(file)
    return match_patches(table, parsed, file, read_streams(parsed, file, None, inputs), inputs)


def force_patches(experiment: Experiment) -> tuple[ExperimentPatch, ...]:
    """Give the patches whose contacts are sources of force.

    Args:
        experiment: The experiment.

    Returns:
        Those with a calibration of their taxels.
    """
    skin = experiment.section(PATCHES)
    return () if skin is None else tuple(patch for patch in skin.patches if patch.table is not None)

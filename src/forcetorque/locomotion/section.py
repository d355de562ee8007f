# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file says of the soles that a robot stands on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Table, Text
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.section import Loading, Section, require_link
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import RobotModel

if TYPE_CHECKING:
    from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole


class SoleTable(Table):
    """A flat sole, for `forcetorque robot balance`."""

    frame: Text
    """Link of the URDF whose z points from the ground into the foot."""
    position_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """A point of the sole's plane in the frame, from which points on the sole count; its origin if left out."""
    outline_m: Annotated[FloatArray, ArrayField((None, 2))] | None = None
    """Corners x, y of the sole from that point; without them nothing shows whether a point lies outside."""
    friction: float | None = None
    """Force along the ground over the normal force up to which the sole holds; without it no slip is looked for."""
    torsional_friction_m: float | None = None
    """Torsion about the normal over the normal force up to which it holds; m."""
    stream: Text | None = None
    """Stream with the `vertical_force` of the ground on it, where no sensor of the foot was logged."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentSole:
    """A sole, and where the force on it was logged if no sensor measures it."""

    sole: Sole
    """The sole."""
    stream: str | None = None
    """Stream with its vertical force; None where force-torque sensors measure it."""


def read_soles(
    entries: Iterable[SoleTable], file: Path, model: RobotModel | None, recording: Recording, *, sensed: bool
) -> tuple[ExperimentSole, ...]:
    """Match the soles of a file to the robot and the recording.

    Args:
        entries: Soles of the experiment file.
        file: The experiment file, for messages.
        model: The robot; None where the file names none.
        recording: The streams.
        sensed: Whether the file has force-torque sensors, which measure what the ground does.

    Returns:
        The soles in the order of the file.

    Raises:
        ExperimentError: If a frame is not in the robot or listed twice, or a sole has a stream beside sensors
            or beside a friction.
    """
    from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole

    soles: list[ExperimentSole] = []
    for index, entry in enumerate(entries):
        where = f"{file}: sole[{index}]"
        if model is not None:
            require_link(model, entry.frame, where)
        if entry.frame in (earlier.sole.frame for earlier in soles):
            raise ExperimentError(f"{where}: the frame {entry.frame!r} is listed twice; keep one")
        if sensed and entry.stream is not None:
            raise ExperimentError(
                f"{where}: expected stream with the vertical_force of the ground, or [[sensor]] in the file, got both; "
                "two sources of one force are not combined"
            )
        limits = [key for key in ("friction", "torsional_friction_m") if getattr(entry, key) is not None]
        if limits and entry.stream is not None:
            raise ExperimentError(
                f"{where}: expected {' and '.join(limits)} of a sole whose force and moment a sensor measures, got "
                "stream beside it: a vertical force shows no slip; leave it out"
            )
        with stated_in(where):
            if entry.stream is not None:
                recording.stream(entry.stream).signal("vertical_force")
            position = np.zeros(3) if entry.position_m is None else entry.position_m
            sole = Sole(
                frame=entry.frame,
                position=position,
                outline=entry.outline_m,
                friction=entry.friction,
                torsional_friction_m=entry.torsional_friction_m,
            )
        soles.append(ExperimentSole(sole=sole, stream=entry.stream))
    return tuple(soles)


def refuse_without_soles(experiment: Experiment) -> None:
    """Refuse an experiment that does not state what the robot stands on.

    Raises:
        ExperimentError: If it has no sole; the message names the links that its intervals say are touched.
    """
    if experiment.section(SOLES):
        return
    supports = [one.support.frame for one in experiment.recording.intervals if one.support is not None]
    touched = dict.fromkeys((*supports, *(entry.contact.link for entry in experiment.contacts)))
    tables = ", ".join(f'[[sole]] frame = "{link}"' for link in touched)
    raise ExperimentError(
        f"experiment {experiment.name!r}: expected [[sole]], the flat soles that the robot stands on, got none; frame "
        "names a link whose plane z = 0 is a sole, outline_m its corners"
        + (f"; its intervals touch {', '.join(touched)}: of these state what is a sole, as {tables}" if touched else "")
    )


def _read(table: tuple[SoleTable, ...], loading: Loading) -> tuple[ExperimentSole, ...]:
    if not table:
        return ()
    sensed = bool(loading.parsed.sensor)
    return read_soles(table, loading.file, loading.model, loading.recording, sensed=sensed)


SOLES: Section[tuple[SoleTable, ...], tuple[ExperimentSole, ...]] = Section(
    key="sole",
    type=tuple[SoleTable, ...],
    default=(),
    description="Soles that the robot stands on, for `forcetorque robot balance`.",
    read=_read,
    empty=(),
    without_sensors=("soles only", "`forcetorque robot balance` reads one of vertical forces alone"),
)

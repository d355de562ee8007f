# SPDX-License-Identifier: BSD-3-Clause
"""Feet whose vertical forces were logged, and nothing else of what the ground does to them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.file import parse_experiment
from forcetorque.experiment.input_files import Inputs
from forcetorque.experiment.intervals import RecordedSpan, read_spans
from forcetorque.experiment.streams import read_streams
from forcetorque.locomotion.section import SOLES, ExperimentSole, read_soles
from forcetorque.recording.alignment import interpolate, require_overlap, usable_samples
from forcetorque.recording.recording import Recording, Use
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import read_urdf


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class FootForces:
    """The vertical forces of an experiment's feet."""

    name: str
    """Name of the experiment."""
    file: Path
    """Its file."""
    recording: Recording
    """What was measured."""
    soles: tuple[ExperimentSole, ...]
    """Soles in the order of the file, each with a stream."""
    intervals: tuple[RecordedSpan, ...]
    """Intervals in the order of the file."""
    model: RobotModel | None
    """The robot, which tells its weight; None where the file names none."""
    gravity: float
    """Magnitude of gravity; m/s2."""

    def __repr__(self) -> str:
        return f"<FootForces {self.name!r}: {', '.join(sole.sole.frame for sole in self.soles)}>"

    def over(self, span: RecordedSpan) -> tuple[IntArray, dict[str, FloatArray]]:
        """Give the forces over an interval, at the instants of the first sole's stream.

        Args:
            span: The interval.

        Returns:
            Stamps that rise, those of ignored intervals left out, shape (n,), ns; and the vertical force on each sole,
            NaN in gaps, shape (n,) each, N.
        """
        first = self.recording.stream(self.soles[0].stream or "")
        at_ns = first.stamp_ns[usable_samples(first.stamp_ns)]
        at_ns = at_ns[span.holds(at_ns)]
        for other in self.intervals:
            if other.use is Use.IGNORE and other is not span:
                at_ns = at_ns[~other.holds(at_ns)]
        forces = {}
        for sole in self.soles:
            stream = self.recording.stream(sole.stream or "")
            require_overlap(first, stream)
            forces[sole.sole.frame] = interpolate(stream, stream.signal("vertical_force").values, at_ns)[:, 0]
        return at_ns, forces


def has_foot_forces(path: Path | str) -> bool:
    """Tell whether an experiment file is about feet whose vertical forces alone were logged.

    Args:
        path: TOML file.

    Returns:
        Whether it has soles and no force-torque sensor.
    """
    parsed = parse_experiment(path)
    return bool(parsed.table(SOLES)) and not parsed.sensor


def load_foot_forces(path: Path | str) -> FootForces:
    """Read the vertical forces of an experiment's feet.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The forces.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file has no sole, or contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    table = parsed.table(SOLES)
    if not table:
        raise ExperimentError(f"{file}: expected [[sole]], a foot with the stream of its vertical_force, got none")
    inputs = Inputs(file.parent)
    inputs.file(Path(file.name))
    model = None if parsed.robot is None else read_urdf(inputs.file(parsed.robot.urdf))
    recording = read_streams(parsed, file, model, inputs)
    return FootForces(
        name=parsed.name,
        file=file,
        recording=recording,
        soles=read_soles(table, file, model, recording, sensed=bool(parsed.sensor)),
        intervals=read_spans(parsed, file, recording),
        model=model,
        gravity=STANDARD_GRAVITY if parsed.robot is None else parsed.robot.gravity,
    )

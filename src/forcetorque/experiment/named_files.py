# SPDX-License-Identifier: BSD-3-Clause
"""Files that an experiment names, resolved from its folder and hashed, and the names of its recordings."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.input_file import accept_input
from forcetorque.base.output_file import real_path
from forcetorque.robot.installed_robots import installed_robot, installed_robots, is_robot_name
from forcetorque.robot.model import RobotModel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InMemory:
    """What a script holds in place of files that an experiment file names."""

    robot: RobotModel | None = None
    """In place of the URDF file; None where tables name one."""
    priors: Mapping[str, FloatArray] = field(default_factory=dict)
    """In place of files of prior matrices, by the name of the sensor; shape (6, c) each; N/count, N m/count."""
    arrays: Mapping[str, FloatArray] | None = None
    """In place of the log, by the names that tables have for them; shape (rows, columns) each; None where tables name a
    log."""


class Inputs:
    """Resolves the paths of an experiment file and remembers what was read."""

    def __init__(self, folder: Path, in_memory: InMemory | None = None) -> None:
        """Begin without inputs.

        Args:
            folder: Folder that paths are relative to.
            in_memory: What stands in place of files; nothing if None.
        """
        self.folder = folder
        self.in_memory = InMemory() if in_memory is None else in_memory
        self._read: dict[str, Path] = {}

    @classmethod
    def of(cls, file: Path) -> Self:
        """Begin with an experiment file, which is the first input.

        Returns:
            Its inputs so far.
        """
        inputs = cls(file.parent)
        inputs.file(Path(file.name))
        return inputs

    def file(self, relative: Path) -> Path:
        """Resolve a file.

        Args:
            relative: Path as the experiment file has it.

        Returns:
            Path to open.

        Raises:
            FormatError: If a pipe or a device is there.
        """
        path = self.folder / relative
        accept_input(path)
        self._read[relative.as_posix()] = path
        return path

    def robot(self, urdf: Path) -> Path:
        """Resolve the file of a robot.

        An installed robot is remembered by its name, with the package and its version.

        Args:
            urdf: Path as the experiment file has it, or the name of an installed robot.

        Returns:
            Path to open.
        """
        if not is_robot_name(urdf, self.folder):
            return self.file(urdf)
        robot = installed_robot(str(urdf))
        accept_input(robot.urdf)
        self._read[robot.source] = robot.urdf
        return robot.urdf

    def below(self, relative: Path, *patterns: str) -> Path:
        """Resolve a folder of which some files are read.

        Args:
            relative: Path as the experiment file has it.
            patterns: Names of the files, with wildcards.

        Returns:
            Path of the folder.

        Raises:
            FormatError: If one of the files is a pipe or a device.
        """
        path = self.folder / relative
        for pattern in patterns:
            for file in sorted(path.glob(pattern)):
                accept_input(file)
                self._read[(relative / file.name).as_posix()] = file
        return path

    def names(self) -> frozenset[str]:
        """Tell what was resolved so far.

        Returns:
            Paths as the experiment file has them.
        """
        return frozenset(self._read)

    def sha256(self) -> dict[str, str]:
        """Hash everything that was resolved.

        Returns:
            SHA-256 in hex by the path as the experiment file has it,
            or by name, package and version of an installed robot.
        """
        return {name: sha256_of(path) for name, path in sorted(self._read.items())}


def changed_inputs(folder: Path, inputs_sha256: Mapping[str, str]) -> list[str]:
    """Find inputs that are not what they were.

    Args:
        folder: Folder of the experiment file.
        inputs_sha256: SHA-256 by name, as `Inputs.sha256` gives them.

    Returns:
        Names of those that changed or are gone.
    """
    files = {name: folder / name for name in inputs_sha256}
    if not all(path.is_file() for path in files.values()):  # an installed robot is named by its package and version
        files |= {robot.source: robot.urdf for robot in installed_robots().values() if robot.source in files}
    return [
        name for name, digest in inputs_sha256.items() if not files[name].is_file() or sha256_of(files[name]) != digest
    ]


def sha256_of(path: Path) -> str:
    """Hash a file.

    Args:
        path: The file.

    Returns:
        SHA-256 in hex.
    """
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


@contextmanager
def stated_in(where: str) -> Iterator[None]:
    """Say in which table of the experiment file the path or name stands that leads to an error.

    Args:
        where: File and table.

    Yields:
        Nothing.

    Raises:
        ForceTorqueError: The error of the body, of the same type, with `where` in front.
    """
    try:
        yield
    except ForceTorqueError as error:
        # who read the file may have said so already, or the last part of it
        file, _, last = where.rpartition(": ")
        starts = {f"{where}: ": "", f"{last}: ": f"{file}: "} if file else {f"{where}: ": ""}
        missing = next((words for start, words in starts.items() if str(error).startswith(start)), f"{where}: ")
        raise type(error)(f"{missing}{error}") from error


@dataclass(frozen=True, slots=True, kw_only=True)
class ExperimentContext:
    """Names, units and files of an experiment, for `LogFormat.read`."""

    experiment: Path
    """The experiment file, for messages."""
    inputs: Inputs
    """Resolves and remembers the files."""
    sensors: Mapping[str, str]
    """Name of the sensor that reads a stream, by the stream."""
    joint_units: Mapping[str, str]
    """Unit of the position of every joint of the robot, rad or m; empty for a wrist sensor."""

    def file(self, relative: Path) -> Path:
        """Resolve a file, which becomes an input.

        Args:
            relative: Path as the experiment file has it.

        Returns:
            Path to open.
        """
        return self.inputs.file(relative)

    def below(self, relative: Path, *patterns: str) -> Path:
        """Resolve a folder of which some files become inputs.

        Args:
            relative: Path as the experiment file has it.
            patterns: Names of the files, with wildcards.

        Returns:
            Path of the folder.
        """
        return self.inputs.below(relative, *patterns)

    def folder(self, relative: Path) -> Path:
        """Resolve a folder that must be there.

        Args:
            relative: Path as the experiment file has it.

        Returns:
            Path of the folder.

        Raises:
            MissingFileError: If it is not there.
        """
        path = self.inputs.folder / relative
        if not path.is_dir():
            raise MissingFileError(f"{path}: expected the folder of a log, there is none")
        return path

    def stated_in(self, table: str) -> AbstractContextManager[None]:
        """Put the file and the table of `[recording]` that is being read in front of errors.

        Args:
            table: The table, such as `stream[2]`.

        Returns:
            The context of its reading.
        """
        return stated_in(f"{self.experiment}: recording.{table}")


def recording_name(experiment: str, file: str) -> str:
    """Name a recording where several experiments have one name.

    Args:
        experiment: Name of the experiment.
        file: End of the path of its file.

    Returns:
        The name, which is also that of its session where the file names none.
    """
    return f"{experiment} ({file})"


def path_endings(file: Path) -> list[str]:
    """Give the ends of a path: the stem of the file with more and more folders in front.

    Returns:
        The ends, shortest first.
    """
    parts = real_path(file).with_suffix("").parts
    return ["/".join(parts[-count:]) for count in range(1, len(parts))]


def file_of_each(experiments: Sequence[Path], output: Path) -> dict[Path, Path]:
    """Name the file that is written of every experiment.

    Args:
        experiments: Experiment files.
        output: The file that is named.

    Returns:
        That file for one experiment; of several one each, NAME.EXPERIMENT with its ending.
    """
    if len(experiments) == 1:
        return {experiments[0]: output}
    names = distinct_files(experiments)
    return {path: output.with_suffix(f".{names[path].replace('/', '-')}{output.suffix}") for path in experiments}


def distinct_files(files: Sequence[Path]) -> dict[Path, str]:
    """Name every file by its stem, with as many folders in front as tell all of them apart.

    Returns:
        Names by file.
    """
    endings = [path_endings(file) for file in files]
    for count in range(min(map(len, endings))):
        names = [ends[count] for ends in endings]
        if len(set(names)) == len(names):
            return dict(zip(files, names, strict=True))
    return {file: file.as_posix() for file in files}

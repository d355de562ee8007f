# SPDX-License-Identifier: BSD-3-Clause
"""Files that an experiment points to: resolved from its folder, and hashed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from forcetorque.errors import ForceTorqueError
from forcetorque.input_file import accept_input


class Inputs:
    """Resolves the paths of an experiment file and remembers what was read."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._read: dict[str, Path] = {}

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
            SHA-256 in hex by the path as the experiment file has it.
        """
        hashes = {}
        for name, path in sorted(self._read.items()):
            with path.open("rb") as stream:
                hashes[name] = hashlib.file_digest(stream, "sha256").hexdigest()
        return hashes


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
        # who read the file may have said so already
        words = str(error) if str(error).startswith(f"{where}: ") else f"{where}: {error}"
        raise type(error)(words) from error

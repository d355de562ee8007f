# SPDX-License-Identifier: BSD-3-Clause
"""Names of recordings, and of their sessions, where several experiments have one name."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from forcetorque.base.files import real_path


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

    Args:
        file: The file.

    Returns:
        The ends, shortest first.
    """
    parts = real_path(file).with_suffix("").parts
    return ["/".join(parts[-count:]) for count in range(1, len(parts))]


def distinct_files(files: Sequence[Path]) -> dict[Path, str]:
    """Name every file by its stem, with as many folders in front as tell all of them apart.

    Args:
        files: The files.

    Returns:
        Names by file.
    """
    endings = [path_endings(file) for file in files]
    for count in range(min(map(len, endings))):
        names = [ends[count] for ends in endings]
        if len(set(names)) == len(names):
            return dict(zip(files, names, strict=True))
    return {file: file.as_posix() for file in files}

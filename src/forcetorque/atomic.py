# SPDX-License-Identifier: BSD-3-Clause
"""Writing a file so that readers see the old content or the new, never a part."""

from __future__ import annotations

import os
import stat
import sys
from pathlib import Path

from forcetorque.errors import ForceTorqueError, MissingFileError
from forcetorque.paths import real_path
from forcetorque.run_files import refuse_input
from forcetorque.temporary import temporary_beside

STANDARD_OUTPUT = Path("-")
"""What a command is given in place of a file to have it on standard output."""

_KINDS = {stat.S_IFDIR: "a folder", stat.S_IFSOCK: "a socket", stat.S_IFBLK: "a block device"}


def write_bytes_atomically(path: Path, data: bytes) -> None:
    """Write a file under a temporary name in the same folder, then rename it.

    If anything fails, the file keeps what it held before and the temporary one is removed. Only a file is
    replaced: a character device such as /dev/null and a pipe stay what they are, and the data go into them.

    Args:
        path: File to write or to replace; a symbolic link keeps pointing to the file that it names; `-` is standard
            output.
        data: Its new content.

    Raises:
        MissingFileError: If the folder of the file does not exist.
        ForceTorqueError: If something is there that is no file, no character device and no pipe.
        OutputError: If the run of the command has read the file.
    """
    if path == STANDARD_OUTPUT:
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()
        return
    if not _is_replaceable(path):
        with path.open("wb") as stream:
            stream.write(data)
        return
    refuse_input(path)
    target = real_path(path)
    with temporary_beside(target) as temporary:
        with temporary.open("wb") as stream:
            stream.write(data)
            stream.flush()
            # Otherwise a power cut after the rename can leave an empty file.
            os.fsync(stream.fileno())
        temporary.replace(target)


def refuse_unwritable(path: Path) -> None:
    """Refuse a path that cannot be written to, before any work is done.

    Args:
        path: As of `write_bytes_atomically`.

    Raises:
        MissingFileError: If the folder of the file does not exist.
        ForceTorqueError: If something is there that is no file, no character device and no pipe.
    """
    if path != STANDARD_OUTPUT:
        _is_replaceable(path)


def _is_replaceable(path: Path) -> bool:
    """Whether it is a file or nothing yet, not something that is open for writing and stays; what else is refused."""
    folder = real_path(path).parent
    try:
        # not of the real path: /dev/stdout leads to a pipe that has no name
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        if not folder.is_dir():
            raise MissingFileError(
                f"{path}: expected an existing folder to write to, got none; create {folder}"
            ) from None
        return True
    if stat.S_ISCHR(mode) or stat.S_ISFIFO(mode):
        return False
    if not stat.S_ISREG(mode):
        raise ForceTorqueError(
            f"{path}: expected a file to write, got {_KINDS.get(stat.S_IFMT(mode), 'no file')}; choose another name"
        )
    return True

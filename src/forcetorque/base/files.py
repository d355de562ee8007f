# SPDX-License-Identifier: BSD-3-Clause
"""Files and folders that are written as a whole or not at all, and what a killed run left."""

from __future__ import annotations

import os
import re
import shutil
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.run_files import refuse_input

if sys.platform != "win32":
    import fcntl

_NAME = re.compile(r"\.forcetorque-[0-9a-f]{32}\.tmp")


@contextmanager
def temporary_beside(target: Path, *, folder: bool = False) -> Iterator[Path]:
    """Make an empty file or folder beside a target, to be filled and renamed to it in the body.

    It is locked while it is there, so that runs tell what others still write from what a killed run left. Leftovers in
    the same folder are removed first. Where there are no such locks, nothing of others is removed.

    Args:
        target: The file or folder that it becomes; its parent exists. A rename within one folder is atomic.
        folder: Whether it is a folder.

    Yields:
        Its path; removed at the end unless the body has renamed it.
    """
    _remove_leftovers(target.parent)
    path, descriptor = _made(target, folder=folder)
    try:
        yield path
    finally:
        _remove(path)
        if descriptor is not None:
            os.close(descriptor)


def _made(target: Path, *, folder: bool) -> tuple[Path, int | None]:
    """A new one with its lock; another run may take it for a leftover before it is locked: then there is a next one."""
    while True:
        path = target.with_name(f".forcetorque-{uuid4().hex}.tmp")
        if folder:
            path.mkdir()
        else:
            path.touch(exist_ok=False)  # as any new file, not by `tempfile`, whose files nobody else may read
        if not _can_lock():
            return path, None
        with suppress(FileNotFoundError):
            descriptor = os.open(path, os.O_RDONLY)
            if _locked(descriptor) is not False and path.exists():
                return path, descriptor
            os.close(descriptor)


def _remove_leftovers(folder: Path) -> None:
    if not _can_lock():
        return
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if _NAME.fullmatch(entry.name):
                with suppress(OSError):  # somebody else's, or removed by another run meanwhile
                    _remove_unlocked(Path(entry.path))


def _remove_unlocked(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    try:
        if _locked(descriptor):
            _remove(path)
    finally:
        os.close(descriptor)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def _can_lock() -> bool:
    return sys.platform != "win32"


def _locked(descriptor: int) -> bool | None:
    """Take the lock; False if another run has it, None if the file system knows no locks."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True


@contextmanager
def new_folder(output: Path) -> Iterator[Path]:
    """Make a folder under a name that nobody has, and give it its own at the end.

    Args:
        output: Folder to make.

    Yields:
        Folder to write to; it is removed on any error, with the parents that it needed.

    Raises:
        ForceTorqueError: If the folder is there already.
    """
    refuse_existing(output)
    parents = [parent for parent in output.parents if not parent.exists()]
    output.parent.mkdir(parents=True, exist_ok=True)
    try:
        with temporary_beside(output, folder=True) as fresh:
            yield fresh
            fresh.rename(output)
    finally:
        with suppress(OSError):  # not empty: the folder is in it, or somebody else's
            for parent in parents:
                parent.rmdir()


def refuse_existing(output: Path, *, where: str = "") -> None:
    """Refuse a folder that is there already, before any work is done.

    Args:
        output: Folder to make.
        where: What the message says in front of its name, such as the option that names it.

    Raises:
        ForceTorqueError: If it is there.
    """
    if os.path.lexists(output):  # a link that leads nowhere is in the way too
        raise ForceTorqueError(f"{where}{output}: expected a new folder, it is there already")


def real_path(path: Path | str) -> Path:
    """Follow the symbolic links of a path, which need not exist.

    `Path.resolve` of Python 3.11 and 3.12 raises RuntimeError where links lead round in a circle. Here such a link
    stays as it is, and whoever opens it gets the OSError that says so.

    Args:
        path: Any path.

    Returns:
        The absolute path.
    """
    return Path(os.path.realpath(path))


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

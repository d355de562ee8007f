# SPDX-License-Identifier: BSD-3-Clause
"""A file or folder under a temporary name beside the one that it becomes; what a killed run left is removed."""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from uuid import uuid4

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

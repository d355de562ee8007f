# SPDX-License-Identifier: BSD-3-Clause
"""A folder that is made file by file under another name, and that a killed run leaves to be continued."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from forcetorque.base.errors import OutputError
from forcetorque.base.output_file import refuse_existing, write_bytes_atomically

if sys.platform != "win32":
    import fcntl

_JOURNAL = ".forcetorque"


class ResumableFolder:
    """The folder while it is made, and its journal: what was written of it by this run or an earlier one."""

    def __init__(self, folder: Path) -> None:
        """Take a folder that is locked for this run.

        Args:
            folder: The folder under its temporary name.
        """
        self.folder = folder
        self._journal = folder / _JOURNAL

    def entry(self, name: str) -> Any:
        """Give what the journal has of a file.

        Args:
            name: Path of the file below the folder.

        Returns:
            Content of its entry; None where the file was not written to its end.
        """
        file = self._entry_file(name)
        if not file.is_file() or not (self.folder / name).is_file():
            return None
        try:
            return json.loads(file.read_text(encoding="utf-8"))
        except ValueError:
            return None

    def written(self, name: str, content: Any) -> None:
        """Enter a file that was written to its end.

        Args:
            name: Path of the file below the folder.
            content: What is to be known of it later; JSON.
        """
        write_bytes_atomically(self._entry_file(name), json.dumps(content).encode())

    def _entry_file(self, name: str) -> Path:
        return self._journal / f"{name.replace('/', '+')}.json"

    def close(self) -> None:
        """Remove the journal."""
        shutil.rmtree(self._journal)


@contextmanager
def resumable_folder(output: Path, plan: Mapping[str, Any]) -> Iterator[ResumableFolder]:
    """Make a folder as `<name>.part`, and rename it at the end.

    On any error what was written stays, and a run with the same plan continues it.

    Args:
        output: Folder to make.
        plan: What it is made from and how; JSON.

    Yields:
        The folder.

    Raises:
        ForceTorqueError: If the output is there already.
        OutputError: If another run makes it, or what is there is of another plan.
    """
    refuse_existing(output)
    part = output.with_name(f"{output.name}.part")
    journal, file = part / _JOURNAL, part / _JOURNAL / "plan.json"
    text = json.dumps(plan, sort_keys=True)
    if part.exists() and any(part.iterdir()) and not file.is_file():
        raise OutputError(f"{part}: expected what an earlier run left of {output}, got another folder; move it away")
    journal.mkdir(parents=True, exist_ok=True)
    if file.is_file() and file.read_text(encoding="utf-8") != text:
        raise OutputError(
            f"{part}: expected what an earlier run with the same dataset and options left, got that of others; delete "
            "it to begin again"
        )
    lock = os.open(journal, os.O_RDONLY) if sys.platform != "win32" else None
    try:
        if lock is not None:
            _require_lock(lock, part)
        if not file.is_file():
            write_bytes_atomically(file, text.encode())
        folder = ResumableFolder(part)
        yield folder
        folder.close()
        part.rename(output)
    finally:
        if lock is not None:
            os.close(lock)


def _require_lock(descriptor: int, part: Path) -> None:
    if sys.platform != "win32":
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise OutputError(f"{part}: expected no other run that makes it, got one; wait for it") from None
        except OSError:  # a file system without locks
            pass


def link_or_copy(source: Path, target: Path, *, link: bool) -> None:
    """Copy a file, unless it is there already.

    Args:
        source: The file; of a symbolic link the file that it names.
        target: Its copy.
        link: Whether a second name of the same file will do, where the file system has such.
    """
    if target.is_file() and target.stat().st_size == source.stat().st_size:
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.unlink(missing_ok=True)
    if link:
        with suppress(OSError):
            os.link(os.path.realpath(source), target)
            return
    fresh = target.with_name(f"{target.name}.part")
    shutil.copyfile(source, fresh)
    fresh.replace(target)

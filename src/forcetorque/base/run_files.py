# SPDX-License-Identifier: BSD-3-Clause
"""Files that one run of a command reads and writes: none may be both."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path

from forcetorque.base.errors import OutputError

_Key = tuple[int, int]
"""Device and number of a file, which all its names share: links of both kinds, relative and absolute paths."""


@dataclass(frozen=True, slots=True)
class _RunFiles:
    inputs: dict[_Key, Path] = field(default_factory=dict)
    outputs: list[Path] = field(default_factory=list)

    def refuse_shared(self, outputs: Iterable[Path]) -> None:
        for output in outputs:
            if (source := self.inputs.get(_key(output) or (0, 0))) is not None:
                raise OutputError(
                    f"{output}: expected a file to write that is not read, got an input of this run ({source}); "
                    "choose another name"
                )


_RUN: ContextVar[_RunFiles | None] = ContextVar("forcetorque_run_files", default=None)


@contextmanager
def files_of_one_run() -> Iterator[None]:
    """Remember what is read and written in the body, which is one run of a command.

    Yields:
        Nothing.
    """
    token = _RUN.set(_RunFiles())
    try:
        yield
    finally:
        _RUN.reset(token)


def declare_input(path: Path | str) -> None:
    """Remember that a file is read; every reader calls this before it opens a file of the user.

    Outside of `files_of_one_run` nothing is remembered.

    Args:
        path: The file; of a folder, every file below it.

    Raises:
        OutputError: If it is to be written too.
    """
    run, source = _RUN.get(), Path(path)
    if run is None:
        return
    # a folder is only walked for a command that writes; it declares its outputs before it looks at a log
    for file in (source.rglob("*") if run.outputs else ()) if source.is_dir() else (source,):
        if (key := _key(file)) is not None:
            run.inputs.setdefault(key, file)
    run.refuse_shared(run.outputs)


def declare_output(path: Path) -> None:
    """Remember that a file will be written, so that reading it is refused from now on.

    Args:
        path: The file; it need not exist.

    Raises:
        OutputError: If it has been read, or another output leads to the same file.
    """
    run = _RUN.get()
    if run is None:
        return
    run.refuse_shared([path])
    if any(os.path.realpath(path) == os.path.realpath(other) for other in run.outputs):
        raise OutputError(f"{path}: expected a file for every output, got the same one twice; choose another name")
    run.outputs.append(path)


def is_declared_output(path: Path) -> bool:
    """Check whether a file is known to be written by this run.

    Args:
        path: The file.

    Returns:
        Whether `declare_output` was called for it.
    """
    run = _RUN.get()
    return run is not None and path in run.outputs


def refuse_input(path: Path) -> None:
    """Refuse to write over a file that this run has read: the last check, right before it is replaced.

    Args:
        path: File to write.

    Raises:
        OutputError: If it has been read.
    """
    run = _RUN.get()
    if run is not None:
        run.refuse_shared([path])


def _key(path: Path) -> _Key | None:
    """What identifies a regular file; None for what does not exist or is none, such as a pipe."""
    try:
        status = path.stat()
    except OSError:
        return None
    return (status.st_dev, status.st_ino) if stat.S_ISREG(status.st_mode) else None

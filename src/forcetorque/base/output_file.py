# SPDX-License-Identifier: BSD-3-Clause
"""Files and folders that are written as a whole or not at all, and which existing ones may be replaced."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import stat
import sys
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from uuid import uuid4

from forcetorque.base.errors import ForceTorqueError, MissingFileError, OutputError
from forcetorque.base.run_files import declare_output, is_declared_output, refuse_input

if sys.platform != "win32":
    import fcntl

_NAME = re.compile(r"\.forcetorque-[0-9a-f]{32}\.tmp")
_WAITING: ContextVar[tuple[ExitStack, dict[Path, Path]] | None] = ContextVar("forcetorque_waiting_files", default=None)
"""Temporary files that `existing_files_replaced_last` renames, by the file that each replaces."""


@contextmanager
def temporary_beside(target: Path, *, folder: bool = False) -> Iterator[Path]:
    """Make an empty file or folder beside a target, to be filled and renamed to it in the body.

    It is locked while it is there, so that runs distinguish what others still write from what a killed run left.
    Leftovers in the same folder are removed first. Where there are no such locks, nothing of others is removed.

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
            path.touch(exist_ok=False)  # as any new file, not by `tempfile`, whose files no other user may read
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
                with suppress(OSError):  # of another user, or removed by another run meanwhile
                    _remove_unlocked(Path(entry.path))


def _remove_unlocked(path: Path) -> None:
    if sys.platform == "win32":
        return
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
    """Take the lock; False if another run has it, None if the file system or the platform knows no locks."""
    if sys.platform != "win32":
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:
            return None
        return True
    return None


@contextmanager
def new_folder(output: Path) -> Iterator[Path]:
    """Make a folder under a temporary name, and rename it at the end.

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
        with suppress(OSError):  # not empty: the folder is in it, or another one
            for parent in parents:
                parent.rmdir()


def refuse_existing(output: Path, *, where: str = "") -> None:
    """Refuse a folder that is there already, before any work is done.

    Args:
        output: Folder to make.
        where: What the message has in front of its name, such as the option that names it.

    Raises:
        ForceTorqueError: If it is there.
    """
    if os.path.lexists(output):  # a link that leads nowhere is in the way too
        raise ForceTorqueError(f"{where}{output}: expected a new folder, it is there already")


def real_path(path: Path | str) -> Path:
    """Follow the symbolic links of a path, which need not exist.

    `Path.resolve` of Python 3.11 and 3.12 raises RuntimeError where links lead round in a circle. Here such a link
    stays as it is, and opening it raises the OSError that reports it.

    Args:
        path: Any path.

    Returns:
        The absolute path.
    """
    return Path(os.path.realpath(path))


def relative_path(path: Path, folder: Path) -> str:
    """Write a path as it is stated in a file of a folder.

    Args:
        path: Any path.
        folder: The folder.

    Returns:
        Relative, with `/`; absolute on another drive.
    """
    try:
        return Path(os.path.relpath(real_path(path), real_path(folder))).as_posix()
    except ValueError:  # on another drive
        return real_path(path).as_posix()


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
    with replaced_file(path) as temporary, temporary.open("wb") as stream:
        stream.write(data)
        stream.flush()
        # Otherwise a power cut after the rename can leave an empty file.
        os.fsync(stream.fileno())


@contextmanager
def replaced_file(path: Path) -> Iterator[Path]:
    """Give the path of a new file, in a folder of its own, which replaces another file at the end.

    In `existing_files_replaced_last` it replaces what is there at the end of that body.

    Args:
        path: File to write or to replace; a symbolic link keeps pointing to the file that it names.

    Yields:
        Its path; if the body fails, it is removed and the other one stays.

    Raises:
        OutputError: If the run of the command has read the file.
    """
    refuse_input(path)
    target, waiting = real_path(path), _WAITING.get()
    with ExitStack() as stack:
        # in a folder, which stays locked whatever the body puts in place of the file
        temporary = stack.enter_context(temporary_beside(target, folder=True)) / target.name
        yield temporary
        if waiting is None or not target.exists():
            temporary.replace(target)
        else:
            waiting[1][target] = temporary
            waiting[0].push(stack.pop_all())


@contextmanager
def existing_files_replaced_last() -> Iterator[None]:
    """Let files that are there keep their content until the end of the body, which may still read them.

    If the body fails, they stay; new files are there as soon as they are written.

    Yields:
        Nothing.

    Raises:
        OutputError: If one of them was read.
    """
    if _WAITING.get() is not None:
        yield
        return
    files: dict[Path, Path] = {}
    with ExitStack() as stack:
        token = _WAITING.set((stack, files))
        try:
            yield
        finally:
            _WAITING.reset(token)
        for target in files:
            refuse_input(target)
        for target, temporary in files.items():
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


_HEAD_BYTES = 4096
_PARQUET = b"PAR1"
_FOOTER_BYTES = 1 << 24
"""Largest footer of a Parquet file that is looked at; ours have a few hundred columns at most."""

_FIGURES = (b"\x89PNG\r\n\x1a\n", b"%PDF-")
_SVG = re.compile(rb"<svg.*Matplotlib v", re.DOTALL)
_HTML = re.compile(rb"\s*<!doctype html", re.IGNORECASE)
_MP4 = re.compile(rb"....ftyp", re.DOTALL)
_JSON = re.compile(rb'\s*\{\s*"schema"\s*:\s*"forcetorque/(?!recording/)')
_PARQUET_SCHEMA = re.compile(rb"forcetorque/(?!recording/)\w+/\d")
_TEXTS = (
    b"sensor,serial,component,unit,",
    b"sensor,serial,variable,unit,reference_value,",
    b"taxel,counts_below_rest,pressure_Pa,",
    b'"interval","stamp_ns","time_s"',
    b"# forcetorque ",
    b"; forcetorque ",
    b"! forcetorque ",
    b"<!-- forcetorque mjcf ",
)
"""Heads of our tables, and of the parameters of loads."""
_GROUPS = b"Corrections of force-torque sensors, f = S f_in + FT_OFFSET"
"""In the comment at the head of the groups for wholebodydynamics."""


def declare_outputs(*paths: Path | None, force: bool | None = None) -> None:
    """Refuse outputs of a command that cannot or must not be written, before anything is computed.

    From then on the run refuses to read them, so that no output is one of its inputs, however either is spelled.

    Args:
        paths: Files to write; `-` is standard output, None is none.
        force: Whether a file that another program made may be replaced, as `--force` allows; None without that option.

    Raises:
        OutputError: If a file is an input of the run, or was made by another program and `force` is not given.
    """
    for path in paths:
        if path is None or path == STANDARD_OUTPUT:
            continue
        refuse_unwritable(path)
        declare_output(path)
        _refuse_foreign(path, force=force)


def refuse_output(path: Path | str, *, inputs_sha256: Collection[str] = (), force: bool = False) -> None:
    """Refuse to replace a file that is an input of a result, or was made by another program.

    Args:
        path: File to write.
        inputs_sha256: SHA-256 in hex of the inputs of what is written.
        force: Whether a file that another program made may be replaced; an input never is.

    Raises:
        OutputError: If the file must not be replaced.
    """
    file = Path(path)
    if file == STANDARD_OUTPUT:
        return
    refuse_unwritable(file)
    if inputs_sha256 and file.is_file():
        with file.open("rb") as stream:
            if hashlib.file_digest(stream, "sha256").hexdigest() in inputs_sha256:
                raise OutputError(f"{file}: expected a file to write, got an input of the result; choose another name")
    if not is_declared_output(file):  # the command has checked it already
        _refuse_foreign(file, force=force)


def is_replaceable(path: Path) -> bool:
    """Check whether a file is a result or a figure, by its content.

    A URDF, an experiment file, a log, a recording, a mesh and a matrix file are none, whichever program wrote them.

    Args:
        path: A file that exists.

    Returns:
        Whether it is empty, a figure, a page, a document, a film, or carries the mark of a result of this library.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD_BYTES)
        if head.startswith(_PARQUET):
            return _is_table_of_results(stream.seek(0, os.SEEK_END), path)
    known = not head or head.startswith((*_FIGURES, *_TEXTS)) or _GROUPS in head or _SVG.search(head) is not None
    return known or any(mark.match(head) for mark in (_HTML, _MP4, _JSON))


def _is_table_of_results(size: int, path: Path) -> bool:
    with path.open("rb") as stream:
        stream.seek(max(size - 8, 0))
        length = int.from_bytes(stream.read(4), "little")
        if length > min(size - 8, _FOOTER_BYTES):
            return False
        stream.seek(size - 8 - length)
        footer = stream.read(length)
    return _PARQUET_SCHEMA.search(footer) is not None and b"forcetorque/recording/" not in footer


def _refuse_foreign(path: Path, *, force: bool | None) -> None:
    if force or not path.is_file() or is_replaceable(path):
        return
    forced = "" if force is None else "; unless it is an input, --force (force=True in Python) replaces it"
    raise OutputError(
        f"{path}: expected a new file, or a result or figure to replace, got another file that is there already; "
        f"choose another name{forced}"
    )

# SPDX-License-Identifier: BSD-3-Clause
"""Which files a command or a method may replace: results and figures, not inputs, not what somebody else made."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Collection
from pathlib import Path

from forcetorque.base.errors import OutputError
from forcetorque.base.files import STANDARD_OUTPUT, refuse_unwritable
from forcetorque.base.run_files import declare_output, is_declared_output

_HEAD_BYTES = 4096
_PARQUET = b"PAR1"
_FOOTER_BYTES = 1 << 24
"""Largest footer of a Parquet file that is looked at; ours have a few hundred columns at most."""

_FIGURES = (b"\x89PNG\r\n\x1a\n", b"%PDF-")
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
)
"""Heads of our tables, and of the parameters of loads."""
_GROUPS = b"Corrections of force-torque sensors, f = S f_in + FT_OFFSET"
"""In the comment at the head of the groups for wholebodydynamics."""


def declare_outputs(*paths: Path | None, force: bool | None = None) -> None:
    """Refuse outputs of a command that cannot or must not be written, before anything is computed.

    From then on the run refuses to read them, so that no output is one of its inputs, however either is spelled.

    Args:
        paths: Files to write; `-` is standard output, None is none.
        force: Whether a file that somebody else made may be replaced, as `--force` says; None without that option.

    Raises:
        OutputError: If a file is an input of the run, or was made by somebody else and `force` is not given.
    """
    for path in paths:
        if path is None or path == STANDARD_OUTPUT:
            continue
        refuse_unwritable(path)
        declare_output(path)
        _refuse_foreign(path, force=force)


def refuse_output(path: Path | str, *, inputs_sha256: Collection[str] = (), force: bool = False) -> None:
    """Refuse to replace a file that is an input of a result, or was made by somebody else.

    Args:
        path: File to write.
        inputs_sha256: SHA-256 in hex of the inputs of what is written.
        force: Whether a file that somebody else made may be replaced; an input never is.

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
    if not is_declared_output(file):  # the command has been asked already
        _refuse_foreign(file, force=force)


def is_replaceable(path: Path) -> bool:
    """Tell whether a file is a result or a figure, by its content.

    A URDF, an experiment file, a log, a recording, a mesh and a matrix file are none, whoever wrote them.

    Args:
        path: A file that exists.

    Returns:
        Whether it is empty, a figure, a page, a document, a film, or carries the mark of a result of this library.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD_BYTES)
        if head.startswith(_PARQUET):
            return _is_table_of_results(stream.seek(0, os.SEEK_END), path)
    known = not head or head.startswith((*_FIGURES, *_TEXTS)) or _GROUPS in head
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

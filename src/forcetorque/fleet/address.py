# SPDX-License-Identifier: BSD-3-Clause
"""Logs at addresses that fsspec reads, such as `s3://bucket/logs/monday`: they are copied while they are read."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

from forcetorque.base.errors import ChangingFileError, ExperimentError, MissingFileError, OutputError, needs_extra

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+://")  # two letters, beside drives


def is_address(text: str) -> bool:
    """Tell addresses from paths.

    Args:
        text: An address, a path, or a pattern of them.

    Returns:
        Whether it begins with a scheme such as `s3://`.
    """
    return _SCHEME.match(text) is not None


def require_path(text: str, where: str) -> None:
    """Refuse an address for what is written, or read in place.

    Args:
        text: What was named.
        where: File and key, and what it is for.

    Raises:
        OutputError: If it is an address.
    """
    found = re.match(r"([A-Za-z][A-Za-z0-9+.-]+:/)/?", text)  # pathlib makes one slash of two
    if found is not None:
        address = f"{found[1]}/{text[found.end() :]}"
        raise OutputError(f"{where}: expected a local or mounted folder, got the address {address!r}; mount it")


def addresses(pattern: str, where: str) -> list[str]:
    """Find the files and folders of a pattern.

    Args:
        pattern: Address with `*` in it, or without.
        where: What it is for, for messages.

    Returns:
        Their addresses, sorted.

    Raises:
        ExperimentError: If it cannot be read, or matches nothing.
    """
    fsspec = _fsspec()
    try:
        system, path = fsspec.core.url_to_fs(pattern)
        found = sorted(system.unstrip_protocol(one) for one in system.glob(path))
    except (OSError, ValueError, ImportError) as error:
        raise ExperimentError(f"{where}: expected an address that fsspec reads, got {pattern!r}: {error}") from error
    if not found:
        raise ExperimentError(f"{where}: expected logs that match {pattern!r}, there is none")
    return found


def sizes(address: str) -> list[tuple[str, int]]:
    """List the files at an address.

    Args:
        address: Address of a file or folder.

    Returns:
        Path and size in bytes of every file, sorted; none where it cannot be read.
    """
    try:
        system, path = _fsspec().core.url_to_fs(address)
        return _sizes(system, path)
    except (OSError, ValueError, ImportError):
        return []


def _sizes(system: Any, path: str) -> list[tuple[str, int]]:
    return sorted((name, int(info["size"] or 0)) for name, info in system.find(path, detail=True).items())


@contextmanager
def copied(address: str) -> Iterator[Path]:
    """Copy a log to this machine, for as long as it is read.

    Args:
        address: Address of a file or folder.

    Yields:
        The copy, in the folder for temporary files.

    Raises:
        MissingFileError: If it cannot be read.
        ChangingFileError: If it changes while it is copied.
    """
    fsspec = _fsspec()
    with tempfile.TemporaryDirectory() as folder:
        try:
            system, path = fsspec.core.url_to_fs(address)
            before = _sizes(system, path)
            local = Path(folder) / path.rstrip("/").rpartition("/")[2]
            system.get(path, str(local), recursive=system.isdir(path))
            after = _sizes(system, path)
        except (OSError, ValueError, ImportError) as error:
            raise MissingFileError(f"{address}: expected a log that fsspec reads, got {error!r}") from error
        if before != after or not before:
            raise ChangingFileError(
                f"{address}: expected a log that does not change while it is copied, its files did; add the recording "
                "when its log is complete"
            )
        yield local


def _fsspec() -> ModuleType:
    with needs_extra("addresses of logs need fsspec", "fleet"):
        import fsspec
    return fsspec

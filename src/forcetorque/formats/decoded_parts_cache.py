# SPDX-License-Identifier: BSD-3-Clause
"""Parts of logs that were decoded, kept while the same log is read for several purposes."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TypeVar

from forcetorque.base.output_file import real_path

_T = TypeVar("_T")
_Kept = dict[Hashable, tuple[Hashable, object]]
_KEPT: ContextVar[_Kept | None] = ContextVar("forcetorque_kept_parts", default=None)


@contextmanager
def parts_kept() -> Iterator[None]:
    """Keep what the body decodes until it ends, so that it is decoded once; inside another one that one keeps it.

    Yields:
        Nothing.
    """
    if _KEPT.get() is not None:
        yield
        return
    token = _KEPT.set({})
    try:
        yield
    finally:
        _KEPT.reset(token)


def are_kept() -> bool:
    """Check whether parts are kept: where they are not, they need not be in memory as a whole."""
    return _KEPT.get() is not None


def kept(log: Path, part: str, decode: Callable[[], _T]) -> _T:
    """Give a part of a log, decoded once inside `parts_kept` while its files do not change.

    Args:
        log: File or folder.
        part: Name of the part; of one log every name has one type.
        decode: Decodes it.

    Returns:
        The part, which nothing may change.
    """
    store = _KEPT.get()
    if store is None:
        return decode()
    key, state = (real_path(log), part), _state(log)
    known = store.get(key)
    if known is None or known[0] != state:
        known = store[key] = (state, decode())
    return known[1]  # type: ignore[return-value]  # what this part was decoded to


def _state(log: Path) -> Hashable:
    files = sorted(log.iterdir()) if log.is_dir() else [log]
    return tuple((file.name, file.stat().st_size, file.stat().st_mtime_ns) for file in files)

# SPDX-License-Identifier: BSD-3-Clause
"""What compiled functions share: a key for the copy on disk, a message when one is made, arrays of one kind.

Importing this loads the compiler, so only modules that are themselves imported when they are needed do.
"""

from __future__ import annotations

import hashlib
import logging
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from numba.core import event

_LOG = logging.getLogger(__name__)


def source_digest(*sources: Path) -> str:
    """Sum up the sources that a compiled function is made of.

    The copy on disk is looked up by the file of the function and by what the function closes over. A
    change in another file is noticed only if the function closes over this.

    Args:
        sources: Files, or folders of which every module counts.

    Returns:
        Digest of all of them.
    """
    digest = hashlib.sha256()
    for source in sources:
        for file in sorted(source.glob("*.py")) if source.is_dir() else [source]:
            digest.update(file.read_bytes())
    return digest.hexdigest()


class _Announce(event.Listener):
    """Logs a message when a compilation starts; a copy on disk starts none."""

    def __init__(self, message: str) -> None:
        self.message = message
        self.logged = False

    def on_start(self, event: Any) -> None:
        if not self.logged:
            _LOG.info(self.message)
            self.logged = True

    def on_end(self, event: Any) -> None:
        pass


def announced(message: str) -> AbstractContextManager[Any]:
    """Log a message, once, if anything is compiled inside the context."""
    return event.install_listener("numba:compile", _Announce(message))


def frozen(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Give a read-only, C-ordered view: every other kind of array would be compiled for by itself.

    Args:
        values: Any array.

    Returns:
        A view of it, or of a copy in C order.
    """
    view = np.ascontiguousarray(values).view(np.ndarray)
    view.flags.writeable = False
    return view

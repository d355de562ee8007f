# SPDX-License-Identifier: BSD-3-Clause
"""A folder of results that is there as a whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from forcetorque.errors import ForceTorqueError
from forcetorque.temporary import temporary_beside


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

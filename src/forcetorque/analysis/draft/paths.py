# SPDX-License-Identifier: BSD-3-Clause
"""Paths as an experiment file has them."""

from __future__ import annotations

import os
from pathlib import Path


def relative(path: Path, folder: Path) -> str:
    """Write a path as seen from the folder of the experiment file.

    Args:
        path: The path.
        folder: The folder.

    Returns:
        Relative, with `/`; absolute where nothing else leads there.
    """
    try:
        return Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return path.resolve().as_posix()

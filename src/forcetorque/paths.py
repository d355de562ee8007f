# SPDX-License-Identifier: BSD-3-Clause
"""Where a path leads."""

from __future__ import annotations

import os
from pathlib import Path


def real_path(path: Path | str) -> Path:
    """Follow the symbolic links of a path, which need not exist.

    `Path.resolve` of Python 3.11 and 3.12 raises RuntimeError where links lead round in a circle. Here such a link
    stays as it is, and whoever opens it gets the OSError that says so.

    Args:
        path: Any path.

    Returns:
        The absolute path.
    """
    return Path(os.path.realpath(path))

# SPDX-License-Identifier: BSD-3-Clause
"""Writing a file so that readers see the old content or the new, never a part."""

from __future__ import annotations

import os
from pathlib import Path
from uuid import uuid4

from forcetorque.errors import MissingFileError


def write_bytes_atomically(path: Path, data: bytes) -> None:
    """Write a file under a temporary name in the same folder, then rename it.

    If anything fails, the file keeps what it held before and the temporary one is removed.

    Args:
        path: File to write or to replace; a symbolic link keeps pointing to the file that it names.
        data: Its new content.

    Raises:
        MissingFileError: If the folder of the file does not exist.
    """
    target = path.resolve()
    if not target.parent.is_dir():
        raise MissingFileError(f"{path}: expected an existing folder to write to, got none; create {target.parent}")
    # Same folder, because a rename is atomic only within one file system. Opened like any new file,
    # not by `tempfile`, whose files nobody else may read.
    temporary = target.with_name(f".{uuid4().hex}.tmp")
    try:
        with temporary.open("xb") as stream:
            stream.write(data)
            stream.flush()
            # Otherwise a power cut after the rename can leave an empty file.
            os.fsync(stream.fileno())
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)

# SPDX-License-Identifier: BSD-3-Clause
"""Bags of ROS 2 in one MCAP file, written by rosbags."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from forcetorque.base.errors import needs_extra
from forcetorque.base.output_file import replaced_file


def typestore(path: Path) -> Any:
    """Give the types of messages of ROS 2.

    Args:
        path: File that they are needed for.

    Returns:
        Their store, of rosbags.

    Raises:
        MissingExtraError: If rosbags is not installed.
    """
    with needs_extra(f"{path}: MCAP is written by rosbags", "ros"):
        from rosbags.typesys import Stores, get_typestore
    return get_typestore(Stores.ROS2_HUMBLE)


@contextmanager
def mcap_writer(path: Path) -> Iterator[Any]:
    """Write a bag under a temporary name, and rename it at the end; on an error there is none.

    Args:
        path: File to write or to replace.

    Yields:
        The writer of rosbags.
    """
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    with replaced_file(path) as temporary:
        bag = temporary.with_suffix(".bag")
        writer = Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            yield writer
        next(bag.glob("*.mcap")).replace(temporary)

# SPDX-License-Identifier: BSD-3-Clause
"""Files that a scene is written to, by their ending: the page, or what another viewer opens."""

from __future__ import annotations

from pathlib import Path

from forcetorque.base.progress import Progress
from forcetorque.viewer.page import require_few_samples, write_page
from forcetorque.viewer.scene_builder import BuiltScene

RRD, MCAP = ".rrd", ".mcap"
"""Endings of recordings for Rerun, and of bags of ROS 2 for Foxglove and others."""


def view_files(path: Path | None) -> tuple[Path, ...]:
    """Name the files that a scene is written to, for the checks of outputs.

    Args:
        path: File of the scene; None for none.

    Returns:
        The file, and that of the layout for Foxglove beside a bag.
    """
    if path is None:
        return ()
    if path.suffix.lower() != MCAP:
        return (path,)
    from forcetorque.viewer.mcap_and_foxglove_files import layout_file

    return path, layout_file(path)


def require_writer(path: Path) -> None:
    """Check, before anything is computed, that what writes a file is installed.

    Args:
        path: The file.
    """
    if path.suffix.lower() == RRD:
        from forcetorque.viewer.rerun_file import imported_rerun

        imported_rerun(path)
    elif path.suffix.lower() == MCAP:
        from forcetorque.formats.ros.bag import typestore

        typestore(path)


def require_room(path: Path, samples: int) -> None:
    """Refuse a page of too many samples; what other viewers open takes any number.

    Args:
        path: File of the scene.
        samples: Number of samples.
    """
    if path.suffix.lower() not in (RRD, MCAP):
        require_few_samples(str(path), samples)


def write_view(path: Path, built: BuiltScene, progress: Progress = lambda _: None) -> int:
    """Write a scene as the ending of the file says: `.rrd`, `.mcap` with a layout beside it, else the page.

    Args:
        path: File to write or to replace.
        built: The scene.
        progress: As of `viewer.packing.packed`, for the page.

    Returns:
        Size of the file; bytes.
    """
    from forcetorque.viewer.viewer_log import viewer_log

    if path.suffix.lower() == RRD:
        from forcetorque.viewer.rerun_file import write_rrd

        return write_rrd(path, viewer_log(built))
    if path.suffix.lower() == MCAP:
        from forcetorque.viewer.mcap_and_foxglove_files import write_layout, write_mcap

        log = viewer_log(built)
        size = write_mcap(path, log)
        write_layout(path, log)
        return size
    return write_page(path, built, progress=progress)

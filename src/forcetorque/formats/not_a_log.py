# SPDX-License-Identifier: BSD-3-Clause
"""Files that go with a log, given in its place: what they are, and where they belong."""

from __future__ import annotations

from codecs import BOM_UTF8
from pathlib import Path

from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_xml
from forcetorque.formats.prior.registry import holds_prior

_LOOKED_AT = 4096


def not_a_log_reason(path: Path) -> str | None:
    """Report what a file is that is no log.

    Args:
        path: File or folder; it exists.

    Returns:
        What it is, and where it belongs; None if it is no robot and no calibration.
    """
    if not path.is_file():
        return None
    if _is_urdf(path):
        return f"{path}: expected a log, got the URDF of a robot: `forcetorque init LOG --urdf {path}`"
    if holds_prior(path):
        return (
            f"{path}: expected a log, got the calibration that a sensor came with: state it as prior of the sensor in "
            f"the file that `forcetorque init LOG` begins; `forcetorque inspect {path}` shows it"
        )
    return None


def _is_urdf(path: Path) -> bool:
    with path.open("rb") as file:
        begins = file.read(_LOOKED_AT)
    if not begins.removeprefix(BOM_UTF8).lstrip().startswith(b"<"):
        return False
    try:
        root = read_xml(path)
    except FormatError:
        return False
    return root is not None and root.tag == "robot"

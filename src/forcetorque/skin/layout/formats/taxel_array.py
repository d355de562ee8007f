# SPDX-License-Identifier: BSD-3-Clause
"""ROS messages TaxelArray, as JSON or as `rostopic echo` prints them: the neutral form of several skins."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.skin.layout.layout import PatchDescription

_SIGN = "centers_x"
_AXES = "xyz"


class TaxelArrayMessage:
    """`header.frame_id`, `link_names`, `centers_x/y/z` (m, in that frame) and `normals_x/y/z`, a number per taxel.

    A taxel is a column of the message. The message knows no modules and no thermal pads: the patch is one module.
    """

    sign = f"a TaxelArray with {_SIGN}"
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Whether the file has a field of the message."""
        return re.search(rf'^\s*\{{?\s*"?{_SIGN}"?\s*:', text, re.MULTILINE) is not None or f'"{_SIGN}"' in text

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read the first message of a file.

        Args:
            path: File; the patch is called like it.
            text: Its content.

        Returns:
            What it says.

        Raises:
            FormatError: If a field is missing or of another length, or the taxels are of several links.
        """
        message = _json(path, text) if text.lstrip().startswith("{") else _echo(text)
        centres, normals = _vectors(path, message, "centers"), _vectors(path, message, "normals")
        count = len(centres)
        if len(normals) not in (0, count):
            raise FormatError(f"{path}: normals: expected as many as there are centers, {count}, got {len(normals)}")
        links = sorted(set(map(str, _field(path, message, "link_names"))))
        if len(links) > 1:
            raise FormatError(
                f"{path}: link_names: expected the taxels of one link, which alone move together, got those of "
                f"{', '.join(links)}; write a file for each"
            )
        return PatchDescription(
            source=str(path),
            name=path.stem,
            frame=_frame(path, message),
            columns=count,
            lines=np.zeros(count, dtype=np.int64),
            taxels=np.arange(count),
            modules=np.zeros(count, dtype=np.int64),
            positions=centres,
            normals=normals if len(normals) else None,
            thermal_pads=np.empty(0, dtype=np.int64),
            thermal_modules=np.empty(0, dtype=np.int64),
        )


def _json(path: Path, text: str) -> dict[str, Any]:
    try:
        message = json.loads(text)
    except json.JSONDecodeError as error:
        raise FormatError(f"{path}:{error.lineno}: expected one message as JSON, got {error.msg}") from error
    header = message.get("header")
    return {**message, "frame_id": header.get("frame_id") if isinstance(header, dict) else None}


def _echo(text: str) -> dict[str, Any]:
    """Fields of the first message: lists in brackets or with a line per entry, and the frame of its header."""
    first = re.split(r"^---\s*$", text, maxsplit=1, flags=re.MULTILINE)[0]
    message: dict[str, Any] = {}
    for name, brackets, entries in re.findall(
        r"^(\w+):[ \t]*(?:\[([^\]]*)\]|((?:\n[ \t]*-[ \t]*\S+)+))", first, re.MULTILINE
    ):
        words = brackets.split(",") if brackets else re.findall(r"-[ \t]*(\S+)[ \t]*(?:\n|$)", entries)
        message[name] = [word.strip().strip("'\"") for word in words if word.strip()]
    frame = re.search(r"^[ \t]*frame_id:[ \t]*[\"']?([^\s\"']+)", first, re.MULTILINE)
    return {**message, "frame_id": frame[1] if frame else None}


def _field(path: Path, message: dict[str, Any], name: str) -> list[Any]:
    values = message.get(name)
    if not isinstance(values, list):
        raise FormatError(f"{path}: expected a list {name}, got {'none' if values is None else repr(values)}")
    return values


def _frame(path: Path, message: dict[str, Any]) -> str:
    if not message["frame_id"]:
        raise FormatError(f"{path}: header.frame_id: expected the frame of the centers, got none; write it")
    return str(message["frame_id"])


def _vectors(path: Path, message: dict[str, Any], name: str) -> FloatArray:
    """Three lists of numbers as vectors; shape (n, 3)."""
    lists = [_field(path, message, f"{name}_{axis}") for axis in _AXES]
    if len({len(values) for values in lists}) > 1:
        lengths = ", ".join(str(len(values)) for values in lists)
        raise FormatError(f"{path}: {name}: expected as many x as y and z, got {lengths}")
    vectors = np.array([[_number(path, name, k, value) for k, value in enumerate(values)] for values in lists])
    return vectors.reshape(len(_AXES), -1).T


def _number(path: Path, name: str, taxel: int, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise FormatError(f"{path}: {name} of taxel {taxel}: expected a finite number, got {value!r}")
    return number

# SPDX-License-Identifier: BSD-3-Clause
"""Keys of a `[recording]` table that are stated beside a log, by `--recording KEY=VALUE`."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from forcetorque.base.errors import FormatError
from forcetorque.formats.log_format import LogDescription, LogFormat, SpecifiableFormat
from forcetorque.formats.registry import format_name, log_formats

_OF_LOG = ("format", "path")


def specified_keys(entries: Iterable[str]) -> dict[str, object]:
    """Read keys and values.

    Args:
        entries: Each as `payload_kg=0` or `origin_from=surface`: a value of TOML, of which a word needs no quotes.

    Returns:
        Values by key.

    Raises:
        FormatError: If one is of another form, or of what the log itself says.
    """
    values: dict[str, object] = {}
    for entry in entries:
        key, equals, text = (part.strip() for part in entry.partition("="))
        if not (equals and key.isidentifier() and text):
            raise FormatError(f"--recording: expected KEY=VALUE, as moment_about=flange, got {entry!r}")
        if key in _OF_LOG:
            raise FormatError(f"--recording: expected keys that the log lacks, got {key}, which is the log's")
        try:
            values[key] = tomllib.loads(f"value = {text}")["value"]
        except tomllib.TOMLDecodeError:
            values[key] = text
    return values


def description_of(known: LogFormat[Any], path: Path, specified: Mapping[str, object]) -> LogDescription:
    """Read a log without an experiment file.

    Args:
        known: Its format.
        path: File or folder that is recognised.
        specified: What is stated beside it.

    Returns:
        As of `describe` of the format.

    Raises:
        FormatError: If something is stated of a format that leaves no key open.
    """
    if not specified:
        return known.describe(path)
    if not isinstance(known, SpecifiableFormat):
        names = " or ".join(format_name(one) for one in log_formats() if isinstance(one, SpecifiableFormat))
        raise FormatError(
            f"{path}: --recording: expected a log whose format leaves keys open ({names}), got a log of the format "
            f"{format_name(known)}; leave the option out, and state what it asks in the experiment file"
        )
    return known.describe_specified(path, specified)

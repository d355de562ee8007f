# SPDX-License-Identifier: BSD-3-Clause
"""What a capability is to the rest of the library: its page, commands, and sections of the experiment file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module

import forcetorque


@dataclass(frozen=True, slots=True, kw_only=True)
class Capability:
    """A folder of the library; everything is named as `module:name` and imported when it is first needed."""

    page: str
    """Page of the documentation, below `docs`, that begins with it."""
    commands: tuple[str, ...] = ()
    """Functions of the command line, or groups of them, under the name that they have there."""
    sections: tuple[str, ...] = ()
    """Sections of the experiment file."""
    needs: tuple[str, ...] = ()
    """Capabilities that its modules import."""


def capabilities() -> tuple[Capability, ...]:
    """Give the capabilities of the library.

    Returns:
        `CAPABILITY` of every folder that `forcetorque.CAPABILITIES` names, in that order.
    """
    return tuple(import_module(f"forcetorque.{name}").CAPABILITY for name in forcetorque.CAPABILITIES)


def all_named(kind: str) -> Iterator[tuple[str, str]]:
    """Go through what all capabilities name.

    Args:
        kind: `commands` or `sections`.

    Yields:
        Name and reference, in the order of the capabilities.
    """
    for capability in capabilities():
        for reference in getattr(capability, kind):
            yield reference.partition(":")[2], reference

# SPDX-License-Identifier: BSD-3-Clause
"""The toy command and the toy group, added as docs/architecture.md says: `tests/toys/command`, `tests/toys/group`."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import forcetorque

TOY = Path(__file__).parents[1] / "toys" / "command"
NAME = "extent"
TOY_GROUP = TOY.with_name("group")
GROUP = "toy"
GROUP_COMMAND = "toy count"


@contextmanager
def added_command(folder: Path = TOY) -> Iterator[None]:
    """Its folder in the library, and its line in the tuple of capabilities."""
    with added_folder(folder, NAME):
        yield


@contextmanager
def added_group(folder: Path = TOY_GROUP) -> Iterator[None]:
    """Its folder in the library, and its line in the tuple of capabilities."""
    with added_folder(folder, GROUP):
        yield


@contextmanager
def added_folder(folder: Path, name: str) -> Iterator[None]:
    """A capability in a folder beside those of the library; what is added meanwhile goes with it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(forcetorque, "__path__", [*forcetorque.__path__, str(folder)])
        # what the import leaves behind in the package goes with the rest
        patch.setattr(forcetorque, name, None, raising=False)
        patch.setattr(forcetorque, "CAPABILITIES", (*forcetorque.CAPABILITIES, name))
        try:
            yield
        finally:
            for module in [known for known in sys.modules if known.split(".")[:2] == ["forcetorque", name]]:
                del sys.modules[module]

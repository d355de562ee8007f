# SPDX-License-Identifier: BSD-3-Clause
"""Scenario files that come with the library."""

from __future__ import annotations

from pathlib import Path

from forcetorque.errors import ForceTorqueError, known_names

_FOLDER = Path(__file__).parents[1] / "scenarios"


def bundled_scenario(name: str) -> Path:
    """Find a scenario file that comes with the library.

    Args:
        name: Its name, such as `icub-insitu`.

    Returns:
        The file.

    Raises:
        ForceTorqueError: If there is none of that name.
    """
    known = [file.stem for file in _FOLDER.glob("*.toml")]
    if name not in known:
        raise ForceTorqueError(f"no scenario is called {name!r}; {known_names(name, known)}; or give a .toml file")
    return _FOLDER / f"{name}.toml"

# SPDX-License-Identifier: BSD-3-Clause
"""Artificial skin: layout, taxels and their calibration, temperature, contacts and their wrenches."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.skin.commands import (
        calibrate_skin as calibrate_skin,
        check_skin as check_skin,
        skin_wrench as skin_wrench,
    )
    from forcetorque.skin.taxels.calibrate import read_patches as read_patches

CAPABILITY = Capability(
    page="skin/layout.md",
    needs=("simulation",),
    commands=("forcetorque.skin.commands:skin",),
    sections=("forcetorque.skin.section:PATCHES",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    calibrate_skin="forcetorque.skin.commands",
    check_skin="forcetorque.skin.commands",
    read_patches="forcetorque.skin.taxels.calibrate",
    skin_wrench="forcetorque.skin.commands",
)

# SPDX-License-Identifier: BSD-3-Clause
"""Force plates: who or what stands on them, and their calibration with a pole or weights."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.plates.commands import fit_plate as fit_plate, plate as plate

CAPABILITY = Capability(
    page="guides/plates.md",
    needs=("inspection", "workbench"),
    commands=("forcetorque.plates.commands:plate", "forcetorque.plates.commands:fit_plate"),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    fit_plate="forcetorque.plates.commands",
    plate="forcetorque.plates.commands",
)

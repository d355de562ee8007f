# SPDX-License-Identifier: BSD-3-Clause
"""Force plates: who or what stands on them."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.plates.commands import plate

CAPABILITY = Capability(
    page="guides/plates.md",
    commands=("forcetorque.plates.commands:plate",),
)

__all__ = ["plate"]

__getattr__, __dir__ = lazy_names(__name__, {"plate": "forcetorque.plates.commands"})

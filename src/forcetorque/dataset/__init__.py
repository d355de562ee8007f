# SPDX-License-Identifier: BSD-3-Clause
"""Datasets for learning: forces examined over all episodes, and a compensated wrench added to every frame."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.dataset.commands import check_dataset as check_dataset, compensate_dataset as compensate_dataset

CAPABILITY = Capability(
    page="dataset.md",
    needs=("inspection", "payload"),
    commands=(
        "forcetorque.dataset.commands:check_dataset",
        "forcetorque.dataset.commands:compensate_dataset",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    check_dataset="forcetorque.dataset.commands",
    compensate_dataset="forcetorque.dataset.commands",
)

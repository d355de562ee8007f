# SPDX-License-Identifier: BSD-3-Clause
"""Many recordings of many robots: one idempotent step per recording, and a dataset of what it gives."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.fleet.commands import (
        fleet_add as fleet_add,
        fleet_report as fleet_report,
        fleet_run as fleet_run,
        fleet_table as fleet_table,
    )
    from forcetorque.fleet.parquet_dataset import Dataset as Dataset

CAPABILITY = Capability(
    page="fleet.md",
    needs=("calibration", "evaluation", "inspection"),
    commands=("forcetorque.fleet.commands:fleet",),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Dataset="forcetorque.fleet.parquet_dataset",
    fleet_add="forcetorque.fleet.commands",
    fleet_report="forcetorque.fleet.commands",
    fleet_run="forcetorque.fleet.commands",
    fleet_table="forcetorque.fleet.commands",
)

# SPDX-License-Identifier: BSD-3-Clause
"""What tests of datasets share: recordings are added without a look for faults, which takes half of the time."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="package", autouse=True)
def without_inspection() -> Iterator[None]:
    """Find nothing in recordings; pictures of commands and processes have what `inspect` finds."""
    with pytest.MonkeyPatch.context() as patch:
        for module in ("fleet.sensor_record", "calibration.interval_and_mount_doubts"):
            patch.setattr(f"forcetorque.{module}.inspect_experiment", lambda experiment, **_: ())
        yield

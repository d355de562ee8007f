# SPDX-License-Identifier: BSD-3-Clause
"""What tests of datasets share: recordings are added without a look for faults, which takes half of the time."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="package", autouse=True)
def without_inspection() -> Iterator[None]:
    """Find nothing in recordings; pictures of commands and processes have what `inspect` finds."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("forcetorque.fleet.sensor_record.inspect_experiment", lambda experiment, **_: ())
        yield

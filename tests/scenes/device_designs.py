# SPDX-License-Identifier: BSD-3-Clause
"""A device whose motion is hardly optimised."""

from __future__ import annotations

from functools import partial

import pytest

from forcetorque.device.excitation_and_predicted_errors import device_span


def hardly_optimise(patch: pytest.MonkeyPatch) -> None:
    """Try few changes of the better motion of a device: a thousand take seconds, and change its numbers alone.

    Args:
        patch: What takes it back.
    """
    patch.setattr("forcetorque.device.design.device_span", partial(device_span, swaps=5))

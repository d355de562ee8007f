# SPDX-License-Identifier: BSD-3-Clause
"""Messages that say nothing are refused by their row, once for all who read messages."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.taxels.taxel_faults import require_counts

MESSAGES = np.full((5, 3), 240.0)


def test_messages_with_counts_pass() -> None:
    """Also where one number of them is zero."""
    require_counts(MESSAGES * [1.0, 0.0, 1.0])
    require_counts(MESSAGES[0])


def test_zeros_and_gaps_are_refused() -> None:
    """By the row where they come from, and how many there are; one message by itself has no row."""
    messages = MESSAGES.copy()
    messages[[1, 3]] = 0.0
    with pytest.raises(SkinError, match=r"^row 1: expected counts, got a message of zeros \(2 such of 5\): .*leave it"):
        require_counts(messages)
    messages[3, 1] = np.nan
    rows = np.array([10, 11, 12, 13, 14])
    with pytest.raises(SkinError, match=r"^row 11 of 'skin': expected counts, got a message of zeros or with gaps"):
        require_counts(messages, where="'skin'", rows=rows)
    with pytest.raises(SkinError, match=r"^patch 'palm': expected counts, got a message of zeros \(1 such of 1\)"):
        require_counts(np.zeros(3), where="patch 'palm'")

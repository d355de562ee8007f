# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of figures share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from matplotlib.figure import Figure

from tests.report.drawing import recorded_figures


@pytest.fixture
def drawn() -> Iterator[list[Figure]]:
    """Figures that were made so far during the test, not drawn, so that what is in them can be asked."""
    with recorded_figures() as figures:
        yield figures

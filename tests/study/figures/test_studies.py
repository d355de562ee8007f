# SPDX-License-Identifier: BSD-3-Clause
"""The figure of studies: what is drawn as best is the least of what is drawn."""

from __future__ import annotations

import numpy as np

from tests.study.drawn_figures import UNDETERMINED, draw_studies


def test_nothing_that_may_not_be_chosen_is_drawn() -> None:
    """Of each sensor and offset the best is the leftmost candidate; undetermined ones and the workbench are none."""
    (panel, *_) = draw_studies(np.random.default_rng(3)).axes
    ticks = [np.asarray(line.get_xdata(), dtype=float) for line in panel.lines if line.get_marker() == "|"]
    best = [float(container.lines[0].get_xdata()[0]) for container in panel.containers]
    assert [len(forces) for forces in ticks] == [60 - UNDETERMINED] * 4
    assert set(map(min, ticks)) <= set(best)
    assert len(set(map(min, ticks))) == 4

# SPDX-License-Identifier: BSD-3-Clause
"""Requirement 1 of the device: in no direction of load less excitation than the workbench has."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.exsitu.bench import Placement
from forcetorque.exsitu.load_table import THESIS_TABLE, read_loads
from forcetorque.exsitu.span import load_sizes
from forcetorque.exsitu.uncertain_loads import UncertainLoads
from forcetorque.spatial import MeasureDirection


def workbench_loads(placement: Placement, samples: int) -> UncertainLoads:
    """Give the loads of the 24 positions of the thesis' workbench.

    Args:
        placement: How exactly weights are placed.
        samples: Samples of all positions together.

    Returns:
        The loads.
    """
    table = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.CHILD_TO_PARENT)
    return UncertainLoads.of_bench(table, placement, samples=samples)


def least_excitation(loads: UncertainLoads, others: UncertainLoads) -> float:
    """Compare what loads excite, sample by sample, with what others do.

    The covariance of a matrix by noise alone is the inverse of the second moment of its loads about their mean, so that
    the ratio of both in the direction in which it is least tells whether any direction is known worse.

    Args:
        loads: Loads.
        others: Loads that span six directions.

    Returns:
        Least ratio of the spread of the loads to that of the others, over all directions; 0 where one is not spanned.
    """
    size = load_sizes(others.wrench)
    root = np.linalg.cholesky(_moment(others, size))
    half = np.linalg.solve(root, _moment(loads, size))
    ratios = np.linalg.eigvalsh(np.linalg.solve(root, half.T))
    return float(np.sqrt(max(ratios[0], 0.0)))


def _moment(loads: UncertainLoads, size: FloatArray) -> FloatArray:
    scaled = loads.wrench / size
    moved = scaled - np.average(scaled, axis=0, weights=loads.count)
    moment: FloatArray = (loads.count[:, None] * moved).T @ moved / loads.count.sum()
    return moment

# SPDX-License-Identifier: BSD-3-Clause
"""Random poses and six-vectors for property tests, singular cases among them."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import settings, strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from forcetorque.base.pose import make_pose

REPEATABLE = settings(derandomize=True, deadline=None)
"""The same examples in every run, however slow the machine."""

LARGEST = 100.0
"""Bound of components of wrenches and twists: the range of a robot's sensors; N, N m, m/s, rad/s."""

FARTHEST = 10.0
"""Bound of components of positions; m."""

_ROTATION_VECTORS = st.one_of(
    arrays(np.float64, 3, elements=st.floats(-np.pi, np.pi)),
    st.sampled_from(
        [
            [0.0, 0.0, 0.0],
            [1e-9, 0.0, 0.0],
            [np.pi, 0.0, 0.0],
            [0.0, np.pi - 1e-9, 0.0],
            [0.0, 0.0, -np.pi / 2],
        ]
    ),
)


def vectors(length: int, bound: float) -> st.SearchStrategy[Any]:
    """Vectors with components within a bound, zero and tiny ones among them."""
    return arrays(np.float64, length, elements=st.floats(-bound, bound))


def rotations() -> st.SearchStrategy[Any]:
    """Rotation matrices, with no, tiny, half and nearly half turns among them."""
    return _ROTATION_VECTORS.map(lambda vector: Rotation.from_rotvec(vector).as_matrix())


def poses() -> st.SearchStrategy[Any]:
    """Poses within the farthest position."""
    return st.builds(make_pose, rotations(), vectors(3, FARTHEST))


def six_vectors() -> st.SearchStrategy[Any]:
    """Wrenches or twists."""
    return vectors(6, LARGEST)

# SPDX-License-Identifier: BSD-3-Clause
"""Memory of one thread: rows of lanes for everything that a block computes on the way."""

from typing import NamedTuple

import numpy as np
from numba import njit

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.block.lanes import DRIVER, STRIDE


class Scratch(NamedTuple):
    """Rows of lanes; one body, contact or sensor per line."""

    q: FloatArray
    dq: FloatArray
    ddq: FloatArray
    cosine: FloatArray
    sine: FloatArray
    motion: FloatArray
    wrench: FloatArray  # of every body, summed up inside sub-models
    expected: FloatArray  # the same, summed up over the whole robot; if both are asked for
    readout: FloatArray  # expected readings
    known: FloatArray  # wrenches of known contacts
    reading: FloatArray  # of the measured sensors, on the outboard part, in the frame of the cut
    residue: FloatArray  # what sub-models outboard leave, on every body
    contact: FloatArray  # unknown wrenches
    torque: FloatArray
    columns: FloatArray  # of the equation of one sub-model
    solution: FloatArray
    right: FloatArray
    work: FloatArray
    carried: FloatArray  # one wrench on its way
    active: FloatArray
    rank: FloatArray
    condition: FloatArray
    gap: FloatArray  # zero where all results so far are finite


@njit(**DRIVER)
def make_scratch(coordinates, bodies, both, leaving, expected, known, sensors, contacts, unknowns, torques):
    """Scratch for so many of each."""
    return Scratch(
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates, STRIDE)),
        np.zeros((coordinates + 1, 9 * STRIDE)),
        np.zeros((bodies, 6 * STRIDE)),
        np.zeros((both, 6 * STRIDE)),
        np.zeros((expected, 6 * STRIDE)),
        np.zeros((known, 6 * STRIDE)),
        np.zeros((sensors, 6 * STRIDE)),
        np.zeros((leaving, 6 * STRIDE)),
        np.zeros((contacts, 6 * STRIDE)),
        np.zeros((torques, STRIDE)),
        np.zeros((unknowns, 6 * STRIDE)),
        np.zeros((unknowns, STRIDE)),
        np.zeros(6 * STRIDE),
        np.zeros((8, STRIDE)),
        np.zeros(6 * STRIDE),
        np.ones((contacts, STRIDE)),
        np.zeros(STRIDE),
        np.zeros(STRIDE),
        np.zeros(STRIDE),
    )

# SPDX-License-Identifier: BSD-3-Clause
"""How wrong a workbench matrix is once the sensor is mounted, set before anything is fitted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FormatError
from forcetorque.simulation.matrix_error import matrix_error, mounted_matrix
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

_LEAST_SHARE = 1e-6
"""A drawn error below this share of the wanted one is rounding and no mounting."""


def workbench_errors(workbench: FloatArray, mounted: FloatArray, changes: Sequence[FloatArray]) -> FloatArray:
    """Give what a workbench matrix gets wrong on a mounted sensor that has no other fault.

    Args:
        workbench: Matrix of the workbench; shape (6, 6); N/count, N m/count.
        mounted: True matrix; shape (6, 6); N/count, N m/count.
        changes: Changes of the true wrench of every recording since the offset was taken; shapes (n, 6); N, N m.

    Returns:
        Measured minus true wrenches of all recordings; shape (sum of n, 6); N, N m.
    """
    errors: FloatArray = np.concatenate(list(changes)) @ matrix_error(workbench, mounted).T
    return errors


def mounted_with_error(
    workbench: FloatArray, mounted: FloatArray, changes: Sequence[FloatArray], *, mean_absolute: Any
) -> FloatArray:
    """Scale what mounting did to a sensor until its workbench matrix errs by as much as is wanted.

    A true wrench w is read as `(1 + E) w`, where `1 + E = workbench mounted^-1`. Every row of E is
    scaled, so each component of the error keeps its course in time and changes in size only. This is
    exact, because true loads do not depend on the sensor.

    Args:
        workbench: Matrix of the workbench; shape (6, 6); N/count, N m/count.
        mounted: True matrix as drawn; shape (6, 6); N/count, N m/count.
        changes: Changes of the true wrench of every recording over which the error is taken, since its offset was
            taken; shapes (n, 6); N, N m.
        mean_absolute: Mean absolute error of every component, as `workbench_errors` has it; shape (6,); N, N m.

    Returns:
        True matrix with that error; shape (6, 6); N/count, N m/count.

    Raises:
        FormatError: If there is nothing to scale in a component, or no mounting can do so much.
    """
    wanted = read_only(mean_absolute, name="mean_absolute", shape=(6,))
    drawn = np.abs(workbench_errors(workbench, mounted, changes)).mean(axis=0)
    for name, unit, want, have in zip(WRENCH_COMPONENTS, WRENCH_UNITS, wanted, drawn, strict=True):
        if have < _LEAST_SHARE * want:
            raise FormatError(
                f"workbench_error: expected an error of {want:g} {unit} in {name}, but mounting as drawn gives none "
                "that could be scaled; set mounting_spread or uneven screws, and recordings that load the sensor"
            )
    scale = np.divide(wanted, drawn, out=np.zeros(6), where=wanted > 0.0)
    error = scale[:, None] * matrix_error(workbench, mounted)
    where = f"workbench_error: expected what mounting can do, got mean errors {wanted.tolist()} (N, N m)"
    return mounted_matrix(where, workbench, error)

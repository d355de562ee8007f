# SPDX-License-Identifier: BSD-3-Clause
"""Cosine and sine without a branch or a call, so that loops over lanes stay vectorised.

The angle is reduced to a quarter turn with pi/2 in three parts [1]; the rest are the polynomials of
fdlibm for |r| <= pi/4 [2]. One unit in the last place up to |x| = 1e6.

References:
    [1] W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980.
    [2] fdlibm, k_sin.c and k_cos.c, Sun Microsystems, 1993 (freely granted).
"""

import numpy as np
from numba import njit

from forcetorque.robot.block.lanes import FORMULA


@njit(**FORMULA)
def cosine_sine(x):
    """Cosine and sine of x."""
    # math.floor would give an integer, for which there is no vector instruction before AVX-512
    quarters = np.floor(x * 0.6366197723675814 + 0.5)
    r = x - quarters * 1.5707963267341256
    r = r - quarters * 6.077100506303966e-11
    r = r - quarters * 2.0222662487959506e-21
    z = r * r
    s = 1.58969099521155010221e-10
    s = -2.50507602534068634195e-08 + z * s
    s = 2.75573137070700676789e-06 + z * s
    s = -1.98412698298579493134e-04 + z * s
    s = 8.33333333332248946124e-03 + z * s
    s = r + r * z * (-1.66666666666666324348e-01 + z * s)
    c = -1.13596475577881948265e-11
    c = 2.08757232129817482790e-09 + z * c
    c = -2.75573143513906633035e-07 + z * c
    c = 2.48015872894767294178e-05 + z * c
    c = -1.38888888888741095749e-03 + z * c
    c = 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * c)
    quarter = quarters - 4.0 * np.floor(quarters * 0.25)
    odd = (quarter == 1.0) | (quarter == 3.0)
    cosine = s if odd else c
    sine = c if odd else s
    return (
        -cosine if (quarter == 1.0) | (quarter == 2.0) else cosine,
        -sine if quarter >= 2.0 else sine,
    )

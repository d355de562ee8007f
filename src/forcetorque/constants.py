# SPDX-License-Identifier: BSD-3-Clause
"""Constants, each once and with its source."""

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s2 (3rd CGPM, 1901)."""

VACUUM_PERMITTIVITY = 8.8541878188e-12
"""Electric constant, F/m (CODATA 2022)."""

NORMAL_95 = 1.959963984540054
"""Standard deviations of half a 95 % interval of a normal distribution, its 0.975 quantile (`scipy.special.ndtri`)."""

MAD_TO_DEVIATION = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation, 1 / `ndtri(0.75)`, to five digits."""

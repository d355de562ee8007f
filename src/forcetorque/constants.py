# SPDX-License-Identifier: BSD-3-Clause
"""Constants, each once and with its source."""

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s2 (3rd CGPM, 1901)."""

VACUUM_PERMITTIVITY = 8.8541878188e-12
"""Electric constant, F/m (CODATA 2022)."""

NORMAL_95 = 1.959963984540054
"""Standard deviations of half a 95 % interval of a normal distribution, its 0.975 quantile (`scipy.special.ndtri`)."""

# SPDX-License-Identifier: BSD-3-Clause
"""Physical constants, each once and with its source."""

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of free fall, m/s2 (3rd CGPM, 1901)."""

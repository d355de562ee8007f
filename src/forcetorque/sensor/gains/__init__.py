# SPDX-License-Identifier: BSD-3-Clause
"""How a sensor uses its range, and which amplifier gains would use it better."""

# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of sensors, skin and motors, and their errors."""

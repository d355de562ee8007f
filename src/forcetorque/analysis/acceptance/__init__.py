# SPDX-License-Identifier: BSD-3-Clause
"""What was measured of sensors, against the limits of an acceptance file."""

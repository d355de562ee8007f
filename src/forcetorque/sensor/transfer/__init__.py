# SPDX-License-Identifier: BSD-3-Clause
"""Transfer functions of one channel: fit, predict, inverse, and which kind to take."""

# SPDX-License-Identifier: BSD-3-Clause
"""From counts of taxels to pressure: working taxels, their curves, and the errors of these."""

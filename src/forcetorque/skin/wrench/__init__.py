# SPDX-License-Identifier: BSD-3-Clause
"""From the pressures of taxels to a wrench on the link: one linear operator for each mask of working taxels."""

# SPDX-License-Identifier: BSD-3-Clause
"""Simulated recordings as experiments on disk, with the truth of their sensors."""

# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations that a sensor came with: matrices of makers, boards and papers, each form a file."""

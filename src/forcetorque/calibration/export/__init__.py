# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations in the files of robots and other programs."""

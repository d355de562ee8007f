# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations on data that was not fitted: errors against what mechanics demands."""

# SPDX-License-Identifier: BSD-3-Clause
"""Drift of a sensor with temperature at a constant load."""

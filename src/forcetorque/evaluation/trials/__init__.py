# SPDX-License-Identifier: BSD-3-Clause
"""Spheres of many sensors, mounting conditions and trials."""

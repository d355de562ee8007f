# SPDX-License-Identifier: BSD-3-Clause
"""Estimation with covariances: of measurements, of known wrenches, and of tangential forces of contacts."""

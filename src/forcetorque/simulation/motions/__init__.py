# SPDX-License-Identifier: BSD-3-Clause
"""Motions of robots with exact derivatives: the data sets of in situ calibration, and contact switching."""

# SPDX-License-Identifier: BSD-3-Clause
"""Drift of a sensor with its temperature."""

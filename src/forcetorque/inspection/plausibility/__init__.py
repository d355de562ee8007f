# SPDX-License-Identifier: BSD-3-Clause
"""Plausibility checks before any fit: data that cannot come from a sensor under the modelled load are refused."""

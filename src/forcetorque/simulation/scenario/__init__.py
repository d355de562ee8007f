# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios: files that specify what is simulated, and their recordings."""

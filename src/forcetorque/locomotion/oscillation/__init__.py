# SPDX-License-Identifier: BSD-3-Clause
"""Oscillations of a signal with intervals, settling after a step, tracking of a target."""

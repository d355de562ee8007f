# SPDX-License-Identifier: BSD-3-Clause
"""Measured numbers of sensors against the limits of an acceptance file."""

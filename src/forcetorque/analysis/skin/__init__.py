# SPDX-License-Identifier: BSD-3-Clause
"""Patches of tactile skin."""

# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin of an experiment."""

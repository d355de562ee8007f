# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on skin as known wrenches of an estimation."""

# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on a patch of skin: clusters of taxels, position, wrench, identity over time."""

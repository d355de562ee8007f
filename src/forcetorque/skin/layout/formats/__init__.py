# SPDX-License-Identifier: BSD-3-Clause
"""Layouts of skin in the formats of others."""

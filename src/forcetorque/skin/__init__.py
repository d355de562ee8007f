# SPDX-License-Identifier: BSD-3-Clause
"""Artificial skin: where its taxels are, the surface that they lie on, and what they say about contacts."""

# SPDX-License-Identifier: BSD-3-Clause
"""Simulated skin: objects of known weight on a smooth surface, and what the taxels of a patch read of them."""

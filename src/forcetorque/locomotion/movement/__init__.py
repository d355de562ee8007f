# SPDX-License-Identifier: BSD-3-Clause
"""How a robot moves: whether it oscillates, how long it settles, how well it tracks (thesis 8.3)."""

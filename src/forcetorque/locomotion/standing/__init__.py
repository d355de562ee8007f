# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stands: which feet carry it, where their pressure is centred, where its centre of mass is."""

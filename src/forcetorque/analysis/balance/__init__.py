# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stands."""

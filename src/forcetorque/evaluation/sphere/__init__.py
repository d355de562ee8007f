# SPDX-License-Identifier: BSD-3-Clause
"""The sphere that gravity draws in the space of forces, and the ellipsoid that a sensor makes of it."""

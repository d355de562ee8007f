# SPDX-License-Identifier: BSD-3-Clause
"""C3D files of motion capture, with the wrenches of force plates and the positions of markers."""

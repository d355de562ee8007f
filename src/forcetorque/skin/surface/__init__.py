# SPDX-License-Identifier: BSD-3-Clause
"""The surface that the taxels of a patch lie on: triangles between them, their normals, and the strip around them."""

# SPDX-License-Identifier: BSD-3-Clause
"""The fits of the thesis: regularised regression towards a prior matrix, lambda on held-out blocks."""

# SPDX-License-Identifier: BSD-3-Clause
"""White noise, slow noise, and what they leave of means, regressions and comparisons."""

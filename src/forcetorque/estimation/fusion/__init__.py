# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of several sources, each with its covariance, combined into one."""

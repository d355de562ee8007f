# SPDX-License-Identifier: BSD-3-Clause
"""The default estimator: the load causes the reading, and the prior is a distribution."""

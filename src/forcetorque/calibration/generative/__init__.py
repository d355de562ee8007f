# SPDX-License-Identifier: BSD-3-Clause
"""The default estimator: the load causes the measurement, and the prior is a distribution of sensors."""

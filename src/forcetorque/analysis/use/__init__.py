# SPDX-License-Identifier: BSD-3-Clause
"""Which calibrations may be used for the loads to come."""

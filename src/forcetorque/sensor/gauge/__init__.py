# SPDX-License-Identifier: BSD-3-Clause
"""From strain, displacement or force to an electrical or optical signal (thesis 1.3)."""

# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is computed of the sensors of one experiment, for a report."""

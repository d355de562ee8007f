# SPDX-License-Identifier: BSD-3-Clause
"""Everything that can be said about the sensors of one experiment."""

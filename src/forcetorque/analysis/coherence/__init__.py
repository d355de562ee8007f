# SPDX-License-Identifier: BSD-3-Clause
"""Whether the forces of all contacts together bear the weight."""

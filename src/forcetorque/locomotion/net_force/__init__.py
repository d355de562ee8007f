# SPDX-License-Identifier: BSD-3-Clause
"""Whether the forces of all contacts together carry the weight (thesis 5.6, Tables 5.9, 5.10)."""

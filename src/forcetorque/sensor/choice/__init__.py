# SPDX-License-Identifier: BSD-3-Clause
"""Which sensor holds stated loads, and what each sensing principle makes of them."""

# SPDX-License-Identifier: BSD-3-Clause
"""Where the taxels of a patch are, and what may be wrong with that."""

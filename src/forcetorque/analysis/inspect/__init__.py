# SPDX-License-Identifier: BSD-3-Clause
"""What a log holds, and what is wrong with it."""

# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers, as text, Parquet, Arrow or a data frame, with a declared meaning of every column."""

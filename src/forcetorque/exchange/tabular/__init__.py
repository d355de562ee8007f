# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers as text, with a declared meaning of every column."""

from forcetorque.exchange.tabular.layout import StampColumn, TableLayout, TableSignal
from forcetorque.exchange.tabular.table import read_table

__all__ = ["StampColumn", "TableLayout", "TableSignal", "read_table"]

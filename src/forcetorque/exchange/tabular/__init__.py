# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers, as text, Parquet or a data frame, with a declared meaning of every column."""

from forcetorque.exchange.tabular.dates import ISO8601
from forcetorque.exchange.tabular.layout import EvenRows, StampColumn, StampUnit, TableLayout, TableSignal
from forcetorque.exchange.tabular.table import read_frame, read_table

__all__ = ["ISO8601", "EvenRows", "StampColumn", "StampUnit", "TableLayout", "TableSignal", "read_frame", "read_table"]

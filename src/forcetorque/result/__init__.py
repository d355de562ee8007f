# SPDX-License-Identifier: BSD-3-Clause
"""The one form of every answer: rows whose fields say unit and digits, and all that is shown made from them."""

from forcetorque.result.cells import finite_or_none, interval, number, with_error
from forcetorque.result.html import html_table, html_warnings
from forcetorque.result.names import short_names
from forcetorque.result.quantity_text import NO_BREAK, with_joined_units
from forcetorque.result.registry import result_classes
from forcetorque.result.result import Result
from forcetorque.result.row import AxisValues, FloatOrNull, Row, Values, WrenchValues
from forcetorque.result.shown import COMPONENTS, Shown, ShownWrench
from forcetorque.result.table import Table, table_of, with_first_column
from forcetorque.result.text import table_text, wrapped
from forcetorque.result.unusable import UnusableSamples
from forcetorque.result.vague import VAGUE_WORDS, without_vague

__all__ = [
    "NO_BREAK",
    "COMPONENTS",
    "VAGUE_WORDS",
    "AxisValues",
    "FloatOrNull",
    "Result",
    "Row",
    "Shown",
    "ShownWrench",
    "Table",
    "UnusableSamples",
    "Values",
    "WrenchValues",
    "finite_or_none",
    "html_table",
    "html_warnings",
    "interval",
    "number",
    "result_classes",
    "short_names",
    "table_of",
    "table_text",
    "with_error",
    "with_first_column",
    "with_joined_units",
    "without_vague",
    "wrapped",
]

# SPDX-License-Identifier: BSD-3-Clause
"""Decimal numbers as files write them: what `float` takes besides, such as `nan`, `inf` and `1_000`, is none."""

import re

DECIMAL_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
"""Digits with or without sign, fraction and exponent, to be matched as a whole."""

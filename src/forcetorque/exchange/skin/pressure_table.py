# SPDX-License-Identifier: BSD-3-Clause
"""Tables of pressure as text, for robots that have no Python: a line for each taxel and count."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from forcetorque.atomic import write_bytes_atomically
from forcetorque.skin import PressureTable

HEADINGS = ("taxel", "counts_below_rest", "pressure_Pa", "beyond_range")
"""Columns of the text."""


def write_pressure_table(path: Path | str, table: PressureTable) -> None:
    """Write the tables of all live taxels as CSV; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder.
        table: The tables.
    """
    text = io.StringIO()
    text.write(",".join(HEADINGS) + "\n")
    for k in np.flatnonzero(table.live):
        for fall, pressure in enumerate(table.values[:, k].tolist()):
            text.write(f"{table.taxels[k]},{fall},{pressure:.6g},{int(fall > table.range_counts[k])}\n")
    write_bytes_atomically(Path(path), text.getvalue().encode())

# SPDX-License-Identifier: BSD-3-Clause
"""The form of a recording on disk, as JSON: files, columns, units and clocks."""

from __future__ import annotations

from typing import Any

from forcetorque.recording.quantity import QUANTITIES, Labels
from forcetorque.recording.storage import INDEX_FILE, SCHEMA

_LABELS = {
    Labels.FIXED: "as listed",
    Labels.JOINTS: "one per joint, named as in the robot model",
    Labels.CHANNELS: "one per channel, in the order of the electronics",
    Labels.TAXELS: "one per number in a message of skin, in its order",
}


def recording_schema() -> dict[str, Any]:
    """Describe the folder of a recording.

    Returns:
        Description with stable keys.
    """
    return {
        "schema": SCHEMA,
        "index": INDEX_FILE,
        "clocks": "every stream names the clock that stamped it; only streams of one clock are combined; "
        "second 0 of an interval is the earliest stamp over all streams",
        "stream_file": {
            "stamp_ns": "int64, ns since the epoch of the clock, in the order of the log",
            "sequence": "int64, counter of the sender; absent where there is none",
            "QUANTITY": "fixed-size list of float64, one entry per column; NaN where a value is missing",
        },
        "quantities": {
            quantity.name: {
                "columns": list(quantity.columns) or _LABELS[quantity.labels],
                "units": list(quantity.units)
                if quantity.labels is Labels.FIXED
                else {"one per column out of": list(quantity.units) or "any"},
                "frame": "named" if quantity.has_frame else "none",
                "description": quantity.description,
            }
            for quantity in QUANTITIES.values()
        },
    }

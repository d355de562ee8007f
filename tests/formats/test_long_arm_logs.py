# SPDX-License-Identifier: BSD-3-Clause
"""Logs of arms that are read some rows at a time, into temporary files, are those that are read as a whole."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base import rows_on_disk
from forcetorque.base.errors import FormatError
from forcetorque.formats.franka.log_format import FrankaFormat
from forcetorque.formats.log_format import LogDescription
from forcetorque.formats.ur_rtde import recorded_fields
from forcetorque.formats.ur_rtde.log_format import UrRtdeFormat
from tests.cases import some_cases
from tests.formats.franka.states import states, write_states, write_table
from tests.formats.ur_rtde.recordings import Tool, accelerometer, recorded, write_binary, write_text
from tests.payload.simulated_ur5 import about_tcp, simulated

ROUNDING = 1e-9
"""N, N m, rad and m of some tens, whose sums have another order."""
_UR, _FRANKA = UrRtdeFormat(), FrankaFormat()


def _repeated() -> dict[str, Any]:
    """Every row twice, as recorders faster than the controller write, with two payloads and an accelerometer."""
    columns = recorded(Tool(), samples=5, declared=((0.3, (0.0, 0.0, 0.02)), (0.6, (0.0, 0.01, 0.03))))
    felt = accelerometer(columns, up=np.array([0.0, 0.0, 9.81]))
    columns |= {f"actual_tool_accelerometer_{k}": column for k, column in enumerate(felt.T)}
    return {name: np.repeat(values, 2) for name, values in columns.items()}


_LOGS: dict[str, Callable[[Path], LogDescription]] = {
    "text": lambda path: _UR.describe(write_text(path, _repeated())),
    "binary": lambda path: _UR.describe(write_binary(path, _repeated())),
    "point by motion": lambda path: _UR.describe_specified(
        write_binary(path, about_tcp(simulated(701, declared_shares=(0.0,))).columns), {"moment_about": "flange"}
    ),
    "states": lambda path: _FRANKA.describe(write_states(path, states(declared=0.2, poses=6, samples=9))),
    "table": lambda path: _FRANKA.describe(write_table(path, states(poses=6, samples=9))),
}


def _in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rows_on_disk, "_FEW_ROWS", 47)
    monkeypatch.setattr(recorded_fields, "_BLOCK_ROWS", 31)
    monkeypatch.setattr(rows_on_disk, "IN_MEMORY", 1)
    monkeypatch.setattr(rows_on_disk, "_WITHOUT_FILE", 0)


@some_cases("log", sorted(_LOGS, key="point by motion".__eq__), quick=4)
def test_blocks_change_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, log: str) -> None:
    """Streams, findings, loads, motions and contradictions, while the arrays are views of files."""
    whole = _LOGS[log](tmp_path / "log")
    _in_blocks(monkeypatch)
    blocks = _LOGS[log](tmp_path / "log")
    assert blocks.table.model_dump_json() == whole.table.model_dump_json()
    assert blocks.reading.findings == whole.reading.findings
    compared = 0
    for one, other in zip(blocks.reading.streams, whole.reading.streams, strict=True):
        assert np.array_equal(one.stamp_ns, other.stamp_ns)
        assert one.signals.keys() == other.signals.keys()
        for name, signal in one.signals.items():
            assert rows_on_disk._pages_of(signal.values) is not None
            np.testing.assert_allclose(signal.values, other.signals[name].values, rtol=0, atol=ROUNDING)
            compared += 1
    assert compared > 2
    if whole.wrist is None or blocks.wrist is None:
        assert (whole.wrist, blocks.wrist, log) == (None, None, "table")
        return
    assert [(one.start_ns, one.mass) for one in blocks.wrist.declared] == [
        (one.start_ns, one.mass) for one in whole.wrist.declared
    ]
    assert blocks.wrist.moving == whole.wrist.moving
    assert blocks.wrist.assumed == whole.wrist.assumed
    assert blocks.wrist.contradictions == whole.wrist.contradictions
    assert bool(whole.wrist.contradictions) is (log == "point by motion")


def test_a_fault_is_named_by_its_row_in_the_log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not by that in its block."""
    _in_blocks(monkeypatch)
    columns = recorded(Tool(), samples=5)
    columns["actual_q_3"][40] = np.inf
    with pytest.raises(FormatError, match=r"row 41: actual_q_3: expected a finite number"):
        _UR.describe(write_binary(tmp_path / "log", columns))
    made = states(poses=6, samples=9)
    made[40]["O_T_EE"] = [2.0 * value if k < 3 else value for k, value in enumerate(made[40]["O_T_EE"])]
    with pytest.raises(FormatError, match=r"state 41: O_T_EE: expected a rotation"):
        _FRANKA.describe(write_states(tmp_path / "states", made))

# SPDX-License-Identifier: BSD-3-Clause
"""What to hang next on a bench."""

from __future__ import annotations

from collections.abc import Sequence

from forcetorque.analysis.workbench.bench_recording import BenchRecording
from forcetorque.analysis.workbench.rows import BlockRow
from forcetorque.exsitu import BenchLoads


def next_words(recording: BenchRecording, blocks: Sequence[BlockRow]) -> str | None:
    """Say what to record next.

    Args:
        recording: What was recorded so far.
        blocks: Its blocks as they were checked.

    Returns:
        A sentence; None where everything is there and sound, or where means were recorded elsewhere.
    """
    if recording.recorded == () and recording.bench is not None:
        return None
    last = {row.position: row for row in blocks}
    wanted = [name for name in recording.loads.names if name not in recording.left_out]
    for name in wanted:
        if name not in last:
            done = sum(row.sound for row in last.values())
            return f"next: {_words(recording.loads, name)}; {done} of {len(wanted)} positions are there and sound"
    again = [row for row in last.values() if not row.sound]
    if again:
        return f"again: {_words(recording.loads, again[0].position)}: {again[0].findings[0]}"
    return f"all {len(wanted)} positions are there and sound"


def _words(loads: BenchLoads, name: str) -> str:
    place = loads.names.index(name)
    weights = loads.weights
    if weights is None:
        return f"position {name}"
    x, y, z = 1e3 * weights.position_m[place]
    structure = weights.structure_kg[place]
    beside = f" and the structure of {structure:g} kg" if structure else ""
    direction = ", ".join(f"{entry:.3g}" for entry in weights.direction[place])
    return (
        f"position {name} ({loads.series[place]}): {weights.mass_kg[place]:g} kg{beside} at "
        f"({x:.4g}, {y:.4g}, {z:.4g}) mm, gravity along ({direction}) of the sensor"
    )

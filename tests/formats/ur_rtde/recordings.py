# SPDX-License-Identifier: BSD-3-Clause
"""A simulated arm with a tool of known mass, recorded as RTDE recorders write.

`python -m tests.formats.ur_rtde.recordings` writes the recording that the guide to wrist sensors reads.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray

GUIDE = Path(__file__).resolve().parents[3] / "docs" / "tutorial" / "ur_recording.csv"
GRAVITY = 9.80665
RATE_HZ = 125.0
TCP_OFFSET = np.array([0.01, 0.0, 0.15, 0.0, 0.0, 1.2])


@dataclass(frozen=True, kw_only=True)
class Tool:
    """Truth of a recording."""

    mass: float = 1.25
    centre: FloatArray = field(default_factory=lambda: np.array([0.012, -0.008, 0.061]))
    zero: FloatArray = field(default_factory=lambda: np.array([0.8, -0.5, 1.1, 0.02, -0.03, 0.01]))
    """Zero error along the axes of the flange."""


def recorded(
    tool: Tool,
    *,
    poses: int = 12,
    samples: int = 20,
    declared: tuple[tuple[float, tuple[float, float, float]], ...] = ((0.0, (0.0, 0.0, 0.0)),),
    about_tcp: bool = False,
    noise: float = 0.05,
    seed: int = 1,
    raw: bool = True,
) -> dict[str, FloatArray]:
    """Give the columns of a recording of poses at rest, with declared loads that follow each other."""
    rng = np.random.default_rng(seed)
    base_R_flange = Rotation.random(poses, random_state=seed)
    repeated = np.repeat(np.arange(poses), samples)
    turned = base_R_flange[repeated]
    position = rng.uniform(-0.5, 0.5, (poses, 3))[repeated]
    offset_turn = Rotation.from_rotvec(TCP_OFFSET[3:])
    weight = tool.mass * turned.inv().apply([0.0, 0.0, -GRAVITY])
    load = np.hstack([weight, np.cross(tool.centre, weight)])
    load += rng.normal(size=(len(repeated), 6)) * noise * np.array([1, 1, 1, 0.08, 0.08, 0.08])
    part = np.arange(len(repeated)) * len(declared) // len(repeated)
    mass = np.array([one[0] for one in declared])[part]
    cog = np.array([one[1] for one in declared])[part]
    known = mass[:, None] * turned.inv().apply([0.0, 0.0, -GRAVITY])
    # each payload that is set zeroes the reading
    reading = load - np.hstack([known, np.cross(cog, known)]) + tool.zero * (1.0 + part[:, None])
    moment = reading[:, 3:] - (np.cross(TCP_OFFSET[:3], reading[:, :3]) if about_tcp else 0.0)
    columns: dict[str, FloatArray] = {"timestamp": 1234.5 + np.arange(len(repeated)) / RATE_HZ}

    def add(name: str, values: FloatArray) -> None:
        columns.update({f"{name}_{k}": column for k, column in enumerate(values.T)})

    add("actual_q", np.tile(np.linspace(-1.0, 1.0, 6), (len(repeated), 1)))
    add("actual_TCP_pose", np.hstack([position + turned.apply(TCP_OFFSET[:3]), (turned * offset_turn).as_rotvec()]))
    add("actual_TCP_force", np.hstack([turned.apply(reading[:, :3]), turned.apply(moment)]))
    if raw:
        add("ft_raw_wrench", load + [3.0, -2.0, 5.0, 0.1, 0.2, -0.1])
    add("tcp_offset", np.tile(TCP_OFFSET, (len(repeated), 1)))
    columns["payload"] = mass
    add("payload_cog", cog)
    return columns


def accelerometer(columns: dict[str, FloatArray], *, up: FloatArray) -> FloatArray:
    """What an accelerometer along the axes of the flange reads at rest; shape (n, 3)."""
    tcp, offset = (
        Rotation.from_rotvec(np.column_stack([columns[f"{name}_{k}"] for k in (3, 4, 5)]))
        for name in ("actual_TCP_pose", "tcp_offset")
    )
    felt: FloatArray = (tcp * offset.inv()).inv().apply(up)
    return felt


def recording_text(columns: dict[str, FloatArray], *, delimiter: str = " ") -> str:
    """As record.py with blanks and full precision, or startFileRecording with commas and six decimals."""
    form = "{!r}" if delimiter == " " else "{:.6f}"
    rows = zip(*columns.values(), strict=True)
    lines = [delimiter.join(columns), *(delimiter.join(form.format(float(value)) for value in row) for row in rows)]
    return "\n".join(lines) + "\n"


def guide_text() -> str:
    """The recording of the guide: 14 poses of 4 rows, a payload of 0.4 kg that the controller subtracts."""
    columns = recorded(Tool(), poses=14, samples=4, declared=((0.4, (0.0, 0.0, 0.04)),), seed=7)
    return recording_text({name: values for name, values in columns.items() if "actual_q" not in name}, delimiter=",")


def write_text(path: Path, columns: dict[str, FloatArray], *, delimiter: str = " ") -> Path:
    """Write `recording_text`."""
    path.write_text(recording_text(columns, delimiter=delimiter), encoding="ascii")
    return path


def write_binary(path: Path, columns: dict[str, FloatArray]) -> Path:
    """As record.py --binary: names, types, then rows without padding, high byte first; with a state of four bytes."""
    names, types = [*columns, "runtime_state"], ["DOUBLE"] * len(columns) + ["UINT32"]
    rows = np.zeros(len(columns["timestamp"]), dtype=[*((name, ">f8") for name in columns), ("runtime_state", ">u4")])
    for name, values in columns.items():
        rows[name] = values
    path.write_bytes(f"{' '.join(names)}\n{' '.join(types)}\n".encode() + rows.tobytes())
    return path


if __name__ == "__main__":
    GUIDE.write_text(guide_text(), encoding="ascii")

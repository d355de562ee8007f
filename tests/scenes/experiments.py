# SPDX-License-Identifier: BSD-3-Clause
"""A small complete experiment of the simulated arm, for tests that damage one thing and look what is said."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.icub_matrix import encode_matrix, read_matrix_file, write_matrix_file
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.simulation.simulated_sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
from forcetorque.simulation.trace import simulate_recording
from tests.scenes.robots import joint_xml, link_xml

DURATION_S, RATE_HZ = 24.0, 50.0
JOINTS = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist")
OFFSET = np.array([8.0, -5.0, 20.0, 0.3, -0.2, 0.1])
FACTORY = y_shaped_matrix(arm_m=0.02, counts_per_newton=25.0)
"""Matrix before mounting; the priors are this, rounded to the sensor's 16 bits."""
MOUNTED = distorted_by_mounting(FACTORY, relative=0.05, rng=np.random.default_rng(7))
"""True matrix."""

PARQUET, YARP, TWO = "parquet.toml", "yarp.toml", "two.toml"
"""The arm's sensor with raw counts in the project's own form; the same as logs of two ports; both sensors."""
FT_LOG, ARM_LOG = "log/arm_ft/analog:o/data.log", "log/arm/stateExt:o/data.log"

_TOOL = (link_xml("tool", mass=0.5, xyz="0.03 0 -0.05"), joint_xml("tool_joint", "hand", "tool", xyz="0 0 -0.1"))
"""Something in the hand, at a fixed joint that carries no sensor tag."""

_HEAD = 'schema = "forcetorque/experiment/1"\nname = "small arm"\n\n[robot]\nurdf = "arm.urdf"\ntolerance = "exact"\n'
_PARQUET = '\n[recording]\nformat = "parquet"\npath = "recording"\n'
_YARP = f"""
[recording]
format = "yarp"
path = "log"

[[recording.stream]]
kind = "analog"
name = "arm_ft"
port = "arm_ft/analog:o"

[[recording.stream]]
kind = "state_ext"
name = "joints"
port = "arm/stateExt:o"
joints = [{", ".join(f'"{joint}"' for joint in JOINTS)}]
"""
_REST = """
[[sensor]]
name = "arm_ft"
stream = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "fit"
start_s = 0.5
end_s = 14.0
use = "calibration"
support = "base"

[[interval]]
label = "judge"
start_s = 14.5
end_s = 23.5
use = "validation"
support = "base"
"""
SECOND_SENSOR = """
[[sensor]]
name = "tool_ft"
stream = "tool_ft"
serial = "SIM/002"
prior = "matrix_SIM002.txt"
joint = "tool_joint"
measure_direction = "parent_to_child"
"""
TEXTS = {PARQUET: _HEAD + _PARQUET + _REST, YARP: _HEAD + _YARP + _REST, TWO: _HEAD + _PARQUET + _REST + SECOND_SENSOR}


def write_experiments(folder: Path) -> None:
    """Write the arm, the priors of its sensors, one recording in two forms, and the experiment files."""
    urdf = ARM_URDF.read_text(encoding="utf-8").replace("</robot>", "\n".join([*_TOOL, "</robot>"]))
    (folder / "arm.urdf").write_text(urdf, encoding="utf-8")
    sensor = SimulatedSensor(matrix=MOUNTED, offset=OFFSET, noise_counts=4.0)
    recording = simulate_recording(
        read_urdf(folder / "arm.urdf").with_sensor(
            "tool_ft", joint="tool_joint", direction=MeasureDirection.PARENT_TO_CHILD
        ),
        {"arm_ft": sensor, "tool_ft": sensor},
        support="base",
        gravity_direction=[0.0, 0.0, -1.0],
        ranges=dict.fromkeys(JOINTS, (-2.2, 2.2)),
        duration_s=DURATION_S,
        rate_hz=RATE_HZ,
        slowest_hz=0.12,
        seed=11,
    )
    for serial in ("SIM001", "SIM002"):
        write_matrix_file(folder / f"matrix_{serial}.txt", encode_matrix(FACTORY))
    write_recording(folder / "recording", recording)
    _write_yarp_log(folder, recording, read_matrix_file(folder / "matrix_SIM001.txt").matrix)
    for name, text in TEXTS.items():
        (folder / name).write_text(text, encoding="utf-8")


def _write_yarp_log(folder: Path, recording: Recording, prior: FloatArray) -> None:
    """Write what yarpdatadumper would have: wrenches made with the prior, joints in degrees."""
    raw, joints = recording.streams["arm_ft"], recording.streams["joints"]
    wrenches = raw.signals["raw"].values @ prior.T
    degrees = np.rad2deg(joints.signals["position"].values)
    _write_port(folder / FT_LOG, raw.stamp_ns.tolist(), [_words(row) for row in wrenches])
    zeros, modes = _list(np.zeros(len(JOINTS))), _list(np.full(len(JOINTS), 7.0))
    rest = " ".join(8 * [zeros] + 2 * [modes])  # velocity and acceleration are not estimated by this board
    _write_port(folder / ARM_LOG, joints.stamp_ns.tolist(), [f"{_list(row)} {rest}" for row in degrees])


def _write_port(log: Path, stamps: list[int], messages: list[str]) -> None:
    log.parent.mkdir(parents=True)
    lines = [
        f"{k} {stamp // 10**9}.{stamp % 10**9:09d} {message}\n"
        for k, (stamp, message) in enumerate(zip(stamps, messages, strict=True))
    ]
    log.write_text("".join(lines), encoding="ascii")
    (log.parent / "info.log").write_text("Type: Bottle;\nStamp: tx;\n", encoding="ascii")


def _words(values: FloatArray) -> str:
    return " ".join(f"{value:.12g}" for value in values)


def _list(values: FloatArray) -> str:
    return f"({_words(values)}) [ok]"


def holed(recording: Recording, name: str, start_s: float, end_s: float) -> Recording:
    """Give the recording with a gap of some seconds in the raw counts of one stream."""
    stream = recording.stream(name)
    signal = stream.signal("raw")
    seconds = (stream.stamp_ns - recording.start_ns) * 1e-9
    values = np.where(((seconds >= start_s) & (seconds < end_s))[:, None], np.nan, signal.values)
    broken = replace(stream, signals={**stream.signals, "raw": replace(signal, values=values)})
    return replace(recording, streams={**recording.streams, name: broken})


def edit(file: Path, old: str, new: str) -> Path:
    """Replace a text that stands in a file exactly once, and give the file back."""
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
    file.write_text(text.replace(old, new), encoding="utf-8")
    return file


def add(file: Path, text: str) -> Path:
    """Append a text to a file and give the file back."""
    with file.open("a", encoding="utf-8") as stream:
        stream.write(text)
    return file


def write_sharing(folder: Path, use: str) -> tuple[str, str]:
    """Write two files of one log: `first` uses 9.5 s of it, `second` 2 s of these and 6 s of others."""
    head = (folder / PARQUET).read_text(encoding="utf-8").split("\n[[interval]]")[0]
    names = ("first.toml", "second.toml")
    for file, spans in zip(names, ([(0.5, 10.0)], [(2.0, 4.0), (11.0, 17.0)]), strict=True):
        text = head.replace('name = "small arm"', f'name = "{file.removesuffix(".toml")}"')
        for k, (start, end) in enumerate(spans):
            text += f'\n[[interval]]\nlabel = "part {k}"\nstart_s = {start}\nend_s = {end}\n'
            text += f'use = "{use}"\nsupport = "base"\n'
        (folder / file).write_text(text, encoding="utf-8")
    return names


def edit_lines(file: Path, change: Callable[[list[str]], list[str]]) -> Path:
    """Rewrite a file by its lines, each with its end, and give the file back."""
    lines = file.read_bytes().decode().splitlines(keepends=True)
    changed = change(list(lines))
    assert changed != lines
    file.write_bytes("".join(changed).encode())
    return file


def edit_line(file: Path, number: int, change: Callable[[str], str]) -> Path:
    """Rewrite one line of a file, counted from 1, and give the file back."""
    return edit_lines(file, lambda lines: [*lines[: number - 1], change(lines[number - 1]), *lines[number:]])


def snapshot(folder: Path) -> dict[str, str]:
    """Give every file and folder below a folder with the hash of its content, temporary files included."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "/"
        for path in folder.rglob("*")
    }

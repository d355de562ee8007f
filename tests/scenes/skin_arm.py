# SPDX-License-Identifier: BSD-3-Clause
"""The small experiment of the arm with a patch of skin on its forearm and the contacts of a skinManager beside it."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.formats.yarp.skin_ports import COLUMNS, UNITS
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.taxels.calibrate import calibrate_skin
from tests.scenes.experiments import PARQUET, add
from tests.scenes.touched import write_touched

SKIN = "skin.toml"
PATCH, EVENTS, LINK = "shank", "hand_events", "forearm"
EVENT_S = (2.0, 8.0)
"""Seconds between which the skinManager sees a contact."""
EVENT = (7.0, 0.01, 0.02, 0.03, -0.5, 0.25, -0.125, 0.01, 0.02, 0.03, 1.0, 0.0, 0.0, 3.0, 3.5, np.nan)
"""What it sees, as its messages have it."""
_TEXT = f"""
[[patch]]
name = "{PATCH}"
serial = "S1"
counts = "counts"
layout = "shank.csv"
link = "{LINK}"
table = "shank.json"
"""


def write_skin_arm(intact: Path, folder: Path) -> Sequence[ContactTruth]:
    """Copy the small experiment and put skin on its arm; give what the objects on it truly do."""
    shutil.copytree(intact, folder, dirs_exist_ok=True)
    truths = write_touched(folder)
    fitted = calibrate_skin([folder / "bag.toml"], code_version="1", created="2020-01-01")
    fitted.calibration.save(folder / "shank.json")
    arm, touched = read_recording(folder / "recording"), read_recording(folder / "touched")
    counts = touched.stream("counts")
    clock, stamps = arm.stream("arm_ft").clock, counts.stamp_ns - counts.stamp_ns[0] + arm.start_ns
    streams = (replace(counts, clock=clock, stamp_ns=stamps), _events(clock, stamps))
    both = {**arm.streams, **{stream.name: stream for stream in streams}}
    write_recording(folder / "recording", Recording(streams=both))
    text = (folder / PARQUET).read_text(encoding="utf-8")
    (folder / SKIN).write_text(text, encoding="utf-8")
    add(folder / SKIN, _TEXT)
    return truths


def _events(clock: str, stamp_ns: IntArray) -> Stream:
    seconds = (stamp_ns - stamp_ns[0]) * 1e-9
    values: FloatArray = np.full((len(stamp_ns), len(COLUMNS)), np.nan)
    values[(seconds >= EVENT_S[0]) & (seconds < EVENT_S[1])] = EVENT
    columns = tuple(f"1.{name}" for name in COLUMNS)
    signal = Signal(quantity="skin_event", values=values, columns=columns, units=UNITS, frame="hand")
    return Stream(name=EVENTS, clock=clock, stamp_ns=stamp_ns, signals={"skin_event": signal})

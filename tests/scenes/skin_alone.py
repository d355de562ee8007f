# SPDX-License-Identifier: BSD-3-Clause
"""An experiment file of contacts that a skinManager saw, and nothing else, whose two clocks are years apart."""

from __future__ import annotations

from pathlib import Path

from tests.formats.yarp.port_logs import INFO_TWO_STAMPS, write_port

EVENTS = ("right forearm", "left forearm")
FRAMES = ("r_forearm_dh_frame", "l_forearm_dh_frame")
SENT_S, DUMPED_S = 1204508983.5, 1373891463.5
"""Seconds of the sender's clock and of the dumper's when the first message came."""
MESSAGES, PERIOD_S = 100, 0.02
TOUCHED = range(40, 60)
"""Messages in which the right forearm is touched."""
HEURISTIC = (-3.0, 0.5, 0.0)
"""What such a message calls force."""
_CONTACT = "((7 4 4 5) (0.02 0.05 0.1) (-3.0 0.5 0.0) (0.0 0.0 0.0) (0.02 0.05 0.1) (1.0 0.0 0.0) (43 44) 30.0)"
_TEXT = """schema = "forcetorque/experiment/1"
name = "touched arms"

[recording]
format = "yarp"
path = "dumper"

[[recording.stream]]
kind = "skin_events"
port = "skin_events"
part = [
  { name = "right forearm", number = 5, frame = "r_forearm_dh_frame" },
  { name = "left forearm", number = 2, frame = "l_forearm_dh_frame" },
]

[[interval]]
label = "all"
start_s = 0.0
use = "validation"
"""


def write_events(folder: Path) -> Path:
    """Write the file and its log."""
    lines = [
        f"{k} {SENT_S + k * PERIOD_S:.6f} {DUMPED_S + k * PERIOD_S:.6f} {_CONTACT if k in TOUCHED else ''}\n"
        for k in range(MESSAGES)
    ]
    port = folder / "dumper" / "skin_events"
    port.mkdir(parents=True)
    write_port(port, "".join(lines), info=INFO_TWO_STAMPS)
    file = folder / "events.toml"
    file.write_text(_TEXT, encoding="utf-8")
    return file

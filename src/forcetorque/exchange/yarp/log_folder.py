# SPDX-License-Identifier: BSD-3-Clause
"""A whole folder of logs as a recording, without anyone saying what is in it."""

from __future__ import annotations

from pathlib import Path

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.discover import PortKind, discover_ports, read_port
from forcetorque.recording import Finding, Recording


def read_log_folder(folder: Path) -> Recording:
    """Read every port of a dumper folder whose messages tell what they hold.

    Args:
        folder: Folder of the ports.

    Returns:
        The recording; ports that cannot be read are findings.

    Raises:
        FormatError: If no port can be read.
    """
    ports = discover_ports(folder)
    readings = [reading for port in ports if port.kind is not PortKind.UNKNOWN for reading in read_port(port)]
    if not readings:
        raise FormatError(
            f"{folder}: expected ports with data.log, or recording.json; found {len(ports)} port(s) and none to read"
        )
    unread = [
        Finding(stream=port.path, kind="not_read", message=port.reason or "", count=0)
        for port in ports
        if port.kind is PortKind.UNKNOWN
    ]
    return Recording(
        streams={reading.stream.name: reading.stream for reading in readings},
        findings=(*unread, *(finding for reading in readings for finding in reading.findings)),
        origin={"format": "yarp", "path": str(folder)},
    )

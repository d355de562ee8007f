# SPDX-License-Identifier: BSD-3-Clause
"""Ports of skin, `skin/<part>:o`: the counts of every taxel of a patch, twelve per triangle, which fall under pressure.

Ports of skinManager whose name ends in `_comp:o` send what is left after their baseline, which rises: no counts.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.plain_numbers import expect_numbers
from forcetorque.exchange.yarp.port_log import read_port_log
from forcetorque.exchange.yarp.reading import CLOCK, PortReading
from forcetorque.recording import Signal, Stream

TRIANGLE = 12
"""Numbers per triangle of skin, ten taxels and two thermal pads."""
MOST_TAXELS = 10_000
"""Numbers of one patch: the torso of iCub has 768."""


def read_skin(port_dir: str | Path, *, stream: str, taxels: int) -> PortReading:
    """Read the log of a port of skin.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        taxels: Numbers of a message, thermal pads and gaps of its triangles included.

    Returns:
        A stream with the signal `taxel_counts`, its columns numbered from 0, and what was found in the log.

    Raises:
        FormatError: If messages hold anything but so many numbers, or none such patch has.
    """
    if not 0 < taxels <= MOST_TAXELS or taxels % TRIANGLE:
        raise FormatError(
            f"{port_dir}: expected {TRIANGLE} numbers for each triangle, {MOST_TAXELS} at most, got {taxels}; count "
            "those of a message"
        )
    names = tuple(map(str, range(taxels)))
    choose = partial(expect_numbers, names=names, advice="state how many numbers a message of this patch has")
    log = read_port_log(port_dir, stream=stream, choose=choose)
    counts = Signal(quantity="taxel_counts", values=log.values, columns=names, units=("counts",) * taxels)
    return PortReading(
        stream=Stream(
            name=stream, clock=CLOCK, stamp_ns=log.stamp_ns, signals={counts.quantity: counts}, sequence=log.sequence
        ),
        findings=log.findings,
    )


def holds_skin(path: str, count: int) -> bool:
    """Tell from name and size of its messages whether a port of plain numbers is one of skin.

    Args:
        path: Path of the port's folder below the folder of logs, with `/`.
        count: Numbers of a message.

    Returns:
        Whether a folder is called `skin` and whole triangles are sent.

    Raises:
        FormatError: If it is one of what a skinManager made of the counts.
    """
    *folders, name = path.split("/")
    if "skin" not in folders or count % TRIANGLE or not count:
        return False
    if "_comp" in name:
        raise FormatError(
            f"{path}: expected counts of taxels, got a port _comp: what a skinManager leaves after its baseline rises "
            f"with pressure where counts fall; record {name.replace('_comp', '')} beside it"
        )
    return True

# SPDX-License-Identifier: BSD-3-Clause
"""Ports of skin: counts of whole triangles, known by their folder; what a skinManager made of them is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.yarp.log_format import PortKind, discover_ports, read_found_port
from forcetorque.formats.yarp.skin_ports import read_skin
from tests.formats.yarp.port_logs import write_port

COUNTS = np.random.default_rng(6).integers(0, 256, (20, 24))
TEXT = "".join(f"{k} {10.0 + 0.02 * k:.6f} {' '.join(map(str, row))}\n" for k, row in enumerate(COUNTS))


def test_counts_are_read(tmp_path: Path) -> None:
    """As they stand, in the order of the message, with stamps and counters."""
    stream = read_skin(write_port(tmp_path, TEXT), stream="patch", taxels=24).stream
    signal = stream.signal("taxel_counts")
    np.testing.assert_array_equal(signal.values, COUNTS)
    assert signal.columns[:2] == ("0", "1")
    assert stream.stamp_ns[1] == 10_020_000_000
    np.testing.assert_array_equal(stream.sequence, np.arange(20))


def test_another_number_of_taxels_is_refused(tmp_path: Path) -> None:
    """Too few for the messages, and a number that no triangles have."""
    folder = write_port(tmp_path, TEXT)
    with pytest.raises(FormatError, match="expected 12 numbers .* got 24; specify how many numbers"):
        read_skin(folder, stream="patch", taxels=12)
    with pytest.raises(FormatError, match="expected 12 numbers for each triangle, 10000 at most, got 25"):
        read_skin(folder, stream="patch", taxels=25)


def test_it_is_discovered_by_its_folder(tmp_path: Path) -> None:
    """Twelve numbers in a folder `skin` are a triangle, elsewhere an inertial sensor; 24 elsewhere are nothing."""
    twelve = "".join(" ".join(line.split()[:14]) + "\n" for line in TEXT.splitlines())
    for port, text in {"skin/arm:o": TEXT, "skin/one:o": twelve, "inertial": twelve, "other": TEXT}.items():
        write_port(tmp_path / port, text)
    write_port(tmp_path / "skin" / "arm_comp:o", TEXT)
    ports = {port.path: port for port in discover_ports(tmp_path)}
    assert {path: port.kind for path, port in ports.items()} == {
        "skin/arm:o": PortKind.SKIN,
        "skin/one:o": PortKind.SKIN,
        "inertial": PortKind.INERTIAL,
        "other": PortKind.UNKNOWN,
        "skin/arm_comp:o": PortKind.UNKNOWN,
    }
    assert "rises with pressure where counts fall" in str(ports["skin/arm_comp:o"].reason)
    (reading,) = read_found_port(ports["skin/arm:o"])
    np.testing.assert_array_equal(reading.stream.signal("taxel_counts").values, COUNTS)


def test_it_is_described_as_a_file_may_state_it(tmp_path: Path) -> None:
    """Kind, folder and number of taxels."""
    write_port(tmp_path / "skin" / "arm:o", TEXT)
    known = recognised_format(tmp_path)
    assert known is not None
    (port,) = known.describe(tmp_path).table.stream
    assert port.model_dump() == {"kind": "skin", "name": "skin/arm:o", "port": "skin/arm:o", "taxels": 24}

# SPDX-License-Identifier: BSD-3-Clause
"""A simulated ATI NET F/T box loses, repeats, reorders and falls silent: every event is counted."""

from __future__ import annotations

import json
import socket
import time
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, RecordingError, UnitError
from forcetorque.live.corrector import Corrector
from forcetorque.live.loop import LiveLoop
from forcetorque.live.net_ft import HEADER, RECORD, REQUEST, START, STOP, CountUnits, NetFtSource, fetch_units
from tests.live.simulated_net_ft import BoxFaults, SimulatedBox
from tests.scenes.calibrations import make_calibration

UNITS = CountUnits(1e-6, 1e-6)
COUNTS = (1_500_000, -2_250_000, 30_000_000, 100_000, -200_000, 50_000)
XML = (
    "<?xml version='1.0'?><netft><cfgcpf>{cpf}</cfgcpf><cfgcpt>1000</cfgcpt><scfgfu>{unit}</scfgfu><scfgtu>N-m</scfgtu>"
    "</netft>"
)


def test_every_event_of_a_box_is_counted() -> None:
    """One in a hundred dropped, some twice, some late, and silence until it is asked again."""
    dropped, repeated, delayed = frozenset({50, 150, 250}), frozenset({20, 170}), frozenset({30, 90, 270})
    faults = BoxFaults(dropped=dropped, repeated=repeated, delayed=delayed, silent_after=200, silent_s=0.3)
    received = 300 - len(dropped) + len(repeated)
    with SimulatedBox(COUNTS, 300, faults) as box:
        source = NetFtSource("127.0.0.1", UNITS, clock=time.monotonic, port=box.port, ask_again_s=0.1, samples=received)
        loop = LiveLoop(source, [Corrector(make_calibration())], [], clock=time.monotonic, silence_s=0.15)
        result = loop.result(loop.run())
    packets = result.packets
    assert (packets.received, packets.lost, packets.restarts) == (received, 3, 1)
    assert (packets.repeated, packets.late, packets.silences) == (2, 3, 1)
    assert packets.longest_silence_s > 0.2
    assert (result.sensors[0].samples, result.sensors[0].repeated, result.sensors[0].late) == (received, 2, 3)


def test_counts_become_newtons_and_strangers_are_dropped() -> None:
    """Datagrams of another port or another length are counted; the box is told to stop at the end."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as box,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other,
    ):
        box.bind(("127.0.0.1", 0))
        box.settimeout(2.0)
        source = NetFtSource("127.0.0.1", UNITS, clock=lambda: 2.0, port=box.getsockname()[1], samples=2)
        packets = source.packets()
        assert next(packets) is None
        request, client = box.recvfrom(64)
        assert REQUEST.unpack(request) == (HEADER, START, 0)
        other.sendto(RECORD.pack(9, 9, 0, *COUNTS), client)
        box.sendto(b"short", client)
        box.sendto(RECORD.pack(1, 7, 0, *COUNTS), client)
        box.sendto(RECORD.pack(2, 14, 0x80020000, *COUNTS), client)
        given = [packet for packet in packets if packet is not None]
        assert REQUEST.unpack(box.recv(64)) == (HEADER, STOP, 0)
    assert np.allclose(given[0].values, [[1.5, -2.25, 30.0, 0.1, -0.2, 0.05]])
    assert [packet.sequence for packet in given] == [1, 2]
    assert [packet.faults for packet in given] == [[0], [2]]
    assert (source.counts.foreign, source.counts.unreadable) == (1, 1)


@pytest.mark.real_data
def test_a_captured_exchange_is_understood(data_dir: Path) -> None:
    """Units of the published configuration, requests and records of a capture."""
    capture = json.loads((data_dir / "live" / "rdt_capture.json").read_text(encoding="utf-8"))
    units = CountUnits.of_configuration(capture["netftapi2_xml"].encode())
    assert (units.newton, units.newton_metre) == (1e-6, 1e-6)
    assert REQUEST.pack(HEADER, START, 0).hex() == capture["requests_hex"][0]
    _, _, status, *counts = RECORD.unpack(bytes.fromhex(capture["records_hex"][0]))
    assert status == 0
    assert np.allclose(np.multiply(counts[:3], units.newton), capture["truth"]["force_N"])
    assert np.allclose(np.multiply(counts[3:], units.newton_metre), capture["truth"]["torque_Nm"])


def test_units_are_stated_or_published() -> None:
    """Pounds are pounds; what is not known is refused."""
    assert CountUnits.of("1e-6 lbf", "0.001 N m").newton == pytest.approx(4.4482216152605e-6, rel=1e-12)
    assert CountUnits.of_configuration(XML.format(cpf=1000, unit="lbf").encode()).newton == pytest.approx(
        4.448e-3, rel=1e-4
    )
    with pytest.raises(UnitError, match="expected one of N,"):
        CountUnits.of("1e-6 N m", "1e-6 N m")
    for text in (XML.format(cpf=0, unit="N"), XML.format(cpf=1, unit="stone"), "<netft/>", "no XML"):
        with pytest.raises(FormatError, match="netftapi2"):
            CountUnits.of_configuration(text.encode())


@pytest.mark.parametrize("transformation", ["0;0;132.710;0;0;0", "0;0;0;0;0;-90", "0.000;0;0;0;0;-0.0"])
def test_a_box_that_turns_or_moves_its_wrenches_is_refused(transformation: str) -> None:
    """Six zeros do neither."""
    text = XML.format(cpf=1000, unit="N").replace("</netft>", f"<cfgtfx>{transformation}</cfgtfx></netft>").encode()
    assert transformation.encode() in text
    if transformation.startswith("0.000"):
        assert CountUnits.of_configuration(text).newton == pytest.approx(1e-3)
        return
    with pytest.raises(RecordingError, match="cfgtfx: expected no tool transformation"):
        CountUnits.of_configuration(text)


@pytest.mark.parametrize("host", ["no box", "a" * 70, "x:y"])
def test_a_box_without_address_is_named(host: str) -> None:
    """Whether its units are stated or asked for."""
    with pytest.raises(RecordingError, match=f"--ati {host}: expected the address"):
        NetFtSource(host, UNITS, clock=time.monotonic)
    with pytest.raises(RecordingError, match=f"--ati {host}: expected its"):
        fetch_units(host, timeout_s=0.5)


def test_a_box_without_web_server_is_named() -> None:
    """With what to state instead."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        with pytest.raises(RecordingError, match="--ati-force and --ati-torque"):
            fetch_units("127.0.0.1", free.getsockname()[1], timeout_s=0.5)

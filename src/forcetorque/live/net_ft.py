# SPDX-License-Identifier: BSD-3-Clause
"""Client of ATI NET F/T boxes: raw data transfer (RDT) over UDP [1].

References:
    [1] ATI Industrial Automation, Network Force/Torque Sensor System manual, RDT protocol.
"""

from __future__ import annotations

import select
import socket
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.errors import FormatError, RecordingError, UnitError, known_names
from forcetorque.base.input_file import xml_of_text
from forcetorque.base.units import parsed_number, si_factor
from forcetorque.live.packets import NUMBERS, Packet, PacketCounts
from forcetorque.live.sample_status import Status
from forcetorque.live.sources import WAIT_S

RDT_PORT: Final = 49152
"""Port of the box."""
START, STOP = 2, 0
"""Commands: real-time streaming, and its end."""
RECORD = struct.Struct(">III6i")
"""RDT sequence, FT sequence, status, six counts."""
REQUEST = struct.Struct(">HHI")
"""Header, command, number of samples; 0 for no end."""
HEADER: Final = 0x1234
"""First word of a request."""
_SUMMARY_ERROR: Final = 0x80000000
_SATURATED: Final = 0x00020000
"""Bit of the status word: a gauge is out of range."""
_LARGEST_XML: Final = 1 << 20
_FORCE_UNITS = {"N": "N", "kN": "kN", "lbf": "lbf", "klbf": "1000 lbf", "kgf": "kgf", "gf": "0.001 kgf"}
_TORQUE_UNITS = {
    "N-m": "N m", "Nm": "N m", "N-mm": "N mm", "Nmm": "N mm", "kN-m": "1000 N m", "kNm": "1000 N m",
    "lbf-in": "lbf in", "lbf-ft": "lbf ft", "kgf-cm": "kgf cm", "kgfcm": "kgf cm",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class CountUnits:
    """What a count of a box is."""

    newton: float
    """N per count of a force."""
    newton_metre: float
    """N m per count of a moment."""

    @classmethod
    def of(cls, force: str, moment: str) -> CountUnits:
        """Read stated units.

        Args:
            force: Unit of a count of force, with its factor: `1e-6 N` where 1000000 counts are a newton.
            moment: The same of a moment.

        Returns:
            The units.

        Raises:
            UnitError: If they are no units of force and moment.
        """
        units = []
        for text, expected in ((force, "N"), (moment, "N m")):
            si, factor = si_factor(text)
            if si != expected:
                raise UnitError(f"unit {text!r}: expected one of {expected}, got one of {si}")
            units.append(factor)
        return cls(*units)

    @classmethod
    def of_configuration(cls, text: bytes) -> CountUnits:
        """Read the configuration that a box publishes as `netftapi2.xml`.

        Args:
            text: The file.

        Returns:
            The units.

        Raises:
            FormatError: If it lacks counts per unit, or its units are not known.
            RecordingError: If the box turns or moves its wrenches by a tool transformation.
        """
        root = xml_of_text(text, where="netftapi2.xml")
        if root is None:
            raise FormatError("netftapi2.xml: expected XML, got nothing")
        transformation = root.findtext("cfgtfx", "")
        if transformation.strip(" \n0.;-"):  # six zeros without one
            raise RecordingError(
                f"netftapi2.xml: cfgtfx: expected no tool transformation, which gives wrenches in another frame, got "
                f"{transformation[:80]!r}; take it off in the configuration of the box, or, where the calibration was "
                "fitted with it, state --ati-force and --ati-torque"
            )
        factors = []
        for counts, unit, known in (("cfgcpf", "scfgfu", _FORCE_UNITS), ("cfgcpt", "scfgtu", _TORQUE_UNITS)):
            per_unit, name = (root.findtext(key, "").strip() for key in (counts, unit))
            if name not in known:
                raise FormatError(f"netftapi2.xml: {unit}: {known_names(name, known)}; got {name[:40]!r}")
            number = parsed_number(per_unit)
            if not number > 0.0:
                raise FormatError(f"netftapi2.xml: {counts}: expected a number above 0, got {per_unit[:40]!r}")
            factors.append(si_factor(known[name])[1] / number)
        return cls(*factors)


def fetch_units(host: str, port: int = 80, timeout_s: float = 3.0) -> CountUnits:
    """Ask a box for its units.

    Args:
        host: Its address.
        port: Port of its web server.
        timeout_s: How long it may take; s.

    Returns:
        The units that it publishes.

    Raises:
        RecordingError: If it does not answer.
    """
    from http.client import HTTPConnection, HTTPException

    connection = None
    try:
        connection = HTTPConnection(host, port, timeout=timeout_s)
        connection.request("GET", "/netftapi2.xml")
        response = connection.getresponse()
        text = response.read(_LARGEST_XML)
        if response.status != 200:
            raise RecordingError(f"--ati {host}: netftapi2.xml: expected an answer, got status {response.status}")
    except (OSError, UnicodeError, HTTPException) as error:
        raise RecordingError(
            f"--ati {host}: expected its configuration at http://{host}:{port}/netftapi2.xml, got {error}; or state "
            "--ati-force and --ati-torque, the units of a count"
        ) from None
    finally:
        if connection is not None:
            connection.close()
    return CountUnits.of_configuration(text)


class NetFtSource:
    """Samples of a box, which is asked again when it falls silent, and then counts its packets from 1 again."""

    def __init__(
        self,
        host: str,
        units: CountUnits,
        *,
        clock: Callable[[], float],
        port: int = RDT_PORT,
        ask_again_s: float = 1.0,
        samples: int | None = None,
    ) -> None:
        """Prepare.

        Args:
            host: Address of the box.
            units: What its counts are.
            clock: Gives seconds.
            port: Its port.
            ask_again_s: Time without a packet after which it is asked again; s.
            samples: Packets after which to stop; None for no end.

        Raises:
            RecordingError: If the address is not known.
        """
        self.counts = PacketCounts(countable=True)
        self.rate_hz: float | None = None
        self.numbers = NUMBERS
        self._last, self._asked_again = 0, False
        try:
            self._address = (socket.gethostbyname(host), port)
        except (OSError, UnicodeError) as error:
            raise RecordingError(f"--ati {host}: expected the address of a box, got {error}") from None
        self._scale = np.repeat([units.newton, units.newton_metre], 3)
        self._clock, self._ask_again_s, self._samples = clock, ask_again_s, samples

    def packets(self) -> Iterator[Packet | None]:
        """Give packets, as of `Source`. Their stamps are times of arrival: the box sends none.

        Yields:
            Packets; None while it waits.
        """
        left = self._samples
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
            client.setblocking(False)
            self._ask(client, START)
            asked = self._clock()
            try:
                while left is None or left > 0:
                    if not select.select([client], [], [], min(WAIT_S, self._ask_again_s))[0]:
                        if self._clock() - asked > self._ask_again_s:
                            self._ask(client, START)
                            asked, self._asked_again = self._clock(), True
                        yield None
                        continue
                    for packet in self._waiting(client):
                        asked = self._clock()
                        yield packet
                        left = None if left is None else left - 1
                    yield None
            finally:
                self._ask(client, STOP)

    def _ask(self, client: socket.socket, command: int) -> None:
        try:
            client.sendto(REQUEST.pack(HEADER, command, 0), self._address)
        except OSError:  # a network that is down comes back; until then the box is silent
            return

    def _waiting(self, client: socket.socket) -> Iterator[Packet]:
        """Packets that are there."""
        while True:
            try:
                data, sender = client.recvfrom(2048)
            except BlockingIOError:
                return
            except OSError:  # the last request met a closed port
                continue
            if sender != self._address:
                self.counts.foreign += 1
                continue
            if len(data) != RECORD.size:
                self.counts.unreadable += 1
                continue
            sequence, _, status, *counts = RECORD.unpack(data)
            fault = Status(0)
            if status & _SUMMARY_ERROR:
                fault = Status.SATURATED if status & _SATURATED else Status.DEVICE
            # old packets may still be on their way
            begins = self._asked_again and sequence < self._last
            self._asked_again, self._last = self._asked_again and not begins, sequence
            yield Packet(
                begins=begins,
                values=np.multiply(counts, self._scale)[None],
                stamp_ns=round(self._clock() * 1e9),
                sequence=sequence,
                faults=[int(fault)],
            )

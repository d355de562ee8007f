# SPDX-License-Identifier: BSD-3-Clause
"""A simulated ATI NET F/T box on the loopback address, which loses, repeats, reorders and interrupts its packets."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from forcetorque.live.net_ft import HEADER, RECORD, REQUEST, START


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxFaults:
    """Packets of a simulated box that meet a fault, counted from 1 over all requests."""

    dropped: frozenset[int] = frozenset()
    """Not sent."""
    repeated: frozenset[int] = frozenset()
    """Sent twice."""
    delayed: frozenset[int] = frozenset()
    """Sent after the next packet."""
    silent_after: int | None = None
    """Packet after which it is silent until it is asked again; None for none."""
    silent_s: float = 0.0
    """How long it is silent at least; s."""


class SimulatedBox:
    """A box in a thread of its own; a context manager."""

    def __init__(self, counts: Sequence[int], packets: int, faults: BoxFaults, *, period_s: float = 0.0005) -> None:
        """Open a port.

        Args:
            counts: Six counts that all packets hold.
            packets: Packets in all.
            faults: What goes wrong.
            period_s: Time between packets; s.
        """
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(0.05)
        self.port: int = self._socket.getsockname()[1]
        self._counts, self._packets, self._faults, self._period_s = tuple(counts), packets, faults, period_s
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._stopped.set()
        self._thread.join()
        self._socket.close()

    def _client(self) -> tuple[str, int] | None:
        """Address that asks for packets; None if it is to stop."""
        while not self._stopped.is_set():
            try:
                data, client = self._socket.recvfrom(64)
            except TimeoutError:
                continue
            if len(data) == REQUEST.size and REQUEST.unpack(data)[:2] == (HEADER, START):
                return (client[0], client[1])
        return None

    def _send(self, number: int, client: tuple[str, int]) -> None:
        self._socket.sendto(RECORD.pack(number, number * 7, 0, *self._counts), client)

    def _serve(self) -> None:
        client, held = self._client(), None
        number, before = 1, 0
        while client is not None and number <= self._packets and not self._stopped.is_set():
            if number in self._faults.delayed:
                held = number
            elif number not in self._faults.dropped:
                self._send(number - before, client)
                if number in self._faults.repeated:
                    self._send(number - before, client)
                if held is not None:
                    self._send(held - before, client)
                    held = None
            if number == self._faults.silent_after:
                time.sleep(self._faults.silent_s)
                client, before = self._client(), number  # every request has numbers from 1 on
            number += 1
            time.sleep(self._period_s)
        self._stopped.wait()

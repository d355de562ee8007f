# SPDX-License-Identifier: BSD-3-Clause
"""Where packets come from: lines of a pipe, and recordings that are replayed."""

from __future__ import annotations

import os
import selectors
from collections.abc import Callable, Iterator
from typing import Final, Protocol

from forcetorque.base.errors import FormatError
from forcetorque.live.packets import Packet, PacketCounts
from forcetorque.live.text_lines import LineForm

LONGEST_LINE: Final = 1 << 16
"""Bytes of the longest line."""
_CHUNK: Final = 1 << 16
WAIT_S: Final = 0.2
"""Time after which a source that has no packet says so; s."""


class Source(Protocol):
    """Gives packets until it ends."""

    counts: PacketCounts
    """What was no packet: unreadable and oversized lines, foreign datagrams."""
    rate_hz: float | None
    """Rate of the sender; None for not known."""
    numbers: int
    """Numbers of its packets, as of `PacketAccount`."""

    def packets(self) -> Iterator[Packet | None]:
        """Give packets.

        Yields:
            Packets; None whenever none is waiting, at least every `WAIT_S`.
        """


class LineSource:
    """Lines of a file descriptor, such as standard input."""

    def __init__(
        self,
        descriptor: int,
        form: LineForm,
        *,
        rate_hz: float | None = None,
        warn: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Begin.

        Args:
            descriptor: Where lines are read.
            form: What they mean.
            rate_hz: Rate of the sender; Hz; None for not known.
            warn: Called with the reason for the first line that is no sample.
        """
        self.counts, self.rate_hz, self.numbers = PacketCounts(), rate_hz, form.numbers
        self._descriptor, self._form, self._warn = descriptor, form, warn
        self._number = 0

    def packets(self) -> Iterator[Packet | None]:
        """Give packets, as of `Source`.

        Yields:
            Packets; None when none is waiting.
        """
        rest, skipping = b"", False
        for chunk in self._chunks():
            if chunk is None:
                yield None
                continue
            *lines, rest = (rest + chunk).split(b"\n")
            for line in lines:
                if skipping:  # the end of a line that was too long
                    skipping = False
                    continue
                yield from self._packet(line)
            if len(rest) > LONGEST_LINE:
                if not skipping:
                    self._count_oversized()
                skipping, rest = True, b""
            yield None
        if rest and not skipping:
            yield from self._packet(rest)

    def _chunks(self) -> Iterator[bytes | None]:
        with selectors.DefaultSelector() as selector:
            try:
                selector.register(self._descriptor, selectors.EVENT_READ)
            except (OSError, ValueError):  # a file is always ready, and cannot be waited for
                waits = False
            else:
                waits = True
            while True:
                if waits and not selector.select(WAIT_S):
                    yield None
                    continue
                chunk = os.read(self._descriptor, _CHUNK)
                if not chunk:
                    return
                yield chunk

    def _count_oversized(self) -> None:
        self.counts.oversized += 1
        self._number += 1

    def _packet(self, line: bytes) -> Iterator[Packet]:
        if len(line) > LONGEST_LINE:
            self._count_oversized()
            return
        self._number += 1
        text = line.decode("utf-8", errors="replace").strip()
        if not text:
            return
        try:
            packet = self._form.packet(text)
        except FormatError as error:
            if not self.counts.unreadable:
                self._warn(f"line {self._number}: {error}; further such lines are counted only")
            self.counts.unreadable += 1
            return
        if packet is not None:
            yield packet

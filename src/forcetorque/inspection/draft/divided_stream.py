# SPDX-License-Identifier: BSD-3-Clause
"""Wrench and motion of one table as two streams, so that a `[[clock]]` can bring one to the other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, ClassVar, Final

from forcetorque.inspection.draft.toml_edits import Edit, TableBlocks, edit_between, key_edit, table_blocks, table_edit
from forcetorque.inspection.draft.toml_lines import tables_of, toml_value
from forcetorque.inspection.fault_messages import clock_of_division, motion_name
from forcetorque.recording.alignment import ClockShift

_JOINTS = ("position", "velocity", "acceleration", "torque", "motor_current", "pwm")
_FRAMES = ("orientation", "translation", "gravity", "proper_acceleration", "angular_velocity", "angular_acceleration")
_OF_MOTION: Final = frozenset((*_JOINTS, *_FRAMES))
"""Quantities that leave the stream of the sensor; others, which a variable or a contact names by the stream, stay."""
_REFERENCES: Final = (("load", "motion"), ("support", "imu"))
"""Tables with keys that list streams of a motion."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DividedStream:
    """The division of a stream of a table, and the clock of the sensor's part."""

    cause: ClassVar[str] = ""
    """Nothing beside the fault is wrong."""
    is_shared: ClassVar[bool] = True
    """Other sensors have the motion too."""
    stream: str
    """The stream."""
    clock: Mapping[str, Any]
    """The `[[clock]]` of one of the two streams."""
    is_first: bool
    """Whether it stands in front of others, which bring streams to the clock of this one."""

    @classmethod
    def of(
        cls, content: Mapping[str, Any], stream: str, delay_s: float, shifts: Sequence[ClockShift]
    ) -> DividedStream | None:
        """Plan the division.

        Args:
            content: Tables of the experiment file.
            stream: The stream.
            delay_s: By how much the stamps of the sensor's signals are late; s.
            shifts: What the clocks of the file did.

        Returns:
            The division; None where the file lists no signals of the stream, or of one kind alone.
        """
        clock, is_first = clock_of_division(stream, delay_s, shifts)
        division = cls(stream=stream, clock=clock, is_first=is_first)
        signals = next((one.get("signal", ()) for one in _streams(content) if one.get("name") == stream), ())
        moves = [one.get("quantity") in _OF_MOTION for one in signals]
        return division if any(moves) and not all(moves) else None

    @property
    def tried(self) -> float:
        """What is tried is what is written."""
        return float(self.clock["delay_s"])

    @property
    def by_hand(self) -> str:
        """What a person writes."""
        clock = ", ".join(f"{key} = {toml_value(value)}" for key, value in self.clock.items())
        place = ", in front of the others" if self.is_first else ""
        return (
            f"list the signals of the motion in a [[recording.stream]] of their own and write [[clock]] {clock}{place}"
        )

    def content(self, content: Mapping[str, Any], value: float) -> dict[str, Any]:
        """Change the content of a file.

        Args:
            content: Its tables.
            value: The delay; s.

        Returns:
            A copy with two streams and the clock.
        """
        changed = deepcopy(dict(content))
        streams = []
        for one in _streams(changed):
            signals = one["signal"]
            if one["name"] != self.stream:
                streams.append(one)
                continue
            own = [signal for signal in signals if signal["quantity"] not in _OF_MOTION]
            moving = [signal for signal in signals if signal["quantity"] in _OF_MOTION]
            streams += [{**one, "signal": own}, {**one, "name": motion_name(self.stream), "signal": moving}]
        changed["recording"]["stream"] = streams
        clock, others = {**self.clock, "delay_s": value}, changed.get("clock", [])
        changed["clock"] = [clock, *others] if self.is_first else [*others, clock]
        for table, _, key, names in self._references(changed):
            table[key] = names
        return changed

    def edit(self, text: str, content: Mapping[str, Any]) -> Edit | None:
        """Make the change of the text of a file.

        Args:
            text: Content of the file.
            content: Its tables.

        Returns:
            The change; None where the text has the tables in a form that is not changed.
        """
        changed = text
        for _, (name, index), key, names in self._references(content):
            edit = key_edit(changed, name, index, key, names)
            changed = changed if edit is None else edit.applied(changed)
        number = next(k for k, one in enumerate(_streams(content)) if one["name"] == self.stream)
        blocks = table_blocks(changed, "recording.stream", number)
        divided = None if blocks is None else self._divided(blocks, _streams(content)[number]["signal"])
        if blocks is None or divided is None:
            return None
        changed = "\n".join([*blocks.before, *divided, *blocks.behind]) + "\n"
        clock = table_edit(changed, "clock", self.clock, before="clock" if self.is_first else "sensor")
        edit = None if clock is None else edit_between(text, clock.applied(changed))
        return edit if edit is not None and edit.results_in(self.content(content, self.tried), text) else None

    def _divided(self, blocks: TableBlocks, signals: Sequence[Mapping[str, Any]]) -> list[str] | None:
        """Lines of the two streams; None where the signals are written in a form that is not changed."""
        head = "\n".join(blocks.head) + "\n"
        named = key_edit(head, "recording.stream", 0, "name", motion_name(self.stream))
        if named is None or len(blocks.inner) not in (0, len(signals)):
            return None
        lines = []
        for moves, text in ((False, head), (True, named.applied(head))):
            part = [signal for signal in signals if (signal["quantity"] in _OF_MOTION) == moves]
            if blocks.inner:
                lines += text.removesuffix("\n").split("\n")
                pairs = zip(signals, blocks.inner, strict=True)
                lines += [line for signal, block in pairs if signal in part for line in block]
                continue
            inline = key_edit(text, "recording.stream", 0, "signal", part)
            if inline is None or any("#" in line for line in inline.old[1:-1]):  # comments in a list would be lost
                return None
            lines += inline.applied(text).removesuffix("\n").split("\n")
        return lines

    def _references(self, content: Mapping[str, Any]) -> Iterator[tuple[Any, tuple[str, int], str, list[str]]]:
        """Tables that list the stream as that of a motion, with their names, keys and new lists."""
        for name, key in _REFERENCES:
            known = content.get(name, ())
            for index, table in enumerate([known] if isinstance(known, Mapping) else known):
                streams = table.get(key)
                if isinstance(streams, list) and self.stream in streams:
                    new = [motion_name(self.stream) if one == self.stream else one for one in streams]
                    yield table, (name, index), key, new


def _streams(content: Mapping[str, Any]) -> Sequence[Any]:
    recording = content.get("recording")
    return tables_of(recording, "stream") if isinstance(recording, dict) else ()

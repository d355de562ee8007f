# SPDX-License-Identifier: BSD-3-Clause
"""What the device does with a file: an oracle that shares no code with the library.

Written after the public sources: `readGroupTag` of YARP's XMLReaderFileV3.cpp joins name and value to text,
`fromString` and `smartAdd` of BottleImpl.cpp take that apart again, `load...FromConfig` and
`usePreEstimatedOffset` of WholeBodyDynamicsDevice.cpp fill the processors, and `filt` of
SixAxisForceTorqueMeasureHelpers.cpp computes.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass, field

Word = int | float | str | bool | list["Word"]


def bottle(text: str) -> list[Word]:
    """Split text into words as YARP does: parentheses nest, commas and blanks separate, quotes protect."""
    words: list[Word] = []
    word, depth, quoted, back = "", 0, False, False
    for char in text + " ":
        if back:
            word, back = word + char, False
        elif not quoted and depth == 0 and char in ", \t\n\r":
            if word:
                words.append(_typed(word))
            word = ""
        else:
            quoted ^= char == '"'
            if not quoted:
                depth += (char in "({") - (char in ")}")
            back = char == "\\"
            word += char
    return words


def _typed(word: str) -> Word:
    if word[0] == "(":
        return bottle(word[1:-1])
    if word in ("true", "false", "null") or word[0] in "[{":
        return word == "true"
    if word in ("inf", "-inf", "nan"):
        return float(word)
    if re.fullmatch(r"[-+.0-9][-+.0-9eE]*", word) and word.count(".") < 2 and word != ".":
        # a word with point or exponent is a float, any other an integer; strtod stops where it must
        digits = re.match(r"[-+]?[0-9]*\.?[0-9]*(?:[eE][-+]?[0-9]+)?", word)
        assert digits is not None
        return float(digits[0]) if re.search("[.eE]", word) else int(word)
    if re.fullmatch(r"[-+0]*[xX][0-9a-fA-F]{1,8}", word) and word[0] in "+-0":
        return int(word, 16)
    return word.replace("\\", "").replace('"', "")


@dataclass
class Processor:
    """The numbers that the device keeps for a sensor."""

    matrix: list[list[float]] = field(default_factory=lambda: [[float(i == j) for j in range(6)] for i in range(6)])
    offset: list[float] = field(default_factory=lambda: [0.0] * 6)
    estimated_offset: list[float] = field(default_factory=lambda: [0.0] * 6)
    coefficients: list[float] = field(default_factory=lambda: [0.0] * 6)
    reference: float = 0.0

    def filt(self, reading: list[float], temperature: float = 0.0) -> list[float]:
        """Correct one reading."""
        return [
            sum(self.matrix[i][j] * reading[j] for j in range(6))
            - self.offset[i]
            + self.coefficients[i] * (temperature - self.reference)
            for i in range(6)
        ]


def configured(text: str) -> tuple[dict[str, Processor], list[Word]]:
    """Configure the sensors that a file names; also give every number that was read, with its type."""
    sensors: dict[str, Processor] = {}
    numbers: list[Word] = []
    plain = re.sub("<!--.*?-->", "", text, flags=re.DOTALL)
    for group, content in re.findall(r'<group name="(FT_\w+)">(.*?)</group>', plain, re.DOTALL):
        for name, value in re.findall(r"<param name=(\"[^\"]*\"|'[^']*')>(.*?)</param>", content, re.DOTALL):
            (entry,) = bottle(f"({html.unescape(name[1:-1])} {value})")
            assert isinstance(entry, list)
            sensor, values = entry  # two words, or the device refuses to start
            assert isinstance(sensor, str)
            assert isinstance(values, list)
            numbers += values
            _configure(sensors.setdefault(sensor, Processor()), group, [float(v) for v in values])  # type: ignore[arg-type]
    return sensors, numbers


def _configure(processor: Processor, group: str, values: list[float]) -> None:
    assert len(values) == {"FT_SECONDARY_CALIBRATION": 36, "FT_TEMPERATURE_COEFFICIENTS": 7, "FT_OFFSET": 6}[group]
    if group == "FT_SECONDARY_CALIBRATION":
        processor.matrix = [[values[6 * r + c] for c in range(6)] for r in range(6)]
    elif group == "FT_OFFSET":
        processor.estimated_offset = values
    else:
        processor.coefficients, processor.reference = values[:6], values[6]


def use_pre_estimated_offset(sensors: dict[str, Processor]) -> None:
    """Take the offsets of the file, with the sign that the device gives them; six zeros are skipped."""
    for processor in sensors.values():
        if any(processor.estimated_offset):
            processor.offset = [-value for value in processor.estimated_offset]

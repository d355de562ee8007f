# SPDX-License-Identifier: BSD-3-Clause
"""One contact of a message of skin events, and the line that holds such contacts [1].

References:
    [1] icub-main, src/libraries/skinDynLib/src/skinContact.cpp, `skinContact::write`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle, BottleValue, leaves, parse_bottle
from forcetorque.exchange.yarp.message_line import check_head, is_number

COLUMNS = (
    "contact_id",
    *(f"pressed_{axis}" for axis in "xyz"),
    *(f"heuristic_{axis}" for axis in "xyz"),
    *(f"centre_{axis}" for axis in "xyz"),
    *(f"normal_{axis}" for axis in "xyz"),
    "taxels",
    "mean_fall",
    "confidence",
)
"""Numbers of a contact; `heuristic` is what the messages call force, `mean_fall` what they call pressure."""
UNITS = ("1", *("m",) * 3, *("heuristic",) * 3, *("m",) * 3, *("1",) * 3, "1", "counts", "1")
"""Their units; no unit of force is among them."""

_HEAD = ("contactId", "bodyPart", "linkNumber", "skinPart")
_VECTORS = ("centre of pressure", "force", "moment", "geometric centre", "normal")
_SIZES = (8, 10)
"""Elements of a contact: of the older skinManager, and with names of link and frame and a confidence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinEvent:
    """One contact of one message."""

    skin_part: int
    """Number of the patch of skin."""
    place: tuple[int, int]
    """Numbers of the part of the body and of the link, which say in which frame the vectors are."""
    values: tuple[float, ...]
    """Numbers as in `COLUMNS`."""


def parse_events_line(line: bytes, *, n_stamps: int) -> tuple[Bottle, tuple[SkinEvent, ...]]:
    """Parse one line of a log of skin events.

    Args:
        line: The line without its end.
        n_stamps: Stamps that stand before the contacts, 1 or 2.

    Returns:
        Sequence number with stamps, and the contacts; none where nothing is touched.

    Raises:
        FormatError: If the line is anything else; the text does not say where.
    """
    if not line.strip():
        raise FormatError("expected a message, got a blank line; delete it")
    bottle = parse_bottle(line.decode("ascii", "backslashreplace").rstrip(" "))
    check_head(line, bottle, n_stamps=n_stamps)
    message = bottle[1 + n_stamps :]
    if not all(map(math.isfinite, filter(is_number, leaves(message)))):
        raise FormatError("expected finite numbers, got one beyond the range of float64; delete the line")
    return bottle[: 1 + n_stamps], tuple(_event(element, k + 1) for k, element in enumerate(message))


def _event(element: BottleValue, number: int) -> SkinEvent:
    if not isinstance(element, tuple) or len(element) not in _SIZES:
        got = f"a list of {len(element)}" if isinstance(element, tuple) else "no list"
        raise FormatError(
            f"contact {number}: expected a list of {_SIZES[0]} or {_SIZES[1]} elements, got {got}; "
            "is this the port skin_events:o?"
        )
    head = _list(element[0], number, " ".join(_HEAD), len(_HEAD))
    pressed, heuristic, _, centre, normal = (
        _list(value, number, name, 3) for value, name in zip(element[1:6], _VECTORS, strict=True)
    )
    taxels, pressure = _list(element[6], number, "active taxels", None), element[7]
    if not is_number(pressure) or not all(isinstance(value, int) for value in head):
        raise FormatError(f"contact {number}: expected whole numbers {' '.join(_HEAD)} and a pressure; delete the line")
    confidence = element[9] if len(element) == max(_SIZES) else math.nan
    if not is_number(confidence):
        raise FormatError(f"contact {number}: expected a confidence as the last element, got none; delete the line")
    contact_id, body_part, link, skin_part = map(int, head)
    return SkinEvent(
        skin_part=skin_part,
        place=(body_part, link),
        values=(contact_id, *pressed, *heuristic, *centre, *normal, len(taxels), pressure, confidence),
    )


def _list(value: BottleValue, number: int, name: str, size: int | None) -> tuple[int | float, ...]:
    """The numbers of a list."""
    numbers = tuple(item for item in value if is_number(item)) if isinstance(value, tuple) else ()
    complete = isinstance(value, tuple) and len(numbers) == len(value) and size in (None, len(numbers))
    if not complete:
        wanted = "a list of numbers" if size is None else f"a list of {size} numbers"
        raise FormatError(
            f"contact {number}: expected {wanted} for {name}, got {len(numbers)} numbers; was the line cut off? "
            "delete it"
        )
    return numbers

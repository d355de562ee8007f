# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `response` in a few lines: natural frequency, damping and bandwidth, or why they are not determined."""

from __future__ import annotations

from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, plus_minus

if TYPE_CHECKING:
    from forcetorque.sensor.bandwidth.bandwidth import Response
    from forcetorque.sensor.bandwidth.decays import ResponseNumber


def response_answer(response: Response) -> Answer:
    """Give the answer.

    Args:
        response: The response of a sensor.

    Returns:
        The answer.
    """
    # of a quantity that comes from several sources the last is that of the measured force
    numbers = {row.quantity: row for row in response.numbers}
    shown = [f"{name} {_number(row)}" for name, row in numbers.items()]
    filtered = (
        (f"filter that undoes it: cut-off {amount(response.inverse.cut_off_hz, 'Hz')}",) if response.inverse else ()
    )
    first = (f"{len(response.events)} events, sampled at {response.rate_hz:.5g} Hz",) if response.events else ()
    return Answer(
        subject=f"{response.sensor} ({response.serial}), {response.excitation}, {response.signal}",
        verdict=shown[0] if shown else "NOT DETERMINED",
        why=("; ".join((*shown[1:], *first, *filtered)), *response.refused[:1]),
        written=(response.figure_file,),
        concern=Concern.BAD if not shown else Concern.UNCERTAIN if response.refused else Concern.NONE,
    )


def _number(row: ResponseNumber) -> str:
    return plus_minus(row.value, row.half_width_95, "" if row.unit == "1" else row.unit)

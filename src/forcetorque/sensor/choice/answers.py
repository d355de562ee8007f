# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `bench sensor` in a few lines: the sensors that hold the loads, the best first."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount
from forcetorque.sensor.choice.result import Holds, SensorChoice, SensorRow

_SHOWN = 5


def choice_answers(choice: SensorChoice) -> Iterator[Answer]:
    """Give the answer: a line for each of the best sensors.

    Args:
        choice: The ranking.

    Yields:
        At most five sensors that hold the loads, or that hold them axis by axis; else one line.
    """
    held, by_axis = choice.held(), choice.held(Holds.AXIS_BY_AXIS)
    counts = (
        f"{len(held)} of {len(choice.sensors)} ranges hold {_loads(choice)} with {100.0 * choice.margin:g} % to spare, "
        f"{len(by_axis)} only axis by axis, {len(choice.sensors) - len(held) - len(by_axis)} are exceeded"
    )
    shown = (held or by_axis)[:_SHOWN]
    if not shown:
        yield Answer(
            subject=_loads(choice),
            verdict="NO SENSOR HOLDS IT",
            why=(counts, f"nearest: {choice.sensors[0].name}, {_used(choice.sensors[0])}"),
            step="state further sensors by --catalogue, or keep less free by --margin",
            written=(choice.figure_file,),
            concern=Concern.BAD,
        )
    for place, row in enumerate(shown, start=1):
        certain = row.holds is Holds.HELD
        yield Answer(
            subject=f"{place}. {row.name} ({row.maker})",
            verdict=f"{'HOLDS' if certain else 'MAY SATURATE'}, {_used(row)}, {_error(row)}",
            why=(counts, _RANKED),
            step="" if certain else "ask the maker whether the range holds for combined loads",
            written=(choice.figure_file,),
            concern=Concern.NONE if certain else Concern.UNCERTAIN,
        )


_RANKED = "smallest stated error over load first, then narrowest range; the maker states the error, it is not measured"


def _loads(choice: SensorChoice) -> str:
    return choice.loads[0] if len(choice.loads) == 1 else f"{len(choice.loads)} loads"


def _used(row: SensorRow) -> str:
    return (
        f"{row.combined_percent:.0f} % of range used"
        if row.holds is not Holds.EXCEEDED
        else (f"{row.axis_percent:.0f} % of the range of an axis")
    )


def _error(row: SensorRow) -> str:
    step = "" if row.resolution_force_N is None else f", step {amount(row.resolution_force_N, 'N')}"
    if row.error_of_load_percent is None:
        return f"no stated error{step}"
    return f"error {amount(row.error_of_load_percent, '%')} of the load{step}"

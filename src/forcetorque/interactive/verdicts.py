# SPDX-License-Identifier: BSD-3-Clause
"""Verdicts as a script holds them: a tuple that shows itself as a table."""

from __future__ import annotations

from forcetorque.analysis import UseVerdict
from forcetorque.result import Table, html_table, short_names, table_text
from forcetorque.result.result import NOTEBOOK_WIDTH


class Verdicts(tuple[UseVerdict, ...]):
    """Whether calibrations may be used, one per calibration and load case: `verdicts[0].sentence`."""

    __slots__ = ()

    def records(self) -> list[dict[str, object]]:
        """Give the verdicts as flat lines.

        Returns:
            One per verdict.
        """
        return [verdict.flat() for verdict in self]

    def __str__(self) -> str:
        return table_text(self._table(), NOTEBOOK_WIDTH)

    def _repr_html_(self) -> str:
        return html_table(self._table())

    def _table(self) -> Table:
        names = short_names([verdict.candidate for verdict in self])
        return Table(
            caption="",
            headings=("sensor", "calibration", "load case", "decision", "why"),
            rows=tuple(
                (verdict.sensor, names[verdict.candidate], verdict.load_case, verdict.decision, verdict.sentence)
                for verdict in self
            ),
        )

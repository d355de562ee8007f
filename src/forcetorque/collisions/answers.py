# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `robot collisions` in a few lines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from forcetorque.results.answer import FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import plus_minus

if TYPE_CHECKING:
    from forcetorque.collisions.result import CollisionRow, Collisions, SensitivityRow


def collisions_answers(collisions: Collisions) -> Iterator[Answer]:
    """Say what every sensor noticed.

    Args:
        collisions: Contacts and what the sensors can notice.

    Yields:
        One answer per sensor.
    """
    for sensor in collisions.sensitivity:
        rows = [row for row in collisions.collisions if row.sensor == sensor.sensor]
        strongest = max(rows, key=lambda row: row.over_threshold, default=None)
        count = f"{len(rows)} CONTACT{'S' if len(rows) > 1 else ''}" if rows else "NO CONTACT"
        yield Answer(
            subject=f"{sensor.sensor}, {collisions.experiment}",
            verdict=f"{count} in {sensor.looked_at_s:.3g} s",
            why=(*([_strongest(strongest)] if strongest is not None else []), _noticed(sensor)),
            step="look at the log around it" if rows else "",
            command=typed("view", FIRST_EXPERIMENT) if rows else "",
            concern=Concern.UNCERTAIN if rows else Concern.NONE,
        )


def _strongest(row: CollisionRow) -> str:
    link = row.link if not row.other_links else f"{row.link} (or {', '.join(row.other_links[:2])})"
    stays = ", and stays, or an earlier contact ended" if row.kind == "new_level" else ""
    force = plus_minus(row.force_N, row.force_half_width_95_N, "N")
    return f"clearest: {row.start_s:.2f} to {row.end_s:.2f} s, {force} on {link}{stays}"


def _noticed(sensor: SensitivityRow) -> str:
    return (
        f"noticed: any force from {sensor.smallest_force_N:.2g} N; threshold for {sensor.alarms_per_hour:g} false "
        f"alarms per hour, from {sensor.free_s:.3g} s without contact"
    )

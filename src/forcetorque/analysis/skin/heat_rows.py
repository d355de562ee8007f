# SPDX-License-Identifier: BSD-3-Clause
"""Rows of contacts that were let go, and what is said of heat."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Final

from forcetorque.analysis.skin.contact_rows import SkinContactRow
from forcetorque.analysis.skin.frames import SkinFrames
from forcetorque.result import Row, Shown, finite_or_none
from forcetorque.skin.contact import Release
from forcetorque.skin.temperature import HeatRule

OFFERED: Final = "offered"
"""Said of a release after which rest may be taken anew."""
HEATING: Final = 1.25
"""Heat that comes faster than in the warm-up by more is said: the limits of drift are told from its steepest minute."""


class ReleaseRow(Row):
    """A contact that was let go."""

    time_s: Annotated[float, Shown("time", "s", digits=1)]
    """When it had settled, since the start of the recording."""
    held_s: Annotated[float, Shown("held", "s", digits=1)]
    """For how long it was held."""
    force_N: Annotated[float, Shown("force", "N", digits=2)]
    """Force before."""
    left_N: Annotated[float, Shown("left", "N", digits=2)]
    """Force that its taxels read after."""
    drift_limit_N: Annotated[float | None, Shown("drift limit", "N", digits=1)]
    """How much of that heat may be."""
    re_tare: Annotated[str, Shown("re-tare")]
    """`offered` where heat explains all that is left, `done` where that was taken as rest, else `no`."""


def release_row(release: Release) -> ReleaseRow:
    """Write a release down.

    Args:
        release: The release.

    Returns:
        Its row.
    """
    offered = OFFERED if release.may_be_heat else "no"
    return ReleaseRow(
        time_s=release.time_s,
        held_s=release.held_s,
        force_N=release.force_N,
        left_N=release.left_N,
        drift_limit_N=finite_or_none(release.drift_limit_N),
        re_tare="done" if release.re_tared else offered,
    )


def heat_warnings(looked: SkinFrames, rows: Sequence[SkinContactRow], *, has_pads: bool) -> tuple[str, ...]:
    """Say what heat makes doubtful.

    Args:
        looked: Frames of a recording.
        rows: Its contacts.
        has_pads: Whether the patch has thermal pads.

    Returns:
        Sentences.
    """
    hot = sum(row.drift_limit_N is not None and row.drift_limit_N > row.force_N for row in rows)
    sentences = (
        (
            has_pads and looked.rule is not HeatRule.LEARNED and len(rows) > 0,
            "no limit of drift is known: heat reads as force; `forcetorque skin calibrate --warm-up` learns how much",
        ),
        (
            hot > 0,
            f"{hot} of {len(rows)} contacts lasted so long that heat through them, which no thermal pad tells, may be "
            "all of their force; take rest anew where they are let go",
        ),
        (
            looked.heating > HEATING,
            f"heat came {looked.heating:.1f} times as fast as in the warm-up: limits of drift do not hold, and what "
            "pads do not tell in time may read as contacts; learn from a warm-up that is as fast",
        ),
        (
            len(looked.dead_pads) > 0,
            f"{len(looked.dead_pads)} thermal pads are dead in this recording: {_listed(looked)}",
        ),
        (
            len(looked.untold) > 0,
            f"{len(looked.untold)} taxels are left out because no living thermal pad tells their heat",
        ),
    )
    return tuple(sentence for holds, sentence in sentences if holds)


def _listed(looked: SkinFrames, most: int = 8) -> str:
    more = ", ..." if len(looked.dead_pads) > most else ""
    return ", ".join(map(str, looked.dead_pads[:most])) + more

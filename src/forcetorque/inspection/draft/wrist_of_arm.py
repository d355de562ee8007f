# SPDX-License-Identifier: BSD-3-Clause
"""The `[load]` and the intervals of an arm whose log fixes frame and sign of the wrench at its flange."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.formats.logged_wrist import DeclaredLoad, LoggedWrist
from forcetorque.inspection.draft.toml_lines import line

_BY_FORMAT = "by the format of the log"


def wrist_load_lines(wrist: LoggedWrist) -> list[str]:
    """Write the `[load]` table.

    Args:
        wrist: The wrench at the flange.

    Returns:
        Its lines.
    """
    return [
        "",
        "[load]",
        line("frame", wrist.frame, "the flange, about whose origin moments are"),
        line("motion", [wrist.stream]),
        line("measure_direction", wrist.measure_direction.value, _BY_FORMAT),
    ]


def wrist_interval_lines(wrist: LoggedWrist) -> list[str]:
    """Write the `[[interval]]` tables: one for each load that the controller knew, and motions, which are ignored.

    Args:
        wrist: The wrench at the flange.

    Returns:
        Their lines. A controller zeroes its measurement when the declared load is set, so that each is a session.
    """
    start, several = wrist.declared[0].start_ns, len(wrist.declared) > 1
    lines: list[str] = []
    for number, declared in enumerate(wrist.declared, start=1):
        label = f"payload {number}" if several else "all"
        known = _declared_text(declared) if declared.mass else ""
        lines += ["", "[[interval]]", line("label", label, known)]
        lines += [line("start_s", 1e-9 * (declared.start_ns - start))]
        if number < len(wrist.declared):
            lines.append(line("end_s", 1e-9 * (declared.end_ns - start)))
        lines.append(line("use", "calibration"))
        if several:
            lines.append(line("session", label))
    return [*lines, *_motion_lines(wrist, start)]


def _motion_lines(wrist: LoggedWrist, start: int) -> Iterator[str]:
    for number, (first, last) in enumerate(wrist.moving, start=1):
        yield from ("", "[[interval]]", line("label", f"motion {number}"))
        yield line("start_s", max(1e-9 * (first - start), 0.0))
        yield line("end_s", 1e-9 * (last - start))
        yield line("use", "ignore")


def _declared_text(declared: DeclaredLoad) -> str:
    return f"with the payload of {declared.mass:g} kg that the controller subtracts, and the reader adds"

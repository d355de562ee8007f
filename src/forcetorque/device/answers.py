# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `bench device` in a few lines: which requirements are not met."""

from __future__ import annotations

from typing import TYPE_CHECKING

from forcetorque.device.design import DeviceDesign
from forcetorque.device.requirements import Verdict
from forcetorque.results.answer import Answer, Concern, typed

if TYPE_CHECKING:
    from forcetorque.device.requirements import RequirementRow


def device_answer(design: DeviceDesign) -> Answer:
    """Give the answer."""
    rows = design.demands.requirements
    met = [row for row in rows if row.verdict is Verdict.MET]
    failed = [row for row in rows if row.verdict is Verdict.NOT_MET]
    first = next((row for row in design.span.sensors if row.sensor == design.sensors[0]), None)
    missing = "" if first is None or not first.missing else f", not {first.missing}"
    calibrated = [row.experiment for row in design.recordings if row.use == "calibration"]
    return Answer(
        subject=f"{design.device} with {len(design.sensors)} sensor{'s' * (len(design.sensors) > 1)}",
        verdict=f"MEETS {len(met)} OF {len(met) + len(failed)} REQUIREMENTS",
        why=(
            f"not met: {'; '.join(_requirement(row) for row in failed) or 'none'}; "
            f"{len(rows) - len(met) - len(failed)} of {len(rows)} not computed",
            *(
                ()
                if first is None
                else (f"{first.motion} excites {first.rank} of 6 directions of {first.sensor}{missing}",)
            ),
        ),
        step="calibrate with the simulated recordings"
        if calibrated
        else "write URDF and logs by the same command with --output FOLDER",
        command=typed("inspect", calibrated[0]) if calibrated else "",
        written=(design.folder, *design.figures, design.figure_file),
        concern=Concern.BAD if failed else Concern.NONE,
    )


def _requirement(row: RequirementRow) -> str:
    if row.value is None or row.limit is None:
        return f"{row.number} {row.requirement}"
    return f"{row.number} {row.requirement}, {row.value:.3g} of {row.limit:.3g} {row.unit}"

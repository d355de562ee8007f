# SPDX-License-Identifier: BSD-3-Clause
"""How a robot stood of which only the vertical forces of the feet were logged: phases, and no centre of pressure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from forcetorque.analysis.balance.interval_balance import BalanceOptions, IntervalBalance
from forcetorque.errors import ExperimentError
from forcetorque.estimation.balance import mass_of, support_phases
from forcetorque.experiment import FootForces
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Use
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot import build_tree

VERTICAL_ONLY: Final = (
    "centre of pressure and zero moment point: only the vertical forces of the feet were logged, and a point takes the "
    "moments too; they are not guessed"
)
"""What vertical forces do not tell."""


def balance_of_forces(content: FootForces, options: BalanceOptions) -> Iterator[IntervalBalance]:
    """Find the support phases of every interval that is not to be ignored.

    Args:
        content: The forces.
        options: What counts as a contact.

    Yields:
        How the robot stood, in the order of the intervals.

    Raises:
        ExperimentError: If every interval is to be ignored, or one has no sample.
    """
    spans = [span for span in content.intervals if span.use is not Use.IGNORE]
    if not spans:
        raise ExperimentError(f"experiment {content.name!r}: expected an interval that is not to be ignored")
    model = content.model
    weight_N = None if model is None else content.gravity * mass_of(build_tree(model, model.root_link))
    thresholds = options.thresholds(weight_N)
    for span in spans:
        with stated_in(f"interval {span.label!r}"):
            at_ns, forces = content.over(span)
            if not len(at_ns):
                raise ExperimentError("expected samples of the vertical forces, got none; the log begins later or ends")
            time_s = seconds_since(at_ns, content.recording.start_ns)
            yield IntervalBalance(
                recording=content.name,
                label=span.label,
                stamp_ns=at_ns,
                time_s=time_s,
                weight_N=weight_N,
                forces=forces,
                net_N=np.sum(list(forces.values()), axis=0),
                phases=support_phases(forces, time_s, thresholds),
                refused=(VERTICAL_ONLY,),
            )

# SPDX-License-Identifier: BSD-3-Clause
"""Which candidate of a sensor is best where nothing touches, if the recording tells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal

import numpy as np

from forcetorque.analysis.use.error_comparison import ErrorComparison, ratio_fields
from forcetorque.analysis.validate.contact_wrenches import ContactWrenches
from forcetorque.evaluation import Offset, PairedErrors, compare_errors
from forcetorque.result import Row, Shown, short_names
from forcetorque.spatial import WRENCH_COMPONENTS


class CandidateComparison(ErrorComparison):
    """The contact force of a candidate against that of another."""

    other: Annotated[str, Shown("against", file=True)]
    """The other candidate."""
    other_mean: Annotated[float, Shown("of that", digits=3)]
    """Mean norm of the contact force with the other."""


class BestCandidate(Row):
    """The candidates of a sensor with one offset, and whether one is best."""

    sensor: str
    """Sensor."""
    offset: Offset
    """Which offset the candidates are judged with."""
    by_magnitude: str
    """Candidate with the smallest mean norm of the force; whether it is the best, `judgement` says."""
    by_axis: tuple[str, ...]
    """Candidate with the smallest mean absolute value, per component."""
    judgement: Literal["better", "no difference", "not told apart"] | None
    """Of that by magnitude: better than every other, no different from those that it is not better than, or too little
    data to tell; null where there is no other."""
    comparisons: tuple[CandidateComparison, ...]
    """The same against every other."""

    @property
    def best(self) -> str | None:
        """The candidate that is better than every other; none where the recording does not tell."""
        return self.by_magnitude if self.judgement == "better" else None

    @property
    def sentence(self) -> str:
        """Who is best, if the recording tells, and on which axes the mean of another is smaller."""
        names = short_names([self.by_magnitude, *(row.other for row in self.comparisons), *self.by_axis])
        least = names[self.by_magnitude]
        words = [f"best is {least}" if self.best else "none is best"]
        words += [
            f"contact force of {least} {row.against(row.other_mean, names[row.other])}" for row in self.comparisons
        ]
        others = [
            f"{component} of {names[name]}"
            for component, name in zip(WRENCH_COMPONENTS, self.by_axis, strict=True)
            if name != self.by_magnitude
        ]
        words += [f"smaller in the mean: {', '.join(others)}"] if others else []
        return f"{self.sensor}, offset {self.offset}: {'; '.join(words)}"


def judged_best(
    sensor: str,
    offset: Offset,
    candidates: Sequence[tuple[int, Offset]],
    pooled: ContactWrenches,
    recordings: Sequence[ContactWrenches],
) -> BestCandidate:
    """Find the candidate with the smallest contact force, and tell whether it is better than every other.

    Args:
        sensor: Name of the sensor.
        offset: The offset that they are judged with.
        candidates: Keys of their wrenches, each with a sample without a gap.
        pooled: Contact wrenches of all recordings.
        recordings: Those of every recording.

    Returns:
        The candidate, and the test of it against every other.
    """
    sizes = {key: np.abs(wrench[~np.isnan(wrench).any(axis=1)]) for key, wrench in pooled.wrenches.items()}
    norms = {key: float(np.linalg.norm(sizes[key][:, :3], axis=1).mean()) for key in candidates}
    least = min(candidates, key=norms.__getitem__)
    names = {key: pooled.candidates[key[0]].name for key in candidates}
    comparisons = tuple(
        CandidateComparison(
            candidate=names[least],
            offset=offset,
            quantity="force",
            unit="N",
            samples=len(sizes[least]),
            mean=norms[least],
            other=names[key],
            other_mean=norms[key],
            **ratio_fields(compare_errors(_pairs(recordings, least, key)).force),
        )
        for key in candidates
        if key != least
    )
    by_axis = np.argmin([sizes[key].mean(axis=0) for key in candidates], axis=0)
    return BestCandidate(
        sensor=sensor,
        offset=offset,
        by_magnitude=names[least],
        by_axis=tuple(names[candidates[place]] for place in by_axis),
        judgement=_judgement(comparisons),
        comparisons=comparisons,
    )


def _pairs(
    recordings: Sequence[ContactWrenches], first: tuple[int, Offset], second: tuple[int, Offset]
) -> list[PairedErrors]:
    """Contact wrenches of two candidates where nothing touches: what should be zero is the error."""
    return [
        PairedErrors.of(one.wrenches[first], one.wrenches[second], np.zeros_like(one.wrenches[first]))
        for one in recordings
        if first in one.wrenches
    ]


def _judgement(
    comparisons: Sequence[CandidateComparison],
) -> Literal["better", "no difference", "not told apart"] | None:
    judgements = {row.judgement for row in comparisons}
    if not judgements:
        return None
    if judgements == {"better"}:
        return "better"
    return "no difference" if judgements <= {"better", "no difference"} else "not told apart"

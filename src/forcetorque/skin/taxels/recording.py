# SPDX-License-Identifier: BSD-3-Clause
"""What was recorded of a patch under pressure: every used interval of every experiment, from its own rest."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError, SkinError
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.intervals import RecordedSpan
from forcetorque.recording.alignment import interpolate, seconds_since, usable_samples
from forcetorque.recording.recording import Use
from forcetorque.skin.experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.messages import require_counts
from forcetorque.skin.taxels.cycle import PressureCycle, pressure_cycle
from forcetorque.skin.taxels.health import Ailment, taxel_ailments


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchRecording:
    """One interval with a patch under pressure."""

    experiment: str
    """Name of the experiment."""
    label: str
    """Label of the interval."""
    use: Use
    """Whether it is fitted or judges."""
    seconds: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    cycle: PressureCycle
    """Counts and pressure from rest, a column per taxel."""
    ailments: tuple[tuple[Ailment, ...], ...]
    """What is wrong with each taxel here."""

    @property
    def sound(self) -> BoolArray:
        """Taxels with which nothing is wrong; shape (c,)."""
        return np.array([not reasons for reasons in self.ailments])


def patch_recordings(experiment: PatchExperiment, patch: ExperimentPatch) -> list[PatchRecording]:
    """Read every interval of an experiment that is not ignored.

    Args:
        experiment: The experiment.
        patch: One of its patches.

    Returns:
        A recording per interval.

    Raises:
        ExperimentError: If the file does not say which stream is the pressure.
    """
    if patch.pressure is None:
        raise ExperimentError(
            f"{experiment.file}: patch {patch.name!r}: expected pressure, the stream with the pressure of the chamber "
            "or bag, got none"
        )
    used = [interval for interval in experiment.intervals if interval.use is not Use.IGNORE]
    recordings = []
    for interval in used:
        with stated_in(f"{experiment.file}: patch {patch.name!r}: interval {interval.label!r}"):
            recordings.append(_recording(experiment, patch, patch.pressure, interval))
    return recordings


def _recording(
    experiment: PatchExperiment, patch: ExperimentPatch, pressure: str, interval: RecordedSpan
) -> PatchRecording:
    stream = experiment.recording.stream(patch.counts)
    chamber = experiment.recording.stream(pressure)
    usable = usable_samples(stream.stamp_ns)
    rows = usable[interval.holds(stream.stamp_ns[usable])]
    at = interpolate(chamber, chamber.signal("pressure").values, stream.stamp_ns[rows])[:, 0]
    whole = stream.signal("taxel_counts").values
    measured = np.isfinite(at) & np.isfinite(whole[rows]).all(axis=1)
    rows, at = rows[measured], at[measured]
    if len(rows) < 2:
        raise SkinError("expected messages with a pressure, got none; do both streams cover the interval?")
    message = whole[rows]
    require_counts(message, where=repr(patch.counts), rows=rows)
    counts = message[:, patch.taxels]
    cycle = pressure_cycle(counts, at)
    return PatchRecording(
        experiment=experiment.name,
        label=interval.label,
        use=interval.use,
        seconds=seconds_since(stream.stamp_ns[rows], experiment.recording.start_ns),
        cycle=cycle,
        ailments=taxel_ailments(counts, cycle.top_fall),
    )


def same_patch(experiments: Sequence[PatchExperiment], name: str | None) -> list[ExperimentPatch]:
    """Find one patch in several experiments.

    Args:
        experiments: Experiments.
        name: Name of the patch; None for the only one.

    Returns:
        The patch in each.

    Raises:
        ExperimentError: If it is not the same patch in all.
    """
    patches = [experiment.patch(name) for experiment in experiments]
    first = patches[0]
    for experiment, patch in zip(experiments, patches, strict=True):
        same = (patch.name, patch.serial, patch.columns) == (first.name, first.serial, first.columns)
        if not same or not np.array_equal(patch.taxels, first.taxels):
            raise ExperimentError(
                f"{experiment.file}: expected the patch {_words(first)} of {experiments[0].file}, got {_words(patch)}; "
                "every patch has its own curves"
            )
    return patches


def _words(patch: ExperimentPatch) -> str:
    serial = "" if patch.serial is None else f" ({patch.serial})"
    return f"{patch.name!r}{serial} with {len(patch.taxels)} taxels in {patch.columns} columns"


def of_use(recordings: Iterable[PatchRecording], use: Use) -> list[PatchRecording]:
    """Choose the recordings of one use.

    Args:
        recordings: Recordings.
        use: The use.

    Returns:
        Those with it.
    """
    return [recording for recording in recordings if recording.use is use]

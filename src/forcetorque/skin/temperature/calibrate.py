# SPDX-License-Identifier: BSD-3-Clause
"""Learn from a warm-up without contact what heat does to the taxels of a patch."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import numpy as np

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.additions import added_to
from forcetorque.experiment.input_files import stated_in
from forcetorque.recording.recording import Use
from forcetorque.results.row import Row, Shown
from forcetorque.skin.contact.following import FASTER
from forcetorque.skin.experiment import ExperimentPatch, PatchExperiment, load_patches
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.layout.normals import rebuilt_normals
from forcetorque.skin.temperature.gains import HeatGains
from forcetorque.skin.temperature.pads import WarmUp
from forcetorque.skin.temperature.warm_up import fit_warm_up
from forcetorque.skin.wrench.frames import patch_messages

UNEXPLAINED: Final = 0.5
"""What pads may leave of a taxel unsaid: half of what wakes it in frames of ten messages; counts."""


class WarmUpRow(Row):
    """A warm-up, and what was learned of it."""

    experiment: Annotated[str, Shown("warm-up")]
    """Name of the experiment."""
    minutes: Annotated[float, Shown("length", "min", digits=1)]
    """Its length."""
    pads: Annotated[int, Shown("pads")]
    """Thermal pads that taxels follow."""
    dead_pads: Annotated[int, Shown("dead")]
    """Thermal pads that tell nothing."""
    pad_change_counts: Annotated[float, Shown("pads change", "counts", digits=1)]
    """Median change of the living ones."""
    taxels: Annotated[int, Shown("taxels")]
    """Taxels with gains."""
    gain: Annotated[float, Shown("gain", digits=2)]
    """Median of their gains; 1 is the rule of the firmware."""
    gain_spread: Annotated[float, Shown("spread", digits=2)]
    """Standard deviation of them from taxel to taxel."""
    misfit_counts: Annotated[float, Shown("misfit", "counts", digits=2)]
    """Median of what the pads leave of a taxel's change."""
    lag_s: Annotated[float, Shown("lag", "s", digits=1)]
    """Median lag of pads behind taxels; negative where they lead."""
    unexplained_counts: Annotated[float, Shown("unexplained", "counts", digits=1)]
    """Most that pads, followed as they come, leave of a taxel."""
    rate_counts_per_min: Annotated[float, Shown("rate", "counts/min", digits=1)]
    """Median of their steepest changes, from which limits of drift are told."""


def learn_warm_up(
    experiment: Path | str | PatchExperiment, patch: ExperimentPatch
) -> tuple[WarmUp, tuple[str, ...], dict[str, str]]:
    """Read a warm-up and learn the gains of a patch.

    Args:
        experiment: Experiment file with the patch and its layout, or what was read of it; its one interval for
            calibration is the warm-up.
        patch: The patch that is calibrated.

    Returns:
        What was learned, what makes it doubtful and what the file adds to its log, and the SHA-256 of its input files.

    Raises:
        ExperimentError: If it is another patch, its layout is not stated, or its interval is not.
    """
    content = load_patches(experiment) if isinstance(experiment, (Path, str)) else experiment
    own = content.patch(patch.name)
    with stated_in(f"{content.file}: patch {own.name!r}: warm-up"):
        same = (own.serial, own.columns) == (patch.serial, patch.columns)
        if not same or not np.array_equal(own.taxels, patch.taxels):
            raise ExperimentError(
                f"expected the patch that is calibrated, with serial {patch.serial!r} and {len(patch.taxels)} taxels "
                f"in {patch.columns} columns, got {own.serial!r} with {len(own.taxels)} in {own.columns}"
            )
        if own.layout is None:
            raise ExperimentError("layout: expected the file that says which columns are thermal pads, got none")
        seconds, counts = patch_messages(content, own)
        chosen = _warming(content, seconds)
        described = describe_patch(own.layout)
        layout = described.layout(rebuilt_normals(described.positions, described.modules))
        learned = fit_warm_up(content.name, seconds[chosen], counts[chosen], layout)
    added = tuple(f"warm-up {content.name!r}: {sentence}" for sentence in added_to(content.recording))
    return (
        learned,
        (*_doubts(learned, own), *added),
        {f"{content.name}: {k}": v for k, v in content.inputs_sha256.items()},
    )


def _warming(content: PatchExperiment, seconds: np.ndarray) -> np.ndarray:
    """Messages of the one interval for calibration."""
    used = [interval for interval in content.intervals if interval.use is Use.CALIBRATION]
    if len(used) != 1:
        raise ExperimentError(f'expected one interval with use = "calibration", the warm-up, got {len(used)}')
    (interval,) = used
    stamps = content.recording.start_ns + np.rint(1e9 * seconds).astype(np.int64)
    chosen = interval.holds(stamps)
    if np.count_nonzero(chosen) < 2:
        raise ExperimentError(f"interval {interval.label!r}: expected messages, got none")
    return chosen


def _doubts(learned: WarmUp, patch: ExperimentPatch) -> tuple[str, ...]:
    """What is missing of the gains."""
    without = [int(column) for column, heat in zip(patch.taxels, learned.taxels, strict=True) if not heat.gains]
    sentences = []
    if learned.dead_pads:
        sentences.append(
            f"{len(learned.dead_pads)} thermal pads are dead ({_listed(learned.dead_pads)}): their taxels follow the "
            "other pad of the module, or those of the nearest module with one"
        )
    if without:
        sentences.append(
            f"{len(without)} taxels were not sound in the warm-up ({_listed(without)}): they have no gain, and are "
            "left out where heat is taken out by gains"
        )
    lags = HeatGains.learned(learned.taxels).lags
    if np.any(lags):
        late, early = int(np.count_nonzero(lags > 0.0)), int(np.count_nonzero(lags < 0.0))
        sentences.append(
            f"{late} of {len(lags)} thermal pads feel heat later than their taxels and {early} sooner, by "
            f"{np.median(lags):+.0f} s in the median: this is made up for once a trend is seen, not when heat begins"
        )
    unexplained = np.array([heat.unexplained_counts for heat in learned.taxels])
    many = int(np.count_nonzero(unexplained > UNEXPLAINED))
    if many > 1:
        sentences.append(
            f"thermal pads leave over {UNEXPLAINED:g} counts of {many} of {len(unexplained)} taxels unexplained when "
            f"heat comes, at most {unexplained.max():.1f}: less than {FASTER:g} times that wakes no taxel, and "
            f"heat that comes more than {FASTER:g} times as fast reads as contacts"
        )
    return tuple(sentences)


def _listed(columns: tuple[int, ...] | list[int], most: int = 8) -> str:
    more = ", ..." if len(columns) > most else ""
    return ", ".join(map(str, columns[:most])) + more


def warm_up_row(learned: WarmUp) -> WarmUpRow:
    """Sum a warm-up up.

    Args:
        learned: What was learned.

    Returns:
        Its row.
    """
    taxels = [heat for heat in learned.taxels if heat.gains]
    gains = np.array([np.mean([gain.gain for gain in heat.gains]) for heat in taxels])
    rates = [heat.rate_counts_per_s for heat in taxels if heat.rate_counts_per_s is not None]
    return WarmUpRow(
        experiment=learned.experiment,
        minutes=learned.seconds / 60.0,
        pads=len(HeatGains.learned(learned.taxels).pads),
        dead_pads=len(learned.dead_pads),
        pad_change_counts=learned.pad_change_counts,
        taxels=len(taxels),
        gain=float(np.median(gains)),
        gain_spread=float(gains.std()),
        misfit_counts=float(np.median([heat.misfit_counts for heat in taxels])),
        lag_s=float(np.median(HeatGains.learned(learned.taxels).lags)),
        unexplained_counts=max(heat.unexplained_counts for heat in taxels),
        rate_counts_per_min=60.0 * float(np.median(rates)),
    )

# SPDX-License-Identifier: BSD-3-Clause
"""Records of a calibration of taxels: recordings, calibrations under test, taxels, and data of figures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, names
from forcetorque.results.table import Row, Shown
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import CalibratedTaxel
from forcetorque.skin.taxels.pressure_cycles import PatchRecording
from forcetorque.skin.taxels.taxel_curve import CurveKind, TaxelCurve
from forcetorque.skin.taxels.taxel_faults import TaxelFault


class SkinRecordingRow(Row):
    """A recording, and how many of the taxels are valid in it."""

    recording: Annotated[str, Shown("recording")]
    """Experiment and label of the interval."""
    use: Annotated[str, Shown("use")]
    """Whether it is for calibration or validation."""
    messages: Annotated[int, Shown("messages")]
    """Messages of counts with a pressure."""
    highest_kPa: Annotated[float, Shown("highest", "kPa", digits=0)]
    """Highest pressure above that at rest."""
    rest_kPa: Annotated[float, Shown("at rest", "kPa", digits=1)]
    """Reading of the pressure at rest, from which it counts."""
    valid_taxels: Annotated[int, Shown("valid")]
    """Taxels with which nothing is wrong in it."""
    wraps: Annotated[int, Shown("wrap")]
    """Taxels that run below 0 and go on at 255; a taxel may have several faults."""
    rails: Annotated[int, Shown("at rails")]
    """Taxels that read 0 or 255."""
    jumps: Annotated[int, Shown("jump")]
    """Taxels that jump from one message to the next."""
    noise: Annotated[int, Shown("noisy")]
    """Taxels that are noisy."""
    never_moves: Annotated[int, Shown("never move")]
    """Taxels that do not fall under pressure."""
    rises: Annotated[int, Shown("rise")]
    """Taxels that rise under pressure."""


class CandidateRow(Row):
    """A form of curve on recordings that were not fitted: medians over taxels of the root mean square error."""

    curve: Annotated[str, Shown("curve")]
    """Form of the curve."""
    recording: Annotated[str, Shown("recording")]
    """Recording, or `all`: then the squares of a taxel are pooled over those in which it is valid."""
    taxels: Annotated[int, Shown("taxels")]
    """Taxels that are valid where it was fitted and in this recording."""
    left_out: Annotated[int, Shown("left out")]
    """Taxels that are not."""
    inside_kPa: Annotated[float | None, Shown("inside", "kPa", digits=1)]
    """At pressures that were fitted."""
    above_kPa: Annotated[float | None, Shown("above", "kPa", digits=1)]
    """At higher ones."""
    inside_any_kPa: Annotated[float | None, Shown("inside, any", "kPa", digits=1)]
    """Inside, over all taxels that were fitted, whether or not they are valid in this recording."""
    above_any_kPa: Annotated[float | None, Shown("above, any", "kPa", digits=1)]
    """Above, over all taxels that were fitted."""
    falling: Annotated[int, Shown("falling")]
    """Fitted taxels whose curve falls anywhere from 0 to 255 counts below rest."""


class TaxelRow(Row):
    """A taxel."""

    taxel: Annotated[int, Shown("taxel")]
    """Column of the taxel."""
    left_out: Annotated[str | None, Shown("left out")]
    """What was wrong with it where it was to be fitted; none for a valid one."""
    range_counts: Annotated[float | None, Shown("range", "counts", digits=1)]
    """Fall below rest at the highest fitted pressure."""
    rmse_kPa: Annotated[float | None, Shown("rmse", "kPa", digits=1)]
    """Root mean square error on the fitted samples."""
    error_kPa: Annotated[float | None, Shown("error loading", "kPa", digits=1)]
    """Error of the curve while loading, without noise."""
    hysteresis_kPa: Annotated[float | None, Shown("hysteresis", "kPa", digits=1)]
    """How much more the same pressure reads while unloading."""
    hysteresis_percent: Annotated[float | None, Shown("of range", "%", digits=1)]
    """The same as a share of the range."""
    inside_kPa: Annotated[float | None, Shown("held out, inside", "kPa", digits=1)]
    """Error on recordings that were not fitted, where it is valid, at pressures that were fitted."""
    above_kPa: Annotated[float | None, Shown("above", "kPa", digits=1)]
    """The same at higher ones."""


def recording_row(recording: PatchRecording) -> SkinRecordingRow:
    """Count what is wrong with the taxels of a recording.

    Args:
        recording: The recording.

    Returns:
        Its row.
    """
    number = Counter(reason for reasons in recording.faults for reason in reasons)
    return SkinRecordingRow(
        recording=recording_name(recording),
        use=recording.use.value,
        messages=len(recording.seconds),
        highest_kPa=1e-3 * recording.cycle.highest,
        rest_kPa=1e-3 * recording.cycle.rest_pressure,
        valid_taxels=int(np.count_nonzero(recording.valid)),
        **{name.name.lower(): number[name] for name in TaxelFault},
    )


def recording_name(recording: PatchRecording) -> str:
    """Name a recording.

    Args:
        recording: The recording.

    Returns:
        Experiment and label of the interval.
    """
    return f"{recording.experiment}: {recording.label}"


def taxel_row(taxel: CalibratedTaxel, inside: float | None, above: float | None) -> TaxelRow:
    """Show what is known of a taxel.

    Args:
        taxel: The taxel.
        inside: Its error where it was not fitted, at pressures that were; Pa.
        above: The same at higher ones; Pa.

    Returns:
        Its row.
    """
    share = taxel.hysteresis_share
    return TaxelRow(
        taxel=taxel.taxel,
        left_out=", ".join(taxel.left_out) or None,
        range_counts=taxel.range_counts,
        rmse_kPa=in_kPa(taxel.rmse_pa),
        error_kPa=in_kPa(taxel.error_pa),
        hysteresis_kPa=in_kPa(taxel.hysteresis_pa),
        hysteresis_percent=None if share is None else 100.0 * share,
        inside_kPa=in_kPa(inside),
        above_kPa=in_kPa(above),
    )


def in_kPa(value: float | None) -> float | None:
    """Turn Pa into kPa.

    Args:
        value: A pressure; Pa.

    Returns:
        The pressure in kPa; None for none, and for one that is not known.
    """
    return None if value is None or not np.isfinite(value) else 1e-3 * value


_DRAWN = 10
"""Taxels whose samples are drawn: more would hide each other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelPicture(ArrayRecord):
    """A recording of pressure, and the curves of one taxel."""

    recording: str
    """Recording."""
    seconds: FloatArray = field(metadata=array("n"))
    """Instants; shape (n,); s."""
    pressure: FloatArray = field(metadata=array("n"))
    """Pressure above that at rest; shape (n,); Pa."""
    fall: FloatArray = field(metadata=array("n", "k"))
    """Counts below rest of valid taxels, spread over all; shape (n, k)."""
    mean_fall: FloatArray = field(metadata=array("n"))
    """Mean over all valid taxels; shape (n,); counts."""
    names: tuple[str, ...] = field(metadata=names("k"))
    """Names of the k taxels."""
    curves: Mapping[str, FloatArray]
    """Curves of the first of them at `levels`, by their forms; Pa."""
    levels: FloatArray = field(metadata=array(None))
    """Counts below rest at which they are given; shape (m,)."""
    highest: float
    """Highest fitted pressure; Pa."""


def taxel_picture(
    recording: PatchRecording,
    name: str,
    columns: Sequence[int],
    curves: Mapping[CurveKind, Sequence[TaxelCurve | None]],
    highest: float,
) -> TaxelPicture:
    """Choose what is drawn of a recording that was fitted.

    Args:
        recording: The recording.
        name: Its name.
        columns: Column of every taxel.
        curves: Curves of every taxel by their forms.
        highest: Highest fitted pressure; Pa.

    Returns:
        Taxels with a curve, evenly spread over their ranges, the one in the middle first.
    """
    reach = {k: curve.range_counts for k, curve in enumerate(next(iter(curves.values()))) if curve is not None}
    ranked = sorted(reach, key=reach.__getitem__)
    middle = ranked[len(ranked) // 2]
    spread = [ranked[place] for place in np.linspace(0, len(ranked) - 1, min(_DRAWN, len(ranked))).astype(int)]
    drawn = list(dict.fromkeys([middle, *spread]))
    fall = recording.cycle.fall
    levels = np.linspace(0.0, float(fall[:, middle].max()) + 3.0, 200)
    chosen = {kind: own[middle] for kind, own in curves.items()}
    return TaxelPicture(
        recording=name,
        seconds=recording.seconds,
        pressure=recording.cycle.pressure,
        fall=fall[:, drawn],
        mean_fall=fall[:, ranked].mean(axis=1),
        names=tuple(f"taxel {columns[k]}" for k in drawn),
        curves={kind.value: curve.pressure(levels) for kind, curve in chosen.items() if curve is not None},
        levels=levels,
        highest=highest,
    )

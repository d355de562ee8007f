# SPDX-License-Identifier: BSD-3-Clause
"""What contacts on skin amount to over an interval, and what makes estimates with skin doubtful."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from forcetorque.estimation.estimate import IntervalEstimates
from forcetorque.recording.recording import Use
from forcetorque.results.row import Row, Shown


class SkinContactSummary(Row):
    """One contact on skin over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    contact: Annotated[str, Shown("contact on skin")]
    """Patch and place of the contact; a place is taken again when a contact was let go."""
    identities: tuple[int, ...]
    """Numbers of the contacts that had it, as `forcetorque skin wrench` has them."""
    samples: Annotated[int, Shown("samples")]
    """Number of samples in which it touches."""
    push_mean_N: Annotated[float, Shown("push", "N", digits=2)]
    """Mean norm of the force that skin feels."""
    force_mean_N: Annotated[float | None, Shown("force", "N", digits=2)]
    """Mean norm of the force with what sensors tell of its tangential part; none where that is not determined."""
    force_sd_N: Annotated[float | None, Shown("sd", "N", digits=2)]
    """Root mean square of the standard deviation of that force, all components together."""
    beyond_range: Annotated[int, Shown("beyond range")]
    """Samples in which a taxel reads more than it was calibrated for."""


def skin_rows(span: IntervalEstimates) -> Iterator[SkinContactSummary]:
    """Sum up contacts on skin.

    Args:
        span: Estimates over an interval.

    Yields:
        A row for each contact that touches in it.
    """
    for source in span.skin:
        there = np.isfinite(source.centre).all(axis=1)
        if span.uncertain is None or not there.any():
            continue
        name = source.contact.name
        force, sd = (values[there][:, :3] for values in (span.uncertain.contact(name), span.uncertain.contact_sd(name)))
        told = np.isfinite(force).all(axis=1)
        yield SkinContactSummary(
            interval=span.interval.label,
            contact=name,
            identities=tuple(np.unique(source.identity[there]).tolist()),
            samples=int(there.sum()),
            push_mean_N=float(np.linalg.norm(source.wrench[there, :3], axis=1).mean()),
            force_mean_N=float(np.linalg.norm(force[told], axis=1).mean()) if told.any() else None,
            force_sd_N=float(np.sqrt((sd[told] ** 2).sum(axis=1).mean())) if told.any() else None,
            beyond_range=int(source.beyond_range[there].sum()),
        )


def skin_doubts(span: IntervalEstimates, exact: tuple[str, ...], resting: tuple[str, ...]) -> Iterator[str]:
    """Say what makes estimates with skin doubtful.

    Args:
        span: Estimates over an interval.
        exact: Sensors whose errors nobody predicts.
        resting: Sensors whose offset is that of the calibration intervals, in which nothing is to touch the robot.

    Yields:
        Sentences.
    """
    if span.uncertain is None:
        return
    label = span.interval.label
    for hidden in span.uncertain.undetermined:
        yield f"{label}: {hidden.sentence}; those cells are empty"
    for source in span.skin:
        beyond = int(source.beyond_range.sum())
        if beyond:
            yield (
                f"{label}: {source.contact.name!r} presses a taxel beyond what it was calibrated for in {beyond} of "
                f"{len(source.beyond_range)} samples: its force is extrapolated there"
            )
    touched = int(np.count_nonzero(np.any([source.identity > 0 for source in span.skin], axis=0)))
    if resting and touched and span.interval.use is Use.CALIBRATION:
        yield (
            f"{label}: skin is touched in {touched} of {len(span.stamp_ns)} samples of a calibration interval, and the "
            f"offset of {', '.join(resting)} is taken there as if nothing touched; leave these samples out, or read by "
            "a calibration (-c)"
        )
    if exact:
        yield f"{label}: readings of {', '.join(exact)} count as exact, as no calibration predicts their errors"

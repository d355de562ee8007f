# SPDX-License-Identifier: BSD-3-Clause
"""Which sensor a calibration is of, which data and loads it was fitted on, and how its lambda was chosen."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Final, Self

import numpy as np
from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.stored_table import StoredTable
from forcetorque.base.wrench import MeasureDirection
from forcetorque.recording.fingerprint import joined_fingerprint, kept_hashes, share_in
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts

_ROUNDING: Final = 1e-6
"""By how much shares and components of directions may lie outside of their range."""
_COPY: Final = 0.9
"""Share of readings from which a recording is called a copy: logs may be cut and rounded differently."""


class SensorIdentity(StoredTable):
    """Which sensor, mounted where, read how."""

    name: str
    """Name in the robot model."""
    serial: str = Field(min_length=1)
    """Serial number."""
    robot: str
    """Name of the robot."""
    frame: str
    """Frame of the reading: child, parent or sensor frame of the robot model's tag."""
    measure_direction: MeasureDirection
    """Who acts on whom in the reading."""


class Content(StoredTable):
    """By what the samples of an interval are known again in another log (`recording.fingerprint`)."""

    quantity: str
    """Quantity of the reading as it was logged: `raw` or `wrench`."""
    windows: str = Field(pattern=r"^([0-9a-f]{16})+$", repr=False)
    """Hashes of windows of its samples, hexadecimal numbers of 16 letters one behind the other."""

    @classmethod
    def joined(cls, contents: Sequence[Content]) -> Content | None:
        """Put the parts of an interval together.

        Args:
            contents: By what the samples of each are known, in the order of time.

        Returns:
            By what all are known; None where there is no part.
        """
        if not contents:
            return None
        return cls(quantity=contents[0].quantity, windows=joined_fingerprint([one.windows for one in contents]))


class FittedInterval(StoredTable):
    """A stretch of time that was fitted."""

    label: str
    """Label of the interval."""
    start_ns: int
    """Start; ns on the recording's clock."""
    end_ns: int
    """End; ns on the recording's clock."""
    session: str | None = None
    """Session that it belongs to; None in files of earlier versions."""
    experiment: str | None = None
    """Experiment that it is of; None in files of earlier versions, where there was one."""
    content: Content | None = None
    """By what its samples are known again; None in files of earlier versions, and where they hardly change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedReadings:
    """A recording with readings that another one has too."""

    recording: str
    """Its name."""
    other: str
    """Name of the recording that counts, with which it shares most."""
    share: float
    """Share of its readings that recordings that count have too, estimated of the kept hashes."""
    samples: float
    """Number of its samples."""

    def __str__(self) -> str:
        if self.share >= _COPY:
            return f"{self.recording!r} has readings of {self.other!r} again, and readings count once"
        percent = max(round(100.0 * self.share), 1)
        return (
            f"{self.recording!r} has about {percent} % of its readings in common with {self.other!r}, and readings "
            "count once"
        )

    @property
    def left_out(self) -> str:
        """Say that it is left out, and what of it no other recording has."""
        if self.share >= _COPY:
            return f"{self}; it is left out"
        lost = (1.0 - self.share) * self.samples
        return f"{self}; it is left out, with about {lost:.0f} of {self.samples:.0f} samples that are in no other"


def readings_twice(intervals: Iterable[tuple[str, float, Content | None]]) -> dict[str, SharedReadings]:
    """Find recordings that have readings of a longer one, such as copies of a log under another name.

    Recordings are visited in the order of their samples, the most first; of equally many the first one counts.

    Args:
        intervals: For every interval of a sensor the name of its recording, its number of samples, or its duration
            where only `str` is wanted, and by what the samples are known again.

    Returns:
        By name of each such recording what it shares.
    """
    recordings: dict[str, dict[Content | None, float]] = {}
    for name, samples, content in intervals:
        own = recordings.setdefault(name, {})
        own[content] = own.get(content, 0.0) + samples  # blocks of an interval have one content
    owners: dict[tuple[str, int], list[tuple[str, Content]]] = {}
    shared: dict[str, SharedReadings] = {}
    for name, own in sorted(recordings.items(), key=lambda item: -sum(item[1].values())):
        hashes = {one: kept_hashes(one.windows) for one in own if one is not None}
        common: dict[str, float] = {}
        for one, values in hashes.items():
            keys = [(one.quantity, value) for value in values.tolist()]
            for other, content in dict.fromkeys(owner for key in keys for owner in owners.get(key, ())):
                seen = own[one] * share_in(values, kept_hashes(content.windows))
                common[other] = common.get(other, 0.0) + seen
        samples = sum(own.values())
        if common:
            share = min(sum(common.values()) / samples, 1.0)
            other = max(common, key=common.__getitem__)
            shared[name] = SharedReadings(recording=name, other=other, share=share, samples=samples)
            continue
        for one, values in hashes.items():
            for value in values.tolist():
                owners.setdefault((one.quantity, value), []).append((name, one))
    return shared


class Provenance(StoredTable):
    """What the fit was made from."""

    code_version: str
    """Version of this library."""
    created: str
    """Date and time of the fit, ISO 8601, UTC."""
    experiment: str
    """Name of the experiment."""
    intervals: tuple[FittedInterval, ...]
    """The fitted intervals."""
    samples: int = Field(ge=0)
    """Number of fitted samples."""
    means: int | None = Field(default=None, ge=0)
    """Number of their means over a second that the generative model was fitted to; None where single samples were, and
    in earlier files."""
    dropped: int = Field(ge=0)
    """Samples of the intervals that were left out."""
    unusable: UnusableCounts = UnusableCounts()
    """Those among them that say nothing of the load: frozen, saturated, repeated; zeros in earlier files."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment file names it."""
    added: tuple[str, ...] = ()
    """What experiment files add to their logs: clocks, frames, joints, rates; in sentences."""


def _lambda_from_file(value: Any) -> Any:
    return math.inf if value == "infinite" else value


Lambda = Annotated[
    float,
    BeforeValidator(_lambda_from_file),
    Field(ge=0.0),
    PlainSerializer(lambda value: "infinite" if math.isinf(value) else value, return_type=float | str),
    WithJsonSchema({"anyOf": [{"type": "number", "minimum": 0}, {"const": "infinite"}]}),
]
"""Lambda in counts2; `infinite`, which JSON has no number for, means that the prior was kept."""


class Selection(StoredTable):
    """How lambda came about."""

    rule: str
    """The rule, in words; `given` where the caller chose."""
    lambda_counts2: tuple[Lambda, ...] = ()
    """Candidates."""
    held_out_rmse: tuple[float, ...] = ()
    """Held-out error of every candidate; 1 N counted like 1 N m."""
    worst_ratio_to_prior: tuple[float, ...] = ()
    """Largest ratio over the blocks of held-out squared error to that of the prior."""
    chosen_on: tuple[FittedInterval, ...] = ()
    """Intervals that were not fitted but that the choice was made on: a verdict on them flatters."""


_Wrench = Annotated[FloatArray, ArrayField((6,))]


class FittedLoads(StoredTable):
    """Range of the fitted loads, as the calibration reads them: without offset and variables.

    Loads of one motion go together, such as a weight and its moment, so that a load can lie within the range of every
    component and be none that was seen. Hence the principal directions. They are of loads, not of channels: what lies
    beyond is then the least by which a load would have to change, whereas channels add up to wrenches that cancel.
    """

    minimum: _Wrench
    """Smallest load per component; N, N m."""
    maximum: _Wrench
    """Largest load per component; N, N m."""
    directions: Annotated[FloatArray, ArrayField((6, 6))]
    """Principal directions of the loads, widest first, one per row, orthonormal for forces and moments in units of the
    largest deviation of their kind; per N, per N m."""
    direction_minimum: _Wrench
    """Smallest load along each direction."""
    direction_maximum: _Wrench
    """Largest load along each direction."""

    @classmethod
    def of(cls, loads: Sequence[FloatArray], deviation: FloatArray) -> FittedLoads:
        """Sum up loads.

        Args:
            loads: Fitted loads, an array per interval; shape (n, 6) each; N, N m.
            deviation: Standard deviation of the reference; shape (6,); N, N m.

        Returns:
            Their range.
        """
        together = np.concatenate(loads)
        sizes = np.repeat([deviation[:3].max(), deviation[3:].max()], 3)
        scale = np.where(sizes > 0.0, sizes, 1.0)
        _, vectors = np.linalg.eigh(np.cov((together / scale).T, bias=True))
        directions = vectors.T[::-1] / scale
        along = together @ directions.T
        return cls(
            minimum=together.min(axis=0),
            maximum=together.max(axis=0),
            directions=directions,
            direction_minimum=along.min(axis=0),
            direction_maximum=along.max(axis=0),
        )


class Validity(StoredTable):
    """Where the fit is supported by data."""

    raw_minimum_counts: Annotated[FloatArray, ArrayField((None,))]
    """Smallest fitted reading per channel; counts."""
    raw_maximum_counts: Annotated[FloatArray, ArrayField((None,))]
    """Largest fitted reading per channel; counts."""
    expected_wrench_sd: Annotated[FloatArray, ArrayField((6,), minimum=0.0)]
    """Standard deviation of the reference wrench; N, N m."""
    rank: int
    """Number of raw directions that moved at all."""
    condition: float | None
    """Ratio of the largest to the smallest deviation over the raw directions; None if infinite."""
    directions: Annotated[FloatArray, ArrayField((None, None))]
    """Raw directions, strongest first, one per row; shape (c, c)."""
    variance_counts2: Annotated[FloatArray, ArrayField((None,), minimum=0.0)]
    """Variance of the raw reading along each direction; counts2."""
    explained: Annotated[FloatArray, ArrayField((None,))]
    """Share of each variance that the reference explains."""
    excited: tuple[bool, ...]
    """Whether the loads move the direction more than anything else does."""
    loads: FittedLoads | None = None
    """Range of the fitted loads; None in files of earlier versions, where the ranges of the channels stand for it."""

    @model_validator(mode="after")
    def _of_one_length(self) -> Self:
        count = len(self.variance_counts2)
        if not len(self.explained) == len(self.excited) == count or self.directions.shape != (count, count):
            raise ValueError(f"expected explained, excited and directions of {count} raw directions, as the variances")
        for name, values, least in (("explained", self.explained, 0.0), ("directions", self.directions, -1.0)):
            if not np.all((least - _ROUNDING <= values) & (values <= 1.0 + _ROUNDING)):
                raise ValueError(f"{name}: expected numbers of {least:g} to 1")
        return self

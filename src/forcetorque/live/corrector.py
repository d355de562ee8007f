# SPDX-License-Identifier: BSD-3-Clause
"""Corrected wrenches of one or more sensors, sample by sample, by the same sensor model as offline."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import RecordingError, ShapeError
from forcetorque.base.units import NORMAL_95
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.live.bias_tracking import BiasTracker, Tracking
from forcetorque.live.choices import FaultPolicy, HeldQuantity, OffsetSource
from forcetorque.live.sample_status import FAULTS, Status
from forcetorque.live.sensor_terms import SensorTerms, sensor_terms
from forcetorque.live.tare_samples import TareSamples
from forcetorque.live.tool import Tool
from forcetorque.recording.frozen_and_saturated_samples import FROZEN_SECONDS, SATURATION_SHARE


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CorrectorOptions:
    """How samples are corrected, for all sensors of a corrector."""

    quantity: HeldQuantity = HeldQuantity.RAW
    """What samples hold."""
    session: str | None = None
    """Power cycle of the calibration that gives the fitted offset; None for the last."""
    offset: OffsetSource = OffsetSource.FITTED
    """Where the offset comes from."""
    tare_s: float = 1.0
    """Time that a tare takes; s."""
    policy: FaultPolicy = FaultPolicy.FLAG
    """What becomes of samples with a fault."""
    limit_counts: float | None = None
    """Largest magnitude of a raw sample; counts; None for not known: saturation is then not seen in the samples."""
    frozen_after_s: float = FROZEN_SECONDS
    """Time for which all channels may repeat one reading; s; infinite for any."""
    tool: Tool | None = None
    """What the sensors carry; None where a tare is to take all of the reading."""
    take_tool_off: bool = False
    """Whether the weight of the tool is taken off the wrench."""
    tracking: Tracking = field(default_factory=Tracking)
    """How the bias is tracked."""

    def __post_init__(self) -> None:
        for name, value in (("tare_s", self.tare_s), ("frozen_after_s", self.frozen_after_s)):
            if not value > 0.0:
                raise RecordingError(f"{name}: expected more than 0, got {value}")
        if self.limit_counts is not None and not self.limit_counts > 0.0:
            raise RecordingError(f"limit_counts: expected more than 0, got {self.limit_counts}")
        if self.take_tool_off and self.tool is None:
            raise RecordingError("take_tool_off: expected a tool, got none")


@dataclass(slots=True, kw_only=True, eq=False)
class Corrected:
    """One corrected sample of s sensors. The next sample overwrites the arrays: copy what is kept."""

    wrench: FloatArray
    """Wrenches in the frames of the readings; shape (s, 6); N, N m."""
    half_width: FloatArray
    """Half-widths of their 95 % intervals, by the posterior of the calibration and the bias; noise of the single sample
    is not in them; shape (s, 6); N, N m; NaN without a posterior."""
    status: IntArray
    """Bits of `Status`; shape (s,)."""


class Corrector:
    """Corrects samples of sensors that are read together. All arrays are allocated once."""

    def __init__(self, calibrations: Calibration | Sequence[Calibration], options: CorrectorOptions | None = None):
        """Prepare.

        Args:
            calibrations: A calibration per sensor, in the order of the samples.
            options: How samples are corrected; a plain correction by the calibrations if None.

        Raises:
            RecordingError: If there is no calibration, or one does not have the session that is named.
            FitError: If samples are wrenches, and a prior matrix cannot be inverted.
        """
        given = [calibrations] if isinstance(calibrations, Calibration) else list(calibrations)
        if not given:
            raise RecordingError("calibrations: expected at least one, got none")
        self.options = options or CorrectorOptions()
        self.calibrations = tuple(given)
        own_offset = self.options.offset is not OffsetSource.FITTED
        self._terms = [
            sensor_terms(one, self.options.quantity, self.options.session, with_offset_error=not own_offset)
            for one in given
        ]
        self._prepare(self._terms)
        self._is_plain = not own_offset and not self.options.take_tool_off
        self._result = Corrected(wrench=self._wrench, half_width=self._half_width, status=self._status)
        tool = self.options.tool
        self._per_gravity = [] if tool is None else [tool.per_gravity(one.sensor.measure_direction) for one in given]
        self.bias, self.bias_variance = np.zeros((2, *self._wrench.shape))
        self.tracker: BiasTracker | None = None
        self._tare: TareSamples | None = None
        if own_offset:
            self.tare()

    @property
    def channels(self) -> int:
        """Channels of a row of a sample: of the sensor that has most."""
        return self._raw.shape[1]

    @property
    def taring(self) -> BoolArray:
        """Of which sensors a tare collects; shape (s,)."""
        return np.zeros(len(self._terms), dtype=np.bool_) if self._tare is None else self._tare.collecting.copy()

    @property
    def variables(self) -> tuple[tuple[str, ...], ...]:
        """Names of the variables of every sensor, in the order in which `correct` takes them."""
        return tuple(term.variables for term in self._terms)

    def _prepare(self, terms: Sequence[SensorTerms]) -> None:
        """Allocate; sensors with fewer channels or variables are filled up with zeros."""
        count = len(terms)
        c, v = (max(term.matrix.shape[1] for term in terms), max(len(term.variables) for term in terms))
        self._counts = [term.matrix.shape[1] for term in terms]
        # the last column of a sample is 1 and meets the offset
        self._sample = np.zeros((count, c + v + 1))
        self._sample[:, -1] = 1.0
        self._raw, self._values = self._sample[:, :c], self._sample[:, c : c + v]
        self._matrix, self._reference = np.zeros((count, 6, c + v + 1)), np.zeros((count, v))
        self._fitted = np.zeros((count, 6))
        # wrench, variables and 1 for the offset, which meet the covariance twice
        d = 6 + v + 1
        self._load = np.zeros((count, d))
        self._load[:, -1] = 1.0
        self._wrench = self._load[:, :6]
        covariance = np.zeros((count, 6, d, d))
        for k, term in enumerate(terms):
            own = len(term.variables)
            self._matrix[k, :, : term.matrix.shape[1]] = term.matrix
            self._matrix[k, :, c : c + own] = term.coefficients
            self._matrix[k, :, -1] = self._fitted[k] = term.offset
            self._reference[k, :own] = term.reference_values
            used = np.r_[np.arange(6 + own), d - 1]
            covariance[k][:, used[:, None], used] = term.covariance * NORMAL_95**2
        # a tare takes off the errors of matrix and coefficients at its load, so they act on the change since then
        self._tared, self._at_tare, self._since = np.zeros((3, count, d))
        self._covariance = covariance.reshape(count, 6 * d, d)
        self._half_width = np.zeros((count, 6))
        self._held = np.full((2, count, 6), np.nan)
        self._status = np.zeros(count, dtype=np.int64)
        self._half_products, self._size = np.zeros((count, 6, d)), np.zeros((count, c))
        self._unloaded, self._weight = np.zeros((2, count, 6))
        limit = self.options.limit_counts
        self._limit = None if limit is None else (1.0 - SATURATION_SHARE) * limit
        self._reaches = np.zeros((count, c), dtype=bool)
        # one product gives the sums of channels, to see equal samples, and of variables
        self._sums, self._ones = np.zeros((count, 2)), np.zeros((self._sample.shape[1], 2))
        self._ones[:c, 0] = self._ones[c:-1, 1] = 1.0
        self._last_sums, self._previous = [[math.nan]] * count, np.full((count, c), np.nan)
        self._same_since: list[int | None] = [None] * count
        self._stamp_ns: int | None = None
        # views with a last axis for products of matrix and vector
        self._columns = (self._sample[..., None], self._wrench[..., None], self._half_width[..., None])
        self._load_column, self._products_column = self._since[..., None], self._half_products.reshape(count, 6 * d, 1)
        self._quadratic = [(k, term.quadratic) for k, term in enumerate(terms) if term.quadratic is not None]

    def tare(self) -> None:
        """Begin a tare: the offset is that of the samples of the next `tare_s` seconds, in which nothing may touch.

        Raises:
            RecordingError: If the offset is that of the calibration.
        """
        if self.options.offset is OffsetSource.FITTED:
            raise RecordingError("tare: expected the offset 'tare' or 'tracked', got 'fitted'")
        self._tare, self.tracker = TareSamples(self.options.tare_s, len(self._terms)), None

    def restart_time(self) -> None:
        """Let stamps begin anew, because the sender did."""
        self._stamp_ns, self._same_since = None, [None] * len(self._same_since)
        if self.tracker is not None:
            self.tracker.restart_time()
        if self._tare is not None:
            self._tare.restart_time()

    def correct(
        self,
        samples: Any,
        *,
        variables: Any = None,
        stamp_ns: int | None = None,
        gravity: Any = None,
        faults: Sequence[int] | None = None,
    ) -> Corrected:
        """Correct one sample of every sensor.

        Args:
            samples: Raw counts, or wrenches by the prior; shape (s, c), or (c,) of one sensor; counts, or N and N m.
                Rows of sensors with fewer channels are filled up by zeros.
            variables: Values of the variables; shape (s, v), or (v,) of one sensor; in their units.
            stamp_ns: Time of the sample; ns. Needed by a tare, tracking, and to see frozen and repeated samples.
            gravity: Acceleration of free fall in the frame of every reading; shape (s, 3), or (3,) of one sensor; m/s2.
                Needed with a tool.
            faults: Bits of `Status` per sensor that the source knows of, such as `status_of_device` of its code.

        Returns:
            Wrenches, intervals and status; overwritten by the next sample.

        Raises:
            ShapeError: If the shapes are not these.
            RecordingError: If variables, time or gravity are needed and missing.
        """
        raw, has_variables = self._raw, self._reference.shape[1] > 0
        if samples is None or (has_variables and variables is None):
            raise ShapeError(self._expected(samples, variables))
        try:
            raw[:] = samples
            if has_variables:
                self._values[:] = variables
        except (TypeError, ValueError):
            raise ShapeError(self._expected(samples, variables)) from None
        if has_variables:
            np.subtract(self._values, self._reference, out=self._values)
        faulty = self._look(stamp_ns, faults)
        column, wrench, half_width = self._columns
        np.matmul(self._matrix, column, out=wrench)
        for k, quadratic in self._quadratic:
            self._wrench[k] = quadratic.corrected(self._wrench[k])
        if not self._is_plain:
            self._offsets(stamp_ns, gravity)
        if has_variables:
            self._load[:, 6:-1] = self._values
        load = self._load_column
        np.subtract(self._load, self._tared, out=self._since)
        np.matmul(self._covariance, load, out=self._products_column)
        np.matmul(self._half_products, load, out=half_width)
        if not self._is_plain:
            self._finish()
        np.sqrt(self._half_width, out=self._half_width)
        if faulty or self.options.policy is FaultPolicy.HOLD:
            self._apply_policy()
        return self._result

    def _expected(self, samples: Any, variables: Any) -> str:
        names = "; ".join(", ".join(names) or "none" for names in self.variables)
        return (
            f"expected samples of shape {self._raw.shape} and variables of shape {self._values.shape} ({names}), got "
            f"{np.shape(samples)} and {None if variables is None else np.shape(variables)}"
        )

    def _look(self, stamp_ns: int | None, faults: Sequence[int] | None) -> bool:
        """Set the status; whether any sensor has a fault."""
        status, faulty = self._status, False
        status[:] = 0
        with np.errstate(invalid="ignore"):  # infinity less infinity
            sums = np.dot(self._sample, self._ones, out=self._sums).tolist()
        if not math.isfinite(sum(channels + values for channels, values in sums)):
            finite = np.isfinite(self._sample)
            self._sample[~finite] = np.nan  # infinity less infinity would be an error of arithmetic
            status[~finite.all(axis=1)] |= Status.NOT_FINITE
            faulty = True
        if self._limit is not None and self._is_saturated(self._limit):
            faulty = True
        if faults is not None and any(faults):
            status |= faults
            faulty = True
        if stamp_ns is not None:
            faulty = self._look_at_time(sums, stamp_ns) or faulty
        return faulty

    def _is_saturated(self, limit: float) -> bool:
        for k, term in enumerate(self._terms):
            # saturation is of counts, which a wrench does not show
            counts = self._raw[k, : self._counts[k]] if term.to_counts is None else term.to_counts @ self._raw[k, :6]
            np.abs(counts, out=self._size[k, : len(counts)])
        np.greater_equal(self._size, limit, out=self._reaches)
        if not self._reaches.any():
            return False
        self._status[self._reaches.any(axis=1)] |= Status.SATURATED
        return True

    def _look_at_time(self, sums: list[list[float]], stamp_ns: int) -> bool:
        before, faulty = self._stamp_ns, False
        if before is not None and stamp_ns <= before:
            self._status |= Status.REPEATED if stamp_ns == before else Status.LATE
            return True
        for k, (now, last) in enumerate(zip(sums, self._last_sums, strict=True)):
            if now[0] == last[0] and (self._raw[k] == self._previous[k]).all():
                since = self._same_since[k]
                if since is None:
                    self._same_since[k] = before
                elif (stamp_ns - since) * 1e-9 > self.options.frozen_after_s:
                    self._status[k] |= Status.FROZEN
                    faulty = True
            else:
                self._same_since[k] = None
        self._previous[:] = self._raw
        self._last_sums, self._stamp_ns = sums, stamp_ns
        return faulty

    def _offsets(self, stamp_ns: int | None, gravity: Any) -> None:
        """Take bias and tool off the wrenches by the fitted offsets, and learn the bias."""
        if self.options.tool is not None:
            self._weigh(gravity)
        usable = (self._status & FAULTS) == 0
        if self.options.offset is not OffsetSource.FITTED:
            if stamp_ns is None:
                raise RecordingError("a tare needs the time of every sample: expected stamp_ns, got none")
            np.subtract(self._wrench, self._weight, out=self._unloaded)
            self._learn(stamp_ns, usable)
        np.subtract(self._wrench, self.bias, out=self._wrench)

    def _weigh(self, gravity: Any) -> None:
        if gravity is None:
            raise RecordingError("a tool needs gravity in the frame of the reading with every sample, got none")
        directions = np.asarray(gravity, dtype=np.float64)
        # every reading has a frame of its own
        if directions.size != 3 * len(self._per_gravity) or directions.shape[-1:] != (3,):
            raise ShapeError(f"gravity: expected shape ({len(self._per_gravity)}, 3), got {directions.shape}")
        for k, matrix in enumerate(self._per_gravity):
            self._weight[k] = matrix @ directions.reshape(-1, 3)[k]

    def _learn(self, stamp_ns: int, usable: BoolArray) -> None:
        temperature, tracker = self._temperature(), self.tracker
        if self._tare is not None:
            collecting = self.taring
            self._status[collecting] |= Status.TARING
            self._at_tare[usable, :6], self._at_tare[usable, 6:-1] = self._weight[usable], self._values[usable]
            for k in self._tare.add(self._unloaded, stamp_ns, usable):
                self._end_tare(k, self._tare, temperature)
            if not self._tare.collecting.any():
                self._tare = None
            usable &= ~collecting
        if tracker is not None:  # not one that this sample began
            if tracker.add(self._unloaded, stamp_ns, temperature, usable.tolist()):
                self.bias[:], self.bias_variance[:] = tracker.bias, tracker.variance
            if tracker.in_contact.any():
                self._status[tracker.in_contact] |= Status.CONTACT

    def _end_tare(self, k: int, tare: TareSamples, temperature: FloatArray | None) -> None:
        self.bias[k], self.bias_variance[k] = tare.bias(k)
        tool = self.options.tool
        if tool is not None:
            # what is not known of the tool is in the bias that keeps it; gravity from the weight that it makes now
            sign = np.sign(self._per_gravity[k][0, 0])
            gravity = self._weight[k, :3] * sign / tool.mass_kg if tool.mass_kg else np.zeros(3)
            self.bias_variance[k] += tool.weight_variance(gravity)
        self._tared[k] = self._at_tare[k]
        if self.options.offset is OffsetSource.TRACKED:
            if self.tracker is None:
                self.tracker = BiasTracker(self.options.tracking, self.bias, self.bias_variance, temperature)
            self.tracker.begin(k, self.bias[k], self.bias_variance[k], temperature)

    def _temperature(self) -> FloatArray | None:
        if not self.options.tracking.with_temperature or self.options.offset is not OffsetSource.TRACKED:
            return None
        if any("temperature" not in names for names in self.variables):
            raise RecordingError(
                "tracking with temperature: expected calibrations with the variable 'temperature', got one without"
            )
        places = [names.index("temperature") for names in self.variables]
        return self._values[np.arange(len(places)), places]

    def _finish(self) -> None:
        """Add the variance of the bias, in squares of half-widths."""
        if self.options.offset is not OffsetSource.FITTED:
            self._half_width += NORMAL_95**2 * self.bias_variance
        np.maximum(self._half_width, 0.0, out=self._half_width)
        if self.options.take_tool_off:  # not before: the errors of the matrix act on the weight too
            np.subtract(self._wrench, self._weight, out=self._wrench)

    def _apply_policy(self) -> None:
        faulty = (self._status & FAULTS) != 0
        if self.options.policy is FaultPolicy.REFUSE:
            self._wrench[faulty] = self._half_width[faulty] = np.nan
        elif self.options.policy is FaultPolicy.HOLD:
            good = ~faulty
            self._held[0, good], self._held[1, good] = self._wrench[good], self._half_width[good]
            self._wrench[faulty], self._half_width[faulty] = self._held[0, faulty], self._held[1, faulty]

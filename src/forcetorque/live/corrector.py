# SPDX-License-Identifier: BSD-3-Clause
"""Corrected wrenches of one or more sensors, sample by sample, by the same sensor model as offline."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.compiled_functions import announced
from forcetorque.base.errors import FitError, RecordingError, ShapeError, known_names
from forcetorque.base.units import NORMAL_95
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection
from forcetorque.experiment.calibration.sensor_model import measured_components, secondary_matrix
from forcetorque.live.bias_tracking_and_tare import BiasTracker, TareSamples, Tracking
from forcetorque.live.compiled_sample import BEFORE, NEVER, NOW, POLICIES, compiled_sample
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.option_values import FaultPolicy, HeldQuantity, OffsetSource
from forcetorque.live.sample_status import FAULTS, Status
from forcetorque.recording.frozen_and_saturated_samples import FROZEN_SECONDS, SATURATION_SHARE


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorTerms:
    """Model of one sensor, of samples of c numbers and v variables."""

    matrix: FloatArray
    """From the sample to the wrench; shape (6, c)."""
    coefficients: FloatArray
    """Of the variables; shape (6, v); N, N m per unit."""
    reference_values: FloatArray
    """Values at which the variables contribute nothing; shape (v,)."""
    offset: FloatArray
    """Fitted offset; shape (6,); N, N m."""
    session: str | None
    """Power cycle that the offset is of; None where the calibration has no names of them."""
    variables: tuple[str, ...]
    """Names of the variables."""
    quadratic: QuadraticCorrection | None
    """Quadratic terms; None for a linear sensor."""
    to_counts: FloatArray | None
    """From the sample back to counts; shape (6, 6); None where samples are counts."""
    covariance: FloatArray
    """Of every component, what the error has of loads, variables and offset: `d covariance d` is its variance for
    `d = (load, variables less reference values, 1)`; shape (6, 7 + v, 7 + v); NaN without a posterior."""


def sensor_terms(
    calibration: Calibration, quantity: HeldQuantity, session: str | None, *, with_offset_error: bool
) -> SensorTerms:
    """Take the terms of a calibration.

    Args:
        calibration: The calibration.
        quantity: What samples hold.
        session: Power cycle whose offset is taken; None for the last.
        with_offset_error: Whether the error of the fitted offset counts.

    Returns:
        The terms.

    Raises:
        RecordingError: If the calibration has no such session.
        FitError: If samples are wrenches, and there is no prior that can be inverted, or the sensor measures fewer than
            six components.
    """
    if not measured_components(calibration.matrix).all():
        raise FitError(f"calibration of {calibration.sensor.name!r}: expected one of a sensor of six components")
    names = [entry.name for entry in calibration.sessions]
    if session is not None and session not in names:
        raise RecordingError(
            f"calibration of {calibration.sensor.name!r}: no session {session!r}; {known_names(session, names)}"
        )
    chosen = calibration if session is None else calibration.in_session(session)
    model = chosen.model
    matrix = model.matrix
    to_counts: FloatArray | None = None
    if quantity is HeldQuantity.WRENCH:
        if calibration.prior is None or calibration.prior.matrix.shape != (6, 6):
            raise FitError(
                f"calibration of {calibration.sensor.name!r}: samples that are wrenches need its prior matrix of six "
                "channels, got none; give raw counts"
            )
        matrix = secondary_matrix(model.matrix, calibration.prior.matrix)
        to_counts = np.asarray(np.linalg.inv(calibration.prior.matrix), dtype=np.float64)
    variables = tuple(variable.name for variable in calibration.variables)
    named = session if session is not None else next(reversed(names), None)
    return SensorTerms(
        matrix=matrix,
        coefficients=model.coefficients,
        reference_values=model.reference_values,
        offset=model.offset,
        session=named,
        variables=variables,
        quadratic=model.quadratic,
        to_counts=to_counts,
        covariance=_covariance(calibration.posterior, variables, named if with_offset_error else None),
    )


def _covariance(posterior: Posterior | None, variables: tuple[str, ...], session: str | None) -> FloatArray:
    """The posterior's, in the order of load, variables and offset; without a session the offset is known."""
    size = 7 + len(variables)
    if posterior is None:
        return np.full((6, size, size), np.nan)
    places = list(range(6))
    places += [6 + posterior.variables.index(name) if name in posterior.variables else -1 for name in variables]
    places.append(6 + len(posterior.variables) + posterior.sessions.index(session) if session is not None else -1)
    own = np.flatnonzero(np.array(places) >= 0)
    there = np.array(places)[own]
    covariance = np.zeros((6, size, size))
    of_rows = posterior.covariance[:, there[:, None], there]
    covariance[:, own[:, None], own] = np.einsum("ai,ijk->ajk", posterior.to_wrench**2, of_rows)
    return covariance


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
            raise RecordingError("take_tool_off: expected a tool, by --tool-mass and --tool-centre, got none")


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
        with announced("compiling the correction of live samples for this machine, once; it takes some seconds"):
            self._read, self._finish = compiled_sample()
        self._is_plain = not own_offset and not self.options.take_tool_off
        self._result = Corrected(wrench=self._wrench, half_width=self._half_width, status=self._status)
        tool = self.options.tool
        self._per_gravity = [] if tool is None else [tool.per_gravity(one.sensor.measure_direction) for one in given]
        self.tracker: BiasTracker | None = None
        self._tare: TareSamples | None = None
        self.tare_moved_N = np.zeros(len(given))
        """By how much the force moved during the last tare, 0 where nothing moved; shape (s,); N."""
        if own_offset:
            self.tare()

    @property
    def channels(self) -> int:
        """Channels of a row of a sample: of the sensor that has most."""
        return self._raw.shape[1]

    @property
    def power_cycles(self) -> tuple[str | None, ...]:
        """Power cycle whose fitted offset is taken, by sensor; None where there is none, or a tare gives the offset."""
        fitted = self.options.offset is OffsetSource.FITTED
        return tuple(term.session if fitted else None for term in self._terms)

    @property
    def taring(self) -> BoolArray:
        """Of which sensors a tare collects; shape (s,)."""
        return np.zeros(len(self._terms), dtype=np.bool_) if self._tare is None else self._tare.collecting.copy()

    @property
    def weight(self) -> FloatArray:
        """What the tool adds to the last reading; shape (s, 6); N, N m; overwritten by the next sample."""
        return self._weight

    @property
    def variables(self) -> tuple[tuple[str, ...], ...]:
        """Names of the variables of every sensor, in the order in which `correct` takes them."""
        return tuple(term.variables for term in self._terms)

    def _prepare(self, terms: Sequence[SensorTerms]) -> None:
        """Allocate; sensors with fewer channels or variables are filled up with zeros."""
        count, options = len(terms), self.options
        c, v = (max(term.matrix.shape[1] for term in terms), max(len(term.variables) for term in terms))
        # the last column of a sample is 1 and meets the offset
        self._sample = np.zeros((count, c + v + 1))
        self._sample[:, -1] = 1.0
        self._raw, self._values = self._sample[:, :c], self._sample[:, c : c + v]
        matrix, reference = np.zeros((count, 6, c + v + 1)), np.zeros((count, v))
        # wrench, variables and 1 for the offset, which meet the covariance twice
        d = 6 + v + 1
        self._load = np.zeros((count, d))
        self._load[:, -1] = 1.0
        self._wrench = self._load[:, :6]
        covariance = np.zeros((count, 6, d, d))
        for k, term in enumerate(terms):
            own = len(term.variables)
            matrix[k, :, : term.matrix.shape[1]] = term.matrix
            matrix[k, :, c : c + own] = term.coefficients
            matrix[k, :, -1] = term.offset
            reference[k, :own] = term.reference_values
            used = np.r_[np.arange(6 + own), d - 1]
            covariance[k][:, used[:, None], used] = term.covariance * NORMAL_95**2
        # a tare takes off the errors of matrix and coefficients at its load, so they act on the change since then
        self._tared, self._at_tare = np.zeros((2, count, d))
        self._half_width, self._status = np.zeros((count, 6)), np.zeros(count, dtype=np.int64)
        self._unloaded, self._weight = np.zeros((2, count, 6))
        self.bias, self.bias_variance = np.zeros((2, count, 6))
        # saturation is of counts, which a wrench does not show
        to_counts = np.array([term.to_counts for term in terms if term.to_counts is not None]).reshape(-1, 6, 6)
        counts = np.array([term.matrix.shape[1] for term in terms], dtype=np.int64)
        limit = math.inf if options.limit_counts is None else (1.0 - SATURATION_SHARE) * options.limit_counts
        self._clock_ns, self._same_since_ns = (np.full(size, NEVER, dtype=np.int64) for size in (2, count))
        self._read_arguments = (
            self._sample, reference, matrix, to_counts, counts, limit, 1e9 * options.frozen_after_s, self._clock_ns,
            np.full((count, c), np.nan), self._same_since_ns, self._load, self._status,
        )  # fmt: skip
        self._finish_arguments = (
            self._load, self.bias, self.bias_variance, self._tared, covariance,
            self._weight if options.take_tool_off else np.zeros((count, 6)), POLICIES[options.policy],
            np.full((2, count, 6), np.nan), self._status, self._half_width, np.zeros(d),
        )  # fmt: skip
        self._quadratic = [(k, term.quadratic) for k, term in enumerate(terms) if term.quadratic is not None]

    def tare(self) -> None:
        """Begin a tare: the offset is that of the samples of the next `tare_s` seconds, in which nothing may touch.

        Where the bias is tracked, a sensor whose force moves during them collects anew, until it does not.

        Raises:
            RecordingError: If the offset is that of the calibration.
        """
        if self.options.offset is OffsetSource.FITTED:
            raise RecordingError("tare: expected the offset 'tare' or 'tracked', got 'fitted'")
        tracking = self.options.tracking
        self.tracker = None
        self._tare = TareSamples(
            self.options.tare_s,
            len(self._terms),
            still_N=tracking.enter_gate * tracking.noise_N,
            until_still=self.options.offset is OffsetSource.TRACKED,
        )

    def restart_time(self) -> None:
        """Let stamps begin anew, because the sender did."""
        self._clock_ns[BEFORE], self._same_since_ns[:] = NEVER, NEVER
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
        has_variables = self._values.shape[1] > 0
        if samples is None or (has_variables and variables is None):
            raise ShapeError(self._expected(samples, variables))
        try:
            self._raw[:] = samples
            if has_variables:
                self._values[:] = variables
        except (TypeError, ValueError):
            raise ShapeError(self._expected(samples, variables)) from None
        try:
            self._clock_ns[NOW] = NEVER if stamp_ns is None else stamp_ns
        except OverflowError:
            raise RecordingError(f"stamp_ns: expected nanoseconds of 64 bits, got {stamp_ns}") from None
        faulty = self._read(*self._read_arguments)
        if faults is not None and any(faults):
            self._status |= faults
            faulty = True
        for k, quadratic in self._quadratic:
            self._wrench[k] = quadratic.corrected(self._wrench[k])
        if not self._is_plain:
            self._offsets(stamp_ns, gravity, faulty)
        self._finish(*self._finish_arguments)
        return self._result

    def _expected(self, samples: Any, variables: Any) -> str:
        names = "; ".join(", ".join(names) or "none" for names in self.variables)
        return (
            f"expected samples of shape {self._raw.shape} and variables of shape {self._values.shape} ({names}), got "
            f"{np.shape(samples)} and {None if variables is None else np.shape(variables)}"
        )

    def _offsets(self, stamp_ns: int | None, gravity: Any, faulty: bool) -> None:
        """Weigh the tool, and learn the bias."""
        if self.options.tool is not None:
            faulty |= self._weigh(gravity)
        if self.options.offset is OffsetSource.FITTED:
            return
        if stamp_ns is None:
            raise RecordingError("a tare needs the time of every sample: expected stamp_ns, got none")
        np.subtract(self._wrench, self._weight, out=self._unloaded)
        self._learn(stamp_ns, (self._status & FAULTS) == 0 if faulty else None)

    def _weigh(self, gravity: Any) -> bool:
        """Weigh the tool; give whether gravity is not finite, which is a fault of the sample."""
        if gravity is None:
            raise RecordingError("a tool needs gravity in the frame of the reading with every sample, got none")
        directions = np.asarray(gravity, dtype=np.float64)
        # every reading has a frame of its own
        if directions.size != 3 * len(self._per_gravity) or directions.shape[-1:] != (3,):
            raise ShapeError(f"gravity: expected shape ({len(self._per_gravity)}, 3), got {directions.shape}")
        faulty = False
        for k, (matrix, direction) in enumerate(zip(self._per_gravity, directions.reshape(-1, 3), strict=True)):
            if np.isfinite(direction).all():
                self._weight[k] = matrix @ direction
            else:
                self._weight[k], faulty = np.nan, True
                self._status[k] |= Status.NOT_FINITE
        return faulty

    def _learn(self, stamp_ns: int, usable: BoolArray | None) -> None:
        """Add to a tare and to the tracked bias; without `usable` no sensor has a fault."""
        temperature, tracker = self._temperature(), self.tracker
        if self._tare is not None:
            collecting = self.taring
            usable = np.ones_like(collecting) if usable is None else usable
            self._status[collecting] |= Status.TARING
            self._at_tare[usable, :6], self._at_tare[usable, 6:-1] = self._weight[usable], self._values[usable]
            for k in self._tare.add(self._unloaded, stamp_ns, usable):
                self._end_tare(k, self._tare, temperature)
            self.tare_moved_N[:] = self._tare.moved_N
            if not self._tare.collecting.any():
                self._tare = None
            usable = usable & ~collecting
        if tracker is not None:  # not one that this sample began
            if tracker.add(self._unloaded, stamp_ns, temperature, usable):
                self.bias[:], self.bias_variance[:] = tracker.bias, tracker.variance
            if any(tracker.in_contact.tolist()):
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

# SPDX-License-Identifier: BSD-3-Clause
"""What a torque loop does with errors of its sensors: a row per robot, gains, and size of error."""

from __future__ import annotations

from typing import Annotated

from forcetorque.results.row import Row, Shown


class TorqueLoopRow(Row):
    """Runs that differ in the draw of E alone."""

    tilt_deg: Annotated[float, Shown("soles", "deg", digits=0)]
    """How far the soles are turned."""
    gain_factor: Annotated[float, Shown("gains", "times", digits=2)]
    """Multiple of the gains of the file."""
    errors: Annotated[str, Shown("errors")]
    """Whose size; `none` without E."""
    scale: Annotated[float, Shown("scale", digits=2)]
    """Multiple of it."""
    force_error_N: Annotated[float, Shown("of weight", "N", digits=1)]
    """Standard deviation of the force error that the weight of the robot then makes on any axis."""
    runs: Annotated[int, Shown("runs")]
    """How many."""
    tracking_rms_Nm: Annotated[float, Shown("tracking", "N m", digits=2, error="tracking_half_width_95_Nm")]
    """Mean over runs of the root mean square of true less desired joint torque, until a fall."""
    tracking_half_width_95_Nm: float | None
    """Half of its 95 % interval over runs; None of a single one."""
    centre_rms_mm: Annotated[float, Shown("CoM off", "mm", digits=1)]
    """Root mean square of how far the centre of mass is from where it should be, until a fall."""
    falls: Annotated[int, Shown("falls")]
    """Runs that fell while the support changed."""
    falls_least_percent: Annotated[float, Shown("at least", "%", digits=0)]
    """Lower end of the 95 % interval of the share that falls (Clopper and Pearson)."""
    falls_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Its upper end."""
    oscillating: Annotated[int, Shown("swings on")]
    """Runs that, standing on the left foot, swing after a push and go on swinging, or fall."""
    oscillating_least_percent: Annotated[float, Shown("at least", "%", digits=0)]
    """Lower end of the 95 % interval of the share that swings on."""
    oscillating_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Its upper end."""
    amplitude_mm: Annotated[float | None, Shown("amplitude", "mm", digits=1)]
    """Median amplitude of the centre of mass where it goes on without a fall; None where none does."""


class TorqueLoopOnsetRow(Row):
    """From which size of E on the linear loop is unstable, over draws of E."""

    tilt_deg: Annotated[float, Shown("soles", "deg", digits=0)]
    """How far the soles are turned."""
    gain_factor: Annotated[float, Shown("gains", "times", digits=2)]
    """Multiple of the gains of the file."""
    errors: Annotated[str, Shown("errors")]
    """Whose size counts as 1."""
    support: Annotated[str, Shown("standing on")]
    """Which feet bear."""
    draws: Annotated[int, Shown("draws")]
    """How many."""
    least_scale: Annotated[float | None, Shown("least", digits=2)]
    """Smallest size of all draws; None where none up to the largest that was looked at is unstable."""
    median_scale: Annotated[float | None, Shown("median", digits=2)]
    """Median; None where it is beyond that."""
    median_force_error_N: Annotated[float | None, Shown("of weight", "N", digits=1)]
    """The median as force error that the weight of the robot makes on any axis."""
    below_one_percent: Annotated[float, Shown("unstable at 1", "%", digits=0)]
    """Share of draws that are unstable at their own size."""
    median_frequency_hz: Annotated[float | None, Shown("frequency", "Hz", digits=2)]
    """Median frequency at which they begin; 0 is a drift away without a swing."""
    largest_scale: float
    """Largest multiple that was looked at."""

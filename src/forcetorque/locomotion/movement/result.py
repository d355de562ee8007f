# SPDX-License-Identifier: BSD-3-Clause
"""What a motion does, column by column: swings, settling after steps, tracking errors."""

from __future__ import annotations

from typing import Annotated

from forcetorque.results.row import FloatOrNull, Row, Shown, Values


class OscillationRow(Row):
    """One oscillation of a column, or that it has none; half-widths are of 95 % intervals."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column; `A - B` is a tracking error."""
    oscillates: Annotated[bool, Shown("oscillates")]
    """Whether a swing stands out of the noise; if not, numbers of it are null."""
    frequency_hz: Annotated[float | None, Shown("frequency", "Hz", digits=4, error="frequency_half_width_95_hz")]
    """Its frequency."""
    frequency_half_width_95_hz: float | None
    """Half-width of that."""
    amplitude: Annotated[float | None, Shown("amplitude", digits=5, error="amplitude_half_width_95")]
    """Half of peak to peak of a steady swing with its mean square, in `unit`."""
    amplitude_half_width_95: float | None
    """Half-width of that."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the column."""
    damping: Annotated[float | None, Shown("damping", digits=4, error="damping_half_width_95")]
    """Damping ratio; about 0 of a swing that stays, below 0 of one that grows; null of one that does not keep its
    phase."""
    damping_half_width_95: float | None
    """Half-width of that."""
    phase_kept_s: Annotated[float | None, Shown("phase kept", "s", digits=1)]
    """Time over which it keeps its phase: that of the interval, or of a part of it."""
    seen_amplitude: Annotated[FloatOrNull, Shown("seen from", digits=5)]
    """Amplitude from which on a further steady swing of that frequency would be seen in 95 % of such records; where
    nothing swings, one of any frequency that was looked at."""
    seen_amplitude_middle: float
    """The same at the geometric middle of the frequencies that were looked at: slow drift hides slow swings most."""
    lowest_hz: float
    """Lowest frequency that was looked at."""
    highest_hz: float
    """Highest frequency that was looked at."""
    samples: int
    """Samples of the interval."""
    duration_s: float
    """How long it lasts."""


class SettlingRow(Row):
    """What a column did after one step."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column."""
    step_at_s: Annotated[float, Shown("step at", "s", digits=3)]
    """Instant of the step, from the start of the recording."""
    step: Annotated[float, Shown("step", digits=5)]
    """How far it went, in `unit`."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the column."""
    settling_s: Annotated[float | None, Shown("settles in", "s", digits=3)]
    """Time after which it stays within the band; null if it does not before the next step."""
    earliest_s: Annotated[float, Shown("from", "s", digits=3)]
    """Lower end of its 95 % interval."""
    latest_s: Annotated[float | None, Shown("to", "s", digits=3)]
    """Upper end; null if noise may hide that it has not settled."""
    band: float
    """Half of the band about the end, in `unit`."""
    overshoot_percent: Annotated[float, Shown("overshoot", "%", digits=1)]
    """How far it went beyond its end, of the step."""
    left_error: Annotated[float | None, Shown("left error", digits=5)]
    """Where it ended less what was wanted there, in `unit`; null where nothing says what was wanted."""


class TrackingRow(Row):
    """How far a column is from what was wanted of it."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column."""
    desired: Annotated[str, Shown("desired")]
    """Column of what was wanted."""
    rms: Annotated[float, Shown("RMS error", digits=5)]
    """Root mean square of the difference, in `unit`."""
    rms_lower_95: Annotated[float, Shown("from", digits=5)]
    """Lower end of its 95 % interval."""
    rms_upper_95: Annotated[float, Shown("to", digits=5)]
    """Upper end."""
    mean_error: Annotated[float, Shown("mean error", digits=5)]
    """Mean of the difference."""
    unit: Annotated[str, Shown("unit")]
    """Unit of both."""
    samples: Annotated[int, Shown("samples")]
    """Samples with both."""
    effective_samples: Annotated[float, Shown("worth", digits=0)]
    """Independent samples with a mean as well known."""


class MotionCurve(Row):
    """A column with the swings that were told of it, for the figure."""

    title: str
    """Interval and column."""
    unit: str
    """Unit of the column."""
    time_s: Values
    """Instants; shape (n,); s."""
    values: Values
    """The column; shape (n,)."""
    swing: Values | None
    """Mean, trend and all swings; shape (n,); null where it does not oscillate."""

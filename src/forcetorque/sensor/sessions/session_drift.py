# SPDX-License-Identifier: BSD-3-Clause
"""Offset and gain of a sensor in every session, what changed between sessions, and the result of both."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.slow_noise import Timeline
from forcetorque.base.noise.window_means import joined_times, means_over, window_for
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import plus_minus
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import FloatOrNull, Row, RowOfSensor, Shown, Table, table_of
from forcetorque.sensor.sessions.session_change_tests import ERROR_RATE, SessionFit, SessionMeans, fit_sessions, holm


class SessionRow(Row):
    """One component in one session; half-widths are of 95 % intervals."""

    session: Annotated[str, Shown("session")]
    """Session."""
    component: Annotated[str, Shown("")]
    """Component of the wrench."""
    unit: Annotated[str, Shown("unit")]
    """N or N m."""
    offset: Annotated[float, Shown("offset", digits=3)]
    """Reading less expected reading at the mean load."""
    offset_half_width_95: Annotated[FloatOrNull, Shown("±", digits=3)]
    """Null where it is not determined."""
    gain: Annotated[float, Shown("gain", digits=4)]
    """Change of the reading per change of the load."""
    gain_half_width_95: Annotated[FloatOrNull, Shown("±", digits=4)]
    """Null where the session does not determine it."""
    gain_session: Annotated[str | None, Shown("gain of")]
    """Session that the gain is of; null for a gain of 1, because no session determines any."""
    mean_load: Annotated[float, Shown("at load", digits=2)]
    """Expected reading at which the offset holds, the mean of all sessions."""
    load_of_session: Annotated[float, Shown("mean load", digits=2)]
    """Mean expected reading of the session."""
    load_deviation: Annotated[float, Shown("moved", digits=2)]
    """Standard deviation of the expected reading in the session."""


class SessionChange(Row):
    """Change of an offset or a gain from one session to another."""

    first: Annotated[str, Shown("from")]
    """Earlier session."""
    second: Annotated[str, Shown("to")]
    """Later session."""
    component: Annotated[str, Shown("")]
    """Component of the wrench."""
    quantity: Annotated[Literal["offset", "gain"], Shown("of")]
    """What changed."""
    unit: Annotated[str, Shown("unit")]
    """N, N m, or 1 of a gain."""
    change: Annotated[float, Shown("change", digits=4)]
    """Later less earlier."""
    half_width_95: Annotated[FloatOrNull, Shown("±", digits=4)]
    """Half of its 95 % interval, which is not widened for the number of comparisons."""
    p_value: Annotated[float, Shown("p", digits=4)]
    """Probability of a change at least as large by noise alone, in this one comparison."""
    beyond_noise: Annotated[bool, Shown("beyond noise")]
    """Whether it is reported as a change (Holm over all rows of the sensor)."""

    @property
    def text(self) -> str:
        """The change in words."""
        size = plus_minus(self.change, self.half_width_95, "" if self.quantity == "gain" else self.unit)
        what = f"gain of {self.component}" if self.quantity == "gain" else self.component
        return f"drift of {what} {size} between {self.first} and {self.second}"


class SensorSessions(RowOfSensor):
    """One sensor."""

    wrench_source: str
    """What makes a wrench of its reading."""
    sessions: tuple[str, ...]
    """Sessions, in the order of the files and of time."""
    windows: int
    """Means over windows that were fitted."""
    window_s: float
    """Length of a window; s."""
    rows: tuple[SessionRow, ...]
    """Sessions by component."""
    changes: tuple[SessionChange, ...]
    """From every session to the next, and from the first to the last."""

    @property
    def drifts(self) -> tuple[SessionChange, ...]:
        """Changes beyond noise."""
        return tuple(row for row in self.changes if row.beyond_noise)


class Drift(DrawnResult):
    """Offsets and gains of sensors by session."""

    answered_by: ClassVar[str | None] = "forcetorque.sensor.answers:drift_answers"
    drawn_by: ClassVar[str] = "forcetorque.sensor.figures:session_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("sensors",)

    interval_uses = (Use.CALIBRATION, Use.VALIDATION)

    schema_name: Literal["forcetorque/drift/1"] = Field(default="forcetorque/drift/1", alias="schema")
    """Form of the result."""
    experiments: tuple[str, ...]
    """Names of the experiments."""
    sensors: tuple[SensorSessions, ...]
    """Sensors in the order of the file."""

    def blocks(self) -> Iterator[Table | str]:
        """Give sessions and changes of every sensor.

        Yields:
            Tables and sentences.
        """
        for sensor in self.sensors:
            yield table_of(
                sensor.rows,
                f"{sensor.sensor} ({sensor.serial}), {sensor.wrench_source}: {sensor.windows} means of "
                f"{sensor.window_s:.3g} s",
            )
            yield table_of(sensor.changes, f"{sensor.sensor}: changes from session to session")
        yield (
            f"±: half a 95 % interval; beyond noise: {100.0 * ERROR_RATE:g} % nominal for any change of a sensor "
            "that did not change"
        )

    def records(self) -> list[dict[str, object]]:
        """Give sessions as flat lines.

        Returns:
            One line per sensor, component and session; the changes are in the JSON.
        """
        return [
            {"sensor": sensor.sensor, "serial": sensor.serial, **row.flat()}
            for sensor in self.sensors
            for row in sensor.rows
        ]


def session_drift(campaign: Campaign, name: str | None, calibration: Calibration | None) -> Drift:
    """Fit offset and gain in every session, and compare sessions.

    Args:
        campaign: The sensor; its calibration and validation intervals are taken.
        name: Name of the calibration; None for none.
        calibration: Reads the sensor, without its offsets; None for prior or logged wrench.

    Returns:
        Offsets and gains by session, and their changes.

    Raises:
        ExperimentError: If there are fewer than two sessions.
        FitError: If there are too few samples.
    """
    means, sessions, window_s = _session_means(campaign, name, calibration)
    components = [k for k in range(6) if means.expected[:, k].any() or campaign.sensor.measured[k]]
    fits = {k: fit_sessions(means, k) for k in components}
    sensor = SensorSessions(
        sensor=campaign.sensor.name,
        serial=campaign.sensor.serial,
        wrench_source=campaign.runs[0].read_by(name, calibration).matrix_source,
        sessions=sessions,
        windows=len(means.line),
        window_s=window_s,
        rows=tuple(row for k, fit in fits.items() for row in _rows(k, fit, means, sessions)),
        changes=_changes(fits, sessions),
    )
    return Drift(
        experiments=campaign.experiments, sensors=(sensor,), warnings=tuple(_warnings(campaign, means, sensor))
    )


def _session_means(
    campaign: Campaign, name: str | None, calibration: Calibration | None
) -> tuple[SessionMeans, tuple[str, ...], float]:
    """Means of reading and expected reading over windows of one length in every session."""
    parts: dict[tuple[str, str], list[tuple[FloatArray, FloatArray]]] = {}
    for run in campaign.runs:
        with campaign.stated(run):
            correction = run.read_by(name, calibration).bare
            intervals = [
                part
                for use in (Use.CALIBRATION, Use.VALIDATION)
                if run.has(use)
                for part in run.samples(use, variables=correction.variables)
            ]
        for part in sorted(intervals, key=lambda one: int(one.samples.stamp_ns[0])):
            key = campaign.session(run, part.interval.label), campaign.recording(run)
            columns = np.hstack([part.readings.wrench(correction), run.sensor.expected_reading(part.samples.reference)])
            parts.setdefault(key, []).append(
                (seconds_since(part.samples.stamp_ns, run.experiment.recording.start_ns), columns)
            )
    sessions = tuple(dict.fromkeys(session for session, _ in parts))
    if len(sessions) < 2:
        raise ExperimentError(
            f"sensor {campaign.sensor.name!r}: expected calibration or validation intervals of two sessions or more, "
            f"got {f'{sessions[0]!r} alone' if sessions else 'none'}; name files of several sessions, or state another "
            "session in the [[interval]] of each"
        )
    joined = {
        key: (np.concatenate([time for time, _ in each]), np.concatenate([columns for _, columns in each]))
        for key, each in parts.items()
    }
    window_s = window_for(joined_times([time for time, _ in joined.values()]))
    ordered = sorted(joined, key=lambda key: sessions.index(key[0]))
    taken = [means_over(joined[key][0] - joined[key][0][0], joined[key][1], window_s) for key in ordered]
    lengths = [len(middle) for middle, _, _ in taken]
    counts = np.concatenate([count for _, _, count in taken])
    columns = np.concatenate([columns for _, columns, _ in taken])
    line = Timeline.of(
        np.concatenate([middle for middle, _, _ in taken]) / window_s,
        recording=np.repeat(np.arange(len(ordered)), lengths),
        share=counts / np.median(counts),
    )
    number = np.repeat([sessions.index(session) for session, _ in ordered], lengths)
    means = SessionMeans(line=line, session=number, measured=columns[:, :6], expected=columns[:, 6:])
    return means, sessions, window_s


def _rows(k: int, fit: SessionFit, means: SessionMeans, sessions: Sequence[str]) -> Iterator[SessionRow]:
    for s, session in enumerate(sessions):
        load = means.expected[means.session == s, k]
        of = int(fit.gain_session[s])
        yield SessionRow(
            session=session,
            component=WRENCH_COMPONENTS[k],
            unit=WRENCH_UNITS[k],
            offset=float(fit.offset[s]),
            offset_half_width_95=float(fit.offset_half_width[s]),
            gain=float(fit.gain[s]),
            gain_half_width_95=float(fit.gain_half_width[s]),
            gain_session=None if of < 0 else sessions[of],
            mean_load=fit.mean_load,
            load_of_session=float(load.mean()),
            load_deviation=float(load.std()),
        )


def _changes(fits: dict[int, SessionFit], sessions: Sequence[str]) -> tuple[SessionChange, ...]:
    last = len(sessions) - 1
    pairs = [*pairwise(range(len(sessions))), *([(0, last)] if last > 1 else [])]
    changes = [
        (k, first, second, of_gain, change)
        for first, second in pairs
        for k, fit in fits.items()
        for of_gain in (False, True)
        if (change := fit.change(first, second, of_gain=of_gain)) is not None
    ]
    beyond = holm([change.p_value for *_, change in changes])
    return tuple(
        SessionChange(
            first=sessions[first],
            second=sessions[second],
            component=WRENCH_COMPONENTS[k],
            quantity="gain" if of_gain else "offset",
            unit="1" if of_gain else WRENCH_UNITS[k],
            change=change.size,
            half_width_95=change.half_width,
            p_value=change.p_value,
            beyond_noise=bool(chosen),
        )
        for (k, first, second, of_gain, change), chosen in zip(changes, beyond, strict=True)
    )


def _warnings(campaign: Campaign, means: SessionMeans, sensor: SensorSessions) -> Iterator[str]:
    name, sessions = campaign.sensor.name, sensor.sessions
    forces = Counter(
        (row.first, row.second, row.change > 0.0)
        for row in sensor.drifts
        if row.quantity == "gain" and row.component in WRENCH_COMPONENTS[:3]
    )
    for (first, second, _), count in forces.items():
        if count > 1:
            yield (
                f"{name}: gains of {count} forces changed in one direction between {first} and {second}: so does a "
                "load of another mass than the file states; look whether the tool is the same"
            )
    if any(run.experiment.loads is not None and not run.experiment.loads.are_stated for run in campaign.runs):
        yield (
            f"{name}: its load is estimated from the same readings, so that gains are relative to each other: all of "
            "them have the error of that mass; weigh it on a scale"
        )
    moments = [means.expected[means.session == s] for s in range(len(sessions))]
    centre = np.array([load.mean(axis=0) for load in moments])[:, :3]
    moved = np.array([np.linalg.norm(load.std(axis=0)[:3]) for load in moments])
    far = np.linalg.norm(centre - centre.mean(axis=0), axis=1)
    worst = int(far.argmax())
    if far[worst] > 2.0 * moved.max(initial=0.0) and far[worst] > 0.0:
        yield (
            f"{name}: the load in {sessions[worst]} is {far[worst]:.2g} N off the mean of all sessions and moves by "
            f"{moved[worst]:.2g} N there (standard deviation): errors of matrix and robot model look like changes of "
            "the offset; record the same motion in every session"
        )

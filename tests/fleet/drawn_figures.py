# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a fleet, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.fleet.figures import fleet_report_figure, fleet_run_figure, fleet_table_figure, over_time_figure
from forcetorque.fleet.report import FleetReport, RankedSensor
from forcetorque.fleet.run import CalibratedSensor, FleetRun
from forcetorque.fleet.sensor_evaluation import RecordingError
from forcetorque.fleet.table import FleetSensor, FleetTable

LONG = "_left $wrist$ " + "x" * 70
ROBOTS = 35
"""More than are drawn."""


def errors_of(rng: np.random.Generator, serial: str, *, dated: bool = True) -> list[RecordingError]:
    """Errors of a sensor in four recordings."""
    return [
        RecordingError(
            serial=serial,
            file=f"day_{day}.toml",
            start_ns=day,
            date=f"2026-01-{day:02}" if dated else "1970-01-01",
            samples=6000,
            force_error_rms_N=float(rng.uniform(0.5, 1.5)),
            moment_error_rms_Nm=float(rng.uniform(0.05, 0.15)),
            offset_error_N=float(rng.uniform(0.0, 4.0)),
            offset_error_Nm=float(rng.uniform(0.0, 0.2)),
        )
        for day in (1, 2, 5, 9)
    ]


def ranked_of(rng: np.random.Generator, rank: int, serial: str) -> RankedSensor:
    """An evaluated sensor; the first two err by more than is allowed."""
    error = float(rng.uniform(2.1, 3.0) if rank < 3 else rng.uniform(0.5, 1.9))
    return RankedSensor(
        robot=f"robot {rank}",
        sensor="wrist_ft",
        serial=serial,
        step="",
        command="",
        rank=rank,
        calibration=f"{serial}.json",
        decision="use",
        load_case="push",
        loads="pushes of 20 N",
        quantity="force",
        unit="N",
        error=error,
        error_at_least=0.8 * error,
        error_at_most=1.2 * error,
        allowed=2.0,
        allowed_N=2.0,
        allowed_Nm=None,
        allowed_is_specified=True,
        times_allowed=0.5 * error,
        last_date="2026-01-09",
        last_file="day_9.toml",
        recordings=4,
        findings=0,
        most_frequent_finding=None,
        reason="errors are small",
    )


def fleet_of_errors(rng: np.random.Generator, sensors: int) -> FleetReport:
    """The report on sensors, of which the first two err too much."""
    serials = [f"FT{k:03}" for k in range(sensors)]
    return FleetReport(
        dataset="fleet_$1",
        recordings=4 * sensors,
        ranked=tuple(ranked_of(rng, rank, serial) for rank, serial in enumerate(serials, start=1)),
        unranked=(),
        over_time=tuple(row for serial in serials for row in errors_of(rng, serial)),
        coverage=(),
        failures=(),
    )


def sensors_of(rng: np.random.Generator, robots: int) -> tuple[FleetSensor, ...]:
    """Sensors of a dataset, the last without a prior; the first errs three times the median."""
    rows = []
    for k in range(robots):
        has_prior = k < robots - 1
        times = 3.0 if k == 0 else float(rng.uniform(0.5, 1.5))
        rows.append(
            FleetSensor(
                robot=f"robot {k}",
                sensor=LONG if k == 1 else "wrist_ft",
                serial=f"FT{k:03}",
                recordings=4,
                duration_s=240.0,
                first_date="2026-01-01",
                last_date="2026-01-09",
                samples=24_000 if has_prior else 0,
                prior_force_error_N=2.0 * times if has_prior else None,
                prior_moment_error_Nm=0.1 * times if has_prior else None,
                times_median=times if has_prior else None,
                findings=0,
                most_frequent_finding=None,
                last_file="day_9.toml",
            )
        )
    return tuple(rows)


def calibrated_of(rng: np.random.Generator, sensors: int) -> tuple[CalibratedSensor, ...]:
    """Sensors of which the first is worse than its prior, one has no prior and the last no validation data."""
    rows = []
    for k in range(sensors):
        error = float(rng.uniform(0.5, 1.0))
        validated = k < sensors - 1
        prior = None if k == 2 or not validated else (0.9 if k == 0 else 4.0) * error
        rows.append(
            CalibratedSensor(
                sensor=LONG if k == 1 else "wrist_ft",
                serial=f"FT{k:03}",
                file=f"FT{k:03}.json",
                recordings=2,
                decision="use" if validated else None,
                force_error_rms_N=error if validated else None,
                prior_force_error_rms_N=prior,
                moment_error_rms_Nm=0.1 * error if validated else None,
                prior_moment_error_rms_Nm=None if prior is None else 0.1 * prior,
                left_out=(),
            )
        )
    return tuple(rows)


def draw_over_time(rng: np.random.Generator) -> Figure:
    """Recordings without a date, of a sensor with a long name, and of one that has no limit."""
    return over_time_figure(
        [
            (LONG, errors_of(rng, "FT001", dated=False), (2.0, 0.2)),
            ("arm", errors_of(rng, "FT003", dated=False), (2.0, 0.2)),
            ("wrist", errors_of(rng, "FT002", dated=False), (None, None)),
        ]
    )


def draw_fleet_report(rng: np.random.Generator) -> Figure:
    """More sensors than are drawn."""
    return fleet_report_figure(fleet_of_errors(rng, 14))


def draw_fleet_table(rng: np.random.Generator) -> Figure:
    """More sensors than are drawn, one with a long name, one without a prior."""
    return fleet_table_figure(FleetTable(dataset="fleet_$1", recordings=8, sensors=sensors_of(rng, ROBOTS)))


def draw_fleet_run(rng: np.random.Generator) -> Figure:
    """Sensors that are better and worse than their priors, and without one or without validation data."""
    return fleet_run_figure(
        FleetRun(
            plan="plan_$1.toml",
            dataset="fleet",
            recordings=8,
            added=8,
            present=0,
            sensors=calibrated_of(rng, 8),
            failures=(),
        )
    )

# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment with every question as a method, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from forcetorque import analysis
from forcetorque.analysis import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, known_names
from forcetorque.recording.alignment import seconds_since

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.report import Report

Calibrations = Calibration | Mapping[str, Calibration]
"""One calibration, or several by name."""

NEW = "calibration"
"""Name of a calibration that is given without one."""


class Run(SensorRun):
    """One sensor of one experiment: `run.calibrate()`, `run.evaluate(calibration)`, `run.report(calibration)`.

    Every method asks the question of `forcetorque.analysis` of that name, where its other options are.
    """

    def calibrate(self, **options: Any) -> Calibration:
        """Fit the sensor on its calibration intervals.

        Args:
            options: As of `calibrate_sensor`: kind, regularisation, nonlinear, moments.

        Returns:
            The calibration; its `doubts` say why what was fitted may be wrong.
        """
        return analysis.calibrate_sensor(self, code_version=version("forcetorque"), created=_now(), **options)

    def expected_wrenches(self, label: str) -> tuple[FloatArray, FloatArray]:
        """Give what mechanics demands that the sensor reads over an interval.

        Args:
            label: Label of the interval: `calibrate` or `judge` where the experiment is made from arrays.

        Returns:
            Instants since the start of the recording, shape (n,), s; and wrenches in the sensor's frame and direction,
            shape (n, 6), N, N m.

        Raises:
            ExperimentError: If there is no interval of that label, or something touches the robot beyond the sensor in
                it, so that mechanics does not say.
        """
        intervals = {interval.label: interval for interval in self.experiment.recording.intervals}
        if label not in intervals:
            raise ExperimentError(f"no interval is labelled {label!r}; {known_names(label, intervals)}")
        (interval,) = self.known([intervals[label]])
        samples = self.interval_samples(interval).samples
        return seconds_since(samples.stamp_ns, self.experiment.recording.start_ns), samples.reference

    def payload(self) -> analysis.WeighedLoad:
        """Weigh what hangs on a wrist sensor, on the calibration intervals.

        Returns:
            Loads, biases, their intervals, and what stays open.
        """
        return analysis.weigh_load(self)

    def evaluate(self, calibrations: Calibrations | None = None) -> analysis.Evaluation:
        """Judge calibrations, and their priors, on the validation intervals.

        Args:
            calibrations: Calibrations of the sensor; its prior is judged if left out.

        Returns:
            Errors, comparisons with the prior, and whether they may be used.
        """
        return analysis.evaluate(self, named(calibrations))

    def validate(self, calibrations: Calibrations | None = None, **options: Any) -> analysis.Validation:
        """Judge calibrations by contact force and joint torques where nothing touches.

        Args:
            calibrations: As of `evaluate`.
            options: As of `analysis.validate`.

        Returns:
            Contact forces and joint torques.
        """
        return analysis.validate(self, named(calibrations), **options)

    def tare(self, label: str, calibration: Calibration | None = None) -> analysis.Tare:
        """Find the offset with which the sensor, at rest over an interval, reads what the model says of its load.

        Args:
            label: Label of the interval.
            calibration: Reads the sensor; its prior or the logged wrench if left out.

        Returns:
            The offset, to be added, with its interval.
        """
        return analysis.tare(self, label, name=None if calibration is None else NEW, calibration=calibration)

    def thermal(self, calibration: Calibration | None = None, **options: Any) -> analysis.Thermal:
        """Find how the reading drifts with temperature at a load that stays.

        Args:
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            options: As of `analysis.thermal`: intervals, variable.

        Returns:
            Drift per degree and per hour, and hysteresis, with intervals.
        """
        name = None if calibration is None else NEW
        return analysis.thermal(self, name=name, calibration=calibration, **options)

    def response(self, excitation: str, calibration: Calibration | None = None, **options: Any) -> analysis.Response:
        """Tell what the sensor does to fast forces: `run.response("impact", force="hammer").corrected(stream)`.

        Args:
            excitation: What was done to it: impact, release or pendulum.
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            options: As of `analysis.response`: component, force, mass_kg, cut_off_hz, intervals.

        Returns:
            Events and their decays, frequency response, and the filter that undoes it.
        """
        name = None if calibration is None else NEW
        return analysis.response(self, excitation, name=name, calibration=calibration, **options)

    def verdicts(self, calibrations: Calibrations) -> tuple[analysis.UseVerdict, ...]:
        """Say whether calibrations may be used for the loads to come.

        Args:
            calibrations: Calibrations of the sensor.

        Returns:
            A verdict for every calibration and load case.
        """
        return analysis.use_verdicts(self, named(calibrations))

    def plan(self, calibration: Calibration | None = None, **options: Any) -> analysis.Plan:
        """Say what to record next: `run.plan(calibration, clearance_deg=10.0)`.

        Args:
            calibration: What is known of the sensor; its prior matrix if left out.
            options: As of `analysis.plan`: load_case, clearance_deg, recordings, seconds, effort, progress.

        Returns:
            The recordings, and the error to expect after each.
        """
        return analysis.plan(self, calibration, **options)

    def report(self, calibrations: Calibrations | None = None, **options: Any) -> Report:
        """Say everything about the sensor in a document: `run.report(calibration).save("a.html")`.

        Args:
            calibrations: As of `evaluate`.
            options: As of `forcetorque.report.report`: title, demands, results.

        Returns:
            The report, to be looked at or saved.
        """
        from forcetorque.report import report

        return report(
            [(str(self.experiment.file), self.experiment)],
            [{self.sensor.name: named(calibrations)}],
            created=_now(),
            code_version=version("forcetorque"),
            **options,
        )

    def figure(self, calibrations: Calibrations | None = None) -> Figure:
        """Draw what is measured on the validation intervals, and what mechanics demands there.

        Args:
            calibrations: As of `evaluate`.

        Returns:
            A figure of matplotlib.
        """
        from forcetorque.report.figures import comparison_figure

        judged = self.judged(named(calibrations))
        return comparison_figure(judged.time_s, judged.reference, dict(judged.measured))


def named(calibrations: Calibrations | None) -> dict[str, Calibration]:
    """Give calibrations their names.

    Args:
        calibrations: One, several by name, or none.

    Returns:
        Them by name; one alone is called `calibration`.
    """
    if calibrations is None:
        return {}
    return {NEW: calibrations} if isinstance(calibrations, Calibration) else dict(calibrations)


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")

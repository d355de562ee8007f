# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment with every question as a method, for scripts and notebooks."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from forcetorque import analysis
from forcetorque.analysis import SensorRun
from forcetorque.analysis.runs.named import Calibrations, named, one_named
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, known_names
from forcetorque.interactive.verdicts import Verdicts
from forcetorque.recording.alignment import seconds_since

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.report import Report

_LOG = logging.getLogger(__name__)


class Run(SensorRun):
    """One sensor of one experiment: `run.calibrate()`, `run.evaluate(calibration)`, `run.report(calibration)`.

    Every method asks the question of `forcetorque.analysis` of that name, where its other options are.
    """

    def calibrate(self, *more: SensorRun, **options: Any) -> Calibration:
        """Fit the sensor on its calibration intervals: `first["wrist"].calibrate(second["wrist"])` on those of both.

        What makes the fit doubtful is logged as warnings, which Python writes to standard error and a notebook shows.

        Args:
            more: The sensor in other experiments, which are fitted together.
            options: As of `calibrate_sensor`: kind, regularisation, nonlinear, moments.

        Returns:
            The calibration.
        """
        answer = analysis.calibrate_for_file(
            [self, *more], f"{self.sensor.name}.json", code_version=version("forcetorque"), created=_now(), **options
        )
        for sentence in answer.cautions():
            _LOG.warning("%s", sentence)
        (entry,) = answer.calibrations
        return entry.calibration

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
        name, reader = one_named(calibration)
        return analysis.tare(self, label, name=name, calibration=reader)

    def thermal(self, calibration: Calibration | None = None, **options: Any) -> analysis.Thermal:
        """Find how the reading drifts with temperature at a load that stays.

        Args:
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            options: As of `analysis.thermal`: intervals, variable.

        Returns:
            Drift per degree and per hour, and hysteresis, with intervals.
        """
        name, reader = one_named(calibration)
        return analysis.thermal(self, name=name, calibration=reader, **options)

    def response(self, excitation: str, calibration: Calibration | None = None, **options: Any) -> analysis.Response:
        """Tell what the sensor does to fast forces: `run.response("impact", force="hammer").corrected(stream)`.

        Args:
            excitation: What was done to it: impact, release or pendulum.
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            options: As of `analysis.response`: component, force, mass_kg, cut_off_hz, intervals.

        Returns:
            Events and their decays, frequency response, and the filter that undoes it.
        """
        name, reader = one_named(calibration)
        return analysis.response(self, excitation, name=name, calibration=reader, **options)

    def verdicts(self, calibrations: Calibrations) -> Verdicts:
        """Say whether calibrations may be used for the loads to come.

        Args:
            calibrations: Calibrations of the sensor.

        Returns:
            A verdict for every calibration and load case; a tuple that shows itself as a table.
        """
        return Verdicts(analysis.use_verdicts(self, named(calibrations)))

    def accept(
        self, spec: analysis.AcceptanceFile | Path | str, calibration: Calibration | None = None, **options: Any
    ) -> analysis.Acceptance:
        """Accept or reject the sensor by limits: `run.accept("limits.toml", calibration).accepted`.

        Args:
            spec: Content of an acceptance file, or the file.
            calibration: The calibration that is judged; the prior if left out.
            options: As of `analysis.accept`: others, population.

        Returns:
            Criteria, each with what was measured.
        """
        stated = spec if isinstance(spec, analysis.AcceptanceFile) else analysis.read_acceptance(spec)
        name, judged = one_named(calibration)
        return analysis.accept(self, stated, None if name is None or judged is None else (name, judged), **options)

    def gains(self, calibration: Calibration | None = None, *, margin: float = 0.2) -> analysis.Gains:
        """Show how far the raw channels are from saturation, and which amplifier gains would suit them.

        Args:
            calibration: Tells what a count is worth; the prior if left out.
            margin: Share of the limit to keep free for forces that were not recorded.

        Returns:
            Head-room of every channel, and gains where the experiment states which can be set.
        """
        name, matrix = one_named(calibration)
        return analysis.select_gains(
            self, margin=margin, calibration=None if name is None or matrix is None else (name, matrix)
        )

    def sphere(
        self, calibrations: Calibrations | None = None, intervals: Sequence[str] | None = None
    ) -> analysis.Spheres:
        """Compare how the three axes weigh a limb that is carried around.

        Args:
            calibrations: As of `evaluate`, compared with the prior.
            intervals: Labels or kinds of the intervals whose motion draws the sphere; those of the experiment if left
                out, else all.

        Returns:
            Ellipsoids of the prior and of every calibration on the same samples.
        """
        return analysis.spheres(self, named(calibrations), intervals)

    def plan(self, calibration: Calibration | None = None, **options: Any) -> analysis.Plan:
        """Say what to record next: `run.plan(calibration, clearance_deg=10.0)`.

        Args:
            calibration: What is known of the sensor; its prior matrix if left out.
            options: As of `analysis.plan`: load_case, clearance_deg, recordings, seconds, effort, progress.

        Returns:
            The recordings, and the error to expect after each.
        """
        _, known = one_named(calibration)
        return analysis.plan(self, known, **options)

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


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")

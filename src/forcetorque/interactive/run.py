# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment with every question as a method, for scripts and notebooks."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from forcetorque import analysis
from forcetorque.analysis import SensorRun
from forcetorque.analysis.plan.plan import RECORDINGS
from forcetorque.analysis.plan.proposal import Effort
from forcetorque.analysis.runs.named import Calibrations, named, one_named
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration, EstimationType, RecordingMoments
from forcetorque.created import created_now
from forcetorque.errors import ExperimentError, known_names
from forcetorque.evaluation import OtherSensors
from forcetorque.interactive.verdicts import Verdicts
from forcetorque.recording.alignment import seconds_since

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.report import Report

_LOG = logging.getLogger(__name__)


class Run(SensorRun):
    """One sensor of one experiment: `run.calibrate()`, `run.evaluate(calibration)`, `run.report(calibration)`.

    Every method asks the question of `forcetorque.analysis` of that name.
    """

    def calibrate(
        self,
        *more: SensorRun,
        kind: EstimationType | str | None = None,
        regularisation: float | Literal["held-out"] | None = None,
        nonlinear: bool | None = None,
        moments: Sequence[RecordingMoments] = (),
    ) -> Calibration:
        """Fit the sensor on its calibration intervals: `first["wrist"].calibrate(second["wrist"])` on those of both.

        What makes the fit doubtful is logged as warnings, which Python writes to standard error and a notebook shows.

        Args:
            more: The sensor in other experiments, which are fitted together.
            kind: `generative`, or an estimation type of the thesis, such as `OwTrTO`; what the experiment says if left
                out, which is the generative model unless it names another.
            regularisation: Lambda of a type of the thesis; counts2; `held-out` to choose it on held-out data.
            nonlinear: Whether quadratic terms may correct readings; what the experiment says if left out.
            moments: What was kept of other recordings, for the generative model.

        Returns:
            The calibration; its `doubts` say why what was fitted may be wrong.
        """
        answer = analysis.calibrate_for_file(
            [self, *more],
            f"{self.sensor.name}.json",
            code_version=version("forcetorque"),
            created=created_now(),
            kind=kind,
            regularisation=regularisation,
            nonlinear=nonlinear,
            moments=moments,
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

    def validate(
        self,
        calibrations: Calibrations | None = None,
        *,
        others: Mapping[str, Calibration] | None = None,
        other_sensors: OtherSensors = OtherSensors.MODEL,
        sub_model: str | None = None,
        contact: str | None = None,
    ) -> analysis.Validation:
        """Judge calibrations by contact force and joint torques where nothing touches.

        Args:
            calibrations: As of `evaluate`.
            others: Calibrations of the other sensors by name, for `measured`; their priors where there is none.
            other_sensors: Whether the other sensors read what the model expects or what they measured.
            sub_model: The sub-model that nothing touches, by the sensor at its base or the root link; that outboard of
                the sensor if left out.
            contact: Link of it at whose origin the contact is estimated; that mounted on the sensor if left out.

        Returns:
            Contact forces and joint torques.
        """
        return analysis.validate(
            self,
            named(calibrations),
            others=others,
            other_sensors=other_sensors,
            sub_model=sub_model,
            contact=contact,
        )

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

    def thermal(
        self,
        calibration: Calibration | None = None,
        *,
        intervals: Collection[str] = (),
        variable: str | None = None,
    ) -> analysis.Thermal:
        """Find how the reading drifts with temperature at a load that stays.

        Args:
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.
            variable: Name of the variable; needed where several are temperatures.

        Returns:
            Drift per degree and per hour, and hysteresis, with intervals.
        """
        name, reader = one_named(calibration)
        return analysis.thermal(self, intervals=intervals, variable=variable, name=name, calibration=reader)

    def response(
        self,
        excitation: str,
        calibration: Calibration | None = None,
        *,
        component: str | None = None,
        force: str | None = None,
        mass_kg: float | None = None,
        cut_off_hz: float | None = None,
        intervals: Collection[str] = (),
    ) -> analysis.Response:
        """Tell what the sensor does to fast forces: `run.response("impact", force="hammer").corrected(stream)`.

        Args:
            excitation: What was done to it: impact, release or pendulum.
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            component: Component of the wrench, such as `fz`; that in which most stands out if left out.
            force: Stream with the force that was measured: an `applied_wrench`, or a `proper_acceleration`.
            mass_kg: Mass that was let go, or that moves with the acceleration; kg.
            cut_off_hz: Cut-off of the filter; Hz; the natural frequency if left out.
            intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.

        Returns:
            Events and their decays, frequency response, and the filter that undoes it.
        """
        name, reader = one_named(calibration)
        return analysis.response(
            self,
            excitation,
            component=component,
            force=force,
            mass_kg=mass_kg,
            cut_off_hz=cut_off_hz,
            intervals=intervals,
            name=name,
            calibration=reader,
        )

    def verdicts(self, calibrations: Calibrations) -> Verdicts:
        """Say whether calibrations may be used for the loads to come.

        Args:
            calibrations: Calibrations of the sensor.

        Returns:
            A verdict for every calibration and load case; a tuple that shows itself as a table.
        """
        return Verdicts(analysis.use_verdicts(self, named(calibrations)))

    def accept(
        self,
        spec: analysis.AcceptanceFile | Path | str,
        calibration: Calibration | None = None,
        *,
        others: Mapping[str, Calibration] | None = None,
        population: Mapping[str, FloatArray] | None = None,
    ) -> analysis.Acceptance:
        """Accept or reject the sensor by limits: `run.accept("limits.toml", calibration).accepted`.

        Args:
            spec: Content of an acceptance file, or the file.
            calibration: The calibration that is judged; the prior if left out.
            others: Calibrations of the other sensors by name, as of `validate`.
            population: Matrices of other sensors by serial number; shape (6, c) each; N/count, N m/count.

        Returns:
            Criteria, each with what was measured.
        """
        stated = spec if isinstance(spec, analysis.AcceptanceFile) else analysis.read_acceptance(spec)
        name, judged = one_named(calibration)
        chosen = None if name is None or judged is None else (name, judged)
        return analysis.accept(self, stated, chosen, others=others, population=population)

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

    def plan(
        self,
        calibration: Calibration | None = None,
        *,
        load_case: str | None = None,
        clearance_deg: float | None = None,
        recordings: int = RECORDINGS,
        seconds: float | None = None,
        effort: Effort | None = None,
        progress: Callable[[str], None] = lambda _: None,
    ) -> analysis.Plan:
        """Say what to record next: `run.plan(calibration, clearance_deg=10.0)`.

        Args:
            calibration: What is known of the sensor; its prior matrix if left out.
            load_case: Name of the use; the one that is furthest from what is allowed if left out.
            clearance_deg: What joints keep away from their limits; that of `[plan]` if left out; deg.
            recordings: How many recordings.
            seconds: About how long each may be; 60 if left out; s.
            effort: How long to look for them.
            progress: Called with what is being done, such as `print`.

        Returns:
            The recordings, and the error to expect after each.
        """
        _, known = one_named(calibration)
        return analysis.plan(
            self,
            known,
            load_case=load_case,
            clearance_deg=clearance_deg,
            recordings=recordings,
            seconds=seconds,
            effort=effort,
            progress=progress,
        )

    def report(
        self,
        calibrations: Calibrations | None = None,
        *,
        title: str | None = None,
        demands: analysis.Demands | None = None,
        results: Mapping[str, dict[str, Any]] | None = None,
        progress: Callable[[str], None] | None = None,
    ) -> Report:
        """Say everything about the sensor in a document: `run.report(calibration).save("a.html")`.

        Args:
            calibrations: As of `evaluate`.
            title: Title of the document; made of the name of the experiment if left out.
            demands: Limits and other sensors to compare with.
            results: Results of other commands by file.
            progress: Called with what is done next, such as `print`.

        Returns:
            The report, to be looked at or saved.
        """
        from forcetorque.report import report

        return report(
            [(str(self.experiment.file), self.experiment)],
            [{self.sensor.name: named(calibrations)}],
            created=created_now(),
            code_version=version("forcetorque"),
            title=title,
            demands=demands,
            results=results,
            progress=progress,
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

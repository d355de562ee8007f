# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment with every analysis as a method, for scripts and notebooks."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.evaluation.load_cases.verdict import UseVerdict
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.calibrations_under_test import Calibrations, named, one_named
from forcetorque.experiment.free_sub_model import OtherSensors
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.planning import RECORDINGS
from forcetorque.planning.proposal import Effort
from forcetorque.recording.alignment import seconds_since
from forcetorque.results.result import NOTEBOOK_WIDTH, created_now
from forcetorque.results.table import Table, short_names
from forcetorque.results.table_rendering import html_table, table_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.evaluation.acceptance.acceptance import Acceptance
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.evaluation.evaluation import Evaluation
    from forcetorque.evaluation.sphere.sphere import Spheres
    from forcetorque.evaluation.validation.validation import Validation
    from forcetorque.payload.result import WeighedLoad
    from forcetorque.payload.tare_offset import Tare
    from forcetorque.planning.planning import Plan
    from forcetorque.report.assessment import Demands
    from forcetorque.report.report import Report
    from forcetorque.sensor.bandwidth.bandwidth import Response
    from forcetorque.sensor.gains.gains import Gains
    from forcetorque.sensor.temperature.temperature_drift import Thermal


class Verdicts(tuple[UseVerdict, ...]):
    """Whether calibrations may be used, one per calibration and load case: `verdicts[0].sentence`."""

    __slots__ = ()

    def records(self) -> list[dict[str, object]]:
        """Give the verdicts as flat lines.

        Returns:
            One per verdict.
        """
        return [verdict.flat() for verdict in self]

    def __str__(self) -> str:
        return table_text(self._table(), NOTEBOOK_WIDTH)

    def _repr_html_(self) -> str:
        return html_table(self._table())

    def _table(self) -> Table:
        names = short_names([verdict.candidate for verdict in self])
        return Table(
            caption="",
            headings=("sensor", "calibration", "load case", "decision", "why"),
            rows=tuple(
                (verdict.sensor, names[verdict.candidate], verdict.load_case, verdict.decision, verdict.sentence)
                for verdict in self
            ),
        )


_LOG = logging.getLogger(__name__)


class Run(SensorRun):
    """One sensor of one experiment: `run.calibrate()`, `run.evaluate(calibration)`, `run.report(calibration)`.

    Every method is the analysis of that name in the package of a capability.
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
        from forcetorque.calibration.calibrate import calibrate_for_file

        answer = calibrate_for_file(
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

    def payload(self) -> WeighedLoad:
        """Weigh what hangs on a wrist sensor, on the calibration intervals.

        Returns:
            Loads, biases, their intervals, and what stays open.
        """
        from forcetorque.payload.identify import weigh_load

        return weigh_load(self)

    def evaluate(self, calibrations: Calibrations | None = None) -> Evaluation:
        """Judge calibrations, and their priors, on the validation intervals.

        Args:
            calibrations: Calibrations of the sensor; its prior is judged if left out.

        Returns:
            Errors, comparisons with the prior, and whether they may be used.
        """
        from forcetorque.evaluation.evaluation import evaluate

        return evaluate(self, named(calibrations))

    def validate(
        self,
        calibrations: Calibrations | None = None,
        *,
        others: Mapping[str, Calibration] | None = None,
        other_sensors: OtherSensors = OtherSensors.MODEL,
        sub_model: str | None = None,
        contact: str | None = None,
    ) -> Validation:
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
        from forcetorque.evaluation.validation.validation import validate

        return validate(
            self,
            named(calibrations),
            others=others,
            other_sensors=other_sensors,
            sub_model=sub_model,
            contact=contact,
        )

    def tare(self, label: str, calibration: Calibration | None = None) -> Tare:
        """Find the offset with which the sensor, at rest over an interval, reads what the model says of its load.

        Args:
            label: Label of the interval.
            calibration: Reads the sensor; its prior or the logged wrench if left out.

        Returns:
            The offset, to be added, with its interval.
        """
        from forcetorque.payload.tare_offset import tare

        name, reader = one_named(calibration)
        return tare(self, label, name=name, calibration=reader)

    def thermal(
        self,
        calibration: Calibration | None = None,
        *,
        intervals: Collection[str] = (),
        variable: str | None = None,
    ) -> Thermal:
        """Find how the reading drifts with temperature at a load that stays.

        Args:
            calibration: Reads the sensor; its prior or the logged wrench if left out.
            intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.
            variable: Name of the variable; needed where several are temperatures.

        Returns:
            Drift per degree and per hour, and hysteresis, with intervals.
        """
        from forcetorque.sensor.temperature.temperature_drift import thermal

        name, reader = one_named(calibration)
        return thermal(self, intervals=intervals, variable=variable, name=name, calibration=reader)

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
    ) -> Response:
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
        from forcetorque.sensor.bandwidth.bandwidth import response

        name, reader = one_named(calibration)
        return response(
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
        from forcetorque.evaluation.load_cases.verdict import use_verdicts

        return Verdicts(use_verdicts(self, named(calibrations)))

    def accept(
        self,
        spec: AcceptanceFile | Path | str,
        calibration: Calibration | None = None,
        *,
        others: Mapping[str, Calibration] | None = None,
        population: Mapping[str, FloatArray] | None = None,
    ) -> Acceptance:
        """Accept or reject the sensor by limits: `run.accept("limits.toml", calibration).accepted`.

        Args:
            spec: Content of an acceptance file, or the file.
            calibration: The calibration that is judged; the prior if left out.
            others: Calibrations of the other sensors by name, as of `validate`.
            population: Matrices of other sensors by serial number; shape (6, c) each; N/count, N m/count.

        Returns:
            Criteria, each with what was measured.
        """
        from forcetorque.evaluation.acceptance.acceptance import accept
        from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile, read_acceptance

        stated = spec if isinstance(spec, AcceptanceFile) else read_acceptance(spec)
        name, judged = one_named(calibration)
        chosen = None if name is None or judged is None else (name, judged)
        return accept(self, stated, chosen, others=others, population=population)

    def gains(self, calibration: Calibration | None = None, *, margin: float = 0.2) -> Gains:
        """Show how far the raw channels are from saturation, and which amplifier gains would suit them.

        Args:
            calibration: Tells what a count is worth; the prior if left out.
            margin: Share of the limit to keep free for forces that were not recorded.

        Returns:
            Head-room of every channel, and gains where the experiment states which can be set.
        """
        from forcetorque.sensor.gains.gains import select_gains

        name, matrix = one_named(calibration)
        return select_gains(self, margin=margin, calibration=None if name is None or matrix is None else (name, matrix))

    def sphere(self, calibrations: Calibrations | None = None, intervals: Sequence[str] | None = None) -> Spheres:
        """Compare how the three axes weigh a limb that is carried around.

        Args:
            calibrations: As of `evaluate`, compared with the prior.
            intervals: Labels or kinds of the intervals whose motion draws the sphere; those of the experiment if left
                out, else all.

        Returns:
            Ellipsoids of the prior and of every calibration on the same samples.
        """
        from forcetorque.evaluation.sphere.sphere import spheres

        return spheres(self, named(calibrations), intervals)

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
    ) -> Plan:
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
        from forcetorque.planning.planning import plan

        _, known = one_named(calibration)
        return plan(
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
        demands: Demands | None = None,
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
        from forcetorque.report.report import report

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
        from forcetorque.evaluation.figures.errors_and_matrices import comparison_figure

        judged = self.judged(named(calibrations))
        return comparison_figure(judged.time_s, judged.reference, dict(judged.measured))

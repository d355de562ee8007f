# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment with every analysis as a method, for scripts and notebooks."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, Literal, Self

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.labelled_arrays import wrench_array, xarray_dataset
from forcetorque.base.lazy import LazyMethod
from forcetorque.collisions import commands as _collisions
from forcetorque.evaluation import commands as _evaluation
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.calibration.stored_moments import RecordingMoments
from forcetorque.experiment.calibrations_under_test import Calibrations, named
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval
from forcetorque.results.result import NOTEBOOK_WIDTH, created_now
from forcetorque.results.table import Table, short_names
from forcetorque.results.table_rendering import html_table, table_text
from forcetorque.sensor import commands as _sensor

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from forcetorque.evaluation.sphere import sphere as _sphere
    from forcetorque.payload import identify as _payload, tare_offset as _tare
    from forcetorque.planning import planning as _planning
    from forcetorque.report.report import Report
    from forcetorque.report.sensor_assessment import Demands
    from forcetorque.sensor.bandwidth import response as _response


class Verdicts(tuple[LoadCaseVerdict, ...]):
    """Whether calibrations may be used, one per calibration and load case: `verdicts[0].message`."""

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
        names = short_names([verdict.calibration for verdict in self])
        return Table(
            caption="",
            headings=("sensor", "calibration", "load case", "decision", "why"),
            rows=tuple(
                (verdict.sensor, names[verdict.calibration], verdict.load_case, verdict.decision, verdict.message)
                for verdict in self
            ),
        )


class ExpectedWrenches(tuple[FloatArray, FloatArray]):
    """Instants and expected wrenches, `time_s, wrench = run.expected_wrenches(label)`.

    Instants since the start of the recording, shape (n,), s; wrenches in the sensor's frame and direction, shape
    (n, 6), N, N m.
    """

    sensor: str
    """Name of the sensor."""
    interval: str
    """Label of the interval."""
    stamp_ns: IntArray
    """The instants on the clock of the sensor; shape (n,); ns."""

    @classmethod
    def of(cls, run: SensorRun, interval: Interval) -> Self:
        """Compute them.

        Returns:
            Instants and wrenches.
        """
        samples = run.interval_samples(interval).samples
        expected = cls((seconds_since(samples.stamp_ns, run.experiment.recording.start_ns), samples.reference))
        expected.sensor, expected.interval, expected.stamp_ns = run.sensor.name, interval.label, samples.stamp_ns
        return expected

    def to_xarray(self) -> Any:
        """Give them as a data set of xarray.

        Returns:
            `xarray.Dataset` with `expected` over `time` and `axis`.

        Raises:
            MissingExtraError: If xarray is not installed.
        """
        wrench = wrench_array(self[1], frame=self.sensor, long_name="expected measurement")
        return xarray_dataset(self.stamp_ns, {"expected": wrench}, {}, sensor=self.sensor, interval=self.interval)


_LOG = logging.getLogger(__name__)


class Run(SensorRun):
    """One sensor of one experiment: `run.calibrate()`, `run.evaluate(calibration)`, `run.report(calibration)`.

    Methods that are named here are functions of the capabilities, whose first parameter is the sensor.
    """

    evaluate = _evaluation.evaluate
    validate = _evaluation.validate
    accept = _evaluation.accept
    gains = _sensor.gains
    collisions = _collisions.collisions
    thermal = _sensor.thermal
    drift = _sensor.drift
    if TYPE_CHECKING:
        payload = _payload.weigh_load
        plan = _planning.plan
        response = _response.response
        sphere = _sphere.spheres
        tare = _tare.tare
    else:
        payload = LazyMethod("forcetorque.payload.identify:weigh_load")
        plan = LazyMethod("forcetorque.planning.planning:plan")
        response = LazyMethod("forcetorque.sensor.bandwidth.response:response")
        sphere = LazyMethod("forcetorque.evaluation.sphere.sphere:spheres")
        tare = LazyMethod("forcetorque.payload.tare_offset:tare")

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
            The calibration; its `warnings` say why what was fitted may be wrong.
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

    def expected_wrenches(self, label: str) -> ExpectedWrenches:
        """Give what mechanics demands that the sensor reads over an interval.

        Args:
            label: Label of the interval: `calibrate` or `validate` where the experiment is made from arrays.

        Returns:
            Instants since the start of the recording, shape (n,), s; and wrenches in the sensor's frame and direction,
            shape (n, 6), N, N m; `to_xarray()` labels them.

        Raises:
            ExperimentError: If there is no interval of that label, or something touches the robot beyond the sensor in
                it, so that mechanics does not say.
        """
        intervals = {interval.label: interval for interval in self.experiment.recording.intervals}
        require_known(label, intervals, ExperimentError, f"no interval is labelled {label!r}")
        (interval,) = self.known([intervals[label]])
        return ExpectedWrenches.of(self, interval)

    def verdicts(self, calibrations: Calibrations) -> Verdicts:
        """Say whether calibrations may be used for the loads to come.

        Args:
            calibrations: Calibrations of the sensor.

        Returns:
            A verdict for every calibration and load case; a tuple that shows itself as a table.
        """
        from forcetorque.evaluation.load_cases.verdict import use_verdicts

        return Verdicts(use_verdicts(self, named(calibrations)))

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
        from forcetorque.experiment.evaluated_wrenches import evaluated_wrenches

        judged = evaluated_wrenches(self, named(calibrations))
        return comparison_figure(judged.time_s, judged.reference, dict(judged.measured))

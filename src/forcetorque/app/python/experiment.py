# SPDX-License-Identifier: BSD-3-Clause
"""Experiments as scripts and notebooks hold them: `experiment["r_leg_ft_sensor"]` is one sensor with its analyses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Self

from forcetorque.app.python.run import Run
from forcetorque.base.lazy import LazyMethod
from forcetorque.base.output_file import refuse_output
from forcetorque.calibration.calibrate import SensorCalibrations
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance
from forcetorque.experiment.calibrations_under_test import Calibrations, named
from forcetorque.experiment.contacts import contact_in_words
from forcetorque.experiment.experiment import Experiment as ExperimentContent
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import load_experiment as load_content
from forcetorque.experiment.validation_offset import OffsetPolicy
from forcetorque.locomotion import commands as _locomotion
from forcetorque.results.result import created_now
from forcetorque.results.table import Table
from forcetorque.results.table_rendering import html_table, html_warnings
from forcetorque.robot.installed_robots import urdf_file

if TYPE_CHECKING:
    from forcetorque.app.run import run as _run
    from forcetorque.estimation.result import EstimateSummary
    from forcetorque.inspection import inspect as _inspection
    from forcetorque.viewer.scene_builder import View


class Experiment(ExperimentContent):
    """Everything that an experiment file points to, sensors by name: `[experiment[name] for name in experiment]`."""

    __slots__ = ()

    balance = _locomotion.balance
    coherence = _locomotion.coherence
    if TYPE_CHECKING:
        inspect = _inspection.inspected
        run = _run.run
    else:
        inspect = LazyMethod("forcetorque.inspection.inspect:inspected")
        run = LazyMethod("forcetorque.app.run.run:run")

    @classmethod
    def of(cls, content: ExperimentContent) -> Self:
        """Hold an experiment.

        Returns:
            The same, with its sensors by name.
        """
        return cls(**{field.name: getattr(content, field.name) for field in fields(content) if field.init})

    def __getitem__(self, sensor: str) -> Run:
        """Choose a sensor.

        Args:
            sensor: Its name, or another one that the robot model has for it.

        Returns:
            The sensor, with every analysis as a method.

        Raises:
            ExperimentError: If the experiment has none of that name.
        """
        return Run(self, self.sensor(sensor))

    def __iter__(self) -> Iterator[str]:
        return (sensor.name for sensor in self.sensors)

    def __contains__(self, sensor: object) -> bool:
        return any(sensor in (one.name, *self.model.sensor(one.name).aliases) for one in self.sensors)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def estimate(
        self,
        calibrations: Calibrations | None = None,
        *,
        contacts: Sequence[str] | None = None,
        length_scale: float | None = None,
        offset: OffsetPolicy | str = "fitted",
        fuse: bool = False,
        output: Path | str | None = None,
        force: bool = False,
    ) -> EstimateSummary:
        """Estimate contact wrenches, joint torques and expected readings.

        Args:
            calibrations: How sensors are read; by their prior or as logged if left out.
            contacts: `FRAME`, `FRAME:force` or `FRAME:force_along:x,y,z` each; those of the file if left out, else at
                the sensors.
            length_scale: Moment that weighs as much as one newton, for more than six unknowns; m.
            offset: Where offsets come from, such as `one-link-imu:hanging`.
            fuse: Whether joint torques of sensors, known contacts and motors are made one, beside each other.
            output: File for every sample, .parquet or .csv; none if left out.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Returns:
            Mean norms of contacts and residuals, with every sample in `intervals`.

        Raises:
            OutputError: If the file is an input, or one that `force` is needed for.
        """
        from forcetorque.estimation.estimate import estimate_experiment
        from forcetorque.estimation.result import summarise_estimates
        from forcetorque.estimation.skin_contacts import frames_of_patches
        from forcetorque.estimation.torque.experiment_fusion import TorqueHistory, fuse_experiment
        from forcetorque.experiment.offsets import corrections_of

        if output is not None:
            refuse_output(output, inputs_sha256=self.inputs_sha256.values(), force=force)
        stated = [contact_in_words(words, self.model) for words in contacts] if contacts else None
        corrections = corrections_of(self, named(calibrations), offset=offset)
        patches = frames_of_patches(self)
        spans = estimate_experiment(self, corrections, contacts=stated, length_scale=length_scale, patches=patches)
        fusions, frictions = fuse_experiment(self, corrections, contacts=stated, patches=patches) if fuse else ([], ())
        file = None if output is None else Path(output)
        summary = summarise_estimates(self, corrections, spans, file=file, fusions=fusions, frictions=frictions)
        torques = TorqueHistory(experiment=self, spans=spans, fusions=fusions)
        return summary.model_copy(update={"intervals": tuple(spans), "torques": torques})

    def view(
        self,
        output: Path | str,
        calibrations: Calibrations | None = None,
        *,
        sensors: Sequence[str] | None = None,
        force: bool = False,
    ) -> View:
        """Write robot pose and force space, linked in time, as a page: `experiment.view("view.html", calibration)`.

        Args:
            output: File of the page, which works offline in any browser; for Rerun it ends in `.rrd`, for Foxglove and
                readers of ROS 2 bags in `.mcap`, beside which is the layout for Foxglove.
            calibrations: How sensors are read, beside their priors; of a sensor any number.
            sensors: Sensors to show; all if left out.
            force: As of `estimate`.

        Returns:
            What the page shows. A robot from arrays is drawn without its looks, whose files only its URDF names.

        Raises:
            ForceTorqueError: If there are too many samples for one file; `forcetorque view` serves them.
            OutputError: As of `estimate`.
        """
        from forcetorque.viewer.scene_builder import View, build_scene
        from forcetorque.viewer.view_file import require_room, require_writer, view_files, write_view

        for file in view_files(Path(output)):
            refuse_output(file, inputs_sha256=self.inputs_sha256.values(), force=force)
        require_writer(Path(output))
        robot = parse_experiment(self.file).robot if self.file.is_file() else None
        urdf = None if robot is None else urdf_file(robot.urdf, self.file.parent)
        accept = partial(require_room, Path(output))
        built = build_scene(self, named(calibrations), urdf=urdf, sensors=sensors, accept=accept)
        written = write_view(Path(output), built)
        return View.of(built).model_copy(update={"file": str(output), "file_bytes": written})

    def _repr_html_(self) -> str:
        start = self.recording.start_ns
        table = Table(
            caption=f"{self.name}: {self.model.name}, {', '.join(sensor.name for sensor in self.sensors)}",
            headings=("interval", "use", "from, s", "to, s", "support"),
            rows=tuple(
                (
                    one.label,
                    one.use.value,
                    f"{(one.start_ns - start) * 1e-9:.1f}",
                    f"{(one.end_ns - start) * 1e-9:.1f}",
                    "" if one.support is None else one.support.frame,
                )
                for one in self.recording.intervals
            ),
        )
        found = (f"{finding.stream}: {finding.message}" for finding in self.recording.findings)
        return html_warnings(found) + html_table(table)


def load_experiment(path: Path | str) -> Experiment:
    """Read an experiment file and everything that it points to.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The experiment, its sensors by name.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself, the robot or the recording.
    """
    return Experiment.of(load_content(path))


def calibrate_jointly(
    recordings: Sequence[ExperimentContent],
    sensors: Sequence[str] | None = None,
    *,
    folder: Path | str = ".",
    tolerance: ModelTolerance | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> SensorCalibrations:
    """Calibrate all sensors of a robot at once, from parts between them that nothing touches.

    Args:
        recordings: Experiments with one robot.
        sensors: Sensors to calibrate; all of the first file if None.
        folder: Where `save` of the result writes a file per sensor, and what they share.
        tolerance: How far the robot model may be off; what the first file says if None.
        progress: Called with a line for people as work goes on, such as `print`.

    Returns:
        A calibration per sensor in `calibrations`, and in `joint` what they share: errors of the model, what is left of
        the equations, spans that were touched.
    """
    from forcetorque.calibration.joint.calibrate import calibrate_jointly

    created = created_now()
    return calibrate_jointly(
        recordings,
        folder,
        sensors,
        code_version=version("forcetorque"),
        created=created,
        tolerance=tolerance,
        progress=progress,
    )

# SPDX-License-Identifier: BSD-3-Clause
"""From an experiment, alone or with the calibrations of a report, to the scene of its whole log."""

from __future__ import annotations

import hashlib
import html
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, Field, ValidationError

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, MissingFileError
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.run_files import declare_input
from forcetorque.base.toml_file import first_error
from forcetorque.collisions.collision_and_sole_events import with_collisions
from forcetorque.experiment.applicability import by_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.recording_notes import added_to
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.payload.load_on_wrist_sensor import is_wrist_load
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Stream
from forcetorque.results.answer import Answer
from forcetorque.results.result import Result
from forcetorque.results.table import Table
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.model import RobotModel
from forcetorque.skin.patches_of_experiment import BESIDE_M, is_skin_alone
from forcetorque.skin.section import PATCHES
from forcetorque.viewer.contact_wrenches import ContactOptions, scene_contacts, scene_parts
from forcetorque.viewer.posture import posture_at, root_poses, scene_joints, shown_sensors, shown_stream
from forcetorque.viewer.robot_shapes import robot_geometry
from forcetorque.viewer.scene import Robot, Scene, SceneFinding, SceneInterval
from forcetorque.viewer.scene_arrays import Block, Priors, SceneDraft, differentiated
from forcetorque.viewer.sensor_wrenches import expected_readings, scene_sensor
from forcetorque.viewer.skin import scene_skin, scene_skin_events

_BESIDE = f"no [robot]: links with skin are drawn side by side, {BESIDE_M:g} m apart, not where they truly are"
_AS_STATED = ContactOptions()
_POSTURE, _SENSOR, _CONTACTS, _FINDINGS = 16, 5, 15, 15
"""Shares of the time that a scene takes: before its sensors, for each of them, for contacts, and for findings."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BuiltScene:
    """A scene with its arrays."""

    scene: Scene
    """The header."""
    block: bytes
    """The arrays."""
    urdf: Path | None = None
    """File of the robot; None for a load without one."""


def build_scene(
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    urdf: Path | None = None,
    sensors: Sequence[str] | None = None,
    mesh_folders: Sequence[Path] = (),
    provenance: Sequence[str] = (),
    contact_options: ContactOptions = _AS_STATED,
    progress: Progress = lambda _: None,
    accept: Callable[[int], None] = lambda _: None,
) -> BuiltScene:
    """Collect everything that the viewer shows of an experiment.

    The instants are the stamps of the first shown sensor, or of skin without any; other streams are interpolated at
    them. What is absent becomes a note and not an error, but for calibrations that may not be applied. Values are not
    smoothed.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name.
        urdf: File of the robot, for its looks; None for a load without one.
        sensors: Sensors to show; all of the experiment if None.
        mesh_folders: Folders with packages of meshes that are looked at first.
        provenance: Lines to add to the list of inputs.
        contact_options: How contacts are estimated.
        progress: Called with the time that is left, of a log that takes longer than a few seconds.
        accept: Called with the number of samples before most is computed; raises where they are too many.

    Returns:
        The scene.

    Raises:
        ExperimentError: If the experiment has no sensor of a name, a calibration may not be applied, or there is no
            robot and no skin of the experiment can be shown.
        RecordingError: If there is no sample to show.
    """
    groups = by_sensor(experiment, calibrations)
    shown = shown_sensors(experiment, sensors)
    names = [sensor.name for sensor in shown]
    recording, model = experiment.recording, experiment.model
    skin_alone = is_skin_alone(model)
    clock = shown_stream(experiment, shown)
    usable, notes = _without_empty(experiment, clock)
    draft = SceneDraft(
        notes=notes, sources=[*_inputs(experiment), *provenance, f"forcetorque {version('forcetorque')}"]
    )
    draft.notes.extend(added_to(experiment.recording))
    draft.notes.extend(
        f"calibrations of {name!r} are not shown: --sensor leaves it out" for name in groups if name not in names
    )
    time_left = TimeLeft(
        progress, f"reading {experiment.name}", _POSTURE + _SENSOR * len(shown) + _CONTACTS + _FINDINGS
    )
    posture = posture_at(recording, model, clock)
    accept(len(posture.stamp_ns))
    root, assumed = root_poses(recording, model, posture, recording.intervals, experiment.processing)
    computed = differentiated(usable)
    priors = Priors(computed, shown)
    expected, lacking = expected_readings(computed, tuple(names), posture)
    draft.notes.extend([_BESIDE] if skin_alone else [*posture.notes, *assumed, *lacking])
    if experiment.processing.smoothing is not None:
        draft.sources.append("the smoothing of the experiment file is not applied to what is shown")
    series = []
    for number, one in enumerate(shown):
        time_left.at(_POSTURE + _SENSOR * number)
        series.append(scene_sensor(computed, one, groups.get(one.name, {}), expected[one.name], posture, priors, draft))
    time_left.at(_POSTURE + _SENSOR * len(shown))
    contacts = () if skin_alone else scene_contacts(computed, groups, posture, priors, draft, contact_options)
    before_skin = len(draft.notes)
    patches = computed.section(PATCHES)
    skin = () if patches is None else scene_skin(patches, model.links, draft)
    events = scene_skin_events(recording, posture.stream.clock, model.links, draft)
    if skin_alone and not (skin or events):
        reasons = "; ".join(draft.notes[before_skin:])
        raise ExperimentError(f"experiment {experiment.name!r}: nothing to show: {reasons}")
    robot, missing = drawn_robot(model, posture.names, urdf, draft.block, mesh_folders)
    if skin_alone:  # a ball that stands for a link would hide the patch on it
        patched = {patch.link for patch in skin}
        robot = replace(robot, shapes=tuple(shape for shape in robot.shapes if shape.link not in patched))
    parts = scene_parts(computed, groups, posture, draft)
    time_left.at(_POSTURE + _SENSOR * len(shown) + _CONTACTS)
    scene = Scene(
        title=experiment.name,
        samples=len(posture.stamp_ns),
        start_ns=str(recording.start_ns),
        end_s=(recording.span_ns[1] + 1 - recording.start_ns) * 1e-9,
        time_s=draft.block.add(seconds_since(posture.stamp_ns, recording.start_ns), "float64"),
        positions=draft.block.add(posture.position, "float32"),
        coordinates=posture.names,
        root=draft.block.add(root, "float32"),
        robot=robot,
        sensors=(*series, *parts),
        contacts=contacts,
        skin=skin,
        skin_events=events,
        intervals=_intervals(experiment),
        findings=tuple(
            _finding(finding, recording.start_ns)
            for finding in with_collisions(
                lambda: inspect_experiment(usable, with_causes=False),
                usable,
                {name: next(iter(group.values())) for name, group in groups.items() if group},
            )
        ),
        notes=tuple(draft.notes) if skin_alone else (*draft.notes, *missing),
        provenance=tuple(draft.sources),
        annotations_url=None,
    )
    return BuiltScene(scene=scene, block=draft.block.bytes(), urdf=urdf)


def drawn_robot(
    model: RobotModel, coordinates: Sequence[str], urdf: Path | None, block: Block, mesh_folders: Sequence[Path]
) -> tuple[Robot, tuple[str, ...]]:
    """Collect what is drawn of a robot.

    Args:
        model: The robot.
        coordinates: Joints whose position is known.
        urdf: Its file; None for a load without one.
        block: Takes the meshes.
        mesh_folders: Folders with packages of meshes that are looked at first.

    Returns:
        The robot, and what is missing.
    """
    geometry = robot_geometry(model, urdf, block, mesh_folders=mesh_folders)
    robot = Robot(
        name=model.name,
        root_link=model.root_link,
        links=tuple(model.links),
        joints=scene_joints(model, coordinates),
        shapes=geometry.shapes,
        meshes=geometry.meshes,
    )
    return robot, geometry.notes


def _without_empty(experiment: Experiment, clock: Stream) -> tuple[Experiment, list[str]]:
    """Leave out intervals that hold no sample of a stream, and say which."""
    recording, stamps = experiment.recording, clock.stamp_ns
    start, end = recording.span_ns
    kept, notes = [], []
    for interval in recording.intervals:
        inside = interval.holds(stamps)
        if inside.any() and start <= interval.start_ns and interval.end_ns <= end + 1:
            kept.append(interval)
        else:
            notes.append(f"interval {interval.label!r} is left out: it holds no sample, or ends outside the log")
    if notes:
        experiment = replace(experiment, recording=recording.with_intervals(kept))
    return experiment, notes


def _inputs(experiment: Experiment) -> list[str]:
    return [f"{name} sha256 {digest}" for name, digest in sorted(experiment.inputs_sha256.items())]


def _intervals(experiment: Experiment) -> tuple[SceneInterval, ...]:
    recording, model = experiment.recording, experiment.model
    states_support = not (is_wrist_load(model) or is_skin_alone(model))
    return tuple(
        SceneInterval(
            label=interval.label,
            use=interval.use.value,
            start_s=(interval.start_ns - recording.start_ns) * 1e-9,
            end_s=(interval.end_ns - recording.start_ns) * 1e-9,
            support=None if interval.support is None else interval.support.frame,
            states_support=states_support,
        )
        for interval in recording.intervals
    )


def _finding(finding: Finding, start_ns: int) -> SceneFinding:
    return SceneFinding(
        stream=finding.stream,
        kind=finding.kind,
        message=finding.message,
        start_s=None if finding.start_ns is None else (finding.start_ns - start_ns) * 1e-9,
        end_s=None if finding.end_ns is None else (finding.end_ns - start_ns) * 1e-9,
    )


def scene_of(
    path: Path,
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    sensors: Sequence[str] | None = None,
    mesh_folders: Sequence[Path] | None = None,
    contact_options: ContactOptions = _AS_STATED,
    progress: Progress = lambda _: None,
    accept: Callable[[int], None] = lambda _: None,
) -> BuiltScene:
    """Build the scene of an experiment.

    Args:
        path: Experiment file.
        experiment: What it points to.
        calibrations: Calibrations by their file; of a sensor any number.
        sensors: Sensors to show; all if None.
        mesh_folders: Folders with packages of meshes.
        contact_options: As of `build_scene`.
        progress: As of `build_scene`.
        accept: As of `build_scene`.

    Returns:
        The scene, which states the hashes of the calibrations.

    Raises:
        MissingFileError: If a folder does not exist.
    """
    for folder in mesh_folders or ():
        if not folder.is_dir():
            raise MissingFileError(f"--mesh-dir {folder}: expected a folder, there is none")
    robot = parse_experiment(path).robot
    return build_scene(
        experiment,
        calibrations,
        urdf=None if robot is None else urdf_file(robot.urdf, path.parent),
        sensors=sensors,
        mesh_folders=mesh_folders or (),
        contact_options=contact_options,
        progress=progress,
        accept=accept,
        provenance=[f"{file} sha256 {hashlib.sha256(Path(file).read_bytes()).hexdigest()}" for file in calibrations],
    )


INLINE_BYTES = 8_000_000
"""Largest page that a notebook shows inside itself."""
_FORMS = {".rrd": "recording of Rerun", ".mcap": "bag of ROS 2"}


def _is_page(file: str | None) -> bool:
    """Whether it is a page that a browser opens."""
    return file is not None and file.lower().endswith(".html")


class View(Result):
    """An experiment as the viewer shows it."""

    schema_name: Literal["forcetorque/view/1"] = Field(default="forcetorque/view/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: tuple[str, ...]
    """Sensors that are shown."""
    skin: tuple[str, ...] = ()
    """Patches of skin, and streams of contacts that a skinManager saw, that are shown."""
    samples: int
    """Number of samples."""
    url: str | None
    """Address of the page while it is served; null otherwise."""
    file: str | None
    """File of the page, or for another viewer, where one was written."""
    file_bytes: int | None
    """Its size."""
    video: str | None
    """File of the video, where one was written."""
    video_frames: int | None
    """Its number of frames."""
    notes: tuple[str, ...]
    """What is absent, and why."""

    @classmethod
    def of(cls, built: BuiltScene) -> Self:
        """Say what a scene shows, before it is shown anywhere.

        Args:
            built: The scene.

        Returns:
            The view, without address and files.
        """
        return cls(
            experiment=built.scene.title,
            sensors=tuple(sensor.name for sensor in built.scene.sensors if sensor.acting is not None),
            skin=(*(one.name for one in built.scene.skin), *(one.name for one in built.scene.skin_events)),
            samples=built.scene.samples,
            url=None,
            file=None,
            file_bytes=None,
            video=None,
            video_frames=None,
            notes=tuple(built.scene.notes),
        )

    def _repr_html_(self) -> str:
        """The page itself, where it is short enough to be kept in a notebook; then what every result says."""
        said = super()._repr_html_()
        file = Path(self.file or "")
        if not _is_page(self.file) or not file.is_file():
            return said
        if (size := file.stat().st_size) > INLINE_BYTES:
            return (
                f"{said}<p>The page has {size / 1e6:.0f} MB and is not shown here, as the notebook would keep it: "
                f"open {html.escape(str(file))}</p>"
            )
        page = html.escape(file.read_text(encoding="utf-8"))
        frame = 'sandbox="allow-scripts allow-downloads" style="width:100%;height:720px;border:0"'
        return f'<iframe title="{html.escape(self.experiment)}" {frame} srcdoc="{page}"></iframe>{said}'

    def answers(self) -> Iterator[Answer]:
        """Say what is shown, and where.

        Yields:
            One answer.
        """
        yield Answer(
            subject=self.experiment,
            verdict=f"{self.samples} samples of {', '.join((*self.sensors, *self.skin))}",
            why=self.notes[:2],
            step=f"open {self.url}" if self.url else f"open {self.file} in a browser" if _is_page(self.file) else "",
            written=(self.file, self.video),
        )

    def blocks(self) -> Iterator[Table | str]:
        """Say what is shown, and where.

        Yields:
            Sentences.
        """
        yield f"{self.experiment}: {self.samples} samples of {', '.join((*self.sensors, *self.skin))}"
        if self.file is not None and self.file_bytes is not None:
            form = _FORMS.get(Path(self.file).suffix.lower(), "page")
            yield f"{form} of {self.file_bytes / 1e6:.1f} MB written to {self.file}"
        if self.video is not None:
            yield f"video of {self.video_frames} frames written to {self.video}"
        if self.url is not None:
            yield f"open {self.url}"

    def records(self) -> list[dict[str, object]]:
        """Give one line.

        Returns:
            What is single.
        """
        several = ("schema", "sensors", "skin", "notes")
        return [{name: value for name, value in self.flat().items() if name not in several}]


class _Sensor(BaseModel):
    calibrations: dict[str, Any]


class _Experiment(BaseModel):
    file: str
    sensors: tuple[_Sensor, ...]


class _Numbers(BaseModel):
    """Of the numbers of a report, those that say what it was made from."""

    schema_name: Literal["forcetorque/report/2"] = Field(alias="schema")
    experiments: tuple[_Experiment, ...]


def view_source(path: Path, calibrations: Sequence[Path] = ()) -> tuple[Path, list[Path]]:
    """Find the experiment to view and the calibrations to read its sensors by.

    Args:
        path: Experiment file, or the numbers of a report, whose paths are meant from the working folder, as they were
            when it was made.
        calibrations: Calibration files beside those of the report.

    Returns:
        Experiment file and calibration files.

    Raises:
        ForceTorqueError: If it is a table, or a report of several experiments.
        FormatError: If it is JSON and no report.
        MissingFileError: If it does not exist, or a file of the report is no longer there.
    """
    if path.suffix in (".parquet", ".csv"):
        raise ForceTorqueError(
            f"{path}: expected an experiment file or the numbers of a report, got a table, which does not say of which "
            f"robot it is; if it is a log, begin an experiment file by `forcetorque init {path} --urdf ROBOT.urdf`; if "
            "it is a result, view the experiment that it was made from"
        )
    if path.suffix != ".json":
        return path, list(calibrations)
    if not path.is_file():
        raise MissingFileError(f"{path}: expected the numbers of a report, there is none")
    numbers = _read(path)
    files = [experiment.file for experiment in numbers.experiments]
    if len(files) != 1:
        raise ForceTorqueError(f"{path}: expected a report of one experiment, got {', '.join(files)}; view one of them")
    used = [Path(file) for sensor in numbers.experiments[0].sensors for file in sensor.calibrations]
    for file in (Path(files[0]), *used):
        if not file.is_file():
            raise MissingFileError(f"{path}: {file}: expected the file that the report was made from, there is none")
    return Path(files[0]), list(dict.fromkeys([*used, *calibrations]))


def _read(path: Path) -> _Numbers:
    declare_input(path)
    try:
        return _Numbers.model_validate_json(path.read_bytes())
    except ValidationError as error:
        raise FormatError(f"{path}: expected the numbers of a report: {first_error(error)}") from error

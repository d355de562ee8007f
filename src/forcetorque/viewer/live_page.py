# SPDX-License-Identifier: BSD-3-Clause
"""The page that follows a live run. It asks for what came since it asked last, so that a slow one gets less often."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.live.corrector import Corrector
from forcetorque.live.lines_from_settings import message_frames
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import HeldQuantity
from forcetorque.live.recent_samples import RecentSamples
from forcetorque.live.result import Samples
from forcetorque.live.ros_topics import RosSource
from forcetorque.live.sample_status import status_text
from forcetorque.live.settings import Settings
from forcetorque.live.sources import ReplaySource, Source
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.urdf import read_urdf
from forcetorque.viewer.page import DATA_URL, STREAM_URL, ViewerServer, page_of
from forcetorque.viewer.posture import posture_at, root_poses
from forcetorque.viewer.robot_shapes import flat
from forcetorque.viewer.scene import (
    ArrayRef,
    Joint,
    LiveFeed,
    LiveSensorState,
    LiveUpdate,
    Robot,
    Scene,
    Sensor,
    Shape,
    WrenchSeries,
)
from forcetorque.viewer.scene_arrays import Block
from forcetorque.viewer.scene_builder import BuiltScene, drawn_robot
from forcetorque.viewer.sensor_wrenches import unread_sensor

MOST_ROWS: Final = 10_000
"""Rows of one answer."""
_PATIENCE_S: Final = 1.0
"""Time that an open page has to see how the run ended; s."""
_UPRIGHT: Final = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
_SPACING_M: Final = 0.2
"""Distance of sensors that are drawn without a robot; m."""

Postures = Callable[[Samples], tuple[FloatArray, FloatArray]]
"""Gives positions of joints, shape (k, d), and poses of the root link, shape (k, 7), at samples."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShownRobot:
    """The robot of a live run, or what is drawn in its place."""

    robot: Robot
    """What is drawn."""
    coordinates: tuple[str, ...]
    """Joints whose positions are known."""
    sensors: Sequence[Sensor]
    """The sensors, without wrenches."""
    postures: Postures
    """How it stands at samples."""
    notes: tuple[str, ...]
    """What is missing."""


def shown_robot(
    settings: Settings,
    source: Source,
    calibrations: Sequence[Calibration],
    block: Block,
    mesh_folders: Sequence[Path] = (),
) -> ShownRobot:
    """Find the robot of a live run: that of the recording, that of `--robot`, else the sensors alone.

    Args:
        settings: What is stated of the run.
        source: Where its samples come from.
        calibrations: A calibration per sensor.
        block: Takes the meshes.
        mesh_folders: Folders with packages of meshes.

    Returns:
        The robot.
    """
    if isinstance(source, ReplaySource) and source.experiment is not None and settings.replay is not None:
        return _recorded_robot(settings.replay, source, calibrations, block, mesh_folders)
    if isinstance(source, RosSource) and source.positions is not None and settings.robot:
        names, frames = source.positions.names, message_frames(settings, calibrations)
        robot, notes = drawn_robot(read_urdf(settings.robot), names, settings.robot, block, mesh_folders)
        return ShownRobot(
            robot=robot,
            coordinates=names,
            sensors=[_beside(one, frames[one.sensor.name]) for one in calibrations],
            postures=lambda samples: (samples.positions, np.tile(_UPRIGHT, (len(samples.time_s), 1))),
            notes=("the root link is drawn upright: where it is in the world is not in the stream", *notes),
        )
    return _sensors_alone(calibrations)


def _recorded_robot(
    path: Path,
    source: ReplaySource,
    calibrations: Sequence[Calibration],
    block: Block,
    mesh_folders: Sequence[Path],
) -> ShownRobot:
    experiment = source.experiment
    if experiment is None:
        return _sensors_alone(calibrations)
    recording, model = experiment.recording, experiment.model
    stream = recording.stream(experiment.sensor(calibrations[0].sensor.name).stream)
    posture = posture_at(recording, model, stream)
    root, assumed = root_poses(recording, model, posture, recording.intervals, experiment.processing)
    stated = parse_experiment(path).robot
    urdf = None if stated is None else urdf_file(stated.urdf, path.parent)
    robot, notes = drawn_robot(model, posture.names, urdf, block, mesh_folders)

    def postures(samples: Samples) -> tuple[FloatArray, FloatArray]:
        at = np.searchsorted(posture.stamp_ns, samples.stamp_ns, side="right") - 1
        at = np.clip(at, 0, len(posture.stamp_ns) - 1)
        return posture.position[at], root[at]

    return ShownRobot(
        robot=robot,
        coordinates=posture.names,
        sensors=[unread_sensor(model, one.sensor.name, one.sensor.serial) for one in calibrations],
        postures=postures,
        notes=(*posture.notes, *assumed, *notes),
    )


def _beside(calibration: Calibration, link: str) -> Sensor:
    ends = ("the child link", "the parent link")
    acting, acted_on = ends if calibration.sensor.measure_direction is MeasureDirection.CHILD_TO_PARENT else ends[::-1]
    return Sensor(
        name=calibration.sensor.name,
        serial=calibration.sensor.serial,
        link=link,
        link_H_sensor=flat(np.eye(4)),
        acting=acting,
        acted_on=acted_on,
        wrenches=(),
    )


def _sensors_alone(calibrations: Sequence[Calibration]) -> ShownRobot:
    """Sensors side by side, each along the axes of the page."""
    joints, shapes = [], []
    for place, one in enumerate(calibrations):
        name, pose = one.sensor.name, np.eye(4)
        pose[0, 3] = _SPACING_M * place
        joints.append(
            Joint(
                name=name, type="fixed", parent="page", child=name, parent_H_child=flat(pose), axis=(0.0, 0.0, 1.0),
                column=None, multiplier=1.0, offset=0.0,
            )
        )  # fmt: skip
        shapes.append(
            Shape(
                link=name, link_H_shape=flat(np.eye(4)), kind="cylinder", size=(0.03, 0.02), mesh=None,
                colour=(0.7, 0.7, 0.7, 0.6),
            )
        )  # fmt: skip
    names = tuple(one.sensor.name for one in calibrations)
    return ShownRobot(
        robot=Robot(
            name="sensors",
            root_link="page",
            links=("page", *names),
            joints=tuple(joints),
            shapes=tuple(shapes),
            meshes=(),
        ),
        coordinates=(),
        sensors=[_beside(one, one.sensor.name) for one in calibrations],
        postures=lambda samples: (samples.positions[:, :0], np.tile(_UPRIGHT, (len(samples.time_s), 1))),
        notes=("no robot in the stream: sensors are drawn side by side, not where they truly are",),
    )


def live_scene(
    shown: ShownRobot, correctors: Sequence[Corrector], block: Block, *, kept: int, window_s: float
) -> BuiltScene:
    """Make the scene of a live run, whose arrays over time begin empty.

    Args:
        shown: The robot.
        correctors: One for each group of sensors.
        block: Has its meshes.
        kept: Rows of the arrays.
        window_s: Time that is shown; s.

    Returns:
        The scene.
    """
    content = block.bytes() or bytes(8)  # a server has no part of nothing
    places = iter(range(len(content), 1 << 62, 8))

    def empty(columns: int) -> ArrayRef:
        return ArrayRef(offset=next(places), shape=(kept, columns), dtype="float32")

    def series(name: str, *, corrected: bool) -> WrenchSeries:
        return WrenchSeries(
            name=name, role="measured", calibrated=corrected, peak=(0.0, 0.0), values=empty(6),
            deviation=empty(6) if corrected else None, reference_force=None, reference_moment=None,
            ellipsoid_force=None, ellipsoid_moment=None,
        )  # fmt: skip

    time_s = ArrayRef(offset=next(places), shape=(kept,), dtype="float64")
    positions, root = empty(max(1, len(shown.coordinates))), empty(7)
    sensors = []
    of_sensors = ((one, corrector) for corrector in correctors for one in corrector.calibrations)
    for (one, corrector), sensor in zip(of_sensors, shown.sensors, strict=True):
        both = [series("corrected", corrected=True)]
        if corrector.options.quantity is HeldQuantity.WRENCH or one.prior is not None:
            both.append(series("by the prior matrix", corrected=False))
        sensors.append(replace(sensor, wrenches=tuple(both)))
    scene = Scene(
        title="live: " + ", ".join(sensor.name for sensor in sensors),
        provenance=(),
        samples=0,
        start_ns="0",
        end_s=0.0,
        time_s=time_s,
        positions=positions,
        coordinates=shown.coordinates,
        root=root,
        robot=shown.robot,
        sensors=tuple(sensors),
        contacts=(),
        intervals=(),
        findings=(),
        notes=shown.notes,
        annotations_url=None,
        live=LiveFeed(url=STREAM_URL, window_s=window_s),
    )
    return BuiltScene(scene=scene, block=content)


class ServedRun:
    """A live run as the page asks for it, a `LivePage`."""

    def __init__(self, recent: RecentSamples, shown: ShownRobot, scene: Scene) -> None:
        """Begin.

        Args:
            recent: Has the samples.
            shown: The robot.
            scene: What the page knows.
        """
        self.recent = recent
        self._shown, self._sensors = shown, scene.sensors
        self._loop: LiveLoop | None = None
        self._ended_by: str | None = None
        self._asked, self._end_seen = threading.Event(), threading.Event()

    def follow(self, loop: LiveLoop) -> None:
        """Show the state of a run, as of `LivePage`.

        Args:
            loop: The run.
        """
        self._loop = loop

    def end(self, ended_by: str) -> None:
        """Note that the run ended, as of `LivePage`; a page that is open gets the last samples.

        Args:
            ended_by: Why.
        """
        self._ended_by = ended_by
        if self._asked.is_set():
            self._end_seen.wait(_PATIENCE_S)

    def answer(self, number: int) -> bytes:
        """Give what came.

        Args:
            number: First sample that is wanted; below 0 for none.

        Returns:
            A `LiveUpdate`, a line end, and the rows array by array.
        """
        self._asked.set()
        ended_by = self._ended_by  # before the samples: those that come with it are the last
        samples = self.recent.since(max(0, number), MOST_ROWS if number >= 0 else 0)
        update = self._update(samples, ended_by)
        if ended_by is not None and (number < 0 or samples.next == self.recent.total):
            self._end_seen.set()
        return json.dumps(asdict(update), allow_nan=False).encode() + b"\n" + b"".join(self._rows(samples))

    def _update(self, samples: Samples, ended_by: str | None) -> LiveUpdate:
        loop = self._loop
        counts = None if loop is None else loop.counts()
        states = [] if loop is None else [state for states in loop.states for state in states]
        return LiveUpdate(
            first=samples.first,
            rows=len(samples.time_s),
            total=self.recent.total,
            received=counts.received if counts else 0,
            lost=counts.lost if counts and counts.countable else None,
            late=counts.late if counts else 0,
            repeated=counts.repeated if counts else 0,
            silent_s=0.0 if loop is None else loop.silent_s,
            ended_by=ended_by,
            sensors=tuple(
                LiveSensorState(
                    status=status_text(state.status),
                    samples=state.samples,
                    faulty=state.faulty,
                    drift=None if (drift := state.drift) is None else tuple(drift.tolist()),
                )
                for state in states
            ),
        )

    def _rows(self, samples: Samples) -> Iterator[bytes]:
        yield samples.time_s.astype("<f8").tobytes()
        positions, root = self._shown.postures(samples)
        arrays = [positions if positions.shape[1] else np.zeros((len(root), 1)), root]
        for k, sensor in enumerate(self._sensors):
            arrays += [samples.wrench[:, k], samples.half_width[:, k] / NORMAL_95]
            if len(sensor.wrenches) > 1:
                arrays.append(samples.reading[:, k])
        for array in arrays:
            yield array.astype("<f4").tobytes()


@contextmanager
def live_page(
    settings: Settings,
    source: Source,
    correctors: Sequence[Corrector],
    *,
    window_s: float,
    port: int = 0,
    mesh_folders: Sequence[Path] = (),
    opened: Callable[[str], None] = lambda _: None,
) -> Iterator[ServedRun]:
    """Serve the page of a live run to the browsers of this machine.

    Args:
        settings: What is stated of the run.
        source: Where its samples come from.
        correctors: One for each group of its sensors.
        window_s: Time that is shown; s.
        port: Port of 127.0.0.1; 0 for any that is free.
        mesh_folders: Folders with packages of meshes.
        opened: Called with the address.

    Yields:
        What the run gives its samples to.

    Raises:
        ForceTorqueError: If the time is not finite and above 0, or the port is taken.
        MissingFileError: If a folder is missing.
    """
    if not 0.0 < window_s < np.inf:
        raise ForceTorqueError(f"--view-s: expected a finite number above 0, got {window_s:g}")
    for folder in mesh_folders:
        if not folder.is_dir():
            raise MissingFileError(f"--mesh-dir {folder}: expected a folder, there is none")
    block = Block()
    calibrations = [one for corrector in correctors for one in corrector.calibrations]
    shown = shown_robot(settings, source, calibrations, block, mesh_folders)
    recent = RecentSamples(correctors, joints=len(shown.coordinates) if isinstance(source, RosSource) else 0)
    built = live_scene(shown, correctors, block, kept=recent.kept, window_s=window_s)
    run = ServedRun(recent, shown, built.scene)
    page = page_of(built, data_url=DATA_URL)
    with ViewerServer(page, built.block, None, port=port, stream=run.answer) as server:
        opened(server.url)
        yield run

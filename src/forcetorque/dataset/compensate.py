# SPDX-License-Identifier: BSD-3-Clause
"""Add the wrench without weight and bias of the tool to every frame of a dataset."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FormatError, OutputError, UnitError
from forcetorque.base.input_file import accept_input
from forcetorque.base.output_file import real_path, refuse_existing
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.base.units import NORMAL_95, si_factor
from forcetorque.base.wrench import WRENCH_COMPONENTS, MeasureDirection, wrench_matrix
from forcetorque.dataset.added_features import add_features, refuse_known_features
from forcetorque.dataset.episode_checks import equal_runs
from forcetorque.dataset.episode_frames import episode_frames, file_frames
from forcetorque.dataset.force_fields import ForceField, OrientationField
from forcetorque.dataset.result import CompensatedDataset
from forcetorque.dataset.resumable_folder import resumable_folder
from forcetorque.dataset.tool_load import KnownLoad, Tool, ToolSamples, identified
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.named_files import stated_in
from forcetorque.formats.lerobot.dataset import INFO, Episode, LeRobotDataset
from forcetorque.formats.specified_signals import even_stamps
from forcetorque.payload.identification.load_estimates import three
from forcetorque.payload.result import LoadRow
from forcetorque.recording.frozen_and_saturated_samples import white_variance
from forcetorque.robot.mount_estimate import rotation_vector

WORLD = "world"
"""The frame of the result whose axes are the world's; its origin is that of the sensor."""
_OF_A_FILE = ('set mount = "unknown"', "give --unknown-mount")
"""What the estimator advises for an experiment file, and what does the same here."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Measurement:
    """How the frames of a dataset become wrenches of the sensor."""

    field: ForceField
    """The measured field."""
    orientation: OrientationField
    """Orientation of the sensor, or of what it is fixed to."""
    force_unit: str | None
    """Unit of the forces; that of their names if None."""
    moment_unit: str | None
    """Unit of the moments; likewise."""
    calibration: Calibration | None
    """Calibration that turns the field into wrenches; None for a field of wrenches."""
    serial: str | None
    """Serial number of the sensor, for the calibration."""

    @property
    def labels(self) -> tuple[str, ...]:
        """Elements that are read."""
        return (*self.field.labels, *self.orientation.labels)

    def factors(self) -> FloatArray:
        """Give factors to N and N m.

        Returns:
            Shape (6,).

        Raises:
            UnitError: If a unit is neither stated nor in the names, or no unit of force or moment.
        """
        given = [self.force_unit] * 3 + [self.moment_unit] * 3
        factors = []
        for label, stated, named, expected in zip(
            self.field.labels, given, self.field.units, ["N"] * 3 + ["N m"] * 3, strict=True
        ):
            option = "--force-unit" if expected == "N" else "--moment-unit"
            unit = stated or named
            if unit is None:
                raise UnitError(
                    f"{label}: expected its unit, which the dataset does not have; give {option}, as {expected!r}"
                )
            si_unit, factor = si_factor(unit)
            if si_unit != expected or (stated and named and si_factor(named) != si_factor(stated)):
                raise UnitError(
                    f"{label}: expected a unit of {expected!r}, as its name has, got {unit!r}; see {option}"
                )
            factors.append(factor)
        return np.array(factors)

    def wrenches(self, values: FloatArray) -> FloatArray:
        """Give the wrenches of frames.

        Args:
            values: The field; shape (n, k); NaN in gaps.

        Returns:
            Shape (n, 6); N, N m; NaN where a value is missing.

        Raises:
            FormatError: If there is a calibration and no serial number.
            SerialNumberError: If the calibration is of another sensor.
            ShapeError: If it has another number of channels.
        """
        if self.calibration is None:
            return np.where(np.isfinite(values), values, np.nan) * self.factors()
        if self.serial is None:
            raise FormatError(
                f"calibration of sensor {self.calibration.sensor.serial!r}: expected --serial, the serial number of "
                "the sensor of the dataset, which the dataset does not have"
            )
        return self.calibration.apply(np.where(np.isfinite(values), values, np.nan), serial=self.serial)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Request:
    """What is to be added to a dataset."""

    measurement: Measurement
    """What is measured."""
    direction: MeasureDirection
    """Who acts on whom in the measurement; the tool is the child."""
    known: KnownLoad | None
    """The tool; None to identify it from the dataset."""
    mount: bool
    """Whether the sensor is turned against the frame of the orientation by an unknown rotation."""
    by_episode: bool
    """Whether every episode has a bias of its own."""
    free_s: float | None
    """Time from the start of each episode in which nothing touches; s; None for all frames."""
    frame: str
    """`sensor` or `world`."""
    frame_H_sensor: FloatArray | None
    """Pose of the sensor in another frame, in which and about whose origin the wrench is wanted; shape (4, 4); m."""
    name: str
    """Feature to add."""

    @property
    def features(self) -> dict[str, tuple[str, ...]]:
        """What is added: names of the elements of the wrench and of its standard deviation, by name of the feature."""
        return {
            self.name: WRENCH_COMPONENTS,
            f"{self.name}_std": tuple(f"{one}_std" for one in WRENCH_COMPONENTS),
        }


def compensated(
    dataset: LeRobotDataset, output: Path, request: Request, *, options: dict[str, Any], progress: Progress
) -> CompensatedDataset:
    """Copy a dataset and add the wrench without weight and bias of the tool.

    Args:
        dataset: The dataset.
        output: Folder to make.
        request: What is added.
        options: What the copy follows from beside the dataset, by which a killed run is continued; JSON.
        progress: Called with lines for people.

    Returns:
        What was taken off and added.

    Raises:
        FormatError: If the dataset is damaged.
        FitError: If weight and bias are not identifiable.
        OutputError: If the output is in the dataset, or the dataset has such a feature.
    """
    _refuse_inside(dataset.root, output)
    refuse_existing(output)
    refuse_known_features(dataset, list(request.features))
    accept_input(dataset.root)
    tool, left_out = _identified(dataset, request, progress)
    errors = np.zeros(6)
    with resumable_folder(output, _plan(dataset, options)) as folder:
        resumed, statistics = add_features(
            dataset,
            folder,
            request.features,
            lambda file, episodes: _values(dataset, request, tool, file, episodes),
            progress,
        )
        errors = np.array(statistics[1]["mean"], dtype=np.float64)
    return _result(dataset, output, request, tool, left_out, resumed, errors)


def _refuse_inside(root: Path, output: Path) -> None:
    source, target = real_path(root), real_path(output)
    if source == target or source in target.parents or target in source.parents:
        raise OutputError(f"{output}: expected a folder beside the dataset {root}, got one in it or around it")


def _plan(dataset: LeRobotDataset, options: dict[str, Any]) -> dict[str, Any]:
    files = {
        file.relative_to(dataset.root).as_posix(): [file.stat().st_size, file.stat().st_mtime_ns]
        for file, _ in dataset.files()
        if file.is_file()
    }
    info = sha256((dataset.root / INFO).read_bytes()).hexdigest()
    listed = sha256(repr(sorted(files.items())).encode()).hexdigest()
    return {"dataset": str(real_path(dataset.root)), "info": info, "files": listed, "options": options}


def _identified(dataset: LeRobotDataset, request: Request, progress: Progress) -> tuple[Tool, int]:
    """Weight and bias, and frames that were left out because they are stuck or lack a value."""
    measurement, rate = request.measurement, dataset.fps
    most = None if request.free_s is None else max(1, round(request.free_s * rate))
    usable_frames = sum(one.frames if most is None else min(one.frames, most) for one in dataset.episodes)
    samples, noises, left_out, frames = ToolSamples(rate, usable_frames), [], 0, 0
    total = sum(episode.frames for episode in dataset.episodes)
    left = TimeLeft(progress, "identifying weight and bias", total)
    for episode, values in episode_frames(dataset, measurement.labels):
        wrench, turned, gravity = _split(measurement, values, f"{episode.file}: episode {episode.index}")
        usable = np.isfinite(wrench).all(axis=1) & np.isfinite(gravity).all(axis=1) & ~_stuck(measurement, values, rate)
        left_out += int(np.count_nonzero(~usable[:most]))
        if episode.frames:
            variance = white_variance(even_stamps(len(wrench), rate_hz=rate, start_s=0.0), wrench)
            noises.append(np.where(variance > 0.0, np.sqrt(variance), np.nan))
        samples.add(episode.index, wrench[:most], gravity[:most], turned[:most], usable[:most])
        frames += episode.frames
        left.at(frames)
    with stated_in(str(dataset.root)):
        tool = identified(
            samples,
            noises,
            known=request.known,
            direction=request.direction,
            mount=request.mount,
            by_episode=request.by_episode,
        )
    return tool, left_out


def _split(measurement: Measurement, values: FloatArray, place: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    width = len(measurement.field.labels)
    turned, gravity = measurement.orientation.turned(values[:, width:], place)
    return measurement.wrenches(values[:, :width]), turned, gravity


def _stuck(measurement: Measurement, values: FloatArray, rate_hz: float) -> BoolArray:
    stuck = np.zeros(len(values), dtype=bool)
    own = values[:, : len(measurement.field.labels)]
    for k in range(own.shape[1]):
        for run in equal_runs(k, own, rate_hz):
            stuck[run.first : run.first + run.frames] = True
    return stuck


def _values(
    dataset: LeRobotDataset, request: Request, tool: Tool, file: Path, episodes: tuple[Episode, ...]
) -> dict[int, npt.NDArray[np.float32]]:
    """Wrench and standard deviation of the episodes of a file."""
    values: dict[int, npt.NDArray[np.float32]] = {}
    for episode, frames in file_frames(dataset, file, episodes, request.measurement.labels):
        place = f"{file}: episode {episode.index}"
        wrench, turned, gravity = _split(request.measurement, frames, place)
        left, covariance = tool.taken_off(wrench, gravity, dataset.fps)
        matrix = _into_frame(request, tool, turned)
        left = np.einsum("...ij,nj->ni" if matrix.ndim == 2 else "nij,nj->ni", matrix, left)
        covariance = matrix @ covariance @ np.swapaxes(matrix, -1, -2)
        deviation = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
        both = np.hstack([left, deviation])
        lacking = np.flatnonzero(~np.isfinite(both).all(axis=1))
        if len(lacking):
            raise FormatError(
                f"{place}: frame {lacking[0]}: expected a measurement and an orientation in every frame, got "
                f"{len(lacking)} without; a policy cannot learn from NaN: repair or remove the episode first"
            )
        values[episode.index] = both.astype(np.float32)
    return values


def _into_frame(request: Request, tool: Tool, turned: FloatArray) -> FloatArray:
    """Matrix that brings wrenches of the sensor into the frame of the result; shape (6, 6) or (n, 6, 6)."""
    if request.frame_H_sensor is not None:
        return wrench_matrix(request.frame_H_sensor)
    if request.frame != WORLD:
        return np.eye(6)
    # the orientation is that of the motion's frame, in which a mount turns the sensor
    rotation = turned @ tool.solution.guess.rotation.T
    matrix = np.zeros((len(turned), 6, 6))
    matrix[:, :3, :3] = matrix[:, 3:, 3:] = rotation
    return matrix


def _result(
    dataset: LeRobotDataset,
    output: Path,
    request: Request,
    tool: Tool,
    left_out: int,
    resumed_files: int,
    deviation: FloatArray,
) -> CompensatedDataset:
    solution = tool.solution
    load = LoadRow.of(solution.loads[0])
    if tool.known is not None:
        halves = NORMAL_95 * np.sqrt(np.diag(tool.known.covariance))
        load = load.model_copy(update={"mass_half_width_95_kg": float(halves[0])})
    warnings = [f"{row.name}: {row.description.replace(*_OF_A_FILE)}" for row in solution.hypotheses]
    tests = [test for test in solution.bias_tests if test.p_value is not None and test.p_value < 1e-3]
    if tests and not request.by_episode:
        largest = max(abs(value or 0.0) for value in tests[0].largest_difference[:3])
        warnings.append(f"biases of episodes differ by up to {largest:.2g} N: --bias episode takes one of each off")
    share = float(np.mean(solution.weight < 0.5))
    mount = rotation_vector(solution.mount) if request.mount else None
    feature, standard_deviation_feature = request.features
    return CompensatedDataset(
        source=str(dataset.root),
        output=str(output),
        version=dataset.version,
        episodes=len(dataset.episodes),
        frames=sum(episode.frames for episode in dataset.episodes),
        measured=request.measurement.field.name,
        orientation=request.measurement.orientation.name,
        feature=feature,
        standard_deviation_feature=standard_deviation_feature,
        frame="pose" if request.frame_H_sensor is not None else request.frame,
        measure_direction=request.direction.value,
        calibrated_by=None if request.measurement.calibration is None else request.measurement.serial,
        loads=(load,),
        load_from="result" if tool.known is not None else "dataset",
        sessions=solution.sessions,
        bias_of="episode" if request.by_episode else "dataset",
        mount_rad=None if mount is None else three(mount),
        windows=len(solution.residual),
        contact_share=share,
        left_out_frames=left_out,
        residual_rms=solution.residual_rms,
        noise=tool.noise,
        mean_standard_deviation=deviation,
        contradicted=any(row.severity == "contradiction" for row in solution.hypotheses),
        resumed_files=resumed_files,
        warnings=tuple(warnings),
    )

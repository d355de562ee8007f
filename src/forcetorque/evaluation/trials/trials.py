# SPDX-License-Identifier: BSD-3-Clause
"""Trials of sensors read from experiment files and grouped, the mean of their indices, and the drift."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, MissingFileError, known_names
from forcetorque.evaluation.section import TRIAL
from forcetorque.evaluation.sphere.ellipsoid import EllipsoidFit
from forcetorque.evaluation.sphere.pooled_fit import PooledSphere, pool_trials
from forcetorque.evaluation.sphere.resampling import BLOCKS
from forcetorque.evaluation.sphere.result import FailureRow, bounded
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
from forcetorque.experiment.applicability import calibrations_of
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Interval
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import AxisValues, Row

_UPPER = 0.975
"""Quantile at the upper end of a 95 % interval."""
_JUDGED = 7
"""Numbers that a drift is told by: index, three intersections, three coordinates of the centre."""


def mean_of_trials(indices: Sequence[float]) -> tuple[float, float, float]:
    """Average the indices of trials with equal weights: the `Average Std` of thesis Tables 4.3 and 4.4.

    Args:
        indices: Performance indices; any unit.

    Returns:
        Their mean, and the ends of its 95 % interval from the scatter between trials, by Student's t: the lower end is
        not below 0; one trial gives 0 and infinity.

    Raises:
        ForceTorqueError: If there is no index, or one is not finite.
    """
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    values = np.asarray(indices, dtype=np.float64)
    if values.ndim != 1 or not len(values) or not np.isfinite(values).all():
        raise ForceTorqueError(f"indices: expected at least one number, all finite, got {list(indices)}")
    mean, count = float(values.mean()), len(values)
    if count == 1:
        return mean, 0.0, np.inf
    margin = float(stdtrit(count - 1, _UPPER) * values.std(ddof=1) / np.sqrt(count))
    return mean, max(0.0, mean - margin), mean + margin


class DriftRow(Row):
    """What changed from the first trial to the last; margins are for all seven numbers at once, from both intervals."""

    identifiable: bool
    """Whether both trials are; else nothing is said to have changed."""
    index_kg: float
    """Change of the index."""
    index_margin_kg: float | None
    """Its margin; none where it has no end."""
    mass_kg: AxisValues
    """Change of the apparent mass of each axis."""
    mass_margin_kg: tuple[float | None, ...]
    """Their margins."""
    centre_N: AxisValues
    """Change of what the sensor reads without force."""
    centre_margin_N: tuple[float | None, ...]
    """Its margins."""
    exceeds: tuple[str, ...] | None
    """What changed by more than its margin; none where it is not identifiable."""


def drift_between(first: EllipsoidFit, last: EllipsoidFit, *, gravity: float) -> DriftRow | None:
    """Compare two trials.

    The margin of a difference has the halves of the two intervals that face each other as its sides, and is wider by
    what it takes for all seven numbers to be within theirs with 95 % where nothing changed.

    Args:
        first: Fit to the first trial.
        last: Fit to the last trial.
        gravity: Magnitude of gravity in both; m/s2.

    Returns:
        The change; None where one has no ellipsoid.
    """
    if first.ellipsoid is None or last.ellipsoid is None:
        return None
    before, after = first.ellipsoid.axis_intersections, last.ellipsoid.axis_intersections
    (index,), (index_margin,) = _change(
        [first.index], [last.index], [first.index_low], [first.index_high], [last.index_low], [last.index_high]
    )
    wider = _wider_together()
    change, margin = _change(before, after, first.low, first.high, last.low, last.high)
    margin, index_margin = wider * margin, wider * index_margin
    centre = last.ellipsoid.centre - first.ellipsoid.centre
    centre_margin = wider * np.hypot(first.centre_margin, last.centre_margin)
    identifiable = first.identifiable and last.identifiable
    exceeds = ["index"] if abs(index) > index_margin else []
    for what, difference, limit in (("mass", change, margin), ("centre", centre, centre_margin)):
        exceeds += [f"{what} {axis}" for axis, beyond in zip("xyz", np.abs(difference) > limit, strict=True) if beyond]
    return DriftRow(
        identifiable=identifiable,
        index_kg=float(index) / gravity,
        index_margin_kg=finite_or_none(float(index_margin) / gravity),
        mass_kg=change / gravity,
        mass_margin_kg=bounded(margin / gravity),
        centre_N=centre,
        centre_margin_N=bounded(centre_margin),
        exceeds=tuple(exceeds) if identifiable else None,
    )


def _wider_together() -> float:
    """How much wider margins are that hold for all evaluated numbers at once with 95 %, by Bonferroni: 1.5."""
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    return float(stdtrit(BLOCKS - 1, 1.0 - (1.0 - _UPPER) / _JUDGED) / stdtrit(BLOCKS - 1, _UPPER))


def _change(
    first: Sequence[float] | FloatArray,
    last: Sequence[float] | FloatArray,
    first_low: Sequence[float] | FloatArray,
    first_high: Sequence[float] | FloatArray,
    last_low: Sequence[float] | FloatArray,
    last_high: Sequence[float] | FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Differences, and the margins on the sides that face each other."""
    a, b = np.asarray(first), np.asarray(last)
    change = b - a
    up = np.hypot(np.asarray(first_high) - a, b - np.asarray(last_low))
    down = np.hypot(a - np.asarray(first_low), np.asarray(last_high) - b)
    return change, np.where(change >= 0.0, up, down)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrialSphere:
    """Sphere analysis of one trial: a sensor in one recording, read in one way."""

    file: str
    """Experiment file."""
    experiment: str
    """Name of the experiment."""
    condition: str | None
    """What was done to the sensor; None if the file does not say."""
    number: int | None
    """Which trial of its condition the file says it is."""
    prior: FloatArray | None
    """Matrix that the prior's forces are read with; shape (6, c); N/count, N m/count."""
    sphere: SensorSphere
    """The analysis."""
    added: tuple[str, ...] = ()
    """What the file adds to its log, in sentences."""

    @property
    def gravity(self) -> float:
        """Magnitude of gravity that the file states; m/s2."""
        return self.sphere.analysis.gravity

    def fit(self, *, with_model: bool) -> EllipsoidFit | None:
        """Give one of the two ellipsoids of forces.

        Args:
            with_model: Whether it is that with the model.

        Returns:
            The fit; None where there is none with the model.
        """
        if not with_model:
            return self.sphere.analysis.free
        mapped = self.sphere.analysis.mapped
        return None if mapped is None else mapped.fit


@dataclass(slots=True, kw_only=True)
class _Reading:
    """What has been read so far."""

    sensors: Collection[str] | None
    calibrations: Mapping[str, Calibration]
    intervals: Sequence[str] | None
    by_interval: bool
    trials: list[TrialSphere] = field(default_factory=list)
    failures: list[FailureRow] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    """Names of sensors and calibrations that were found in a file."""
    known: dict[str, None] = field(default_factory=dict)
    """All sensors of all files."""


def read_trials(
    paths: Sequence[Path | str],
    *,
    sensors: Collection[str] | None = None,
    calibrations: Mapping[str, Calibration] | None = None,
    intervals: Sequence[str] | None = None,
    by_interval: bool = False,
    progress: Callable[[str], None] | None = None,
) -> tuple[list[TrialSphere], list[FailureRow]]:
    """Read experiment files one after the other and analyse their spheres; what fails does not stop the others.

    Args:
        paths: Experiment files.
        sensors: Names of sensors, each in one file at least; None for all.
        calibrations: Calibrations by name, each for the sensor of its name and serial number in any of the files.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for what each file says.
        by_interval: Whether each interval is a trial of its own; else all of a file are taken together.
        progress: Called with a line for people at every file.

    Returns:
        Trials in the order of the files, and what failed.

    Raises:
        MissingFileError: If a file is not there; nothing has been read then.
        ExperimentError: If a file is named twice.
    """
    files = [Path(path) for path in paths]
    _refuse_wrong_names(files)
    reading = _Reading(sensors=sensors, calibrations=calibrations or {}, intervals=intervals, by_interval=by_interval)
    for count, path in enumerate(files, 1):
        if progress is not None:
            progress(f"reading {path} ({count} of {len(files)})")
        try:
            experiment = load_experiment(path)
            spans = sphere_intervals(experiment, intervals)
        except (ForceTorqueError, OSError, np.linalg.LinAlgError) as error:
            reading.failures.append(FailureRow.of(str(path), None, error))
            continue
        # only forces are kept: the recording goes before the next one comes
        _read_sensors(reading, path, experiment, spans)
    _require_all_used(reading)
    return reading.trials, reading.failures


def _refuse_wrong_names(paths: Sequence[Path]) -> None:
    """What is wrong with the names is said before hours are spent on the files."""
    seen: set[Path] = set()
    for path in paths:
        if not path.is_file():
            raise MissingFileError(f"{path}: expected an experiment file, there is none")
        if path.resolve() in seen:
            raise ExperimentError(f"{path}: is named twice, and a trial does not count twice; name it once")
        seen.add(path.resolve())


def _read_sensors(reading: _Reading, path: Path, experiment: Experiment, spans: Sequence[Interval]) -> None:
    reading.known.update(dict.fromkeys(sensor.name for sensor in experiment.sensors))
    for sensor in _chosen(reading, experiment):
        run, own = SensorRun(experiment, sensor), calibrations_of(experiment, sensor, reading.calibrations)
        reading.used.update(own)
        for together in ([span] for span in spans) if reading.by_interval else [list(spans)]:
            try:
                spheres = sensor_spheres(run, own, together)
            except (ForceTorqueError, OSError) as error:
                reading.failures.append(FailureRow.of(str(path), sensor.name, error, named=reading.sensors is not None))
                continue
            reading.trials += [
                TrialSphere(
                    file=str(path),
                    experiment=experiment.name,
                    condition=experiment.section(TRIAL).condition,
                    # a file with several trials numbers none of them
                    number=None if reading.by_interval and len(spans) > 1 else experiment.section(TRIAL).number,
                    prior=sensor.prior,
                    sphere=sphere,
                    added=added_to(experiment.recording),
                )
                for sphere in spheres
            ]


def _chosen(reading: _Reading, experiment: Experiment) -> Iterator[ExperimentSensor]:
    """Sensors of a file that were asked for, each once."""
    if reading.sensors is None:
        yield from experiment.sensors
        return
    for sensor in experiment.sensors:
        names = {sensor.name, *experiment.model.sensor(sensor.name).aliases}
        asked = names & set(reading.sensors)
        if asked:
            reading.used |= asked
            yield sensor


def _require_all_used(reading: _Reading) -> None:
    """What the user named and no file has is a failure too."""
    for name in dict.fromkeys(reading.sensors or ()):
        if name not in reading.used:
            error = ExperimentError(f"no file has a sensor {name!r}; {known_names(name, reading.known)}")
            reading.failures.append(FailureRow.of("--sensor", name, error))
    for name, calibration in reading.calibrations.items():
        if name not in reading.used:
            sensor = calibration.sensor
            words = f"is of {sensor.name!r} with the serial number {sensor.serial!r}, which was read from no file"
            reading.failures.append(FailureRow.of(name, sensor.name, ExperimentError(words)))


_SAME_WEIGHT = 0.01
"""Difference of the weights of trials, relative to their mean, up to which they are of one limb."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrialGroup:
    """All trials of one sensor under one condition, read in one way."""

    trials: tuple[TrialSphere, ...]
    """In their order, at least one."""
    pooled: PooledSphere | None
    """One analysis over all; None with one trial, or where there is none."""
    not_pooled: str | None
    """Why several trials were not pooled."""

    @property
    def first(self) -> TrialSphere:
        """The first trial, which says what all have in common."""
        return self.trials[0]

    def pooled_fit(self, *, with_model: bool) -> EllipsoidFit | None:
        """Give one of the two pooled ellipsoids.

        Args:
            with_model: Whether it is that with the model.

        Returns:
            The fit; None where there is none.
        """
        if self.pooled is None:
            return None
        return self.pooled.mapped if with_model else self.pooled.free

    def identifiable_indices(self, *, with_model: bool) -> list[float]:
        """Compute the indices of the trials that are identifiable.

        Args:
            with_model: Whether they are those with the model.

        Returns:
            Indices in the order of the trials; kg.
        """
        fits = [(trial.gravity, trial.fit(with_model=with_model)) for trial in self.trials]
        return [fit.index / gravity for gravity, fit in fits if fit is not None and fit.identifiable]

    def drift(self, *, with_model: bool) -> DriftRow | None:
        """Compare the first trial with the last.

        Args:
            with_model: Whether by the fits with the model.

        Returns:
            Last minus first; None with one trial, where one has no ellipsoid, or where the files state different
            gravity, which no sensor is to blame for.
        """
        if self.trials[0].gravity != self.trials[-1].gravity:
            return None
        ends = [trial.fit(with_model=with_model) for trial in (self.trials[0], self.trials[-1])]
        if len(self.trials) < 2 or ends[0] is None or ends[1] is None:
            return None
        return drift_between(ends[0], ends[1], gravity=self.first.gravity)

    def index(self, *, with_model: bool) -> float | None:
        """Give the index by which the group may be compared with others.

        Args:
            with_model: Whether it is that with the model.

        Returns:
            That of the pooled fit, or of the only trial; kg; None where it is not identifiable.
        """
        fit = self._known_fit(with_model=with_model)
        return None if fit is None else fit.index / self.first.gravity

    def index_interval(self, *, with_model: bool) -> tuple[float, float] | None:
        """Give the 95 % interval of that index.

        Args:
            with_model: Whether it is that with the model.

        Returns:
            Its ends; kg; None where the index is not identifiable.
        """
        fit, gravity = self._known_fit(with_model=with_model), self.first.gravity
        return None if fit is None else (fit.index_low / gravity, fit.index_high / gravity)

    def _known_fit(self, *, with_model: bool) -> EllipsoidFit | None:
        """The pooled fit, all of whose trials have one gravity, or that of the only trial, if it is identifiable."""
        fit = self.pooled_fit(with_model=with_model)
        if len(self.trials) == 1:
            fit = self.first.fit(with_model=with_model)
        return fit if fit is not None and fit.identifiable else None


def group_trials(
    trials: Sequence[TrialSphere], *, progress: Callable[[str], None] | None = None
) -> tuple[list[TrialGroup], list[str]]:
    """Sort trials by sensor, serial number, condition and way of reading, and pool those of each group.

    Args:
        trials: Trials in the order of their files.
        progress: Called with a line for people at every group that is pooled.

    Returns:
        Groups in the order of their first trials, and warnings.
    """
    by_condition: dict[tuple[str, str, str | None, str], list[TrialSphere]] = {}
    for trial in trials:
        sphere = trial.sphere
        by_condition.setdefault((sphere.sensor, sphere.serial, trial.condition, sphere.calibration), []).append(trial)
    groups, warnings = [], []
    for (sensor, serial, condition, candidate), members in by_condition.items():
        where = f"{sensor} ({serial}), {condition or 'no condition'}, {candidate}"
        ordered, warning = _ordered(members)
        if warning is not None:
            warnings.append(f"{where}: {warning}")
        if progress is not None and len(ordered) > 1:
            progress(f"pooling {len(ordered)} trials of {where}")
        pooled, reason = _pooled(ordered)
        groups.append(TrialGroup(trials=tuple(ordered), pooled=pooled, not_pooled=reason))
    return groups, warnings


def _ordered(trials: list[TrialSphere]) -> tuple[list[TrialSphere], str | None]:
    """Trials by their numbers, where all have one; else as they came."""
    numbers = [trial.number for trial in trials]
    stated = [number for number in numbers if number is not None]
    if len(stated) == len(trials) == len(set(stated)):
        return sorted(trials, key=lambda trial: trial.number or 0), None
    if not stated:
        return trials, None
    return trials, "[trial] number is missing or double in some files; the order is that of the files"


def _pooled(trials: Sequence[TrialSphere]) -> tuple[PooledSphere | None, str | None]:
    """One analysis over trials, or why there is none; neither for one trial."""
    if len(trials) < 2:
        return None, None
    spheres = [trial.sphere for trial in trials]
    priors = [trial.prior for trial in trials]
    if spheres[0].calibration == PRIOR and not all(_same(priors[0], prior) for prior in priors[1:]):
        return None, "the trials are read with different prior matrices"
    gravities = list(dict.fromkeys(trial.gravity for trial in trials))
    if len(gravities) > 1:
        return None, f"the files state different gravity ({', '.join(f'{gravity:g}' for gravity in gravities)} m/s2)"
    weights = np.array([_weight(sphere) for sphere in spheres])
    known = weights[np.isfinite(weights)]
    if len(known) and float(np.ptp(known)) > _SAME_WEIGHT * float(known.mean()):
        masses = ", ".join(f"{weight / spheres[0].analysis.gravity:.3g}" for weight in known)
        return None, f"by the models the trials carry different weights ({masses} kg)"
    references = [sphere.reference for sphere in spheres]
    whole = [reference for reference in references if reference is not None]
    complete = len(whole) == len(spheres)
    forces, weight = [sphere.force for sphere in spheres], float(known.mean()) if complete else None
    try:
        return pool_trials(forces, whole if complete else None, weight=weight), None
    except (FitError, np.linalg.LinAlgError) as error:
        return None, str(error)


def _same(first: FloatArray | None, other: FloatArray | None) -> bool:
    return first is other or (first is not None and other is not None and np.array_equal(first, other))


def _weight(sphere: SensorSphere) -> float:
    """Weight on the sensor by the model, N; NaN if it is not known."""
    if sphere.analysis.mass is not None:
        return sphere.analysis.mass * sphere.analysis.gravity
    if sphere.reference is None:
        return np.nan
    return float(np.linalg.norm(sphere.reference, axis=1).mean())

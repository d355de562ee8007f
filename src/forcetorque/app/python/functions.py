# SPDX-License-Identifier: BSD-3-Clause
"""Analyses that begin with a file of their own, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from forcetorque.base.output_file import refuse_existing
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, estimation_type
from forcetorque.locomotion.movement import BAND_SHARE, Motion
from forcetorque.results.result import created_now
from forcetorque.skin.taxels.calibrate import SkinCalibration
from forcetorque.skin.taxels.curve import CurveKind
from forcetorque.skin.taxels.patch_calibration import PatchCalibration
from forcetorque.skin.wrench.wrench import SkinWrench, WrenchChoice
from forcetorque.study.candidate import SWEEP_LAMBDAS
from forcetorque.workbench.recording import BenchRecording

if TYPE_CHECKING:
    from forcetorque.device.design import DeviceDesign
    from forcetorque.device.device_file import DeviceFile
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.simulation.recordings import WrittenScenario
    from forcetorque.study.result import Studies
    from forcetorque.workbench.result import Workbench


def workbench(
    *recordings: BenchRecording | Path | str,
    full_matrix: bool = False,
    only_next: bool = False,
    spec: AcceptanceFile | None = None,
    seed: int = 0,
) -> Workbench:
    """Calibrate sensors with known loads, and find faults of the workbench: `workbench("SN170.toml")`.

    Args:
        recordings: What was hung on each sensor, or the file of it.
        full_matrix: Whether loads that do not move all six directions are refused, whatever a prior says.
        only_next: Whether only blocks are checked, and nothing is fitted.
        spec: Limits to judge the calibrations by; none if left out.
        seed: Of the deals into folds.

    Returns:
        Faults, errors and matrices; `save` writes the calibration of a single sensor.
    """
    from forcetorque.workbench.calibrate import workbench
    from forcetorque.workbench.recording import read_bench

    read = [given if isinstance(given, BenchRecording) else read_bench(given) for given in recordings]
    created = created_now()
    return workbench(
        read,
        code_version=version("forcetorque"),
        created=created,
        full_matrix=full_matrix,
        only_next=only_next,
        spec=spec,
        seed=seed,
    )


def design_device(device: DeviceFile | Path | str | None = None) -> DeviceDesign:
    """Check a calibration device by computation.

    Args:
        device: The device, or its file; the one that comes with the library if None.

    Returns:
        What the command line shows; its `picture` has the motion, `forcetorque.device.write_device` writes it.
    """
    from forcetorque.device.design import design_device
    from forcetorque.device.device_file import DEFAULT_DEVICE, DeviceFile, read_device

    if not isinstance(device, DeviceFile):
        device = read_device(DEFAULT_DEVICE if device is None else device)
    return design_device(device)


def motion(
    log: Path | str,
    columns: Sequence[str],
    *,
    steps_s: Sequence[float] = (),
    band_share: float = BAND_SHARE,
    desired: Sequence[str] = (),
    intervals: Collection[str] = (),
    calibrations: Mapping[str, Calibration] | None = None,
) -> Motion:
    """Say how columns of a log move.

    Args:
        log: Experiment file, with or without sensors, or a log.
        columns: Columns of the log, or of `balance`.
        steps_s: Instants of steps; those of what was wanted if none is named; s.
        band_share: Half of the band of settling over the step.
        desired: Columns of the log with what was wanted, one for each of the first; none if nothing was.
        intervals: Labels of the intervals that are taken; all that are not to be ignored if none is named.
        calibrations: Calibrations that read the sensors for columns of `balance`, by name.

    Returns:
        Oscillations, settling times and tracking errors.
    """
    from forcetorque.locomotion.logged_signals import motion_signals
    from forcetorque.locomotion.movement import motion

    signals = motion_signals(log, columns, desired=desired, intervals=intervals, calibrations=calibrations)
    return motion(signals, steps_s=steps_s, band_share=band_share)


def motion_of_arrays(
    time_s: Any,
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    *,
    desired: Mapping[str, Any] | None = None,
    steps_s: Sequence[float] = (),
    band_share: float = BAND_SHARE,
) -> Motion:
    """Say how arrays move, such as columns of a data frame or of a simulation.

    Args:
        time_s: Instants; shape (n,); s.
        columns: Samples by name; shape (n,) each.
        units: Unit of each.
        desired: What was wanted of some of them, by their names; shape (n,) each.
        steps_s: Instants of steps; those of what was wanted if none is named; s.
        band_share: Half of the band of settling over the step.

    Returns:
        Oscillations, settling times and tracking errors.
    """
    from forcetorque.locomotion.logged_signals import motion_signals_of_arrays
    from forcetorque.locomotion.movement import motion

    signals = motion_signals_of_arrays(time_s, columns, units, desired=desired)
    return motion(signals, steps_s=steps_s, band_share=band_share)


def simulate(
    scenario: Path | str, folder: Path | str, *, progress: Callable[[str], None] | None = None
) -> WrittenScenario:
    """Make recordings of a simulated robot whose sensors are known: `simulate("wrist", "simulated")`.

    Args:
        scenario: Scenario file (TOML), or a bundled one: icub-insitu, stance, switching, wrist.
        folder: Folder to make; it is there as a whole or not at all.
        progress: Called with a line for people at every recording, such as `print`.

    Returns:
        What was written: an experiment file per recording.

    Raises:
        ForceTorqueError: If there is no such scenario, or the folder is there already.
    """
    from forcetorque.simulation.recordings import write_scenario
    from forcetorque.simulation.scenario.file import bundled_scenario
    from forcetorque.simulation.scenario.scenario import load_scenario

    file = scenario if str(scenario).endswith(".toml") else bundled_scenario(str(scenario))
    return write_scenario(load_scenario(Path(file)), folder, progress=progress)


def calibrate_skin(
    *experiments: Path | str,
    patch: str | None = None,
    curve: str = CurveKind.MONOTONE,
    highest_pa: float | None = None,
    warm_up: Path | str | None = None,
) -> SkinCalibration:
    """Fit the pressure curve of every taxel of a patch.

    Args:
        experiments: Experiment files with the patch, fitted and kept back.
        patch: Name of the patch; None for the only one.
        curve: Form of curve to keep.
        highest_pa: Highest pressure above rest to fit; Pa; None for all.
        warm_up: Experiment file of a recording without contact while the robot warms up; heat is not told from pressure
            without one.

    Returns:
        The answer, with the curves as its `calibration`.
    """
    from forcetorque.skin.taxels.calibrate import calibrate_skin

    created = created_now()
    return calibrate_skin(
        experiments,
        code_version=version("forcetorque"),
        created=created,
        patch=patch,
        curve=curve,
        highest_pa=highest_pa,
        warm_up=warm_up,
    )


def skin_wrench(
    experiment: Path | str, calibration: Path | str | PatchCalibration, *, patch: str | None = None, **choice: Any
) -> SkinWrench:
    """Find the contacts on a patch in a recording, and their wrenches on the link.

    Args:
        experiment: Experiment file with the patch.
        calibration: Calibration of its taxels, or its file.
        patch: Name of the patch; None for the only one.
        choice: As of `WrenchChoice`: method, taxel_area_mm2, plan, rest_s, averaged and others.

    Returns:
        Every contact of every frame.
    """
    from forcetorque.skin.wrench.wrench import skin_wrench

    return skin_wrench(experiment, calibration, patch=patch, choice=WrenchChoice(**choice))


def study(
    *experiments: Path | str,
    sensors: Sequence[str] | None = None,
    data_sets: Mapping[str, Sequence[str]] | None = None,
    kinds: Sequence[str] = tuple(ESTIMATION_TYPES),
    lambdas: Sequence[float] = SWEEP_LAMBDAS,
    sphere: Collection[str] | None = None,
    folder: Path | str | None = None,
    progress: Callable[[str], None] | None = None,
) -> Studies:
    """Fit every estimation type, lambda and data set, and choose: `study("a.toml", "b.toml", progress=print)`.

    Args:
        experiments: Experiment files with the same sensors.
        sensors: Names of the sensors; all of the first file if left out.
        data_sets: Labels or kinds of the intervals that are fitted together, by name; every combination of kinds if
            left out.
        kinds: Estimation types, SnTdTO to OwTrTO; all nine if left out.
        lambdas: Lambdas of the thesis' equation (5.4); counts2; the thirteen of its tables if left out.
        sphere: Intervals whose motion draws a sphere, for the types S...; what the files say if left out.
        folder: Folder to make for tables, figures and calibrations of the best; nothing is written if left out.
        progress: Called with a line for people at every step, such as `print`.

    Returns:
        The choice for every sensor; `records()` has every candidate.

    Raises:
        ForceTorqueError: If there is nothing to study, or the folder is there already.
    """
    from forcetorque.study.result import Studies, studied_sensor, study_warnings
    from forcetorque.study.study import study_sensor
    from forcetorque.study.study_data import read_study_data

    if folder is not None:
        refuse_existing(Path(folder))
    types = [estimation_type(name) for name in kinds]
    created = created_now()
    studied = read_study_data([Path(file) for file in experiments], sensors, progress=progress)
    answers = (
        study_sensor(
            data,
            data_sets=data_sets,
            kinds=types,
            lambdas=tuple(sorted(set(lambdas))),
            sphere=sphere,
            code_version=version("forcetorque"),
            created=created,
            progress=progress,
        )
        for data in studied
    )
    names = tuple(map(str, experiments))
    if folder is not None:
        from forcetorque.study.folder import write_study_folder

        return write_study_folder(folder, answers, experiments=names, progress=progress)
    studies = list(answers)
    return Studies(
        experiments=names,
        folder=None,
        sensors=tuple(studied_sensor(one) for one in studies),
        warnings=tuple(sentence for one in studies for sentence in study_warnings(one)),
    )

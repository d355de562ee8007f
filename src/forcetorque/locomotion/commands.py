# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque robot balance`, `coherence`, `motion`, `torque-loop` and `oscillation-causes`."""

import logging
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from collections.abc import Mapping

    from forcetorque.base.progress import Progress
    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.sensor_reading import Correction
    from forcetorque.experiment.validation_offset import OffsetPolicy
    from forcetorque.locomotion.motion_quality import Motion
    from forcetorque.locomotion.net_force.result import Coherence
    from forcetorque.locomotion.standing.balance import Balance
    from forcetorque.locomotion.standing.centre_of_mass_and_pressure import PlaneTolerance
    from forcetorque.locomotion.standing.foot_wrenches import FootForces
    from forcetorque.locomotion.torque_control.oscillation_causes import OscillationCauses
    from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile
    from forcetorque.locomotion.torque_control.torque_loop_study import TorqueLoopStudy

_LOG = logging.getLogger(__name__)
_CALIBRATIONS = Option(
    "Calibration file, or folder of them. Default: the priors.",
    "--calibration",
    "-c",
    typed=list[Path],
    reads="forcetorque.results.terminal.command_inputs:read_calibrations",
)


@command(
    "phases, loads and points of the first interval that it stands in",
    Saved(
        flags=("--output", "-o"),
        help="File for every sample, .parquet or .csv.",
        function="forcetorque.locomotion.standing.balance:Balance.write",
        endings=(".parquet", ".csv"),
    ),
)
def balance(
    experiments: Annotated[
        "Experiment | Sequence[Experiment | FootForces | Path | str]",
        Option("Experiment files (TOML) with [[sole]]; see docs/locomotion/balance.md.", typed=list[Path]),
    ],
    calibrations: Annotated["Calibration | Mapping[str, Calibration] | None", _CALIBRATIONS] = None,
    *,
    touch: Annotated[str, Option("Force that a contact reaches, as 50N, or a share of the weight, as 15%.")] = "15%",
    release: Annotated[str, Option("Force above which it lasts, as 20N or 6%; no more than --touch.")] = "6%",
    offset: Annotated[
        "OffsetPolicy | str",
        Option(
            "Where offsets of sensors come from: fitted, one-link-imu:LABEL, one-link-fixed-frame:LABEL, tare:LABEL or "
            "none; see docs/locomotion/coherence.md.",
            typed=str,
        ),
    ] = "fitted",
    by_motion: Annotated[
        bool, Option("Forces that masses, joints and IMU demand, without a force sensor.", "--by-motion")
    ] = False,
    dwell_s: Annotated[
        float, Option("Shortest contact, and shortest pause between contacts, that counts; s.", "--dwell")
    ] = 0.0,
    least_load: Annotated[
        str | None, Option("Load below which a foot has no centre of pressure. Default: --touch.")
    ] = None,
    height_band_m: Annotated[
        float | None,
        Option(
            "How far the centre of mass may be from its median height; m. With it, its acceleration by (5.22).",
            "--height-band",
        ),
    ] = None,
    plane: Annotated[
        "PlaneTolerance | None",
        Option("How far soles may be out of one plane; `PlaneTolerance()` if None.", python_only=True),
    ] = None,
) -> "Balance":
    """Say which feet bear the robot, and where.

    Example: forcetorque robot balance standing.toml --touch 50N --release 20N

    Python: `experiment.balance(calibration)`, without a sensor `experiment.balance(by_motion=True)`; of vertical forces
    alone `locomotion.balance([locomotion.load_foot_forces("walking.toml")])`

    Returns:
        Phases, centres of pressure and of mass over all intervals that are not ignored, with every sample in
        `intervals`.

    Raises:
        ExperimentError: If a file has no sole, or comes twice.
        EstimationError: If no foot is down in any interval, or thresholds cross.
    """
    from forcetorque.base.errors import ExperimentError
    from forcetorque.experiment.calibrations_under_test import named
    from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.experiment.validation_offset import Offset, OffsetPolicy
    from forcetorque.locomotion.standing.balance import balance
    from forcetorque.locomotion.standing.centre_of_mass_and_pressure import PlaneTolerance
    from forcetorque.locomotion.standing.interval_balance import BalanceOptions
    from forcetorque.locomotion.standing.support_phases import ForceLimit

    def limit(option: str, text: str) -> ForceLimit:
        with stated_in(option):
            return ForceLimit.of(text)

    options = BalanceOptions(
        touch=limit("--touch", touch),
        release=limit("--release", release),
        dwell_s=dwell_s,
        least_load=None if least_load is None else limit("--least-load", least_load),
        height_band_m=height_band_m,
        plane=PlaneTolerance() if plane is None else plane,
    )
    several = [experiments] if isinstance(experiments, Experiment) else experiments
    refuse_a_file_twice([Path(one) for one in several if isinstance(one, Path | str)])
    policy = OffsetPolicy.of(offset) if isinstance(offset, str) else offset
    if policy.offset in (Offset.FIRST_SECOND, Offset.JUDGED_MEAN):
        raise ExperimentError(
            f"--offset {policy}: it comes from every interval itself, in which nobody knows what a foot bears; take "
            "one from an interval, such as one-link-imu:LABEL"
        )
    if by_motion and (calibrations or policy.offset is not Offset.FITTED):
        raise ExperimentError(
            "--by-motion: no sensor is read, so that calibrations and --offset have no use; leave out one"
        )
    read = [_with_corrections(one, named(calibrations), policy, by_motion=by_motion) for one in several]
    contents, corrections = [content for content, _ in read], [reading for _, reading in read]
    return balance(contents, corrections, options, by_motion=by_motion)


def _with_corrections(
    experiment: "Experiment | FootForces | Path | str",
    calibrations: "Mapping[str, Calibration]",
    policy: "OffsetPolicy",
    *,
    by_motion: bool,
) -> "tuple[Experiment | FootForces, Mapping[str, Correction]]":
    """A recording of feet, and how its sensors are read; vertical forces have none, nor has motion."""
    from forcetorque.base.errors import ExperimentError
    from forcetorque.experiment.loading import Purpose
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.experiment.offsets import corrections_of
    from forcetorque.experiment.validation_offset import Offset
    from forcetorque.locomotion.standing.foot_wrenches import FootForces, has_foot_forces, load_foot_forces
    from forcetorque.results.terminal.command_inputs import read_experiment

    if by_motion and not isinstance(experiment, FootForces):
        return (
            experiment
            if not isinstance(experiment, Path | str)
            else read_experiment(Path(experiment), _LOG, Purpose.MOTION)
        ), {}
    if isinstance(experiment, Path | str) and has_foot_forces(experiment):
        experiment = load_foot_forces(experiment)
    if isinstance(experiment, FootForces):
        if policy.offset is not Offset.FITTED:
            raise ExperimentError(f"{experiment.file}: --offset {policy}: vertical forces have no offset to remove")
        return experiment, {}
    if isinstance(experiment, Path | str):
        experiment = read_experiment(Path(experiment), _LOG)
    with stated_in(str(experiment.file)):
        corrections = corrections_of(experiment, calibrations, offset=policy)
    for sensor, correction in corrections.items():
        _LOG.info("%s: %s", sensor, correction.source)
    return experiment, corrections


@command("the errors by phase, calibration and offset")
def coherence(
    experiment: Annotated[
        "Experiment",
        Option(
            "Experiment; every interval that is not ignored is a phase, in which its support, or the links that it "
            "names in contact_links, and its contacts touch the world."
        ),
    ],
    candidates: Annotated[
        "Calibration | Mapping[str, Mapping[str, Calibration]] | None",
        Option(
            "Calibration, or a folder of them. All files are one candidate, each folder is one, with at most one "
            "calibration for each sensor. The prior is always a candidate.",
            "--calibration",
            "-c",
            typed=list[Path],
            reads="forcetorque.calibration.joint.calibrate:read_candidates",
        ),
    ] = None,
    offsets: Annotated[
        "Sequence[OffsetPolicy | str]",
        Option(
            "Where offsets come from: one-link-imu:LABEL, one-link-fixed-frame:LABEL, tare:LABEL, fitted or none. "
            "Default: the first interval in which one link alone is touched.",
            "--offset",
            typed=list[str],
            reads="forcetorque.experiment.offsets:offset_policies",
        ),
    ] = (),
) -> "Coherence":
    """Compare the net contact force with the weight as contacts switch.

    Example: forcetorque robot coherence switching.toml -c calibrations

    Python: `experiment.coherence(calibration)`

    Returns:
        Net forces, errors and intervals per offset, phase and candidate.

    Raises:
        ExperimentError: If there is no phase, a link that is said to touch bears nothing, one that is not bears the
            robot, or an offset cannot be determined.
        FitError: If an offset has too few samples.
    """
    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.calibrations_under_test import NEW, named
    from forcetorque.locomotion.net_force.net_force import net_force_errors

    by_name = {NEW: candidates} if isinstance(candidates, Calibration) else candidates or {}
    sensors = {name: named(calibrations) for name, calibrations in by_name.items()}
    return net_force_errors(experiment, sensors, offsets)


@command("the columns with their swings")
def motion(
    log: Annotated["Path | str", Option("Experiment file (TOML), with or without sensors, or a log.")],
    columns: Annotated[Sequence[str], Option("Column of the log, or of `balance`, such as com.y.", "--column")] = (),
    *,
    desired: Annotated[
        Sequence[str], Option("Column of the log with what was wanted; one for each --column, in its order.")
    ] = (),
    intervals: Annotated[
        Collection[str], Option("Label of an interval. Default: all that are not ignored.", "--interval")
    ] = (),
    steps_s: Annotated[Sequence[float], Option("Instant of a step, s. Default: steps of --desired.", "--step-at")] = (),
    band_share: Annotated[
        float,
        Option(
            "Half of the band about its end in which a column has settled. Default: 5.",
            "--band-percent",
            reads=lambda percent: percent / 100.0,
        ),
    ] = 0.05,
    calibrations: Annotated["Mapping[str, Calibration] | None", _CALIBRATIONS] = None,
) -> "Motion":
    """Say whether a motion oscillates, how long it settles, how well it tracks.

    Example: forcetorque robot motion walk.toml --column com.y --column zmp.y

    Python: `app.motion("swaying.toml", ["com_y"])`, of arrays `app.motion_of_arrays`

    Returns:
        Oscillations, settling times and tracking errors.
    """
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.locomotion.logged_signals import motion_signals
    from forcetorque.locomotion.motion_quality import motion

    with stated_in(str(log)):
        signals = motion_signals(log, columns, desired=desired, intervals=intervals, calibrations=calibrations)
        return motion(signals, steps_s=steps_s, band_share=band_share)


@command("tracking, oscillations and falls over the size of the error")
def torque_loop(
    file: Annotated[
        "TorqueLoopFile | Path | str | None",
        Option(
            "File of the loop (TOML), see docs/locomotion/torque_loop.md; without one, the default, which takes ten "
            "minutes."
        ),
    ] = None,
    *,
    progress: Annotated["Progress", Option("Called with a line for people as work goes on.")] = lambda _: None,
) -> "TorqueLoopStudy":
    """Balance a simulated biped by torques from sensors with errors.

    Example: forcetorque robot torque-loop loop.toml --figure loop.png

    Python: `locomotion.torque_loop(progress=print)`, ten minutes

    Returns:
        Tracking, oscillations and falls by size of error; and where the linear loop predicts that they begin.

    Raises:
        MissingExtraError: If MuJoCo is not installed.
        ControlError: If gains are unstable without any error.
    """
    from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile, read_torque_loop
    from forcetorque.locomotion.torque_control.torque_loop_study import study_torque_loop

    if file is None:
        file = TorqueLoopFile()
    return study_torque_loop(file if isinstance(file, TorqueLoopFile) else read_torque_loop(file), progress)


@command("unstable draws per cause")
def oscillation_causes(
    file: Annotated[
        "TorqueLoopFile | Path | str | None",
        Option("File of the loop (TOML), as that of `robot torque-loop`; its motion is not run."),
    ] = None,
    *,
    progress: Annotated["Progress", Option("Called with a line for people as work goes on.")] = lambda _: None,
) -> "OscillationCauses":
    """Find which delay, gain or compliance makes sensor errors oscillate a robot.

    Example: forcetorque robot oscillation-causes loop.toml --figure causes.png

    Python: `locomotion.oscillation_causes(progress=print)`, two minutes

    Returns:
        Per cause the value that robots with small errors bear, and the share of larger errors that oscillate there.

    Raises:
        MissingExtraError: If MuJoCo is not installed.
        ControlError: If a loop is unstable without any error.
    """
    from forcetorque.locomotion.torque_control.oscillation_causes import study_causes
    from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile, read_torque_loop

    if file is None:
        file = TorqueLoopFile()
    return study_causes(file if isinstance(file, TorqueLoopFile) else read_torque_loop(file), progress)

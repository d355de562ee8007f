# SPDX-License-Identifier: BSD-3-Clause
"""Soles beyond a sensor, on which contacts are expected: what they bear that the ground cannot do."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.raw_counts import chosen_intervals
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.locomotion.section import SOLES, ExperimentSole
from forcetorque.locomotion.standing.foot_wrenches import balance_of_sensors
from forcetorque.locomotion.standing.interval_balance import BalanceOptions
from forcetorque.locomotion.standing.sole_limits import SoleEventRow, sole_events
from forcetorque.robot.tree import build_tree, sub_models


def events_on_soles(
    run: SensorRun, calibration: tuple[str, Calibration] | None, intervals: Collection[str]
) -> tuple[tuple[SoleEventRow, ...], tuple[str, ...]]:
    """Look for forces and moments on the soles beyond a sensor that these do not explain.

    Args:
        run: The sensor.
        calibration: Name and calibration that read it; its prior with the offset of the calibration intervals if None.
        intervals: Labels of the intervals to look at; all that are not ignored if there is none.

    Returns:
        Events, and why soles could not be tested, as text.
    """
    soles = soles_beyond(run)
    if not soles:
        return (), ()
    experiment = run.experiment
    chosen = [interval for _, interval in chosen_intervals([run], intervals)]
    alone = replace(
        experiment,
        sensors=(run.sensor,),
        recording=experiment.recording.with_intervals(chosen),
        sections={**experiment.sections, SOLES.key: soles},
    )
    # the offset is that of all calibration intervals, whatever is looked at
    source = replace(experiment, sensors=(run.sensor,))
    try:
        corrections = corrections_of(source, {} if calibration is None else dict([calibration]))
        if corrections[run.sensor.name].removes_offset:
            return tuple(_events(alone, corrections)), ()
        reason = "its offset is not known; give a calibration of this session"
    except ForceTorqueError as error:
        reason = str(error)
    names = ", ".join(entry.sole.frame for entry in soles)
    return (), (f"{run.sensor.name}: no test of what presses on {names}: {reason}",)


def _events(experiment: Experiment, corrections: Mapping[str, Correction]) -> Iterator[SoleEventRow]:
    options = BalanceOptions()
    for balance in balance_of_sensors(experiment, corrections, options):
        yield from sole_events(balance, release_N=options.thresholds(balance.weight_N).release_N)


def soles_beyond(run: SensorRun) -> tuple[ExperimentSole, ...]:
    """Name the soles whose events a sensor tells.

    Args:
        run: The sensor.

    Returns:
        Those with an outline or a friction between which and the sensor there is no other one.
    """
    experiment = run.experiment
    if not experiment.section(SOLES):
        return ()
    tree = build_tree(experiment.model, experiment.model.root_link)
    parts = sub_models(tree, [sensor.name for sensor in experiment.sensors])
    bodies = next((part.bodies for part in parts if part.sensor == run.sensor.name), ())
    return tuple(
        entry
        for entry in experiment.section(SOLES)
        if (entry.sole.outline is not None or entry.sole.has_friction) and tree.frames[entry.sole.frame][0] in bodies
    )

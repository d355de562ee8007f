# SPDX-License-Identifier: BSD-3-Clause
"""A biped that stands and moves, with perfect sensors: what the ground does to its feet is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.locomotion.section import SOLES as SECTION, ExperimentSole
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.storage import read_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.simulation.motions.movement import Movement
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario, simulate
from tests.scenes.switchings import short_switching

DAY = "switching_day1"
OUTLINE_M = np.array([[-0.09, -0.045], [0.11, -0.045], [0.11, 0.045], [-0.09, 0.045]])
SOLES = tuple(ExperimentSole(sole=Sole(frame=frame, outline=OUTLINE_M)) for frame in ("l_sole", "r_sole"))


@dataclass(frozen=True, kw_only=True, eq=False)
class Standing:
    """An experiment with soles, how its sensors are read without error, and what the ground does."""

    experiment: Experiment
    """The experiment."""
    corrections: Mapping[str, Correction]
    """True matrices and offsets."""
    truth: Recording
    """True contact wrenches: a stream per link."""

    def true_points(self, frame: str, stamp_ns: IntArray) -> FloatArray:
        """Where the ground presses on a sole; shape (n, 2); m; NaN in the air."""
        stream = self.truth.stream(frame)
        wrench = interpolate(stream, stream.signal("wrench").values, stamp_ns)
        pressed = np.where(wrench[:, 2:3] > 1.0, wrench[:, 2:3], np.nan)
        return np.stack([-wrench[:, 4], wrench[:, 3]], axis=1) / pressed


def switching(folder: Path) -> Standing:
    """The biped that hangs, stands on both feet and on one, without anything that disturbs it."""
    content = short_switching().exact()
    scenario = build_scenario(content.model_copy(update={"recording": content.recording[:1]}))
    write_scenario(scenario, folder)
    (simulated,) = simulate(scenario)
    experiment = load_experiment(folder / f"{DAY}.toml")
    return Standing(
        experiment=replace(experiment, sections={**experiment.sections, SECTION.key: SOLES}),
        corrections={
            name: Correction(
                model=WrenchModel(matrix=sensor.matrix, offset=sensor.offset),
                source="the truth",
                matrix_source="the truth",
            )
            for name, sensor in simulated.sensors.items()
        },
        truth=read_recording(folder / f"{DAY}_contacts"),
    )


def moving(like: Standing, movement: Movement, *, rate_hz: float = 50.0) -> Standing:
    """The same robot and sensors in another movement on one foot."""
    seconds = np.arange(0.0, movement.duration_s, 1.0 / rate_hz)
    stamps = np.round(seconds * 1e9).astype(np.int64)
    joints, readings = movement.joints(seconds), movement.readings(seconds)
    experiment = like.experiment
    logged = ("position", "rad", joints.position), ("velocity", "rad/s", joints.velocity)
    signals = {
        quantity: Signal(quantity=quantity, values=values, columns=joints.names, units=(unit,) * len(joints.names))
        for quantity, unit, values in (*logged, ("acceleration", "rad/s2", joints.acceleration))
    }
    streams = {"joints": Stream(name="joints", clock="robot", stamp_ns=stamps, signals=signals)}
    for sensor in experiment.sensors:
        model = like.corrections[sensor.name].model
        raw = (readings.of_name(sensor.name) - model.offset) @ np.linalg.inv(model.matrix).T
        signal = experiment.recording.stream(sensor.stream).signal("raw")
        streams[sensor.stream] = Stream(
            name=sensor.stream, clock="robot", stamp_ns=stamps, signals={"raw": replace(signal, values=raw)}
        )
    support = Support(frame=movement.support, gravity_direction=movement.gravity_direction)
    interval = Interval(label="moving", start_ns=0, end_ns=int(stamps[-1]) + 1, use=Use.VALIDATION, support=support)
    truth = movement.support_wrench(seconds)
    contact = Stream(
        name=support.frame,
        clock="robot",
        stamp_ns=stamps,
        signals={"wrench": Signal.of_fixed("wrench", truth, frame=support.frame)},
    )
    return Standing(
        experiment=replace(experiment, recording=Recording(streams=streams, intervals=(interval,))),
        corrections=like.corrections,
        truth=Recording(streams={support.frame: contact}),
    )

# SPDX-License-Identifier: BSD-3-Clause
"""Contests on the calibration device: three stacked sensors through its twelve steps, with errors that are planted."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.contests.contest_file import PHASES, Contestant, ContestRun, Method
from forcetorque.contests.phases_and_runs_by_load import MotionPath, trial_by_phase
from forcetorque.device.components import device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import DeviceTrajectory, twelve_steps
from forcetorque.device.robot_model import device_model
from forcetorque.experiment.experiment import Experiment, ExperimentSensor, FitOptions, Role
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing

RATE_HZ = 10.0
"""Of all streams: the device moves slowly."""
NOISE = np.array([0.05, 0.05, 0.05, 0.003, 0.003, 0.003])
"""White noise of a reading; N, N m."""
ENCODER_RAD = np.deg2rad(0.05)
"""Noise of the encoders; less than the 0.1 degree of thesis Table 6.3."""
CURVED = 0.0005
"""Response of a sensor that no matrix describes, over its load at 35 kg."""
GROUND = Support(frame="base", gravity_direction=[0.0, 0.0, -1.0])
DEVICE = read_device().with_sensors(3)
SIZES = np.array([350.0, 350.0, 350.0, 60.0, 60.0, 60.0])
"""About the largest loads at 35 kg; N, N m."""


@cache
def motion_of(load_kg: float) -> tuple[FloatArray, tuple[str, ...], FloatArray, dict[str, FloatArray]]:
    """Instants, joints, positions, and the true wrench of every sensor under a load."""
    load = device_load(DEVICE, load_kg)
    time, motion = DeviceTrajectory(device=DEVICE, load=load, sequence=twelve_steps(DEVICE)).sampled(RATE_HZ)
    wrenches = device_response(DEVICE, load, motion).wrenches
    return time, motion.names, motion.position, {name: wrenches.of_name(name) for name in DEVICE.sensor_names}


def curved(wrench: FloatArray, name: str) -> FloatArray:
    """What a sensor adds to its reading beyond any matrix, the same in every run."""
    rng = np.random.default_rng([7, DEVICE.sensor_names.index(name)])
    share = wrench / SIZES
    products = np.einsum("ni,nj->nij", share, share).reshape(len(share), -1)
    added: FloatArray = CURVED * SIZES * (products @ rng.standard_normal((36, 6)))
    return added


def run_of(
    name: str,
    load_kg: float,
    rng: np.random.Generator,
    *,
    use: Use = Use.VALIDATION,
    priors: Mapping[str, FloatArray] | None = None,
    serial: str | None = None,
    reverse: bool = False,
) -> ContestRun:
    """One run of the device; a reading is the true wrench, curved, with offset and noise, as six counts."""
    time, joints, position, wrenches = motion_of(load_kg)
    stamps = np.round(1e9 * time).astype(np.int64)
    streams = {
        "joints": Stream(
            name="joints",
            clock="device",
            stamp_ns=stamps,
            signals={
                "position": Signal(
                    quantity="position",
                    values=(position[::-1] if reverse else position)
                    + ENCODER_RAD * rng.standard_normal(position.shape),
                    columns=joints,
                    units=("rad",) * len(joints),
                )
            },
        )
    }
    for sensor, wrench in wrenches.items():
        true = wrench[::-1] if reverse else wrench
        read = true + curved(true, sensor) + rng.normal(size=6) + NOISE * rng.standard_normal(true.shape)
        signal = Signal(quantity="raw", values=read, columns=tuple(f"ch{k}" for k in range(6)), units=("counts",) * 6)
        streams[sensor] = Stream(name=sensor, clock="device", stamp_ns=stamps, signals={"raw": signal})
    interval = Interval(label=name, start_ns=0, end_ns=int(stamps[-1]), use=use, support=GROUND)
    return ContestRun(
        name=name,
        load_kg=load_kg,
        experiment=Experiment(
            name=name,
            file=Path(name),
            model=device_model(DEVICE, device_load(DEVICE, load_kg)),
            recording=Recording(streams=streams).with_intervals([interval]),
            sensors=tuple(_sensor(sensor, (priors or {}).get(sensor, np.eye(6)), serial) for sensor in wrenches),
            contacts=(),
            processing=Processing(derivative_window=SavitzkyGolay(window_s=0.6, order=3)),
            fit_options=FitOptions(),
            roles={name: Role(kind=name, session=None)},
            supports=(GROUND,),
            inputs_sha256={},
        ),
    )


def _sensor(name: str, prior: FloatArray, serial: str | None) -> ExperimentSensor:
    return ExperimentSensor(
        name=name,
        serial=serial or f"SN {name}",
        stream=name,
        quantity="raw",
        prior=prior,
        prior_source="maker",
        limit_counts=1000.0,
    )


def planted(sensor: str, size: float, loads_kg: tuple[float, ...], rng: np.random.Generator) -> FloatArray:
    """A matrix that errs by a given share of the judged loads, what no matrix describes included."""
    true = [_by_phase(load)[sensor] for load in loads_kg]
    pattern = rng.standard_normal((6, 6)) * SIZES[:, None] / SIZES
    scale = _judged(loads_kg)
    low, high = 0.0, 1.0
    for _ in range(30):  # the error grows with the share
        middle = 0.5 * (low + high)
        error = _size([(w + curved(w, sensor)) @ (np.eye(6) + middle * pattern).T - w for w in true]) / scale
        low, high = (middle, high) if np.sqrt((error**2).sum()) < size else (low, middle)
    return np.eye(6) + low * pattern


@cache
def _by_phase(load_kg: float) -> dict[str, FloatArray]:
    """Wrenches of all sensors by phase of the motion, rests left out."""
    _, joints, position, wrenches = motion_of(load_kg)
    phase = MotionPath.of(joints, position).phase
    zero = np.zeros(6)
    return {
        name: trial_by_phase(phase, wrench, wrench, zero, phases=PHASES, load_kg=load_kg).reference
        for name, wrench in wrenches.items()
    }


@cache
def _judged(loads_kg: tuple[float, ...]) -> FloatArray:
    return _size([wrench for load in loads_kg for wrench in _by_phase(load).values()])


def _size(wrenches: list[FloatArray]) -> FloatArray:
    """Root mean square force and moment about the mean of each run; shape (2,); N, N m."""
    moved = np.concatenate([wrench - wrench.mean(axis=0) for wrench in wrenches])
    return np.sqrt((moved.reshape(-1, 2, 3) ** 2).sum(axis=2).mean(axis=0))


def maker(sensor: str) -> Contestant:
    """A sensor as it was bought, under its own name."""
    return Contestant(name=sensor, sensor=sensor, method=Method.MAKER)

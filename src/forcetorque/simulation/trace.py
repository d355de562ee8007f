# SPDX-License-Identifier: BSD-3-Clause
"""What a movement does to joints and sensors at the instants at which they are read, and recordings of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array, check_arrays, mapping, read_only_mapping
from forcetorque.base.errors import RobotError, require_known
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_smooth_motion
from forcetorque.simulation.motions.movement import Movement, MovementKind
from forcetorque.simulation.simulated_sensor import SimulatedSensor

EPOCH_NS = 1_700_000_000_000_000_000
"""When a simulated recording starts unless somebody says otherwise; ns."""

_ENCODER_STEP = 2.0 * np.pi / 2**16

IMU_STREAM = "imu"
"""Name of the stream of an IMU."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinkTrace(ArrayRecord):
    """The motion of a link at the instants at which an IMU on it is read."""

    link: str
    """The link."""
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Stamps; shape (n,); ns."""
    motion: RootMotion
    """Its true motion, in its own axes; n samples."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trace(ArrayRecord):
    """A movement as joints and perfect sensors see it, from which any number of real sensors can be read."""

    movement: Movement
    """What the robot did."""
    rate_hz: float
    """Rate of every stream; Hz."""
    start_ns: int
    """When it started; ns."""
    joints: Stream
    """Positions of the joints as their encoders read them."""
    stamp_ns: Mapping[str, IntArray]
    """Stamps of every sensor; shape (n,); ns."""
    loads: Mapping[str, FloatArray] = field(metadata=mapping(None, 6))
    """True wrenches at those stamps, each in the sensor's frame and direction; shape (n, 6); N, N m."""
    imu: LinkTrace | None = None
    """What an IMU goes through, if there is one."""
    exact: bool = False
    """Whether joints and IMU are read with all their derivatives."""

    def __post_init__(self) -> None:
        check_arrays(self)
        stamps = {name: np.array(own, dtype=np.int64) for name, own in self.stamp_ns.items()}
        for own in stamps.values():
            own.setflags(write=False)
        object.__setattr__(self, "stamp_ns", read_only_mapping(stamps))

    def recorded(
        self,
        sensors: Mapping[str, SimulatedSensor],
        *,
        rng: np.random.Generator,
        temperature_degC: tuple[float, float] | None = None,
        imu: SimulatedImu | None = None,
    ) -> Recording:
        """Read sensors under these loads.

        Args:
            sensors: What each sensor is made of, by its name in the robot.
            rng: Source of noise.
            temperature_degC: Temperature of the sensors at the start and at the end, linear in between; None where
                it is not measured.
            imu: An IMU on the link that was traced; none if None.

        Returns:
            A stream `joints` with positions, a stream per sensor, under its name, with raw counts, the board's
            status and, if given, the temperature, and a stream `imu`, if there is one.

        Raises:
            RobotError: If a sensor, or the link of the IMU, was not traced.
        """
        streams = {"joints": self.joints}
        for name, sensor in sensors.items():
            streams[name] = self._sensor_stream(name, sensor, rng, temperature_degC)
        if imu is not None:
            if self.imu is None or self.imu.link != imu.link:
                traced = "no IMU" if self.imu is None else f"one at {self.imu.link!r}"
                raise RobotError(
                    f"movement {self.movement.name!r}: expected a trace with an IMU at {imu.link!r}, it has {traced}"
                )
            signals = imu.read(self.imu.motion, rng)
            turning = (imu.turning(self.imu.motion),) if self.exact else ()
            streams[IMU_STREAM] = _stream(IMU_STREAM, self.imu.stamp_ns, *signals, *turning)
        return Recording(streams=streams, origin={"format": "simulation", "robot": self.movement.model.name})

    def _sensor_stream(
        self, name: str, sensor: SimulatedSensor, rng: np.random.Generator, ends: tuple[float, float] | None
    ) -> Stream:
        require_known(
            name, self.loads, RobotError, f"movement {self.movement.name!r} was traced without sensor {name!r}"
        )
        stamps = self.stamp_ns[name]
        temperature = _temperature(seconds_since(stamps, self.start_ns) / self.movement.duration_s, ends)
        held = sensor.read(self.loads[name], rng, rate_hz=self.rate_hz, temperature_degC=temperature)
        signals = [
            Signal(
                quantity="raw",
                values=held.counts,
                columns=tuple(f"ch{k}" for k in range(6)),
                units=("counts",) * 6,
            ),
            Signal(
                quantity="saturated",
                values=held.saturated.astype(np.float64)[:, None],
                columns=("saturated",),
                units=("0 or 1",),
            ),
        ]
        if temperature is not None:
            signals.append(
                Signal(quantity="temperature", values=temperature[:, None], columns=("temperature",), units=("degC",))
            )
        return _stream(name, stamps, *signals)


def trace_movement(
    movement: Movement,
    sensors: Iterable[str],
    *,
    rate_hz: float,
    rng: np.random.Generator,
    start_ns: int = EPOCH_NS,
    imu_link: str | None = None,
    exact: bool = False,
) -> Trace:
    """Find what a movement does to the joints and sensors of a robot at the instants at which they are read.

    Joints and sensors have their own stamps, out of step and with jitter, as on a real network.
    Joints are read with encoders of 16 bits a turn. Unless all is to be exact: then every stream has
    the same even stamps from the start on, joints have no steps, and they and the IMU all their derivatives.

    Args:
        movement: What the robot does.
        sensors: Names of sensors of the robot.
        rate_hz: Rate of every stream; Hz.
        rng: Source of stamps.
        start_ns: When it starts; ns.
        imu_link: Link that an IMU is on; none if None.
        exact: Whether all is read at the same even instants, joints without steps and with their derivatives.

    Returns:
        Positions of the joints, the true loads of the sensors, and the motion of the IMU's link.
    """
    draw_stamps = partial(_even_stamps if exact else partial(_stamps, rng=rng), movement.duration_s, rate_hz)
    joint_stamps = draw_stamps() + start_ns
    motion = movement.joints(seconds_since(joint_stamps, start_ns))
    stamps = {name: draw_stamps() + start_ns for name in sensors}
    imu = None
    if imu_link is not None:  # last, so that its stamps change no others
        imu_ns = draw_stamps() + start_ns
        imu_motion = movement.link_motion(seconds_since(imu_ns, start_ns), imu_link)
        imu = LinkTrace(link=imu_link, stamp_ns=imu_ns, motion=imu_motion)
    return Trace(
        movement=movement,
        rate_hz=rate_hz,
        start_ns=start_ns,
        joints=_stream("joints", joint_stamps, *_joint_signals(movement, motion, exact=exact)),
        stamp_ns=stamps,
        loads={
            name: movement.readings(seconds_since(own, start_ns), [name]).of_name(name) for name, own in stamps.items()
        },
        imu=imu,
        exact=exact,
    )


def _joint_signals(movement: Movement, motion: JointMotion, *, exact: bool) -> Iterator[Signal]:
    """Positions as encoders read them; or as they are, with their derivatives."""
    units = tuple(movement.model.joints[name].type.unit for name in motion.names)
    position = motion.position if exact else np.rint(motion.position / _ENCODER_STEP) * _ENCODER_STEP
    yield Signal(quantity="position", values=position, columns=motion.names, units=units)
    if exact:
        for quantity, values, per in (
            ("velocity", motion.velocity, "/s"),
            ("acceleration", motion.acceleration, "/s2"),
        ):
            own = tuple(f"{unit}{per}" for unit in units)
            yield Signal(quantity=quantity, values=values, columns=motion.names, units=own)


def _even_stamps(duration_s: float, rate_hz: float) -> IntArray:
    return np.rint(np.arange(int(duration_s * rate_hz)) * (1e9 / rate_hz)).astype(np.int64)


def _stamps(duration_s: float, rate_hz: float, rng: np.random.Generator) -> IntArray:
    period_ns = 1e9 / rate_hz
    count = int(duration_s * rate_hz)
    jitter = rng.uniform(-0.2, 0.2, count)
    ticks = np.rint((np.arange(count) + rng.uniform(0.2, 0.8) + jitter) * period_ns)
    return ticks.astype(np.int64)


def _stream(name: str, stamps: IntArray, *signals: Signal) -> Stream:
    return Stream(
        name=name, clock="simulation", stamp_ns=stamps, signals={signal.quantity: signal for signal in signals}
    )


def _temperature(share: FloatArray, ends: tuple[float, float] | None) -> FloatArray | None:
    if ends is None:
        return None
    return ends[0] + (ends[1] - ends[0]) * share


def record(
    movement: Movement,
    sensors: Mapping[str, SimulatedSensor],
    *,
    rate_hz: float,
    rng: np.random.Generator,
    temperature_degC: tuple[float, float] | None = None,
    start_ns: int = EPOCH_NS,
    imu: SimulatedImu | None = None,
) -> Recording:
    """Record the joints and sensors of a robot during a movement.

    Joints and sensors have their own stamps, out of step and with jitter, as on a real network.
    Joints are read with encoders of 16 bits a turn.

    Args:
        movement: What the robot does.
        sensors: What each sensor is made of, by its name in the robot.
        rate_hz: Rate of every stream; Hz.
        rng: Source of stamps and noise.
        temperature_degC: Temperature of the sensors at the start and at the end, linear in between; None where
            it is not measured.
        start_ns: When it starts; ns.
        imu: An IMU; none if None.

    Returns:
        A stream `joints` with positions, a stream per sensor, under its name, with raw counts, the board's
        status and, if given, the temperature, and a stream `imu`, if there is one.
    """
    link = None if imu is None else imu.link
    trace = trace_movement(movement, sensors, rate_hz=rate_hz, rng=rng, start_ns=start_ns, imu_link=link)
    return trace.recorded(sensors, rng=rng, temperature_degC=temperature_degC, imu=imu)


def simulate_recording(
    model: RobotModel,
    sensors: Mapping[str, SimulatedSensor],
    *,
    support: str,
    gravity_direction: Any,
    ranges: Mapping[str, tuple[float, float]],
    duration_s: float,
    rate_hz: float,
    slowest_hz: float,
    seed: int,
) -> Recording:
    """Record sensors and joints of a robot that moves smoothly and at random while one link stands still.

    Args:
        model: The robot.
        sensors: What each sensor is made of, by its name in the robot.
        support: Link that stands still.
        gravity_direction: Direction in which things fall, in the axes of that link; shape (3,).
        ranges: Lowest and highest position of every moving joint; rad or m.
        duration_s: Length of the recording; s.
        rate_hz: Rate of every stream; Hz.
        slowest_hz: About the frequency of the slowest motion; Hz.
        seed: Seed of everything that is random.

    Returns:
        What `record` gives.
    """
    rng = np.random.default_rng(seed)
    motion_seed = int(rng.integers(2**32))

    def trajectory(seconds: FloatArray) -> JointMotion:
        return random_smooth_motion(ranges, seconds, slowest_hz=slowest_hz, rng=np.random.default_rng(motion_seed))

    stand = Stand(model=model, support=support, gravity_direction=gravity_direction, ranges=ranges)
    movement = stand.movement("random", MovementKind.RANDOM, trajectory, duration_s)
    return record(movement, sensors, rate_hz=rate_hz, rng=rng)


_XYZ = ("x", "y", "z")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedImu(ArrayRecord):
    """An IMU that reads along the axes of a link, at its origin."""

    link: str
    """The link."""
    accelerometer_bias: FloatArray = field(default_factory=partial(np.zeros, 3), metadata=array(3))
    """What it reads too much; shape (3,); m/s2."""
    gyroscope_bias: FloatArray = field(default_factory=partial(np.zeros, 3), metadata=array(3))
    """What it reads too much; shape (3,); rad/s."""
    accelerometer_noise: float = 0.0
    """Standard deviation of white noise; m/s2."""
    gyroscope_noise: float = 0.0
    """Standard deviation of white noise; rad/s."""

    def __post_init__(self) -> None:
        check_arrays(self)
        for name in ("accelerometer_noise", "gyroscope_noise"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise RobotError(f"IMU at {self.link!r}: {name}: expected at least 0, got {getattr(self, name):g}")

    def read(self, motion: RootMotion, rng: np.random.Generator) -> tuple[Signal, Signal]:
        """Read the motion of the link.

        Args:
            motion: Motion of the link's frame, in its own axes; n samples.
            rng: Source of noise.

        Returns:
            Proper acceleration and angular velocity, as the streams of an IMU have them.
        """
        shape = motion.proper_acceleration.shape
        acceleration = self.accelerometer_bias + self.accelerometer_noise * rng.standard_normal(shape)
        velocity = self.gyroscope_bias + self.gyroscope_noise * rng.standard_normal(shape)
        return (
            self._signal("proper_acceleration", motion.proper_acceleration + acceleration, "m/s2"),
            self._signal("angular_velocity", motion.angular_velocity + velocity, "rad/s"),
        )

    def turning(self, motion: RootMotion) -> Signal:
        """Compute the angular acceleration of the link, which gyroscopes do not measure.

        Args:
            motion: Motion of the link's frame, in its own axes; n samples.

        Returns:
            The true angular acceleration.
        """
        return self._signal("angular_acceleration", motion.angular_acceleration, "rad/s2")

    def _signal(self, quantity: str, values: FloatArray, unit: str) -> Signal:
        return Signal(quantity=quantity, values=values, columns=_XYZ, units=(unit,) * 3, frame=self.link)

# SPDX-License-Identifier: BSD-3-Clause
"""Motion of the support frame: at rest in the world, or carried from an IMU."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError, RobotError, known_names
from forcetorque.recording.alignment import Interpolation, rows_of
from forcetorque.recording.recording import NO_MOTION, MovingSupport, Recording, Support
from forcetorque.recording.smoothing import FilteredColumns, SavitzkyGolay
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.dynamics import motion_of_link
from forcetorque.robot.model import JointType, RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree, joints_between

IMU_QUANTITIES: Final = ("proper_acceleration", "angular_velocity", "angular_acceleration", "gravity")
"""What an IMU may tell."""


def imu_streams(recording: Recording) -> tuple[str, ...]:
    """Name the streams of a recording in which an IMU tells how a link moves.

    Returns:
        Names of the streams; those of an orientation, which tells gravity alone, only where nothing tells more.
    """
    quantities = {name: stream.signals.keys() & set(IMU_QUANTITIES) for name, stream in recording.streams.items()}
    return tuple(name for name in quantities if quantities[name] - {"gravity"}) or tuple(
        name for name in quantities if quantities[name]
    )


def joints_to_support(model: RobotModel, recording: Recording, support: Support | MovingSupport) -> tuple[str, ...]:
    """Name the joints whose motion is needed to know how the support frame moves.

    Args:
        model: The robot.
        recording: Streams of the IMU, if there is one.
        support: The support.

    Returns:
        Joints between the IMU and the support frame; none for a support at rest.
    """
    if isinstance(support, Support):
        return ()
    return joints_between(build_tree(model, imu_frame(model, recording, support)), support.frame)


class LoggedSupport:
    """Support of a recording, whose motion can be had at any instants.

    Angular acceleration is taken from the IMU's streams where they have it, else it is the
    derivative of the angular velocity. Where they hold `gravity`, or of a robot without joints the
    proper acceleration alone, the frame is taken to turn slowly.
    """

    def __init__(
        self,
        model: RobotModel,
        recording: Recording,
        support: Support | MovingSupport,
        *,
        window: SavitzkyGolay,
        gravity: float,
    ) -> None:
        """Find the signals of the IMU, if there is one.

        Args:
            model: The robot.
            recording: Streams of the IMU.
            support: The support.
            window: Filter that differentiates the angular velocity on its own clock.
            gravity: Magnitude of gravity for a support at rest; m/s2.
        """
        self._support, self._gravity = support, gravity
        self._signals: dict[str, tuple[Interpolation, Signal]] = {}
        self._rate: FilteredColumns | None = None
        if isinstance(support, Support):
            return
        self._tree = build_tree(model, imu_frame(model, recording, support))
        for quantity, (stream, signal) in _imu_signals(model, recording, support).items():
            self._signals[quantity] = (Interpolation(stream), signal)
            if quantity == "angular_velocity":
                self._rate = FilteredColumns(stream.stamp_ns, signal.values, window, derivatives=(1,), together=True)

    def at(self, joints: JointMotion, at_ns: IntArray) -> RootMotion:
        """Give the motion of the support frame at instants.

        Args:
            joints: Motion of at least the joints of `joints_to_support`, at the same instants.
            at_ns: Instants on the clock of the streams; shape (n,); ns.

        Returns:
            The motion; NaN where a stream has a gap.
        """
        if isinstance(self._support, Support):
            return RootMotion.fixed(self._support.gravity_direction, gravity=self._gravity)
        if "angular_velocity" not in self._signals:
            still = np.zeros((len(at_ns), 3))
            acceleration = (
                -self._logged("gravity", at_ns)
                if "gravity" in self._signals
                else self._logged("proper_acceleration", at_ns)
            )
            imu = RootMotion(proper_acceleration=acceleration, angular_velocity=still, angular_acceleration=still)
        else:
            imu = RootMotion(
                proper_acceleration=self._logged("proper_acceleration", at_ns),
                angular_velocity=self._logged("angular_velocity", at_ns),
                angular_acceleration=self._angular_acceleration(at_ns),
            )
        return motion_of_link(self._tree, joints, imu, self._support.frame)

    def _logged(self, quantity: str, at_ns: IntArray) -> FloatArray:
        interpolation, signal = self._signals[quantity]
        neighbours = interpolation.at(at_ns)
        return neighbours.interpolated(signal.values[neighbours.before], signal.values[neighbours.after])

    def _angular_acceleration(self, at_ns: IntArray) -> FloatArray:
        if "angular_acceleration" in self._signals or self._rate is None:
            return self._logged("angular_acceleration", at_ns)
        neighbours = self._signals["angular_velocity"][0].at(at_ns)
        rows, before, after = rows_of(neighbours)
        (values,) = self._rate.at(rows)
        return neighbours.interpolated(values[before], values[after])


def support_motion_at(
    model: RobotModel,
    recording: Recording,
    support: Support | MovingSupport,
    joints: JointMotion,
    at_ns: IntArray,
    *,
    window: SavitzkyGolay,
    gravity: float,
) -> RootMotion:
    """Give the motion of the support frame at given instants.

    Args:
        model: As of `LoggedSupport`.
        recording: As of `LoggedSupport`.
        support: As of `LoggedSupport`.
        joints: As of `LoggedSupport.at`.
        at_ns: As of `LoggedSupport.at`.
        window: As of `LoggedSupport`.
        gravity: As of `LoggedSupport`.

    Returns:
        The motion, as of `LoggedSupport.at`.
    """
    return LoggedSupport(model, recording, support, window=window, gravity=gravity).at(joints, at_ns)


def imu_frame(model: RobotModel, recording: Recording, support: MovingSupport) -> str:
    """Find the link in whose frame an IMU reads.

    Args:
        model: The robot.
        recording: Streams of the IMU.
        support: The support that names them.

    Returns:
        Name of the link.

    Raises:
        RecordingError: If signals are missing or doubled, or in different frames.
        RobotError: If their frame is no link of the robot.
    """
    frames = {signal.frame for _, signal in _imu_signals(model, recording, support).values()}
    if len(frames) != 1:
        raise RecordingError(
            f"support frame {support.frame!r}: expected the IMU's signals in one frame, got {sorted(map(str, frames))}"
        )
    frame = str(frames.pop())
    if frame not in model.links:
        raise RobotError(
            f"the IMU of support frame {support.frame!r} reads in the frame {frame!r}, which is no link of robot "
            f"{model.name!r}; {known_names(frame, model.links)}"
        )
    return frame


def _imu_signals(model: RobotModel, recording: Recording, support: MovingSupport) -> dict[str, tuple[Stream, Signal]]:
    signals: dict[str, tuple[Stream, Signal]] = {}
    if support.is_unknown:
        raise RecordingError(
            f"frame {support.frame!r}: expected streams that tell how it moves, got none, so that nothing says what "
            f'the sensor must read; name them as motion of [load] in place of "{NO_MOTION}"'
        )
    for name in support.motion_streams:
        stream = recording.stream(name)
        for quantity in IMU_QUANTITIES:
            if quantity not in stream.signals:
                continue
            if quantity in signals:
                raise RecordingError(
                    f"support frame {support.frame!r}: {quantity} is in the streams {signals[quantity][0].name!r} and "
                    f"{name!r}; keep one"
                )
            signals[quantity] = (stream, stream.signals[quantity])
    _require_complete(model, support, signals)
    return signals


def _require_complete(model: RobotModel, support: MovingSupport, signals: dict[str, tuple[Stream, Signal]]) -> None:
    has: Sequence[str] = sorted(signals)
    # what hangs on a wrist sensor has no joints: it is weighed in poses that are still, or nearly
    still = (
        ({"gravity"}, {"proper_acceleration"})
        if all(joint.type is JointType.FIXED for joint in model.joints.values())
        else ({"gravity"},)
    )
    if set(signals) in still:
        return
    if "gravity" not in signals and {"proper_acceleration", "angular_velocity"} <= set(signals):
        return
    raise RecordingError(
        f"support frame {support.frame!r}: expected proper_acceleration and angular_velocity, or gravity alone, which "
        "an orientation gives, in the "
        f"streams {', '.join(support.motion_streams)}; got {', '.join(has) or 'neither'}"
    )

# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches of several sensors of one recording: what these have in common is computed once.

The motion of the joints is most of the work of an expected wrench, and sensors of one robot share joints. Joints are
filtered once for all sensors; where sensors have the same instants, all else is computed at once too.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.recording.recording import Recording
from forcetorque.recording.shared_filters import SharedFilters


@dataclass(frozen=True, slots=True, eq=False)
class _Evaluation:
    """Wrenches that were computed at once, those that are not fetched yet by the name of their sensor."""

    key: Hashable
    at_ns: IntArray
    waiting: dict[str, FloatArray] = field(default_factory=dict)


class SharedWrenches:
    """Expected wrenches of sensors that are analysed one after the other; each is kept until it is fetched."""

    def __init__(self, recording: Recording, streams: Mapping[str, str]) -> None:
        """Group the sensors.

        Args:
            recording: The recording.
            streams: Stream of every sensor, by the name of the sensor in the robot model.
        """
        self.filters = SharedFilters()
        """Derivatives of the joints."""
        self._recording, self._streams = recording, dict(streams)
        self._evaluations: list[_Evaluation] = []

    def of(
        self, sensor: str, key: Hashable, at_ns: IntArray, compute: Callable[[Sequence[str]], dict[str, FloatArray]]
    ) -> FloatArray:
        """Give the expected wrench of a sensor.

        Args:
            sensor: Name of the sensor.
            key: Everything but the instants that the wrenches depend on.
            at_ns: Instants; shape (n,); ns.
            compute: Gives the wrenches of some sensors at these instants by name; shape (n, 6) each; N, N m.

        Returns:
            Wrenches; shape (n, 6); N, N m.
        """
        earlier = [one for one in self._evaluations if one.key == key and np.array_equal(one.at_ns, at_ns)]
        for evaluation in earlier:
            if sensor in evaluation.waiting:
                return evaluation.waiting.pop(sensor)
        together = [] if earlier else self._with_stamps_of(sensor)
        if together:
            try:
                wrenches = compute([sensor, *together])
            except ForceTorqueError:  # such as a joint that only another sensor needs
                wrenches = compute([sensor])
            own = wrenches.pop(sensor)
            self._evaluations.append(_Evaluation(key, at_ns, wrenches))
            return own
        return compute([sensor])[sensor]

    def _with_stamps_of(self, sensor: str) -> list[str]:
        """Other sensors with the same stamps."""
        if sensor not in self._streams:
            return []
        stream = self._recording.stream(self._streams[sensor])
        return [
            name
            for name, other in self._streams.items()
            if name != sensor
            and self._recording.stream(other).clock == stream.clock
            and np.array_equal(self._recording.stream(other).stamp_ns, stream.stamp_ns)
        ]

# SPDX-License-Identifier: BSD-3-Clause
"""Which stream goes to which port when a recording is written as a folder of yarpdatadumper."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TypeAlias

from forcetorque.errors import RecordingError
from forcetorque.exchange.yarp.discover import PortKind
from forcetorque.exchange.yarp.measures import MeasuresSensor

_OF_ONE_STREAM = (PortKind.ANALOG, PortKind.STATE_EXT, PortKind.STATE, PortKind.INERTIAL)


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamPort:
    """A port whose messages hold one stream."""

    path: str
    """Folder of the port below the folder of logs, with `/`, such as `icub/left_leg/stateExt:o`."""
    kind: PortKind
    """`analog`, `state_ext`, `state` or `inertial`."""
    stream: str
    """Stream of the recording."""

    def __post_init__(self) -> None:
        _check_path(self.path)
        if self.kind not in _OF_ONE_STREAM:
            raise RecordingError(
                f"port {self.path!r}: expected one of {', '.join(_OF_ONE_STREAM)}, got {str(self.kind)!r}; "
                "a device with several sensors is a DevicePort"
            )
        object.__setattr__(self, "kind", PortKind(self.kind))


@dataclass(frozen=True, slots=True, kw_only=True)
class DevicePort:
    """A port `measures:o` of a device with several sensors, whose streams share their stamps."""

    path: str
    """Folder of the port below the folder of logs, with `/`."""
    sensors: tuple[MeasuresSensor, ...]
    """What each sensor of the device is called and where it stands; `read_measures` takes the same."""

    def __post_init__(self) -> None:
        _check_path(self.path)
        object.__setattr__(self, "sensors", tuple(self.sensors))
        places: dict[str, list[int]] = {}
        for sensor in self.sensors:
            places.setdefault(sensor.list, []).append(sensor.index)
        if not places:
            raise RecordingError(f"port {self.path!r}: expected at least one sensor, got none")
        for name, indices in places.items():
            if sorted(indices) != list(range(len(indices))):
                raise RecordingError(
                    f"port {self.path!r}: expected the indices 0 to {len(indices) - 1} in the list {name}, each once, "
                    f"got {', '.join(map(str, indices))}; a message has no empty places"
                )


WrittenPort: TypeAlias = StreamPort | DevicePort
"""A port to write."""


def _check_path(path: str) -> None:
    parts = PurePosixPath(path).parts
    if not parts or path.startswith("/") or ".." in parts or "\\" in path:
        raise RecordingError(f"port {path!r}: expected a path below the folder of logs, such as icub/head/state:o")

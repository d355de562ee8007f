# SPDX-License-Identifier: BSD-3-Clause
"""Writing a recording as a folder of yarpdatadumper, so that simulated data take the path of measured ones.

The folder does not say which clock stamped a port, nor in which frame it reads: readers take all
stamps for those of one clock, so streams whose clocks are apart are read as they would be from a
network whose machines are not synchronised.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

import numpy as np

from forcetorque.errors import MissingFileError, RecordingError
from forcetorque.exchange.yarp.message_text import device_messages, stamp_text, stream_messages
from forcetorque.exchange.yarp.written_port import DevicePort, WrittenPort
from forcetorque.paths import real_path
from forcetorque.recording import Recording, Stream
from forcetorque.temporary import temporary_beside


def write_ports(folder: Path | str, recording: Recording, ports: Sequence[WrittenPort]) -> None:
    """Write streams of a recording as logs of ports.

    Angles are written in deg. The samples stand in the order of the stream, each with its sequence
    number, counted from 0 where the stream has none, and its stamp as that of the sender. All ports
    are there at the end, or none.

    Args:
        folder: Folder of logs; made if it is not there. What it holds already is left alone.
        recording: The recording.
        ports: Which streams go where; what the kind of a port cannot carry is not written.

    Raises:
        RecordingError: If a port is there already, two share a folder or lie in each other, or a stream
            does not hold what its port sends.
        MissingFileError: If the folder that the folder of logs is to be made in does not exist.
    """
    target = real_path(folder)
    if not target.parent.is_dir():
        raise MissingFileError(f"{folder}: expected an existing folder to write to, got none; create {target.parent}")
    _check_places(target, ports)
    with temporary_beside(target, folder=True) as fresh:
        for port in ports:
            _write_port(fresh / port.path, recording, port)
        _move(fresh, target, ports)


def _check_places(target: Path, ports: Sequence[WrittenPort]) -> None:
    if not ports:
        raise RecordingError("ports: expected at least one, got none")
    paths = [PurePosixPath(port.path) for port in ports]
    for k, path in enumerate(paths):
        for other in paths[:k]:
            if path == other or path in other.parents or other in path.parents:
                raise RecordingError(f"ports: {str(other)!r} and {str(path)!r} lie in each other; give each its own")
        if (target / path).exists():
            raise RecordingError(
                f"{target / path}: exists; a log is never written over, choose a new folder; nothing was written"
            )
        for parent in (target, *(target / above for above in path.parents)):
            if parent.exists() and not parent.is_dir():
                raise RecordingError(f"{parent}: expected a folder or nothing, got a file; nothing was written")


def _write_port(folder: Path, recording: Recording, port: WrittenPort) -> None:
    if isinstance(port, DevicePort):
        stream = _shared_messages(recording, port)
        texts = device_messages(recording, port)
    else:
        stream = recording.stream(port.stream)
        texts = stream_messages(recording, port)
    sequence = np.arange(len(stream)) if stream.sequence is None else stream.sequence
    _check_envelopes(port, stream)
    folder.mkdir(parents=True)
    with (folder / "data.log").open("w", encoding="ascii", newline="\n") as log:
        log.writelines(
            f"{number} {stamp_text(stamp)} {text}\n"
            for number, stamp, text in zip(sequence.tolist(), stream.stamp_ns.tolist(), texts, strict=True)
        )
    first, last = (stamp_text(int(stamp)) for stamp in (stream.stamp_ns.min(), stream.stamp_ns.max()))
    info = f"Type: Bottle;\nStamp: tx;\n[{first}] /{port.path} [connected]\n[{last}] /{port.path} [disconnected]\n"
    (folder / "info.log").write_text(info, encoding="utf-8", newline="\n")


def _shared_messages(recording: Recording, port: DevicePort) -> Stream:
    """Give the stream whose stamps are those of all streams of a device."""
    first, *others = (recording.stream(sensor.stream) for sensor in port.sensors)
    for other in others:
        same_sequence = (
            first.sequence is other.sequence
            if first.sequence is None or other.sequence is None
            else np.array_equal(first.sequence, other.sequence)
        )
        if not same_sequence or not np.array_equal(first.stamp_ns, other.stamp_ns):
            raise RecordingError(
                f"port {port.path!r}: expected the streams {first.name!r} and {other.name!r} to share their stamps and "
                "sequence numbers, because they are sent in the same messages; give each its own port"
            )
    return first


def _check_envelopes(port: WrittenPort, stream: Stream) -> None:
    if not len(stream):
        raise RecordingError(f"port {port.path!r}: the stream {stream.name!r} holds no sample; leave the port out")
    if (stream.stamp_ns <= 0).any():
        raise RecordingError(
            f"port {port.path!r}: expected stamps after the epoch, got {int(stream.stamp_ns.min())} ns in the stream "
            f"{stream.name!r}; others mean that the sender gave none"
        )
    if stream.sequence is not None and ((stream.sequence < 0) | (stream.sequence >= 10**18)).any():
        raise RecordingError(
            f"port {port.path!r}: expected sequence numbers from 0 to 18 digits in the stream {stream.name!r}, got "
            f"{int(stream.sequence.min())} to {int(stream.sequence.max())}; a negative one means that there was none"
        )


def _move(fresh: Path, target: Path, ports: Sequence[WrittenPort]) -> None:
    """Put the ports where they belong: the whole folder at once if it is new, else one by one or none."""
    if not target.exists():
        fresh.rename(target)
        return
    new_folders: list[Path] = []
    placed: list[Path] = []
    try:
        for port in ports:
            place = target / port.path
            for parent in reversed([above for above in place.parents if not above.exists()]):
                parent.mkdir()
                new_folders.append(parent)
            (fresh / port.path).rename(place)
            placed.append(place)
    except BaseException:
        for path in placed:
            shutil.rmtree(path)
        for path in reversed(new_folders):
            path.rmdir()
        raise

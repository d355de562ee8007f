# SPDX-License-Identifier: BSD-3-Clause
"""The page that follows a live run: what its server gives, and that nobody who looks holds the run up."""

from __future__ import annotations

import http.client
import json
import socket
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError, RecordingError
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.ros.messages import JOINT_TYPE
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import OffsetSource
from forcetorque.live.ros_topics import RosSource, attachment
from forcetorque.live.run_from_settings import make_run
from forcetorque.live.settings import Settings
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.viewer.live_page import ServedRun, live_page, live_scene, shown_robot
from forcetorque.viewer.scene_arrays import Block
from tests.app.outcome import Run
from tests.live.test_ros_topics import PUBLISHER, Loopback, _joints, _wrench
from tests.scenes.calibrations import make_calibration
from tests.scenes.experiments import JOINTS, PARQUET


@dataclass(frozen=True)
class Answer:
    """What a page gets."""

    update: dict[str, Any]
    time_s: FloatArray
    arrays: list[FloatArray]


def _answer(content: bytes, *columns: int) -> Answer:
    head, _, body = content.partition(b"\n")
    update = json.loads(head)
    rows = update["rows"]
    arrays, at = [], 8 * rows
    for count in columns:
        end = at + 4 * rows * count
        arrays.append(np.frombuffer(body[at:end], "<f4").reshape(rows, count).astype(np.float64))
        at = end
    assert at == len(body)
    return Answer(update, np.frombuffer(body[: 8 * rows], "<f8"), arrays)


def _get(url: str, place: str, method: str = "GET") -> tuple[int, bytes]:
    connection = http.client.HTTPConnection("127.0.0.1", urlsplit(url).port, timeout=10)
    connection.request(method, urlsplit(url).path + place)
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer.status, content


def test_a_recording_is_followed(arm: Path) -> None:
    """Rows are the corrected wrenches, intervals and readings of the run, with the robot as the recording has it."""
    calibration = make_calibration(name="arm_ft", serial="SIM001")
    settings = Settings(replay=Path(PARQUET), speed=0.0, offset=OffsetSource.TARE)
    source, correctors = make_run(settings, [calibration], descriptor=0, warn=print)
    urls: list[str] = []
    with live_page(settings, source, correctors, window_s=5.0, opened=urls.append) as page:
        loop = LiveLoop(source, correctors, [], clock=time.monotonic, recent=page.recent)
        page.follow(loop)
        page.end(loop.run())
        status, content = _get(urls[0], "stream?after=1000")
        assert status == 200
        answer = _answer(content, len(JOINTS), 7, 6, 6, 6)
        _, only_state = _get(urls[0], "stream?after=-1")
        assert [_get(urls[0], place)[0] for place in ("stream", "stream?after=x", "stream?after=1&a=b")] == [404] * 3
        assert _get(urls[0], "stream?after=0", "POST")[0] == 404
        assert b'"live":{"url":"stream","window_s":5.0}' in _get(urls[0], "")[1]
    recording = load_experiment(PARQUET).recording
    raw = recording.stream("arm_ft").signal("raw").values
    expected = calibration.apply(raw, serial="SIM001")
    assert (answer.update["first"], answer.update["rows"], answer.update["total"]) == (1000, 200, 1200)
    assert (answer.update["received"], answer.update["lost"], answer.update["ended_by"]) == (1200, None, "end of input")
    (sensor,) = answer.update["sensors"]
    assert (sensor["status"], sensor["samples"], sensor["faulty"], len(sensor["drift"])) == ("ok", 1200, 0, 6)
    positions, root, wrench, deviation, reading = answer.arrays
    tared = wrench - expected[1000:]
    assert np.ptp(tared, axis=0).max() < 1e-4  # one offset for all
    assert np.isnan(deviation).all()  # a calibration without a posterior
    assert calibration.prior is not None
    assert np.allclose(reading, raw[1000:] @ calibration.prior.matrix.T, rtol=1e-5)
    logged = recording.stream("joints").signal("position").values
    assert np.abs(positions[-1] - logged[-1]).max() < 0.1
    assert np.allclose(np.linalg.norm(root[:, 3:], axis=1), 1.0, atol=1e-6)
    assert _answer(only_state).update["rows"] == 0


def test_a_page_that_stops_to_read_does_not_hold_the_run_up(arm: Path) -> None:
    """Many ask for all and read nothing; the run goes through, and its end is waited for no longer than a second."""
    settings = Settings(replay=Path(PARQUET), speed=0.0)
    source, correctors = make_run(
        settings, [make_calibration(name="arm_ft", serial="SIM001")], descriptor=0, warn=print
    )
    urls: list[str] = []
    with live_page(settings, source, correctors, window_s=5.0, opened=urls.append) as page:
        loop = LiveLoop(source, correctors, [], clock=time.monotonic, recent=page.recent)
        page.follow(loop)
        parts = urlsplit(urls[0])
        silent = [socket.create_connection(("127.0.0.1", parts.port or 0)) for _ in range(8)]
        for one in silent:
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1024)
            one.sendall(f"GET {parts.path}stream?after=0 HTTP/1.1\r\nHost: {parts.netloc}\r\n\r\n".encode() * 50)
        begun = time.monotonic()
        ended_by = loop.run()
        assert (ended_by, page.recent.total) == ("end of input", 1200)
        page.end(ended_by)
        assert time.monotonic() - begun < 20.0
        for one in silent:
            one.close()


def test_a_robot_of_ros_moves_with_its_joints() -> None:
    """Positions are those that came last, in the order of the robot; before they came there are none."""
    session = Loopback()
    settings = Settings(ros2=("/ft/wrench",), robot=Path(ARM_URDF), joints="/joint_states", frame=("hand",), shown=True)
    calibration = make_calibration()
    source, correctors = make_run(settings, [calibration], descriptor=0, warn=print, ros=session)
    assert isinstance(source, RosSource)
    block = Block()
    shown = shown_robot(settings, source, [calibration], block)
    built = live_scene(shown, correctors, block, kept=10, window_s=1.0)
    assert built.scene.sensors[0].link == "hand"
    from forcetorque.live.recent_samples import RecentSamples

    page = ServedRun(RecentSamples(correctors, joints=len(shown.coordinates), kept=10), shown, built.scene)
    loop = LiveLoop(source, correctors, [], clock=time.monotonic, recent=page.recent)
    page.follow(loop)
    for number, position in enumerate([None, 0.3, 0.4], start=1):
        if position is not None:
            session.send("/joint_states", _joints([shown.coordinates[1]], [position]), None, JOINT_TYPE)
        session.send("/ft/wrench", _wrench(10**9 + number * 10**6, frame="hand"), attachment(number, 0, PUBLISHER))
    source._left = 3
    loop.run()
    positions = _answer(page.answer(0), len(shown.coordinates), 7, 6, 6, 6).arrays[0]
    assert np.isnan(positions[:, 0]).all()
    assert positions[1:, 1] == pytest.approx([0.3, 0.4], abs=1e-6)
    assert np.isnan(positions[0, 1])


def test_sensors_without_a_robot_stand_side_by_side() -> None:
    """With a note."""
    settings = Settings(ros2=("leg_ft=/a", "arm_ft=/b"), frame=("leg_ft=foot", "arm_ft=hand"), shown=True)
    calibrations = [make_calibration(), make_calibration(name="arm_ft")]
    source, correctors = make_run(settings, calibrations, descriptor=0, warn=print, ros=Loopback())
    block = Block()
    scene = live_scene(
        shown_robot(settings, source, calibrations, block), correctors, block, kept=4, window_s=1.0
    ).scene
    assert [joint.parent_H_child[3] for joint in scene.robot.joints] == [0.0, 0.2]
    assert "not where they truly are" in scene.notes[0]


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"joints": None}, "--joints too"),
        ({"robot": None}, "--joints: .* expected --robot too"),
        ({"frame": ()}, "expected --frame, the frame_id"),
        ({"frame": ("nowhere",)}, "expected a link"),
        ({"shown": False}, "got none of --base-gravity, --tool-mass"),
    ],
)
def test_a_robot_is_stated_whole(changed: dict[str, Any], message: str) -> None:
    """Without a page a robot is for a tool."""
    stated: dict[str, Any] = {
        "ros2": ("/ft/wrench",), "robot": Path(ARM_URDF), "joints": "/joint_states", "frame": ("hand",), "shown": True,
    }  # fmt: skip
    with pytest.raises(RecordingError, match=message):
        make_run(Settings(**stated | changed), [make_calibration()], descriptor=0, warn=print, ros=Loopback())


def test_the_command_serves_a_page(arm: Path, run: Run) -> None:
    """Its address is on standard error; options of the page alone are refused."""
    make_calibration(name="arm_ft", serial="SIM001").save("arm.json")
    words = ("live", "arm.json", "--replay", PARQUET, "--speed", 0, "--lines", "none")
    outcome = run(*words, "--view", "--no-browser")
    assert outcome.code == 0
    assert "page: http://127.0.0.1:" in outcome.err
    assert "1200 samples" in outcome.err
    assert "--view too" in run(*words, "--port", 8123).error()
    for window_s in (0, "inf", "nan"):
        assert "--view-s: expected a finite number above 0" in run(*words, "--view", "--view-s", window_s).error()
    with pytest.raises(ForceTorqueError, match="above 0"), live_page(Settings(), None, [], window_s=-1.0):  # type: ignore[arg-type]
        pass

# SPDX-License-Identifier: BSD-3-Clause
"""Wrenches of ROS 2 in, corrected ones out: in this process, and between two peers of zenoh on this machine."""

from __future__ import annotations

import json
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingExtraError, RecordingError
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.formats.ros.messages import JOINT_TYPE, WRENCH_TYPE
from forcetorque.formats.ros.single_messages import WrenchEncoder, read_wrench
from forcetorque.live.loop import LiveLoop
from forcetorque.live.result import LiveRun
from forcetorque.live.ros_topics import (
    WRENCH_HASH,
    RosOutput,
    RosSource,
    attachment,
    publisher_tokens,
    read_attachment,
    topic_key,
)
from forcetorque.live.run_from_settings import make_run
from forcetorque.live.sample_status import Status
from forcetorque.live.settings import Settings
from forcetorque.live.zenoh_session import zenoh_session
from forcetorque.simulation.robots import ARM_URDF
from tests.scenes.calibrations import FACTORY, make_calibration

RAW = np.array([100.0, -200.0, 300.0, -400.0, 500.0, -600.0])
PRIOR = FACTORY @ RAW
PUBLISHER, OTHER = b"p" * 16, b"q" * 16


class Loopback:
    """Carries messages within the process, by keys without stars but in the last part."""

    def __init__(self) -> None:
        self.takers: dict[str, Callable[[bytes, bytes | None], None]] = {}
        self.sent: list[tuple[str, bytes, bytes]] = []
        self.tokens: list[str] = []

    def subscribe(self, key: str, take: Callable[[bytes, bytes | None], None]) -> None:
        self.takers[key] = take

    def publisher(self, key: str) -> Callable[[bytes, bytes], None]:
        return lambda message, attached: self.sent.append((key, message, attached))

    def announce(self, token: str) -> None:
        self.tokens.append(token)

    def send(self, topic: str, message: bytes, attached: bytes | None, kind: str = WRENCH_TYPE) -> None:
        self.takers[topic_key(0, topic, kind)](message, attached)


def _wrench(stamp_ns: int, frame: str = "ft_link", values: Any = PRIOR) -> bytes:
    return WrenchEncoder(frame).encode(stamp_ns, tuple(values))


def _run(
    messages: Callable[[Loopback], int], *, calibration: Calibration | None = None, **stated: Any
) -> tuple[LiveRun, Loopback]:
    """What becomes of messages, of which the function gives how many are wrenches that are corrected."""
    session, now = Loopback(), iter(np.arange(1e6) * 1e-3)
    calibration = calibration or make_calibration()
    settings = Settings(ros2=("/ft/wrench",), publish=("/ft/corrected",), **{"frame": ("ft_link",)} | stated)
    source, correctors = make_run(
        settings, [calibration], descriptor=0, warn=lambda _: None, clock=lambda: float(next(now)), ros=session
    )
    assert isinstance(source, RosSource)
    topics = {calibration.sensor.name: "/ft/corrected"}
    output = RosOutput(session, topics, {calibration.sensor.name: "ft_link"}, domain=0, with_faults=False)
    source._left = messages(session)
    loop = LiveLoop(source, correctors, [output], clock=lambda: float(next(now)))
    return loop.result(loop.run()), session


def test_keys_are_as_the_middleware_makes_them() -> None:
    """Domain, topic, type and hash; the hash is that of rosbags; two tokens show node and publisher."""
    assert topic_key(7, "/ft/wrench", WRENCH_TYPE) == "7/ft/wrench/geometry_msgs::msg::dds_::WrenchStamped_/*"
    rosbags = pytest.importorskip("rosbags.typesys")
    types = rosbags.get_typestore(rosbags.Stores.ROS2_JAZZY)
    assert types.hash_rihs01(WRENCH_TYPE) == WRENCH_HASH
    node, publisher = publisher_tokens(0, ["/ft/corrected"])
    assert node == "@ros2_lv/0/{zid}/0/0/NN/%/%/forcetorque_live"
    assert publisher.startswith("@ros2_lv/0/{zid}/0/1/MP/%/%/forcetorque_live/%ft%corrected/geometry_msgs::msg::dds_::")
    assert publisher.endswith(f"WrenchStamped_/{WRENCH_HASH}/::,10:,:,:,,")


def test_attachments_have_number_and_publisher() -> None:
    """33 bytes; others are refused."""
    data = attachment(3, 5, PUBLISHER)
    assert data.hex() == "0300000000000000" + "0500000000000000" + "10" + PUBLISHER.hex()
    assert read_attachment(data) == (3, PUBLISHER)
    for broken in (None, data[:-1], data[:16] + b"\x0f" + data[17:]):
        with pytest.raises(FormatError, match="attachment"):
            read_attachment(broken)


def test_wrenches_are_corrected_and_sent_on() -> None:
    """With stamp and frame of the message; lost, repeated, foreign, broken and faulty ones are counted and not sent."""

    def send(session: Loopback) -> int:
        for number in (1, 2, 4, 4, 5):
            session.send("/ft/wrench", _wrench(10**9 + number), attachment(number, 0, PUBLISHER))
        session.send("/ft/wrench", _wrench(10**9 + 9), attachment(1, 0, OTHER))
        session.send("/ft/wrench", _wrench(10**9 + 9), None)
        session.send("/ft/wrench", _wrench(10**9 + 9)[:-8], attachment(6, 0, PUBLISHER))
        session.send("/ft/wrench", _wrench(10**9 + 9, frame="base"), attachment(6, 0, PUBLISHER))
        session.send("/ft/wrench", _wrench(10**9 + 6, values=[np.nan] * 6), attachment(6, 0, PUBLISHER))
        return 6

    result, session = _run(send)
    packets = result.packets
    assert (packets.received, packets.lost, packets.repeated, packets.foreign, packets.unreadable) == (6, 1, 1, 1, 3)
    assert len(session.sent) == 4
    expected = make_calibration().apply(RAW, serial="SN001")
    for place, (key, message, attached) in enumerate(session.sent):
        assert key == topic_key(0, "/ft/corrected", WRENCH_TYPE, WRENCH_HASH)
        assert read_attachment(attached)[0] == place + 1
        stamp_ns, frame, wrench = read_wrench(message)
        assert (stamp_ns, frame) == (10**9 + (1, 2, 4, 5)[place], "ft_link")
        assert np.allclose(wrench, expected, rtol=0, atol=1e-10)
    assert len(session.tokens) == 2


def test_a_publisher_that_begins_again_is_heard() -> None:
    """After a second of silence, from its first message on; nothing counts as lost."""

    def send(session: Loopback) -> int:
        for number in range(1, 30):
            session.send("/ft/wrench", _wrench(10**9 + number), attachment(number + 50, 0, PUBLISHER))
        return 30

    session, calibration, now = Loopback(), make_calibration(), [0.0]
    source = RosSource(
        session, {"leg_ft": "/ft/wrench"}, frames={"leg_ft": "ft_link"}, domain=0, clock=lambda: now[0], messages=31
    )
    send(session)
    packets = (packet for packet in source.packets() if packet is not None)
    first = [next(packets) for _ in range(29)]
    now[0] = 2.0
    for number in (1, 2):
        session.send("/ft/wrench", _wrench(10**9 + 99), attachment(number, 0, OTHER))
    assert [packet.begins for packet in (*first, *packets)] == [False] * 29 + [True, False]
    assert source.counts.foreign == 0
    assert calibration.sensor.name == "leg_ft"


def test_messages_that_wait_at_an_interrupt_are_counted() -> None:
    """As lost, with those between them that never came and those that found no room; not those of joints."""
    session = Loopback()
    source = RosSource(
        session,
        {"leg_ft": "/ft/wrench"},
        frames={"leg_ft": "ft_link"},
        domain=0,
        clock=time.monotonic,
        joints_topic="/j",
    )
    source._queue.maxsize = 6
    for number in (1, 2, 5, 6, 7):
        session.send("/ft/wrench", _wrench(10**9 + number), attachment(number, 0, PUBLISHER))
        session.send("/j", b"", None, JOINT_TYPE)
    packets = source.packets()
    assert next(packets) is not None
    packets.close()
    assert source.counts.lost == 6


@pytest.mark.parametrize("last", [attachment(1, 0, OTHER), attachment(900, 0, OTHER), None])
def test_messages_that_wait_are_those_of_the_publisher_that_is_heard(last: bytes | None) -> None:
    """Whatever comes last: of another publisher, or without its number."""
    session = Loopback()
    source = RosSource(session, {"leg_ft": "/ft/wrench"}, frames={"leg_ft": "ft_link"}, domain=0, clock=time.monotonic)
    for number in (1, 2, 4, 3):
        session.send("/ft/wrench", _wrench(10**9 + number), attachment(number, 0, PUBLISHER))
    session.send("/ft/wrench", _wrench(10**9), last)
    packets = source.packets()
    assert next(packets) is not None
    packets.close()
    assert source.counts.lost == 3


def _joints(names: list[str], positions: list[float]) -> bytes:
    rosbags = pytest.importorskip("rosbags.typesys")
    types = rosbags.get_typestore(rosbags.Stores.ROS2_JAZZY)
    known = types.types
    stamp = known["builtin_interfaces/msg/Time"](sec=1, nanosec=0)
    header = known["std_msgs/msg/Header"](stamp=stamp, frame_id="")
    message = known[JOINT_TYPE](
        header=header, name=names, position=np.array(positions), velocity=np.array([]), effort=np.array([])
    )
    return bytes(types.serialize_cdr(message, JOINT_TYPE))


def _tool(folder: Path) -> dict[str, Any]:
    """A tool of 2 kg behind joint a about x and joint b about y."""
    urdf = folder / "arm.urdf"
    urdf.write_text(
        """<robot name="arm"><link name="base"/><link name="upper"/><link name="ft_link"/>
        <joint name="a" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="1 0 0"/>
        <limit lower="-3" upper="3" effort="9" velocity="9"/></joint>
        <joint name="b" type="revolute"><parent link="upper"/><child link="ft_link"/><axis xyz="0 1 0"/>
        <limit lower="-3" upper="3" effort="9" velocity="9"/></joint></robot>"""
    )
    return {
        "robot": urdf, "joints": "/joint_states", "base_gravity": "0,0,-9.81", "frame": ("ft_link",),
        "tool_mass_kg": 2.0, "tool_centre_m": "0,0,0", "take_tool_off": True,
    }  # fmt: skip


def test_the_weight_of_a_tool_follows_from_joints(tmp_path: Path) -> None:
    """Taken off in each posture, by positions that come in two messages; before they came a sample has a fault."""
    calibration = make_calibration(offset=np.zeros(6))
    sign = 1.0 if calibration.sensor.measure_direction.value.startswith("child") else -1.0
    weights = {(0.0, 0.0): [0.0, 0.0, -9.81], (np.pi / 2, 0.0): [0.0, -9.81, 0.0], (0.0, np.pi / 2): [9.81, 0.0, 0.0]}

    def send(session: Loopback) -> int:
        session.send("/ft/wrench", _wrench(10**9), attachment(1, 0, PUBLISHER))
        for number, ((a, b), weight) in enumerate(weights.items(), start=2):
            session.send("/joint_states", _joints(["other", "a"], [9.0, a]), None, JOINT_TYPE)
            session.send("/joint_states", _joints(["b"], [b]), None, JOINT_TYPE)
            wrench = np.array([*(2.0 * sign * np.array(weight)), 0.0, 0.0, 0.0])
            raw = np.linalg.solve(calibration.matrix, wrench)
            session.send("/ft/wrench", _wrench(10**9 + number, values=FACTORY @ raw), attachment(number, 0, PUBLISHER))
        return 1 + len(weights)

    result, session = _run(
        send, calibration=calibration, **_tool(tmp_path)
    )  # fmt: skip
    assert (result.sensors[0].device_errors, len(session.sent)) == (1, 3)
    for _, message, _ in session.sent:
        assert np.abs(read_wrench(message)[2]).max() < 1e-9


_IN_G: dict[str, Any] = {
    "robot": ARM_URDF, "joints": "/joint_states", "base_gravity": "0,0,-1", "frame": ("tool",), "tool_mass_kg": 1.0,
    "tool_centre_m": "0,0,0", "take_tool_off": True,
}  # fmt: skip


def test_every_joint_must_have_come_lately(tmp_path: Path) -> None:
    """A joint that is silent makes a fault, though another one comes; so does a position that is NaN."""
    session, now = Loopback(), [0.0]
    settings = Settings(ros2=("/ft/wrench",), **_tool(tmp_path))
    source, (corrector,) = make_run(
        settings, [make_calibration()], descriptor=0, warn=print, clock=lambda: now[0], ros=session
    )
    packets = (packet for packet in source.packets() if packet is not None)

    def status(at_s: float, names: list[str], positions: list[float]) -> int:
        now[0] = at_s
        session.send("/joint_states", _joints(names, positions), None, JOINT_TYPE)
        number = round(1e3 * at_s)
        session.send("/ft/wrench", _wrench(10**6 * number), attachment(number, 0, PUBLISHER))
        packet = next(packets)
        return int(corrector.correct(packet.values, gravity=packet.gravity, faults=packet.faults).status[0])

    assert status(1.0, ["a", "b"], [0.1, 0.2]) == 0
    assert status(1.4, ["b"], [0.2]) == 0
    assert status(1.6, ["b"], [0.2]) == Status.DEVICE
    assert status(1.7, ["a"], [0.1]) == 0
    assert status(1.8, ["a"], [np.nan]) == Status.NOT_FINITE
    assert status(1.9, ["a"], [0.1]) == 0


def test_stamps_that_begin_again_are_heard() -> None:
    """As of `ros2 bag play --loop`, whose publisher counts on: after eight messages, at each of two turns."""

    def send(session: Loopback) -> int:
        for number in range(300):
            stamp_ns = 10**9 + number % 100 * 10**7
            session.send("/ft/wrench", _wrench(stamp_ns, values=PRIOR + number), attachment(number, 0, PUBLISHER))
        return 300

    result, session = _run(send)
    assert len(session.sent) == 300 - 2 * 7
    assert (result.packets.restarts, result.packets.backwards, result.packets.lost) == (2, 14, 0)
    assert result.sensors[0].late == 14 == result.sensors[0].faulty


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"ros2": ("ft/wrench",)}, "full name of a topic"),
        ({"ros2": ("/ft/*",)}, "full name of a topic"),
        ({"publish": ("/ft/wrench",)}, "every topic once"),
        ({"publish": ("foot=/ft/x",)}, "once per sensor"),
        ({"domain": 233}, "ROS_DOMAIN_ID"),
        ({"sequence": "n"}, "--sequence: not of --ros2"),
        ({"rate_hz": 10.0}, "--rate: not of --ros2"),
        ({"tool_mass_kg": 1.0, "tool_centre_m": "0,0,0", "take_tool_off": True}, "got none of --robot, --joints"),
        ({"joints": "/joint_states"}, "got none of --robot, --base-gravity, --tool-mass"),
        ({"frame": ()}, "expected --frame, the frame_id .* child frame of its calibration, child_to_parent; got none"),
        (_IN_G, "free fall of 9.7 to 9.9 m/s2, got one of 1"),
        ({"ros2": ()}, "expected one of --input"),
    ],
)
def test_nothing_is_guessed(changed: dict[str, Any], message: str) -> None:
    """What is needed and not stated, or stated and not of topics, is refused by name."""
    settings = Settings(**({"ros2": ("/ft/wrench",), "publish": ("/ft/corrected",), "frame": ("ft_link",)} | changed))
    with pytest.raises(RecordingError, match=message.replace("[", "[[]")):
        make_run(settings, [make_calibration()], descriptor=0, warn=lambda _: None, ros=Loopback())


def test_a_frame_must_be_a_link() -> None:
    """It is refused before anything is heard."""
    settings = Settings(
        ros2=("/ft/wrench",), robot=ARM_URDF, joints="/joint_states", base_gravity="0,0,-9.81", frame=("nowhere",),
        tool_mass_kg=1.0, tool_centre_m="0,0,0", take_tool_off=True,
    )  # fmt: skip
    with pytest.raises(RecordingError, match="--frame nowhere: expected a link"):
        make_run(settings, [make_calibration()], descriptor=0, warn=lambda _: None, ros=Loopback())


def test_without_zenoh_its_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """As the line that installs it."""
    monkeypatch.setitem(sys.modules, "zenoh", None)
    with pytest.raises(MissingExtraError, match=r"forcetorque\[zenoh\]"), zenoh_session():
        pass


@pytest.mark.long
def test_two_peers_on_this_machine(tmp_path: Path) -> None:
    """A driver is heard by the command and hears what that sends, without multicast and without ROS."""
    zenoh = pytest.importorskip("zenoh")
    make_calibration().save(tmp_path / "leg.json")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{free.getsockname()[1]}"
    config = zenoh.Config()
    config.insert_json5("listen/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    words = (
        "live",
        "leg.json",
        "--ros2",
        "/ft/wrench",
        "--publish",
        "/ft/corrected",
        "--router",
        endpoint,
        "--frame",
        "ft_link",
    )
    received: list[tuple[bytes, bytes]] = []
    with (
        zenoh.open(config) as driver,
        subprocess.Popen(
            [sys.executable, "-m", "forcetorque", *words, "--lines", "none", "--details", "--format", "json"],
            cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        ) as process,
    ):  # fmt: skip
        subscriber = driver.declare_subscriber(
            topic_key(0, "/ft/corrected", WRENCH_TYPE),
            lambda sample: received.append((sample.payload.to_bytes(), sample.attachment.to_bytes())),
        )
        publisher = driver.declare_publisher(topic_key(0, "/ft/wrench", WRENCH_TYPE, WRENCH_HASH))
        begun, number = time.monotonic(), 0
        while len(received) < 100 and time.monotonic() - begun < 60.0:
            number += 1
            if number % 10:  # every tenth is lost
                stamp_ns = time.time_ns()
                publisher.put(
                    _wrench(stamp_ns, values=PRIOR + number), attachment=attachment(number, stamp_ns, PUBLISHER)
                )
            time.sleep(0.005)
        tokens = [str(reply.ok.key_expr) for reply in driver.liveliness().get("@ros2_lv/0/**")]
        process.send_signal(signal.SIGTERM)
        assert process.stderr is not None
        account = json.loads(process.stderr.read())
        assert process.wait(30) == 0
        subscriber.undeclare()
    assert len(received) >= 100
    assert sorted(token.split("/")[5] for token in tokens) == ["MP", "NN"]
    packets, sensor = account["packets"], account["sensors"][0]
    # what came before the command heard the first is not known
    assert packets["lost"] == pytest.approx(packets["received"] / 9.0, abs=1.1)
    assert (packets["unreadable"], packets["foreign"], sensor["faulty"]) == (0, 0, 0)
    numbers = [read_attachment(attached)[0] for _, attached in received]
    assert numbers == list(range(1, len(numbers) + 1))
    stamps = [read_wrench(message)[0] for message, _ in received]
    assert (np.diff(stamps) > 0).all()

# SPDX-License-Identifier: BSD-3-Clause
"""Lines become samples as stated, and whatever is wrong with them is counted and survived."""

from __future__ import annotations

import json
import math
import os
import socket
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.base.output_file import is_replaceable
from forcetorque.experiment.calibration.calibration_file import SessionOffset
from forcetorque.formats.ros.single_messages import read_wrench
from forcetorque.live import outputs
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import FaultPolicy, HeldQuantity, Input, OffsetSource
from forcetorque.live.outputs import COLUMNS, CorrectedRow, UdpOutput, mcap_file, parquet_file
from forcetorque.live.packets import Packet, PacketAccount, PacketCounts
from forcetorque.live.result import LiveRun
from forcetorque.live.run_from_settings import make_run
from forcetorque.live.sample_status import Status
from forcetorque.live.settings import Settings
from forcetorque.live.sources import LONGEST_LINE, LineSource
from forcetorque.live.text_lines import LineForm, MeasuresLines, RosCsvLines, SensorColumns, YarpLines, stamp_of
from tests.scenes.calibrations import FACTORY, OFFSET, make_calibration, make_variable

RAW = np.array([[100.0, -200.0, 300.0, -400.0, 500.0, -600.0]])
CHANNELS = "c1,c2,c3,c4,c5,c6"
TABLE: dict[str, Any] = {
    "form": Input.CSV,
    "quantity": HeldQuantity.RAW,
    "channels": (CHANNELS,),
    "stamp": "t:s",
    "sequence": "n",
}
NO_TABLE: dict[str, Any] = {"channels": (), "stamp": None, "sequence": None}
YARP: dict[str, Any] = {"form": Input.YARP, "quantity": HeldQuantity.RAW}


class Kept:
    """An output that keeps its rows."""

    def __init__(self) -> None:
        self.rows: list[CorrectedRow] = []

    def write(self, row: CorrectedRow) -> None:
        self.rows.append(row)

    def flush(self) -> None:
        """Nothing waits."""


def _run(text: str, settings: Settings) -> tuple[LiveRun, list[CorrectedRow]]:
    """What becomes of a text on standard input."""
    kept, time_s = Kept(), iter(np.arange(1e6) * 1e-3)
    with TemporaryFile() as file:
        file.write(text.encode())
        file.seek(0)
        source, correctors = make_run(settings, [make_calibration()], descriptor=file.fileno(), warn=lambda _: None)
        loop = LiveLoop(source, correctors, [kept], clock=lambda: float(next(time_s)))
        return loop.result(loop.run()), kept.rows


def _line(number: int, stamp_s: float | str, values: Sequence[float] = RAW[0].tolist()) -> str:
    return ",".join(map(str, (number, stamp_s, *values))) + "\n"


def test_no_sample_is_lost_without_a_count() -> None:
    """Gaps, repeated and reordered numbers, words, NaN, steps back in time, and lines that are too long."""
    lines = [_line(k, k * 0.01, (RAW[0] + k % 3).tolist()) for k in range(30)]
    lines[4] = lines[20] = ""
    lines[8], lines[9] = lines[9], lines[8]
    lines[12] += lines[12]
    lines[15] = _line(15, "soon")
    lines[17] = _line(17, 0.05)
    lines[22] = _line(22, 0.22, [float("nan")] * 6)
    lines[25] = "9" * (LONGEST_LINE + 10) + "\n"
    result, rows = _run("".join(["n,t," + CHANNELS + "\n", *lines]), Settings(**TABLE))
    packets, sensor = result.packets, result.sensors[0]
    # two were not sent; of two the lines could not be read
    assert (packets.lost, packets.unreadable, packets.oversized) == (4, 1, 1)
    assert (packets.late, packets.repeated, packets.backwards) == (1, 1, 1)
    assert (sensor.samples, sensor.not_finite, sensor.late, sensor.repeated) == (27, 1, 2, 1)
    assert packets.received == len(rows) == 27
    assert sensor.samples + (packets.lost or 0) - packets.repeated == 30
    assert [row.status for row in rows if row.status & Status.NOT_FINITE] == [Status.NOT_FINITE]
    assert "4 lost" in next(result.answers()).verdict
    assert len(result.text(80).splitlines()) > 12  # with tables


@pytest.mark.parametrize(("mark", "written"), [(";", ";"), ("\t", "\t"), (" ", "  "), (",", ", ")])
def test_a_heading_without_commas_is_between_semicolons_tabs_or_blanks(mark: str, written: str) -> None:
    """And the lines below it as the heading."""
    lines = [("n,t," + CHANNELS + "\n").replace(",", mark), *(_line(k, k * 0.01) for k in range(3))]
    result, rows = _run("".join([lines[0], *(line.replace(",", written) for line in lines[1:])]), Settings(**TABLE))
    assert (result.packets.received, result.packets.unreadable, len(rows)) == (3, 0, 3)


def test_sensors_variables_and_status_are_where_they_are_stated() -> None:
    """Two sensors of one table, one with a temperature, one with a code of the device."""
    warm, plain = make_calibration(name="warm", variables=(make_variable(),)), make_calibration(name="plain")
    columns = [f"{name}{k}" for name in "ab" for k in range(6)]
    settings = Settings(
        form=Input.CSV, quantity=HeldQuantity.RAW, stamp="t:ms", status=("plain=code",), variables=("temperature=T",),
        channels=("warm=" + ",".join(columns[:6]), "plain=" + ",".join(columns[6:])),
    )  # fmt: skip
    text = ",".join(["t", *columns, "T", "code"]) + "\n" + ",".join(map(str, [5, *RAW[0], *RAW[0], 31.5, 2])) + "\n"
    reading, writing = os.pipe()
    os.write(writing, text.encode())
    os.close(writing)
    kept = Kept()
    source, correctors = make_run(settings, [warm, plain], descriptor=reading, warn=lambda _: None)
    LiveLoop(source, correctors, [kept], clock=lambda: 0.0).run()
    os.close(reading)
    first, second = kept.rows
    assert (first.stamp_ns, first.status, second.status) == (5_000_000, 0, Status.SATURATED)
    assert np.allclose(first.values[:6], warm.apply(RAW[0], serial="SN001", variables={"temperature": 31.5}))
    assert np.allclose(second.values[:6], plain.apply(RAW[0], serial="SN001"))


def test_lists_of_a_device_are_read_by_their_indices() -> None:
    """The order is of the configuration; a stamp of the board that stays is a sample that repeats."""
    wrench = " ".join(map(str, FACTORY @ RAW[0]))
    lists = f"() () () () (((31.0) 8.0) ((33.0) 9.0)) (((1 2 3 4 5 6) 8.0) (({wrench}) {{stamp}})) () () () ()"
    text = "".join(f"{k} 1.{k} {lists.format(stamp=stamp)}\n" for k, stamp in ((1, 9.0), (2, 9.0), (3, 10.0)))
    settings = Settings(form=Input.YARP_MEASURES, quantity=HeldQuantity.WRENCH, envelope=True, index=("1",))
    result, rows = _run(text + "4 1.4 (1 2)\n", settings)
    assert [row.status for row in rows] == [0, Status.REPEATED, 0]
    assert result.packets.unreadable == 1
    assert np.allclose(rows[0].values[:6], make_calibration().apply(RAW[0], serial="SN001"))


def test_indices_are_of_the_lists_of_a_device() -> None:
    """One that is none is refused; one beyond a list makes its lines unreadable, by name; an empty list is NaN."""
    stated: dict[str, Any] = {"form": Input.YARP_MEASURES, "quantity": HeldQuantity.WRENCH}
    warm = make_calibration(name="warm", variables=(make_variable(),))
    for index in ("foo", "-1", "²"):
        settings = Settings(**stated, index=("0",), variables=(f"temperature={index}",))
        with pytest.raises(RecordingError, match=f"temperatures, got {index}"):
            make_run(settings, [warm], descriptor=0, warn=print)
    line = "() () () () (((31.0) 8.0)) (((1 2 3 4 5 6) 8.0)) () () () ()"
    columns = SensorColumns(name="warm", variables=("0",), index=7)
    with pytest.raises(FormatError, match="index 7, the list has 1"):
        MeasuresLines(sensors=[columns], envelope=False).packet(line)
    empty = MeasuresLines(sensors=[columns], envelope=False).packet("() () () () () () () () () ()")
    assert empty is not None
    assert np.isnan(empty.values).all()


@pytest.mark.real_data
def test_captured_lines_are_read(data_dir: Path) -> None:
    """`yarp read` with and without its envelope, and `ros2 topic echo --csv`: the known truth."""
    forms: dict[str, LineForm] = {
        "yarp_read_analog_envelope.txt": YarpLines(channels=6, envelope=True),
        "yarp_read_analog.txt": YarpLines(channels=6, envelope=False),
        "ros2_topic_echo_csv.txt": RosCsvLines(frame="ft_sensor"),
    }
    for name, form in forms.items():
        packets = [form.packet(line) for line in (data_dir / "live" / name).read_text().splitlines() if line]
        assert len(packets) == 5
        values = np.array([packet.values[0] for packet in packets if packet is not None])
        wrench = [0.1, -2.5, 30.25, 0.01, -0.02, 0.003] if "yarp" in name else [1.0, -2.0, 3.5, 0.1, 0.2, -0.3]
        assert np.allclose(values[0], wrench)
        assert np.allclose(np.diff(values[:, 0]), wrench[0])
    ros = forms["ros2_topic_echo_csv.txt"].packet("1700000000,5000000,ft_sensor,1,2,3,4,5,6")
    assert ros is not None
    assert ros.stamp_ns == 1_700_000_000_005_000_000
    with pytest.raises(FormatError, match="frame"):
        forms["ros2_topic_echo_csv.txt"].packet("1,2,other,1,2,3,4,5,6")


def test_stamps_are_read_exactly() -> None:
    """Sixteen digits and more are not rounded by a float."""
    texts = {"1700000000.010000": 1_700_000_000_010_000_000, "-0.5": -500_000_000, "1e-3": 1_000_000, "7": 7 * 10**9}
    assert {text: stamp_of(text, "s") for text in texts} == texts
    assert stamp_of("1700000000123456789", "ns") == 1_700_000_000_123_456_789
    for text in ("nan", "inf", "soon", "", "1e30", "9300000000"):
        with pytest.raises(FormatError):
            stamp_of(text, "s")
    with pytest.raises(FormatError, match="292 years"):
        RosCsvLines().packet("9223372036,999999999,f,1,2,3,4,5,6")


def test_losses_need_numbers_or_a_rate() -> None:
    """Gaps in time count with a rate; without, the answer says that they cannot be counted."""
    text = (
        "t," + CHANNELS + "\n" + "".join(f"{t}," + ",".join(map(str, RAW[0] + t)) + "\n" for t in (0, 10, 20, 50, 60))
    )
    stated = TABLE | {"sequence": None, "stamp": "t:ms"}
    result, _ = _run(text, Settings(**stated, rate_hz=100.0))
    assert result.packets.lost == 2
    result, _ = _run(text, Settings(**stated))
    assert result.packets.lost is None
    answer = next(result.answers())
    assert "not countable" in answer.verdict
    assert "state --rate, or --sequence" in answer.step
    result, _ = _run(text, Settings(**stated | {"stamp": None}))
    assert "state --stamp and --rate, or --sequence" in next(result.answers()).step


def test_numbers_wrap_around_and_begin_again() -> None:
    """After 2^32, and after the sender was restarted."""
    account = PacketAccount()

    def add(*numbers: int) -> list[Status]:
        return [account.add(Packet(values=RAW, sequence=number)) for number in numbers]

    top = (1 << 32) - 1
    assert add(top - 1, top, 1, 0, 0) == [0, 0, 0, Status.LATE, Status.REPEATED]
    assert account.counts == PacketCounts(received=5, late=1, repeated=1, countable=True)
    assert add(100_000, 1) == [0, 0]
    assert (account.counts.lost, account.counts.restarts) == (99_998, 1)


@pytest.mark.parametrize(
    ("stated", "heading", "mark", "last"),
    [
        (YARP | {"envelope": True}, "", " ", (1 << 15) - 1),
        (TABLE | {"sequence": "n:65536"}, "n,t," + CHANNELS + "\n", ",", (1 << 16) - 1),
        (TABLE, "n,t," + CHANNELS + "\n", ",", (1 << 32) - 1),
    ],
)
@pytest.mark.parametrize("lower", [0, 100])
def test_numbers_go_on_behind_the_last_one(
    stated: dict[str, Any], heading: str, mark: str, last: int, lower: int
) -> None:
    """Losses are counted there, and a tare goes on; where another number is the last, the sender began again."""
    numbers = [last - lower - 8 + k for k in range(9)] + [1, *range(4, 20)]
    lines = [mark.join([str(n), str(0.1 * k), *map(str, RAW[0] + k % 2)]) + "\n" for k, n in enumerate(numbers)]
    result, rows = _run("".join([heading, *lines]), Settings(offset=OffsetSource.TARE, **stated))
    assert (result.packets.restarts, result.packets.lost) == (0, 3 + lower)
    assert [row.status for row in rows].count(int(Status.TARING)) == 11
    if last == (1 << 16) - 1:
        assert _run("".join([heading, *lines]), Settings(**stated | {"sequence": "n"}))[0].packets.restarts == 1


@pytest.mark.parametrize("stated", [TABLE, TABLE | {"sequence": None, "rate_hz": 100.0}, TABLE | {"stamp": None}])
def test_a_sender_that_begins_again_is_heard(stated: dict[str, Any]) -> None:
    """After eight packets, whether numbers, stamps or both began again; the answer says why samples were faulty."""
    lines = [_line(k, k * 0.01, (RAW[0] + k % 3).tolist()) for k in range(60)]
    result, rows = _run("".join(["n,t," + CHANNELS + "\n", *lines, *lines[3:50]]), Settings(**stated))
    assert (result.packets.restarts, result.packets.lost) == (1, 0)
    assert result.sensors[0].faulty == 7
    assert not any(row.status for row in rows[67:])
    assert "7 late" in (why := next(result.answers()).why[0]) or "7 repeated" in why


def test_packets_that_come_twice_are_no_restart() -> None:
    """Also if every packet comes again some packets later."""
    account = PacketAccount()
    for number in range(20, 60):
        account.add(Packet(values=RAW, sequence=number))
        account.add(Packet(values=RAW, sequence=number - 15))
    assert account.counts.restarts == 0


@pytest.mark.parametrize("numbers", [256, 1 << 15, 1 << 32])
def test_a_number_that_was_lost_a_round_ago_is_no_late_one(numbers: int) -> None:
    """Of 70 000 packets 1 % are lost and 1 % come twice, the second time three packets later."""
    rng, account = np.random.default_rng(8), PacketAccount(numbers=numbers)
    fates = rng.choice(3, size=70_000, p=[0.98, 0.01, 0.01])
    fates[[0, -1]] = 0
    for k, fate in enumerate(fates):
        if fate != 1:
            account.add(Packet(values=RAW, sequence=k % numbers))
        if k >= 3 and fates[k - 3] == 2:
            account.add(Packet(values=RAW, sequence=(k - 3) % numbers))
    assert account.counts.lost == (fates == 1).sum()
    assert account.counts.repeated == (fates[:-3] == 2).sum()
    assert (account.counts.late, account.counts.restarts) == (0, 0)


@pytest.mark.parametrize("clock", [1.0, 0.999, 1.001])
def test_jitter_loses_nothing(clock: float) -> None:
    """Half a millisecond at 500 Hz, also of a clock that is off; two that were not sent are counted."""
    rng, account = np.random.default_rng(0), PacketAccount(500.0)
    for k in range(5000):
        if k not in (100, 2000):
            stamp_ns = round(clock * k * 2e6 + rng.normal(0.0, 5e5))
            account.add(Packet(values=RAW, stamp_ns=stamp_ns))
    assert account.counts.lost == 2


@pytest.mark.parametrize("clock", [0.9, 0.95, 0.98, 0.99, 1.01, 1.02, 1.04, 1.07, 1.1])
def test_the_rate_is_that_of_the_stamps(clock: float) -> None:
    """A sender that is slower or faster than stated, with a jitter of a twentieth, loses what it did not send."""
    rng, account, missing = np.random.default_rng(11), PacketAccount(100.0), {150, 151, 900, 1500}
    for k in range(2000):
        if k not in missing:
            account.add(Packet(values=RAW, stamp_ns=round(clock * k * 1e7 + rng.normal(0.0, 5e5))))
    assert account.counts.lost == len(missing)


def test_a_sender_at_half_the_stated_rate_loses_half() -> None:
    """The rate is not followed as far as that."""
    account = PacketAccount(100.0)
    for k in range(1000):
        account.add(Packet(values=RAW, stamp_ns=k * 20_000_000))
    assert account.counts.lost == 999


def test_a_gap_of_millions_takes_no_memory() -> None:
    """Of a long gap only the last numbers may still come late."""
    account = PacketAccount()
    for number in (0, 1 << 20, (1 << 20) - 1, 5):
        account.add(Packet(values=RAW, sequence=number))
    assert account.counts.lost == (1 << 20) - 2
    assert len(account._missing) < 5000
    account.add(Packet(values=RAW, sequence=1 << 21))  # so far ahead that it began to count elsewhere
    assert (account.counts.lost, account.counts.restarts) == ((1 << 20) - 2, 2)


def test_a_source_that_stops_is_reported_and_waited_for() -> None:
    """The silence is told once when it begins, and counted when it ends."""
    warnings: list[str] = []
    reading, writing = os.pipe()
    times = iter([0.0, 0.1, 0.2, 3.0, 5.0, 9.0, *[9.1] * 20])
    source = LineSource(reading, YarpLines(channels=6, envelope=False))

    def packets() -> Iterator[Packet | None]:
        yield Packet(values=RAW)
        yield None
        yield None
        yield None
        yield Packet(values=RAW + 1.0)

    source.packets = packets  # type: ignore[method-assign]
    loop = LiveLoop(source, [Corrector(make_calibration())], [], clock=lambda: next(times), warn=warnings.append)
    result = loop.result(loop.run())
    os.close(reading)
    os.close(writing)
    assert len(warnings) == 1
    assert (result.packets.silences, result.stamps) == (1, "arrival")
    assert result.packets.longest_silence_s > 8.0
    assert "silent 1 time" in next(result.answers()).why[0]


def test_a_silence_that_lasts_to_the_end_is_counted() -> None:
    """As where the sender dies before its pipe is closed."""
    now = [0.0]

    def packets() -> Iterator[Packet | None]:
        yield Packet(values=RAW)
        now[0] = 10.0
        yield None

    source = LineSource(0, YarpLines(channels=6, envelope=False))
    source.packets = packets  # type: ignore[method-assign]
    loop = LiveLoop(source, [Corrector(make_calibration())], [], clock=lambda: now[0])
    result = loop.result(loop.run())
    assert (result.packets.silences, result.packets.longest_silence_s) == (1, 10.0)


def test_a_stamp_without_place_is_an_unreadable_line(tmp_path: Path) -> None:
    """The file is kept."""
    with TemporaryFile() as text, parquet_file(tmp_path / "live.parquet") as output:
        text.write(("n,t," + CHANNELS + "\n" + _line(0, 0.0) + _line(1, "1e30") + _line(2, 0.02)).encode())
        text.seek(0)
        source, correctors = make_run(Settings(**TABLE), [make_calibration()], descriptor=text.fileno(), warn=print)
        loop = LiveLoop(source, correctors, [output], clock=lambda: 0.0)
        assert loop.result(loop.run()).packets.unreadable == 1
    assert pq.read_table(tmp_path / "live.parquet")["stamp_ns"].to_pylist() == [0, 20_000_000]


@pytest.mark.parametrize(("raised", "ended_by"), [(KeyboardInterrupt, "interrupt"), (BrokenPipeError, "closed output")])
def test_an_interrupt_ends_with_an_account(raised: type[BaseException], ended_by: str) -> None:
    """What was read until then is in it."""

    class Closed(Kept):
        def write(self, row: CorrectedRow) -> None:
            super().write(row)
            if len(self.rows) == 2:
                raise raised

    source = LineSource(0, YarpLines(channels=6, envelope=False))
    source.packets = lambda: iter([Packet(values=RAW + k) for k in range(5)])  # type: ignore[method-assign]
    loop = LiveLoop(source, [Corrector(make_calibration())], [Closed()], clock=lambda: 0.0)
    result = loop.result(loop.run())
    assert (result.ended_by, result.sensors[0].samples) == (ended_by, 2)


def test_refused_samples_have_no_line() -> None:
    """By the policy; they are counted."""
    text = "n,t," + CHANNELS + "\n" + _line(0, 0.0) + _line(1, 0.01, [float("nan")] * 6) + _line(2, 0.02)
    result, rows = _run(text, Settings(**TABLE, policy=FaultPolicy.REFUSE))
    assert len(rows) == 2
    assert (result.sensors[0].refused, result.sensors[0].samples) == (1, 3)


def test_a_tracked_bias_is_in_the_account() -> None:
    """With its interval and its drift since the tare."""
    rng = np.random.default_rng(2)
    lines = [_line(k, k * 0.01, (RAW[0] + rng.normal(0.0, 1.0, 6)).tolist()) for k in range(400)]
    settings = Settings(**TABLE, offset=OffsetSource.TRACKED, tare_s=1.0)
    result, rows = _run("".join(["n,t," + CHANNELS + "\n", *lines]), settings)
    sensor = result.sensors[0]
    assert sensor.bias is not None
    assert sensor.drift is not None
    assert np.abs(sensor.bias - make_calibration().apply(RAW[0], serial="SN001")).max() < 0.1
    assert np.abs(rows[-1].values[:6]).max() < 0.5
    assert "Bias of the force" in next(result.answers()).why[0]
    assert json.loads(result.json_text())["sensors"][0]["drift"] is not None


def test_a_tare_that_did_not_end_is_told() -> None:
    """Of the sensor whose samples have faults."""
    lines = [_line(k, k * 0.01, [float("nan")] * 6) for k in range(50)]
    result, _ = _run("".join(["n,t," + CHANNELS + "\n", *lines]), Settings(**TABLE, offset=OffsetSource.TARE))
    assert result.sensors[0].taring
    assert "Its tare did not end" in " ".join(next(result.answers()).why)


def test_a_file_is_written_in_row_groups(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All rows, no more than a group in memory; no file of a run that failed."""
    monkeypatch.setattr(outputs, "ROW_GROUP", 10)
    file = tmp_path / "live.parquet"
    with parquet_file(file) as output:
        for k in range(25):
            output.write(CorrectedRow(k, "leg", tuple(np.arange(12.0) + k), 0 if k else 1))
        assert not file.exists()
    table = pq.read_table(file)
    assert table.column_names == list(COLUMNS)
    assert pq.ParquetFile(file).num_row_groups == 3
    assert table["stamp_ns"].to_pylist() == list(range(25))
    assert table["status"].to_pylist()[:2] == ["not_finite", "ok"]
    with pytest.raises(FormatError), parquet_file(tmp_path / "other.parquet"):
        raise FormatError("broken")
    assert [path.name for path in tmp_path.iterdir()] == ["live.parquet"]
    assert is_replaceable(file)  # the same command may run again


def test_a_file_of_ros_holds_wrenches_without_faults(tmp_path: Path) -> None:
    """Read back as a bag; the status says where samples are left out; a wrench that is held is kept."""
    pytest.importorskip("rosbags")
    from forcetorque.formats.ros.bag import opened_bag

    rows = [CorrectedRow(10**9 + k, "leg", tuple(np.arange(12.0) + k), 2 if k in (3, 4) else 0) for k in range(6)]
    for with_faults in (False, True):
        file = tmp_path / f"live_{with_faults}.mcap"
        with mcap_file(file, {"leg": "leg_frame"}, with_faults=with_faults) as output:
            for row in rows:
                output.write(row)
            output.write(replace(rows[0], stamp_ns=-1))
        assert output.lost == 1
        with opened_bag(file) as bag:
            messages = {topic: [data for _, part in bag.messages(topic) for data in part] for topic in bag.types}
        wrenches = [read_wrench(bytes(data)) for data in messages["/leg/wrench"]]
        expected = [row for row in rows if with_faults or not row.status]
        assert wrenches == [(row.stamp_ns, "leg_frame", row.values[:6]) for row in expected]
        assert read_wrench(bytes(messages["/leg/half_width_95"][0]))[2] == rows[0].values[6:]
        assert [bytes(data)[8:-1].decode() for data in messages["/leg/status"]] == ["ok", "saturated", "ok"]


def test_datagrams_go_to_this_machine_only() -> None:
    """JSON with a time and a name per sensor; another machine is refused."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server:
        server.bind(("127.0.0.1", 0))
        server.settimeout(2.0)
        output = UdpOutput(f"127.0.0.1:{server.getsockname()[1]}")
        output.write(CorrectedRow(1_500_000_000, "leg", (1.0, *[float("nan")] * 11), 0))
        content = json.loads(server.recv(4096))
        output.close()
    assert content["timestamp"] == 1.5
    assert (content["leg"]["fx_N"], content["leg"]["fy_N"]) == (1.0, None)
    for address in ("192.168.1.2:9870", "127.0.0.1", "127.0.0.1:0", "localhost:1"):
        with pytest.raises(RecordingError, match="loopback"):
            UdpOutput(address)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"form": None}, "expected one of --input"),
        ({"quantity": None}, "expected --quantity"),
        ({"channels": ()}, "--channels with 6 columns"),
        ({"channels": ("foot=" + CHANNELS,)}, "once per sensor"),
        ({"channels": ("a,b,c,d,e,state.O_F_ext_hat_K[5]",)}, "along the axes of the base; take --replay"),
        (
            {"channels": (",".join(f"actual_TCP_force_{k}" for k in range(6)),)},
            "along the axes of the base; take --replay",
        ),
        ({"stamp": "t"}, "COLUMN:UNIT"),
        ({"envelope": True}, "--envelope: not of"),
        ({"speed": 0.0}, "--speed: not of --input csv"),
        ({"ati_force": "1 N"}, "--ati-force: not of --input csv"),
        ({"ati_port": 1}, "--ati-port: not of --input csv"),
        ({"random_walk": "1,1"}, "--random-walk: not of --offset fitted"),
        ({"with_temperature": True, "offset": OffsetSource.TARE}, "--with-temperature: not of --offset tare"),
        ({"tare_s": 2.0}, "--tare-s: not of --offset fitted"),
        ({"tool_mass_kg": 1.0, "tool_centre_m": "0,0,0", "gravity": "x,y,z"}, "without --take-tool-off"),
        ({"rate_hz": 0.0}, "--rate: expected a number above 0"),
        ({"ati_port": 70_000}, "--ati-port: expected a port"),
        ({"stamp": None, "rate_hz": 100.0}, "expected --stamp too"),
        ({"frame": ("child",)}, "--frame: not of --quantity raw"),
        ({"quantity": HeldQuantity.WRENCH}, "expected --frame child, .* child_to_parent, .* got none"),
        ({"quantity": HeldQuantity.WRENCH, "frame": ("base",)}, "expected --frame child, .* got base"),
        ({"form": Input.ROS2_CSV, "quantity": HeldQuantity.WRENCH, **NO_TABLE}, "expected --frame, the frame_id"),
        ({"channels": ("c1,c2,c3,c4,c5,c1",)}, "expected every column once, got 'c1' 2 times"),
        ({"channels": ("fx [N],c2,c3,c4,c5,c6",)}, "--channels fx .N.: expected counts, got .* unit N"),
        ({"stamp": "t_ms:s"}, "--stamp t_ms: expected s, got a heading with the unit ms"),
        ({"form": None, "ati": "127.0.0.1"}, "--channels: not of --ati"),
        ({"variables": ("temperature=T",)}, "SENSOR.]NAME=COLUMN"),
        ({"tool_mass_kg": 1.0}, "both --tool-mass and --tool-centre"),
        ({"tool_mass_kg": 1.0, "tool_centre_m": "0,0,0"}, "needs --gravity"),
        ({"tool_mass_kg": 1.0, "tool_centre_m": "0,0"}, "3 numbers"),
        ({"form": Input.YARP}, "--channels: not of"),
        ({"form": Input.ROS2_CSV}, "--quantity wrench"),
        ({"sequence": "n:1"}, "--sequence: expected COLUMN"),
        ({"sequence": ":5"}, "--sequence: expected COLUMN"),
        ({"sequence": ""}, "--sequence: expected COLUMN"),
        ({"channels": ("ch1 [mV],c2,c3,c4,c5,c6",)}, "--channels ch1 .mV.: expected counts, got .* unit mV"),
        ({"channels": ("c1_V,c2,c3,c4,c5,c6",)}, "--channels c1_V: expected counts, got .* unit V"),
        ({"stamp": "t [min]:s"}, "--stamp t .min.: expected s, got .* unit min"),
        ({"tool_mass_kg": 1.0, "tool_centre_m": "0,0,0", "take_tool_off": True, "gravity": "x,y,z [mm/s2]"}, "mm/s2"),
        ({"form": Input.YARP_MEASURES, "channels": (), "stamp": None, "sequence": None}, "expected --index"),
    ],
)
def test_nothing_is_guessed(changed: dict[str, Any], message: str) -> None:
    """What is needed and not stated, or stated and not needed, is refused by name."""
    settings = Settings(**(TABLE | changed))
    with pytest.raises(RecordingError, match=message.replace("[", "[[]")):
        make_run(settings, [make_calibration()], descriptor=0, warn=lambda _: None)


def test_units_of_headings_and_gravity_are_those_of_the_options() -> None:
    """Of wrenches N and N m; free fall in g, and none at all, make lines unreadable."""
    own = {"quantity": HeldQuantity.WRENCH, "frame": ("child",), "channels": ("fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz [N mm]",)}
    with pytest.raises(RecordingError, match=r"--channels tz \[N mm\]: expected N m, got .* unit N mm"):
        _run("", Settings(**TABLE | own))
    own |= {"channels": ("fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz",), "gravity": "gx,gy,gz"}
    lines = [_line(k, k, [1.0] * 6)[:-1] + f",0,0,{g}\n" for k, g in enumerate((-9.81, -1.0, 0.0, 9700, math.nan))]
    heading = "n,t,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz,gx,gy,gz\n"
    tool = {"tool_mass_kg": 1.0, "tool_centre_m": "0,0,0", "take_tool_off": True}
    result, rows = _run(heading + "".join(lines), Settings(**TABLE | own | tool))
    assert (result.packets.unreadable, [row.status for row in rows]) == (3, [0, Status.NOT_FINITE])


@pytest.mark.parametrize("moment", ["tz [mN m]", "tz (mNm)", "tz [kN m]", "tz [lbf in]", "tz_mNm", "tz [N]", "tz_kNm"])
def test_units_that_are_not_known_are_other_units(moment: str) -> None:
    """A bracket or an ending that is no spelling of N m is never taken for it."""
    own = {"quantity": HeldQuantity.WRENCH, "frame": ("child",), "channels": (f"fx,fy,fz,tx,ty,{moment}",)}
    with pytest.raises(RecordingError, match=r"--channels tz.*: expected N m, got a heading with the unit"):
        _run("", Settings(**TABLE | own))


@pytest.mark.parametrize("columns", ["fx [N],fy_N,f[2],tx [N·m],ty (Nm),wrench_z"])
def test_units_as_expected_and_places_in_arrays_are_taken(columns: str) -> None:
    """However they are written."""
    own = {"quantity": HeldQuantity.WRENCH, "frame": ("child",), "channels": (columns,)}
    result, _ = _run(f"n,t,{columns}\n" + _line(0, 0.0, [1.0] * 6), Settings(**TABLE | own))
    assert (result.packets.received, result.packets.unreadable) == (1, 0)


@pytest.mark.parametrize(("sequence", "unreadable"), [("n:4294967296", 1), ("n", 1), ("n:4294967297", 0)])
def test_a_number_beyond_the_count_is_unreadable(sequence: str, unreadable: int) -> None:
    """The default may be stated."""
    lines = f"n,t,{CHANNELS}\n" + _line((1 << 32) - 1, 0.0, [1.0] * 6) + _line(1 << 32, 0.1, [1.0] * 6)
    result, _ = _run(lines, Settings(**TABLE | {"sequence": sequence}))
    assert (result.packets.unreadable, result.packets.received) == (unreadable, 2 - unreadable)


def test_a_heading_must_have_the_columns() -> None:
    """A name that is not there ends the run."""
    with pytest.raises(RecordingError, match="one column 't'"):
        _run("n,time," + CHANNELS + "\n", Settings(**TABLE))


@pytest.mark.parametrize(
    ("stated", "named"),
    [({}, "second day"), ({"session": "first day"}, "first day"), ({"offset": OffsetSource.TARE}, None)],
)
def test_the_power_cycle_of_an_offset_is_in_the_account(stated: dict[str, Any], named: str | None) -> None:
    """Without a statement it is the last one; a tare has none."""
    days = [
        SessionOffset(name=f"{day} day", offset=OFFSET, standard_error=None, prior_offset=None)
        for day in ("first", "second")
    ]
    calibration = make_calibration().model_copy(update={"sessions": tuple(days)})
    source, correctors = make_run(Settings(**TABLE | stated), [calibration], descriptor=0, warn=lambda _: None)
    result = LiveLoop(source, correctors, [], clock=time.monotonic).result("end of input")
    assert result.sensors[0].power_cycle == named
    assert [text for text in next(result.answers()).why if "Offset: " in text] == (
        [f"Offset: as it was in power cycle {named!r} of the calibration."] if named else []
    )


def test_options_of_tracking_are_read() -> None:
    """Numbers between commas."""
    given = make_run(
        Settings(**TABLE, offset=OffsetSource.TRACKED, random_walk="2,0.1", tracking_noise="0.3,0.01"),
        [make_calibration()],
        descriptor=0,
        warn=lambda _: None,
    )[1][0].options.tracking
    assert (given.random_walk_N, given.random_walk_Nm, given.noise_N, given.noise_Nm) == (2.0, 0.1, 0.3, 0.01)
    assert CorrectorOptions().tracking.random_walk_N == 1.0

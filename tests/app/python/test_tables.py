# SPDX-License-Identifier: BSD-3-Clause
"""Several sensors, loads, an IMU and sessions from arrays: the tables of the file, with the numbers of the file."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from forcetorque.app.python.experiment import Experiment, load_experiment
from forcetorque.app.python.experiment_of_tables import experiment_of_tables, stream_of_arrays
from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, ShapeError, UnitError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import write_recording
from forcetorque.recording.stream import Signal, Stream
from tests.scenes.experiment_folders import arm, intact
from tests.scenes.experiments import JOINTS, TWO

__all__ = ["arm", "intact"]

LOADS = """
[[load]]
name = "tool"
link = "hand"
mass_kg = 0.4
centre_of_mass_m = [0.0, 0.01, -0.05]

[[load]]
name = "nothing"
link = "hand"
mass_kg = 0.0

[calibration]
accuracy = { force_N = 0.2, moment_Nm = 0.02 }
"""


def tables_of(experiment: Experiment) -> dict[str, Any]:
    """Tables of the file with the arrays of its log, robot and prior matrices."""
    tables = tomllib.loads(experiment.file.read_text(encoding="utf-8"))
    streams = [_stream(stream, experiment.recording.start_ns) for stream in experiment.recording.streams.values()]
    tables["robot"]["urdf"] = experiment.model
    for table, sensor in zip(tables["sensor"], experiment.sensors, strict=True):
        for key in ("joint", "measure_direction"):  # the model has a tag for it by now
            table.pop(key, None)
        table["prior"] = sensor.prior
    return tables | {"recording": {"stream": streams}}


def _stream(stream: Stream, start_ns: int) -> dict[str, Any]:
    named = {
        key: dict(zip(signal.columns, signal.values.T, strict=True)) if key == "position" else signal.values
        for key, signal in stream.signals.items()
        if signal.units != ("0 or 1",)  # flags of a converter, which files of arrays do not have
    }
    frame = next((signal.frame for signal in stream.signals.values() if signal.frame is not None), None)
    return stream_of_arrays(stream.name, (stream.stamp_ns - start_ns) * 1e-9, frame=frame, **named)


@pytest.fixture
def two(arm: Path) -> Path:
    """File of two sensors, a load that changes, and two sessions."""
    text = (arm / TWO).read_text(encoding="utf-8") + LOADS
    text = text.replace('label = "fit"', 'label = "fit"\nload = "tool"\nsession = "monday"')
    text = text.replace('label = "judge"', 'label = "judge"\nload = "nothing"\nsession = "tuesday"')
    (arm / "loaded.toml").write_text(text, encoding="utf-8")
    return arm / "loaded.toml"


@pytest.fixture
def moving(arm: Path) -> Path:
    """File of a base whose motion an IMU tells: it is tilted."""
    recording = load_experiment(arm / TWO).recording
    joints = recording.stream("joints")
    count = len(joints.stamp_ns)
    falls = np.tile(STANDARD_GRAVITY * np.array([0.28, 0.0, 0.96]), (count, 1))
    axes = ("x", "y", "z")
    signals = {
        "proper_acceleration": Signal(
            quantity="proper_acceleration", values=falls, columns=axes, units=("m/s2",) * 3, frame="base"
        ),
        "angular_velocity": Signal(
            quantity="angular_velocity", values=np.zeros((count, 3)), columns=axes, units=("rad/s",) * 3, frame="base"
        ),
    }
    imu = Stream(name="imu", clock=joints.clock, stamp_ns=joints.stamp_ns, signals=signals)
    write_recording(arm / "tilted", Recording(streams={**recording.streams, "imu": imu}))
    text = (arm / TWO).read_text(encoding="utf-8")
    text = text.replace('path = "recording"', 'path = "tilted"')
    text = text.replace("gravity_direction = [0.0, 0.0, -1.0]", 'imu = ["imu"]')
    (arm / "tilted.toml").write_text(text, encoding="utf-8")
    return arm / "tilted.toml"


def _same_numbers(file: Experiment, arrays: Experiment, sensor: str, label: str) -> None:
    (_, expected), (_, same) = (one[sensor].expected_wrenches(label) for one in (file, arrays))
    assert np.abs(expected).max() > 1.0
    np.testing.assert_allclose(same, expected, atol=1e-6)  # instants are rounded to 1 ns


def test_two_sensors_with_loads_and_sessions_give_what_the_file_gives(two: Path) -> None:
    """Expected wrenches under every load, the fitted matrix with accuracy and sessions; control: without the load."""
    file = load_experiment(two)
    arrays = experiment_of_tables(tables_of(file))
    assert list(arrays) == list(file) == ["arm_ft", "tool_ft"]
    for label in ("fit", "judge"):
        _same_numbers(file, arrays, "arm_ft", label)
    assert [role.session for role in arrays.roles.values()] == ["monday", "tuesday"]
    fitted, same = (one["arm_ft"].calibrate(kind="OnTdTO", regularisation=0.0) for one in (file, arrays))
    np.testing.assert_allclose(same.matrix, fitted.matrix, rtol=1e-6, atol=1e-9)
    np.testing.assert_array_equal(arrays.fit_options.accuracy, [0.2] * 3 + [0.02] * 3)
    bare = tables_of(file)
    bare["load"] = [load | {"mass_kg": 0.0} for load in bare["load"]]
    with pytest.raises(AssertionError):
        _same_numbers(file, experiment_of_tables(bare), "arm_ft", "fit")


def test_positions_of_unknown_joints_are_named(two: Path) -> None:
    """When the experiment is made, not when its expected wrenches are."""
    tables = tables_of(load_experiment(two))
    (joints,) = (stream for stream in tables["recording"]["stream"] if stream["name"] == "joints")
    (position,) = joints["signal"]
    position["names"] = [*JOINTS[:-1], "wirst"]
    with pytest.raises(ExperimentError, match="stream 'joints': position: expected names of joints of .*, got wirst"):
        experiment_of_tables(tables)


def test_an_imu_gives_what_the_file_gives(moving: Path) -> None:
    """A tilted base weighs the limb along other axes."""
    file = load_experiment(moving)
    arrays = experiment_of_tables(tables_of(file))
    for sensor in ("arm_ft", "tool_ft"):
        _same_numbers(file, arrays, sensor, "judge")
    level = load_experiment(moving.parent / TWO)
    with pytest.raises(AssertionError):
        _same_numbers(level, arrays, "arm_ft", "judge")


def test_tables_may_name_files_beside_arrays(two: Path) -> None:
    """Robot, prior and log of files, which are inputs then; numbers of NumPy and tuples are numbers and lists."""
    named = experiment_of_tables(tomllib.loads(two.read_text(encoding="utf-8")), folder=two.parent)
    assert {"arm.urdf", "matrix_SIM001.txt"} < named.inputs_sha256.keys()
    tables = tables_of(load_experiment(two))
    tables["robot"]["urdf"] = "arm.urdf"
    tables["sensor"] = [tables["sensor"][0] | {"full_scale": np.array([900, 900, 900, 30, 30, 30])}]
    tables["support"] = ({"frame": "base", "gravity_direction": np.array([0, 0, -1])},)
    arrays = experiment_of_tables(tables, folder=two.parent)
    assert arrays.inputs_sha256.keys() == {"arm.urdf"}
    np.testing.assert_array_equal(arrays.sensors[0].full_scale, [900.0] * 3 + [30.0] * 3)


def _without(tables: dict[str, Any], table: str, key: str) -> dict[str, Any]:
    return tables | {table: [{name: value for name, value in tables[table][0].items() if name != key}]}


def _stream_with(tables: dict[str, Any], **changes: Any) -> dict[str, Any]:
    first, *others = tables["recording"]["stream"]
    return tables | {"recording": {"stream": [first | changes, *others]}}


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (lambda t: _without(t, "sensor", "serial"), FormatError, r"sensor\[0\].serial: expected this key"),
        (lambda t: t | {"suport": []}, FormatError, "unknown key 'suport'; did you mean"),
        (lambda t: t | {"sensor": []}, FormatError, "sensor: "),
        (lambda t: _stream_with(t, variable="counts"), ExperimentError, r"stream\[0\].variable: expected an array"),
        (lambda t: _stream_with(t, variable=np.zeros((2, 2, 2))), ExperimentError, "expected rows of numbers"),
        (lambda t: _stream_with(t, time={"unit": "min"}), FormatError, r"recording.stream\[0\].time.unit"),
        (
            lambda t: t | {"sensor": [t["sensor"][0] | {"prior": np.ones((3, 6))}]},
            ShapeError,
            r"sensor\[0\].prior: expected an array of shape \(6",
        ),
    ],
)
def test_tables_that_do_not_fit_are_refused(
    two: Path, change: Callable[[dict[str, Any]], dict[str, Any]], error: type[Exception], message: str
) -> None:
    """In one line, by the place of the key."""
    with pytest.raises(error, match=message) as refused:
        experiment_of_tables(change(tables_of(load_experiment(two))))
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 700


def test_a_stream_states_units_and_names() -> None:
    """SI units where none is given; a frame of pandas names its columns; one column may be a vector."""
    time = np.arange(4) * 0.1
    frame = pd.DataFrame(np.zeros((4, 2)), columns=["hip", "rail"])
    table = stream_of_arrays("joints", time, position=frame, units={"position": ["deg", "mm"]}, torque=frame)
    position, torque = table["signal"]
    assert (position["names"], position["unit"], position["columns"]) == (["hip", "rail"], ["deg", "mm"], [1, 2])
    assert (torque["names"], torque["unit"]) == (["hip", "rail"], "N m")
    wrench = stream_of_arrays("ft", time, frame="tool", wrench=np.zeros((4, 6)))["signal"][0]
    assert (wrench["unit"], wrench["frame"]) == (["N", "N", "N", "N m", "N m", "N m"], "tool")
    assert stream_of_arrays("t", time, temperature=np.zeros(4))["signal"][0]["variable"].shape == (4, 1)


@pytest.mark.parametrize(
    ("quantities", "error", "message"),
    [
        ({}, ExperimentError, "stream 'arm': expected a quantity, such as raw=counts, got none"),
        ({"row": np.zeros((3, 6))}, ExperimentError, "no quantity is called 'row'; did you mean \"raw\""),
        ({"raw": np.zeros((4, 6))}, ShapeError, r"stream 'arm': raw: expected an array of shape \(3, n\)"),
        ({"raw": "counts"}, ExperimentError, "stream 'arm': raw: expected numbers, got 'counts'"),
        ({"wrench": np.zeros((3, 5))}, ShapeError, r"stream 'arm': wrench: expected an array of shape \(3, 6\)"),
        (
            {"position": {"hip": np.zeros(3)}, "units": {"postion": "deg"}},
            ExperimentError,
            "stream 'arm': units: 'postion' is not given; did you mean \"position\"",
        ),
        ({"position": {}}, ExperimentError, "position: expected columns by name, got none"),
        (
            {"wrench": pd.DataFrame(np.zeros((3, 6)), columns=["tx", "ty", "tz", "fx", "fy", "fz"])},
            ExperimentError,
            "in this order, got tx, ty, tz, fx, fy, fz",
        ),
    ],
)
def test_a_stream_that_does_not_fit_is_refused(
    quantities: dict[str, Any], error: type[ForceTorqueError], message: str
) -> None:
    """Before any table names it."""
    with pytest.raises(error, match=message):
        stream_of_arrays("arm", np.arange(3.0), **quantities)


def test_a_unit_of_another_quantity_is_refused(two: Path) -> None:
    """Newtons are no counts."""
    file = load_experiment(two)
    tables = tables_of(file)
    streams = {stream["name"]: stream for stream in tables["recording"]["stream"]}
    (signal,) = streams["arm_ft"]["signal"]
    streams["arm_ft"] |= {"signal": [signal | {"unit": "N"}]}
    with pytest.raises(UnitError, match="expected a unit of raw that converts to counts"):
        experiment_of_tables(tables | {"recording": {"stream": list(streams.values())}})


def test_positions_are_those_of_all_joints(two: Path) -> None:
    """What the tables leave out is named as in a file."""
    file = load_experiment(two)
    joints = file.recording.stream("joints")
    shorter = replace(
        joints.signals["position"], values=joints.signals["position"].values[:, :-1], columns=JOINTS[:-1],
        units=("rad",) * (len(JOINTS) - 1),
    )  # fmt: skip
    stream = Stream(name="joints", clock="a", stamp_ns=joints.stamp_ns, signals={"position": shorter})
    tables = tables_of(file)
    streams = [one for one in tables["recording"]["stream"] if one["name"] != "joints"]
    tables["recording"] = {"stream": [*streams, _stream(stream, file.recording.start_ns)]}
    with pytest.raises(ForceTorqueError, match=f"joint '{JOINTS[-1]}'"):
        experiment_of_tables(tables)["arm_ft"].expected_wrenches("fit")

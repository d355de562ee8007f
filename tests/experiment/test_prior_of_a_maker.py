# SPDX-License-Identifier: BSD-3-Clause
"""A sensor with the file that its maker sent: its counts are read and calibrated, or refused where units differ."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import encode_matrix
from forcetorque.formats.prior.firmware_updater import FirmwareFile
from forcetorque.formats.prior.matrix_files import PolynomialModel
from forcetorque.formats.prior.registry import read_prior_file
from tests.cases import some_cases
from tests.formats.prior.written import write_firmware_file, write_polynomial_model
from tests.scenes.tutorial_log import distortion, motion, robot_text, truth

VOLTS_PER_COUNT = 20.0 / 65536.0
"""A converter of 16 bits over both signs of 10 V."""
OFFSET_V = np.array([0.4, -0.3, 0.1, 0.2, -0.5, 0.3])
"""What the gauges have without load."""
LIGHT = 0.1
"""Part of the arm's weight that the smallest of the sensors can carry: its full scale is 1 N m."""

FILE = """schema = "forcetorque/experiment/1"
name = "gauges"
robot = {{ urdf = "robot.urdf" }}

[recording]
format = "tabular"
path = "."

[[recording.stream]]
name = "log"
file = "log.csv"
stamp = {{ column = "t", unit = "s" }}
signal = [
  {{ quantity = "position", columns = {joints}, units = {units} }},
  {{ quantity = "raw", columns = {channels}, units = {counts} }},
]

[[sensor]]
name = "wrist"
stream = "log"
serial = "{serial}"
prior = {prior}
joint = "arm_ft_joint"
measure_direction = "child_to_parent"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "fit"
start_s = 0.0
end_s = 23.5
use = "calibration"
support = "base"

[[interval]]
label = "judge"
start_s = 32.0
use = "validation"
support = "base"
"""


def _written(folder: Path, matrix: np.ndarray, prior: str, serial: str, *, weight: float = 1.0) -> Path:
    """The tutorial's arm, or one of a part of its weight, whose sensor gives counts that `matrix` makes wrenches of."""
    time, joints = motion()
    names = [f"q{k}" for k in range(len(joints.names))]
    channels = [f"g{k}" for k in range(6)]
    noise = np.random.default_rng(2).normal(0.0, 1.0, (len(time), 6))
    counts = np.rint(weight * truth() @ np.linalg.inv(matrix).T + OFFSET_V / VOLTS_PER_COUNT + noise)
    rows = np.column_stack([time, joints.position, counts])
    heading = ",".join(["t", *names, *channels])
    np.savetxt(folder / "log.csv", rows, delimiter=",", header=heading, comments="", fmt="%.6g")
    (folder / "robot.urdf").write_text(_of_weight(robot_text(), weight), encoding="utf-8")
    text = FILE.format(
        joints=[*names],
        units=["rad"] * len(names),
        channels=channels,
        counts=["counts"] * 6,
        prior=prior,
        serial=serial,
    )
    text = text.replace(f"columns = {names}", f"columns = {names}, names = {list(joints.names)}").replace("'", '"')
    (folder / "experiment.toml").write_text(text, encoding="utf-8")
    return folder / "experiment.toml"


def _of_weight(urdf: str, part: float) -> str:
    return re.sub(r'\b(value|i[xyz]{2})="([^"]*)"', lambda number: f'{number[1]}="{part * float(number[2])!r}"', urdf)


def _judged(file: Path) -> tuple[float, float]:
    """Mean force error of the prior and of a calibration, on what was not fitted."""
    run = SensorRun(load_experiment(file), "wrist")
    calibration = calibrate_sensor(run, code_version="0", created="2026-01-01T00:00:00+00:00")
    verdicts = evaluate(run, {"new": calibration}).verdicts
    errors = {row.calibration: row.force_error_mean_N for row in verdicts if row.offset == "judged-mean"}
    return errors["prior"], errors["new"]


@pytest.mark.real_data
@some_cases(("name", "serial"), [("FT35366.cal", "FT35366"), ("FT11712.cal", "FT11712")])
def test_an_ati_file_is_the_prior_of_gauges(data_dir: Path, tmp_path: Path, name: str, serial: str) -> None:
    """Its volts become counts; a sensor that is 3 % off is calibrated from there, and its full scale is the maker's."""
    (tmp_path / name).write_bytes((data_dir / "ati_cal" / name).read_bytes())
    made = read_prior_file(tmp_path / name)
    prior = f'{{ path = "{name}", volts_per_count = {VOLTS_PER_COUNT!r} }}'
    file = _written(tmp_path, distortion() @ made.matrix * VOLTS_PER_COUNT, prior, serial, weight=LIGHT)
    sensor = load_experiment(file).sensors[0]
    assert sensor.prior is not None
    assert sensor.full_scale is not None
    assert made.full_scale is not None
    np.testing.assert_allclose(sensor.prior, made.matrix * VOLTS_PER_COUNT)
    np.testing.assert_allclose(sensor.full_scale, made.full_scale)
    before, after = _judged(file)
    assert after < 0.2 * before


def _board(folder: Path) -> tuple[str, np.ndarray]:
    matrix = encode_matrix(np.random.default_rng(6).normal(0, 1, (6, 6)) * np.repeat([2e-2, 8e-4], 3)[:, None])
    registers = ("0x00 0x80 0x02 0x64 0x29 0x62",) * 6
    write_firmware_file(
        folder / "board.dat", FirmwareFile(serial="SN7", matrix=matrix, tare=(0,) * 6, registers=registers)
    )
    return "board.dat", matrix.matrix


def test_a_board_file_and_a_plain_table_are_priors(tmp_path: Path) -> None:
    """Both are per count; moments of a table in N mm become N m."""
    name, matrix = _board(tmp_path)
    scaled = matrix * np.repeat([1.0, 1e3], 3)[:, None]
    np.savetxt(tmp_path / "plain.csv", scaled, delimiter=",")
    file = _written(tmp_path, matrix, f'"{name}"', "SN7")
    np.testing.assert_array_equal(load_experiment(file).sensors[0].prior, matrix)
    table = '{ path = "plain.csv", force_unit = "N", moment_unit = "N mm" }'
    file.write_text(file.read_text(encoding="utf-8").replace(f'"{name}"', table), encoding="utf-8")
    sensor = load_experiment(file).sensors[0]
    np.testing.assert_allclose(sensor.prior, matrix)
    assert (sensor.prior_source, sensor.full_scale) == ("plain.csv", None)


@pytest.mark.parametrize(
    ("prior", "serial", "words"),
    [
        ('"board.dat"', "SN8", "expected the prior matrix of the sensor 'SN8', got that of 'SN7'"),
        ('{ path = "board.dat", volts_per_count = 1.0 }', "SN7", "expected no volts_per_count: FirmwareUpdater file"),
        ('{ path = "board.dat", force_unit = "N" }', "SN7", "expected no force_unit nor moment_unit"),
        ('"ati.cal"', "FT7", r"expected volts_per_count, for ATI calibration 1.0 of Gamma SI-65-5 is per volt"),
        (
            '"model.xml"',
            "SN7",
            'expected a matrix that takes counts, got model file of Mohamed 2023.*prior = "identity"',
        ),
        ('"robot.urdf"', "SN7", "expected a calibration: .*; got XML with the root 'robot'"),
        ('{ path = "board.dat", gain = 2 }', "SN7", "unknown key 'gain'"),
    ],
)
def test_what_is_no_prior_of_counts_is_refused(tmp_path: Path, prior: str, serial: str, words: str) -> None:
    """With the table of the experiment file, what was expected, and what to write."""
    from tests.formats.prior.test_prior_files import ati_text

    _, matrix = _board(tmp_path)
    (tmp_path / "ati.cal").write_text(ati_text(), encoding="utf-8")
    write_polynomial_model(tmp_path / "model.xml", PolynomialModel(matrix=np.eye(6), offset=np.zeros(6)))
    file = _written(tmp_path, matrix, prior, serial)
    with pytest.raises(ForceTorqueError, match=words) as error:
        load_experiment(file)
    assert re.search(r"experiment\.toml: sensor\[0\]", str(error.value))
    assert isinstance(error.value, ExperimentError | ValueError)

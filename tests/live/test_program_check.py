# SPDX-License-Identifier: BSD-3-Clause
"""Programs of robots that are given what this library wrote do what the corrector does; other files are noticed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.export.wholebodydynamics import from_calibration, write_groups
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior, RowNoise
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import HeldQuantity, Input, OffsetSource
from forcetorque.live.program_check import program_checks
from forcetorque.live.result import LiveRun
from forcetorque.live.run_from_settings import make_run
from forcetorque.live.settings import Settings
from forcetorque.payload.export.export import export_load
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import RobotLoad
from forcetorque.results.answer import Concern
from tests.scenes.calibrations import make_calibration, make_variable

DIGITS = 1e-6
"""Of files with nine digits, at wrenches of up to 1e3 N."""
POSE = (0.01, -0.02, 0.03, 0.4, -0.3, 2.0)
COLUMNS = "t,c1,c2,c3,c4,c5,c6,T,gx,gy,gz"


def _with_posterior(calibration: Calibration) -> Calibration:
    """Every coefficient is off by 1e-4."""
    covariance = np.broadcast_to(np.diag([1e-8] * 6 + [0.0025]), (6, 7, 7))
    posterior = Posterior(
        space="wrench", variables=(), sessions=("first",), drift=False, mean=np.zeros((6, 7)), covariance=covariance,
        mean_covariance=covariance[:, :6, :6], prior_covariance=None, to_wrench=np.eye(6), accuracy=np.zeros(6),
        noise=(RowNoise(white=0.01, time_constant_s=0.0, ratio=0.0),) * 6, repeatability=0.0, load_centre=np.zeros(6),
    )  # fmt: skip
    return calibration.model_copy(update={"posterior": posterior})


def _stream(count: int = 40) -> str:
    """Raw samples, temperatures and gravity in changing postures."""
    rng = np.random.default_rng(4)
    raw, warm, down = rng.normal(0.0, 500.0, (count, 6)), rng.uniform(20.0, 45.0, count), rng.normal(size=(count, 3))
    down *= 9.80665 / np.linalg.norm(down, axis=1)[:, None]
    rows = np.column_stack([np.arange(count) * 0.01, raw, warm, down])
    return "\n".join([COLUMNS, *(",".join(map(repr, row)) for row in rows.tolist())]) + "\n"


def _run(
    calibration: Calibration,
    checks: list[str],
    pose: Any = None,
    text: str = "",
    **stated: Any,
) -> LiveRun:
    settings = Settings(
        form=Input.CSV, quantity=HeldQuantity.RAW, channels=("c1,c2,c3,c4,c5,c6",), stamp="t:s",
        variables=("temperature=T",) if calibration.variables else (), **stated,
    )  # fmt: skip
    with TemporaryFile() as file:
        file.write((text or _stream()).encode())
        file.seek(0)
        source, correctors = make_run(settings, [calibration], descriptor=file.fileno(), warn=lambda _: None)
        programs = program_checks(checks, correctors, sensor_pose=pose)
        loop = LiveLoop(source, correctors, [], clock=lambda: 0.0, checks=programs)
        return loop.result(loop.run())


def test_wholebodydynamics_corrects_as_the_calibration(tmp_path: Path) -> None:
    """With temperature and secondary matrix; an offset of the other sign is seen, with how many samples it spoils."""
    calibration = make_calibration(variables=(make_variable(),))
    correction, file = from_calibration(calibration), tmp_path / "wbd.xml"
    write_groups(file, [correction])
    check = _run(calibration, [f"wholebodydynamics={file}"]).checks[0]
    assert (check.samples, check.outside) == (40, None)
    assert check.force_difference_N < DIGITS
    assert check.moment_difference_Nm < DIGITS
    plain = _with_posterior(make_calibration())
    correction = from_calibration(plain)
    write_groups(file, [correction])
    result = _run(plain, [f"wholebodydynamics={file}"])
    assert (result.checks[0].samples, result.checks[0].outside) == (40, 0)
    write_groups(file, [replace(correction, offset=-correction.offset)])
    result = _run(plain, [f"wholebodydynamics={file}"])
    (check,) = result.checks
    assert check.force_difference_N == pytest.approx(2.0 * np.abs(plain.offset[:3]).max(), rel=1e-6)
    assert check.outside == 40
    # of a load of up to 30 N with a relative error of 1e-4
    assert 1e-4 < check.force_half_width_95_N < NORMAL_95 * 30e-4
    answer = next(result.answers())
    assert "40 of 40 samples beyond the interval" in " ".join(answer.why)
    assert "wbd.xml" in answer.step
    without = _run(make_calibration(), [f"wholebodydynamics={file}"])
    assert (without.checks[0].samples, without.checks[0].outside) == (40, None)
    answer = next(without.answers())
    assert answer.concern is Concern.UNCERTAIN
    assert "in 40 samples; no interval to judge by" in " ".join(answer.why)


def _of_sensor(load: RobotLoad, path: Path, form: LoadFormat) -> str:
    pose = make_pose(rotation_from_rpy(POSE[3:]), POSE[:3])
    export_load(load, path, form, world_frame="world", body_H_sensor=pose, force=True)
    return f"{form}={path}"


TOOL: dict[str, Any] = {
    "tool_mass_kg": 0.8, "tool_centre_m": "0.01,-0.02,0.05", "take_tool_off": True, "gravity": "gx,gy,gz",
}  # fmt: skip
TAKEN_OFF = CorrectorOptions(tool=Tool(mass_kg=0.8, centre_m=np.zeros(3)), take_tool_off=True)
CHANGES: dict[str, Callable[[str], str]] = {
    "gravity-filter": lambda text: text.replace("[0.0, 0.0, ", "[0.0, 0.0, -").replace("--", ""),
    "ur": lambda text: text.replace("(0.8,", "(0.9,"),
    "franka": lambda text: text.replace("(0.8,", "(0.9,"),
    "kuka": lambda text: text.replace("{M 0.8", "{M 0.9"),
}
"""A mistake in each file."""


@pytest.mark.parametrize("direction", MeasureDirection)
@pytest.mark.parametrize("form", ["gravity-filter", "ur", "franka", "kuka"])
def test_loads_are_taken_off_as_the_tool(tmp_path: Path, form: str, direction: MeasureDirection) -> None:
    """In every posture, through the pose in the flange; a mistake in the file is seen in newtons."""
    calibration = _with_posterior(make_calibration())
    sensor = calibration.sensor.model_copy(update={"measure_direction": direction})
    calibration = calibration.model_copy(update={"sensor": sensor})
    load = RobotLoad(
        sensor="leg_ft", frame="ft", direction=direction, mass=0.8,
        centre_of_mass=np.array([0.01, -0.02, 0.05]), inertia=np.eye(3) * 0.01, bias=np.zeros(6),
    )  # fmt: skip
    path = tmp_path / "load"
    entry, pose = _of_sensor(load, path, LoadFormat(form)), None if form == "gravity-filter" else POSE
    check = _run(calibration, [entry], pose, **TOOL).checks[0]
    assert (check.samples, check.outside) == (40, 0)
    assert check.force_difference_N < DIGITS
    assert check.moment_difference_Nm < DIGITS
    text = path.read_text(encoding="utf-8")
    changed = CHANGES[form](text)
    assert changed != text
    path.write_text(changed, encoding="utf-8")
    check = _run(calibration, [entry], pose, **TOOL).checks[0]
    assert check.force_difference_N > 0.9
    assert check.outside > 30


def _filter_file(folder: Path) -> str:
    load = RobotLoad(
        sensor="leg_ft", frame="ft", direction=make_calibration().sensor.measure_direction, mass=1.8,
        centre_of_mass=np.array([0.01, -0.02, 0.05]), inertia=np.eye(3) * 0.01, bias=np.zeros(6),
    )  # fmt: skip
    return _of_sensor(load, folder / "filter.yaml", LoadFormat.GRAVITY_FILTER)


def test_samples_without_gravity_are_not_compared(tmp_path: Path) -> None:
    """Where it is zero or NaN; a file that is 1 kg off shows on the other samples; nothing else is claimed."""
    entry, calibration = _filter_file(tmp_path), _with_posterior(make_calibration())
    heading, *lines = _stream().splitlines()
    for value in ("0", "nan"):
        none = [",".join([*line.split(",")[:-3], *[value] * 3]) for line in lines]
        result = _run(calibration, [entry], text="\n".join([heading, *none]) + "\n", **TOOL)
        assert (result.checks[0].samples, result.checks[0].outside) == (0, None)
        answer = next(result.answers())
        assert "gravity-filter: no sample was compared" in " ".join(answer.why)
        assert (answer.concern, "gravity" in answer.step) == (Concern.UNCERTAIN, True)
        mixed = _run(calibration, [entry], text="\n".join([heading, *none[:20], *lines[20:]]) + "\n", **TOOL)
        assert mixed.checks[0].samples == 20 == mixed.checks[0].outside
        assert 1.0 < mixed.checks[0].force_difference_N < 9.81


def test_the_frame_of_a_filter_is_that_of_the_reading(tmp_path: Path) -> None:
    """Another one is refused; where none is stated, that it was not compared is said."""
    entry, (corrector,) = _filter_file(tmp_path), [Corrector(make_calibration(), TAKEN_OFF)]
    warnings: list[str] = []
    program_checks([entry], [corrector], sensor_pose=None, warn=warnings.append)
    assert "sensor_frame 'ft'" in warnings[0]
    program_checks([entry], [corrector], sensor_pose=None, frame="ft", warn=warnings.append)
    assert len(warnings) == 1
    with pytest.raises(ForceTorqueError, match="expected 'ft_link', as --frame states, got 'ft'"):
        program_checks([entry], [corrector], sensor_pose=None, frame="ft_link")


def test_every_sensor_is_in_a_file(tmp_path: Path) -> None:
    """One that no file has is named; a file for each is enough."""
    both, files = [make_calibration(), make_calibration(name="other")], [tmp_path / "a.xml", tmp_path / "b.xml"]
    for file, one in zip(files, both, strict=True):
        write_groups(file, [from_calibration(one)])
    entries, corrector = [f"wholebodydynamics={file}" for file in files], Corrector(both)
    assert len(program_checks(entries, [corrector], sensor_pose=None)) == 2
    with pytest.raises(ForceTorqueError, match="got none of other"):
        program_checks(entries[:1], [corrector], sensor_pose=None)


def test_what_a_check_needs_is_asked_for(tmp_path: Path) -> None:
    """Program, file, tool and pose, by name."""
    (tmp_path / "empty").write_text("", encoding="utf-8")
    calibration, file = make_calibration(), tmp_path / "empty"
    cases: list[tuple[list[str], dict[str, Any], Any, str]] = [
        (["abb=x"], {}, None, "PROGRAM=FILE"),
        ([str(file)], {}, None, "PROGRAM=FILE"),
        ([f"ur={file}"], {}, POSE, "--take-tool-off"),
        ([f"ur={file}"], TOOL, None, "--sensor-pose"),
        ([f"ur={file}"], TOOL, POSE, "one line as set_target_payload"),
        ([f"gravity-filter={file}"], TOOL, None, "GravityCompensationWrench"),
        ([], {}, POSE, "--sensor-pose"),
    ]
    for entries, stated, pose, message in cases:
        with pytest.raises(ForceTorqueError, match=message):
            _run(calibration, entries, pose, **stated)
    warm = tmp_path / "warm.xml"
    write_groups(warm, [from_calibration(make_calibration(variables=(make_variable(),)))])
    with pytest.raises(ForceTorqueError, match="FT_TEMPERATURE_COEFFICIENTS: expected a calibration with the variable"):
        program_checks([f"wholebodydynamics={warm}"], [Corrector(calibration)], sensor_pose=None)
    write_groups(warm, [from_calibration(calibration)])
    with pytest.raises(ForceTorqueError, match="expected --offset fitted, got tare"):
        _run(calibration, [f"wholebodydynamics={warm}"], offset=OffsetSource.TARE, tare_s=0.1)
    other = from_calibration(make_calibration(name="other"))
    write_groups(tmp_path / "wbd.xml", [other])
    with pytest.raises(ForceTorqueError, match="expected one of leg_ft, got other"):
        _run(calibration, [f"wholebodydynamics={tmp_path / 'wbd.xml'}"])

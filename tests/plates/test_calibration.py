# SPDX-License-Identifier: BSD-3-Clause
"""Calibration of simulated plates with a pole and with weights: truth recovered, and errors of new loads in mm."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, FormatError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.formats.c3d.force_platform import centre_of_pressure
from forcetorque.plates.applied_loads import AppliedLoads, loads_of_pole, loads_of_weights
from forcetorque.plates.plate_calibration import PLATE as PLATE_SETUP, calibrate_loads
from forcetorque.plates.plate_file import PlateFile, read_plates
from forcetorque.plates.result import PlateCalibration, save_cal_matrix
from forcetorque.plates.simulated_plates import SimulatedPlate, write_pole_trial, write_trial
from forcetorque.results.answer import MOST_LINES, Concern, answer_text
from tests.app.outcome import typed

POLE = {"tip": "pole_tip", "head": "pole_head", "load_cell": "load_cell"}
DIRECTION: Any = "parent_to_child"
PLATE = SimulatedPlate.draw(np.random.default_rng(3), crosstalk=0.02, corner_error_m=0.003)


def _loads(plates: PlateFile, **changes: str) -> AppliedLoads:
    return loads_of_pole(plates, plates.plate(None), **(POLE | changes), serial="FP1", measure_direction=DIRECTION)


def _calibrated(path: Path) -> PlateCalibration:
    plates = read_plates(path)
    return calibrate_loads(
        plates, plates.plate(None), _loads(plates), measure_direction=DIRECTION, code_version="0", created="2026-01-01"
    )


@pytest.fixture(scope="module")
def fitted(tmp_path_factory: pytest.TempPathFactory) -> PlateCalibration:
    """A plate with 2 % cross-talk and corners that are 3 mm off, calibrated with 40 pushes of a pole."""
    path = tmp_path_factory.mktemp("plate") / "pole.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(4))
    return _calibrated(path)


def _centre_errors(calibration: PlateCalibration, folder: Path) -> tuple[float, float]:
    """Of pushes that are not fitted, before and after; root mean square, mm."""
    path = folder / "new.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(99), pushes=20)
    new = _loads(read_plates(path))
    before, after = (
        1e3 * (centre_of_pressure(wrench) - new.centre_m)
        for wrench in (
            new.bench.raw - PLATE.baseline,
            new.bench.raw @ calibration.calibration.matrix.T + calibration.calibration.offset,
        )
    )
    return tuple(float(np.sqrt((errors**2).sum(axis=1).mean())) for errors in (before, after))  # type: ignore[return-value]


def test_errors_of_new_pushes_fall_from_millimetres_to_the_noise(fitted: PlateCalibration, tmp_path: Path) -> None:
    """Of the centre of pressure in the laboratory; the result predicts both, before and after."""
    before, after = _centre_errors(fitted, tmp_path)
    assert before > 5.0
    assert after < 0.05  # mm: noise of 0.02 N m over 200 N, means of 600 samples, and of markers of 0.1 mm
    assert fitted.centre_before_mm == pytest.approx(before, rel=0.3)
    assert fitted.centre_after_mm == pytest.approx(after, rel=0.5)


def test_the_true_matrix_is_within_its_intervals(fitted: PlateCalibration) -> None:
    """Gains against the inverse of what the plate does, about its surface in the file."""
    surface_X_sensor = np.eye(6)
    depth = 0.04
    surface_X_sensor[3:, :3] = [[0.0, -depth, 0.0], [depth, 0.0, 0.0], [0.0, 0.0, 0.0]]
    inverse = surface_X_sensor @ np.linalg.solve(PLATE.distortion, np.linalg.inv(surface_X_sensor))
    shift = np.array([1.0, -1.0, -1.0]) * PLATE.corner_error_m  # along the axes of the plate
    moved = np.eye(6)  # about the centre of the file, which is shifted: moment - shift x force
    moved[3:, :3] = -np.array([[0.0, 0.0, shift[1]], [0.0, 0.0, -shift[0]], [-shift[1], shift[0], 0.0]])
    truth = moved @ inverse
    error = np.abs(fitted.calibration.matrix - truth) / fitted.calibration.matrix_standard_error
    assert (error < 1.96).mean() > 0.85
    assert error.max() < 4.5
    assert np.abs(fitted.calibration.matrix - inverse)[3:, 2].max() > 1e-3  # negative control: the corners are off
    for row in fitted.components:
        assert row.half_width_95 < 0.01


def test_the_answer_is_short_and_names_errors_before_and_after(fitted: PlateCalibration) -> None:
    """In at most twelve lines; the figure has both."""
    text = answer_text(list(fitted.answers()), 80)
    assert len(text.splitlines()) <= MOST_LINES
    assert f"CENTRE OF PRESSURE {fitted.centre_before_mm:.1f} mm -> 0.0" in text
    assert len(fitted.figure().axes) == 2


def test_cal_matrix_corrects_the_channels(fitted: PlateCalibration, tmp_path: Path) -> None:
    """A file of type 4 with it reads what the calibration gives."""
    path = tmp_path / "a.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(5), pushes=8)
    plates = read_plates(path)
    save_cal_matrix(fitted, tmp_path / "cal.csv")
    cal_matrix = np.loadtxt(tmp_path / "cal.csv", delimiter=",")
    channels = plates.file.analog[:, :6]
    sensor = channels @ cal_matrix.T * np.repeat([1.0, 1e-3], 3)
    origin = plates.plates[0].origin_m
    corrected = np.hstack([sensor[:, :3], sensor[:, 3:] + np.cross(sensor[:, :3], origin)])
    expected = plates.plates[0].wrench @ fitted.calibration.matrix.T
    np.testing.assert_allclose(corrected, expected, atol=1e-5)
    without = fitted.model_copy(update={"cal_matrix": None})
    with pytest.raises(ExperimentError, match="expected a plate of type 2 or 4"):
        save_cal_matrix(without, tmp_path / "none.csv")


@pytest.mark.real_data
def test_a_trial_of_another_writer_gives_its_true_matrix(data_dir: Path) -> None:
    """Without pauses between pushes; the matrix that undoes the distortion of the trial to 0.002, and before 0.075."""
    folder = data_dir / "c3d_plates"
    truth = np.array(json.loads((folder / "truth.json").read_text())["pole"]["inverse_is_the_PILS_matrix"])
    result = _calibrated(folder / "pole_trial.c3d")
    size = np.repeat([1.0, 200.0], 3)  # mm, so that forces and moments count alike
    error = np.abs(np.array(result.cal_matrix) - truth) * size / size[:, None]
    assert error.max() < 0.005
    assert (np.abs(np.eye(6) - truth) * size / size[:, None]).max() > 0.05
    assert result.centre_after_mm < 0.2 < 10.0 < result.centre_before_mm
    assert any("no pause without load" in text for text in result.warnings)


def _weighed(folder: Path, force: FloatArray, places: FloatArray) -> Path:
    seconds, rate = 1.0, 1000
    n = round(seconds * rate)
    points = PLATE.corners_m.mean(axis=0) + np.column_stack([places, np.zeros(len(places))]) * (1.0, -1.0, 1.0)
    rng = np.random.default_rng(6)
    exact = replace(PLATE, corner_error_m=np.zeros(3))
    down = np.repeat(np.column_stack([0 * force, 0 * force, -force]), n, axis=0)
    channels = exact.channels(down, np.repeat(points, n, axis=0), rng)
    path = folder / "weights.c3d"
    write_trial(path, [exact], channels, {"floor": np.zeros((len(channels) // 10, 3))})
    return path


def test_weights_at_known_places_correct_what_they_excite(tmp_path: Path) -> None:
    """Vertical forces alone: the other directions are named, and stay as measured."""
    x, y = (grid.ravel() for grid in np.meshgrid([-0.2, 0.0, 0.2], [-0.15, 0.0, 0.15]))
    places = np.vstack([np.column_stack([x, y])] * 2)
    mass = np.repeat([10.0, 25.0], len(x))
    path = _weighed(tmp_path, STANDARD_GRAVITY * mass, places)
    rows = [
        f"{k},{m},{a},{b},0,0,0,1,{k + 0.1},{k + 0.9}" for k, (m, (a, b)) in enumerate(zip(mass, places, strict=True))
    ]
    table = tmp_path / "weights.csv"
    heading = f"# gravity_m_per_s2: {STANDARD_GRAVITY}\nname,mass_kg,x_m,y_m,z_m,dx,dy,dz,start_s,end_s\n"
    table.write_text(heading + "\n".join(rows) + "\n")
    words = ["--serial", "FP1", "--measure-direction", "parent_to_child", "--weights", str(table)]
    done = typed("bench", "fit-plate", str(path), *words, "-o", str(tmp_path / "w.json"), "--format", "json")
    assert done.code == 0, done.err
    assert read_calibration(tmp_path / "w.json").sensor.serial == "FP1"
    result = json.loads(done.out)
    assert result["centre_after_mm"] < 0.1 < 1.0 < result["centre_before_mm"]
    assert len(result["unmoved"]) == 3
    table.write_text(heading.replace(",end_s", "") + "\n".join(row.rpartition(",")[0] for row in rows) + "\n")
    assert "expected numbers start_s and end_s" in typed("bench", "fit-plate", str(path), *words).err


def test_refusals_name_what_is_there(tmp_path: Path) -> None:
    """Marker, channel, direction, sign of the load cell, too few pushes, and neither pole nor weights."""
    path = tmp_path / "a.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(5), pushes=4)
    plates = read_plates(path)
    with pytest.raises(ExperimentError, match="--tip: no marker is called 'tip'.*pole_tip"):
        _loads(plates, tip="tip")
    with pytest.raises(ExperimentError, match="--load-cell: no channel is called 'cell'"):
        _loads(plates, load_cell="cell")
    with pytest.raises(ExperimentError, match="Mx1: expected a channel in N or kN"):
        _loads(plates, load_cell="Mx1")
    with pytest.raises(ExperimentError, match="Fz1: expected compression above 0"):
        _loads(plates, load_cell="Fz1")
    with pytest.raises(ExperimentError, match="expected at least 6 pushes .* got 4"):
        _loads(plates)
    words = ["bench", "fit-plate", str(path), "--serial", "FP1", "--measure-direction"]
    assert "expected --tip, --head and --load-cell of a pole, or --weights" in typed(*words, "parent_to_child").err
    write_pole_trial(path, PLATE, np.random.default_rng(5), pushes=8, force=True)
    pole = ["--tip", "pole_tip", "--head", "pole_head", "--load-cell", "load_cell"]
    done = typed(*words, "child_to_parent", *pole)
    assert done.code == 2
    assert "check --measure-direction, or --tip and --head exchanged" in done.err
    with pytest.raises(ExperimentError, match="--tip, --head: .* are they exchanged"):
        _loads(read_plates(path), tip="pole_head", head="pole_tip")
    with pytest.raises(ExperimentError, match="--tip, --head: expected two markers, got 'pole_tip' for both"):
        _loads(read_plates(path), head="pole_tip")
    with pytest.raises(FormatError, match="expected no file there"):
        write_pole_trial(path, PLATE, np.random.default_rng(5), pushes=8)


def test_a_tip_marker_up_the_axis_of_the_pole_moves_no_place(tmp_path: Path) -> None:
    """The place is where the axis meets the surface; the marker itself is up to 20 mm beside it."""
    path = tmp_path / "a.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(5), pushes=8)
    plates = read_plates(path)
    tip, head = (plates.file.marker_labels.index(label) for label in ("pole_tip", "pole_head"))
    markers = plates.file.markers.copy()
    markers[:, tip] += 0.05 * (markers[:, head] - markers[:, tip])
    moved = replace(plates, file=replace(plates.file, markers=markers))
    np.testing.assert_allclose(_loads(moved).centre_m, _loads(plates).centre_m, atol=1e-6)


_HEADING = f"# gravity_m_per_s2: {STANDARD_GRAVITY}\nname,mass_kg,x_m,y_m,z_m,dx,dy,dz,start_s,end_s\n"


def _of_table(folder: Path, mass: FloatArray, heading: str = _HEADING, **changes: tuple[float, float]) -> Any:
    """Calibrate with weights that stand for 1 s each; `changes` has other intervals by name."""
    places = np.array([[-0.2, -0.15], [0.2, -0.15], [-0.2, 0.15], [0.2, 0.15], [0.0, 0.0], [0.1, 0.0], [0.0, 0.1]])
    path = _weighed(folder, STANDARD_GRAVITY * mass, places)
    spans = {f"w{k}": (k + 0.1, k + 0.9) for k in range(len(mass))} | changes
    rows = [
        f"{name},{m},{a},{b},0,0,0,1,{start},{end}"
        for m, (a, b), (name, (start, end)) in zip(mass, places, spans.items(), strict=True)
    ]
    table = folder / "w.csv"
    table.write_text(heading + "\n".join(rows) + "\n")
    plates = read_plates(path)
    plate = plates.plate(None)
    loads = loads_of_weights(plates, plate, table, serial="FP1", measure_direction=DIRECTION)
    return calibrate_loads(plates, plate, loads, measure_direction=DIRECTION, code_version="0", created="2026-01-01")


MASSES = np.array([10.0, 20.0, 30.0, 10.0, 20.0, 30.0, 10.0])


@pytest.mark.parametrize(
    ("interval", "message"),
    [
        ((1.8, 2.9), "weights 2 and 3: expected intervals apart"),
        ((2.1, 9.0), "weight 3: expected start_s before end_s, from 0 to 7 s, got 2.1 to 9 s"),
        ((2.9, 2.1), "weight 3: expected start_s before end_s"),
    ],
)
def test_intervals_that_overlap_or_leave_the_file_are_refused(
    tmp_path: Path, interval: tuple[float, float], message: str
) -> None:
    """By the numbers of the weights."""
    with pytest.raises(ExperimentError, match=message):
        _of_table(tmp_path, MASSES, w2=interval)


def test_an_interval_before_the_weight_stands_is_refused(tmp_path: Path) -> None:
    """The gain would be too large."""
    with pytest.raises(ExperimentError, match=r"'w2', start_s: expected a steady load from 1.95 to 2.9 s, got Fz -2"):
        _of_table(tmp_path, MASSES, w1=(1.1, 1.9), w2=(1.95, 2.9))


def test_spaces_after_commas_of_the_heading_do_not_matter(tmp_path: Path) -> None:
    """As in the columns of the loads."""
    assert _of_table(tmp_path, MASSES, _HEADING.replace(",", ", ")).loads == len(MASSES)


def test_weights_of_one_mass_leave_no_baseline_in_the_error_before(tmp_path: Path) -> None:
    """The mean difference is subtracted, and a note says what the weights do not separate."""
    result = _of_table(tmp_path, np.full(7, 20.0))
    assert any("all weights have one mass: gain and offset of Fz cannot be separated" in w for w in result.warnings)
    assert np.abs(result.centre_shift_mm).max() < 2.0  # mm: the baseline of 0.15 N m alone is 0.8 mm


def test_loads_that_contradict_name_what_a_plate_has(tmp_path: Path) -> None:
    """A load cell in other units is named by it and by the C3D file, not by tables of a sensor's file."""
    path = tmp_path / "pole.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(4), pushes=20)
    plates, loads = read_plates(path), _loads(read_plates(path))
    bench = loads.bench
    other = replace(loads, bench=replace(bench, loads=replace(bench.loads, wrench=2.5 * bench.loads.wrench)))
    with pytest.raises(
        FitError, match="or the unit and the calibration of the load cell, and SCALE, GEN_SCALE"
    ) as told:
        calibrate_loads(
            plates, plates.plate(None), other, measure_direction=DIRECTION, code_version="0", created="2026-01-01"
        )
    assert "sensor]" not in str(told.value)
    texts = [value for key in PLATE_SETUP.__dataclass_fields__ if isinstance(value := getattr(PLATE_SETUP, key), str)]
    assert len(texts) == 7
    assert not any("[" in words or "prior" in words for words in texts)


def test_a_gain_far_from_one_and_a_larger_error_of_the_wrench_are_no_success(fitted: PlateCalibration) -> None:
    """Nor is an error of the centre of pressure near that before."""
    assert next(fitted.answers()).concern == Concern.NONE
    row = fitted.components[2].model_copy(update={"gain": 1.3})
    far = fitted.model_copy(update={"components": (*fitted.components[:2], row, *fitted.components[3:])})
    assert next(far.answers()).concern == Concern.UNCERTAIN
    for update in (
        {"centre_after_mm": 0.95 * fitted.centre_before_mm},
        {"error_after": 2.0 * np.asarray(fitted.error_before)},
    ):
        answer = next(fitted.model_copy(update=update).answers())
        assert answer.verdict == "NOT BETTER THAN AS MEASURED"
        assert answer.concern == Concern.BAD


@pytest.mark.long
def test_an_error_of_the_tip_goes_into_the_centre_of_pressure(tmp_path: Path) -> None:
    """As the page states: nothing in the trial tells it from corners that are off."""
    path = tmp_path / "a.c3d"
    write_pole_trial(path, PLATE, np.random.default_rng(4), tip_error_m=0.002)
    result = _calibrated(path)
    _, after = _centre_errors(result, tmp_path)
    assert after == pytest.approx(2.0, abs=0.1)
    assert result.centre_after_mm < 0.1

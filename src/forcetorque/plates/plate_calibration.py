# SPDX-License-Identifier: BSD-3-Clause
"""Calibration of a force plate with applied wrenches, by the estimator of the workbench."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.pose import skew
from forcetorque.base.wrench import WRENCH_COMPONENTS, MeasureDirection
from forcetorque.formats.c3d.force_platform import ForcePlate, centre_of_pressure
from forcetorque.inspection.plausibility.compared_wrenches import WORKBENCH
from forcetorque.plates.applied_loads import ONE_MASS, AppliedLoads
from forcetorque.plates.plate_file import PlateFile
from forcetorque.plates.result import FAR_GAIN, ComponentRow, PlateCalibration, PlatePicture
from forcetorque.plates.weight_on_plates import LOADED_N
from forcetorque.workbench.bench_recording import BenchRecording
from forcetorque.workbench.sensor_fit import bench_calibration, fit_sensor, held_out_errors

_NORMAL_95 = 1.96
_LEVER_M = 0.2
"""Lever at which a moment counts like a force where cross-talk is shown; m."""


def calibrate_loads(
    plates: PlateFile,
    plate: ForcePlate,
    loads: AppliedLoads,
    *,
    measure_direction: MeasureDirection,
    code_version: str,
    created: str,
) -> PlateCalibration:
    """Fit matrix and offset of a plate to known loads.

    Args:
        plates: The trial.
        plate: The plate.
        loads: Known loads with measurements.
        measure_direction: Who acts on whom in the channels.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.

    Returns:
        Gains, cross-talk, errors of the centre of pressure before and after, and the calibration.

    Raises:
        FitError: If the loads determine no matrix, or contradict the measurements.
    """
    _require_sign(f"{plates.file.path}: plate {plate.number}", loads.bench.raw, loads.bench.loads.wrench)
    recording = BenchRecording.of(loads.bench, measure_direction=measure_direction, frame=plate.name)
    fit = fit_sensor(recording, np.random.default_rng(0), with_series=False, setup=PLATE, check_prior=CHECK_CHANNELS)
    if fit.fitted is None or fit.row.held_out is None or fit.row.prior is None:
        raise FitError(f"{plates.file.path}: plate {plate.number}: {fit.row.reason}")
    calibration = bench_calibration(
        recording, fit.fitted, code_version=code_version, created=created, warnings=fit.warnings
    )
    known = fit.bench.loads.wrench
    left_out = known + held_out_errors(fit.fitted, [np.array([k]) for k in range(len(known))])
    bears = np.abs(known[:, 2]) > LOADED_N
    if not bears.any():
        raise FitError(f"{plates.file.path}: expected loads with over {LOADED_N:g} N across the surface, got none")
    place = loads.centre_m[bears]
    before, after = (
        1e3 * (centre_of_pressure(wrench[bears]) - place)
        for wrench in (fit.bench.raw - _baseline(fit.bench.raw, known), left_out)
    )
    matrix = calibration.matrix
    components = _component_rows(matrix, fit.fitted.fit.posterior.matrix_error(matrix))
    return PlateCalibration(
        trial=str(plates.file.path),
        plate=plate.number,
        serial=loads.bench.serial,
        source=loads.source,
        loads=len(known),
        components=components,
        unmoved=fit.row.unmoved,
        centre_before_mm=_rms(before),
        centre_shift_mm=tuple(before.mean(axis=0).tolist()),
        centre_shift_half_width_95_mm=float(_NORMAL_95 * before.std(axis=0).max() / np.sqrt(len(before))),
        centre_after_mm=_rms(after),
        centre_largest_after_mm=float(np.linalg.norm(after, axis=1).max()),
        error_before=fit.row.prior,
        error_after=fit.row.held_out,
        cal_matrix=None
        if (values := corrected_cal_matrix(plate, matrix)) is None
        else tuple(map(tuple, values.tolist())),
        offset=calibration.offset,
        warnings=(*loads.notes, *_gain_warnings(components), *fit.warnings),
        calibration=calibration,
        picture=PlatePicture(
            half_edges_mm=None if plate.half_edges_m is None else 1e3 * plate.half_edges_m,
            place_mm=1e3 * place,
            before_mm=before,
            after_mm=after,
        ),
    )


def corrected_cal_matrix(plate: ForcePlate, matrix: FloatArray) -> FloatArray | None:
    """Compute the CAL_MATRIX that makes a plate of type 4 measure what the calibration gives.

    Args:
        plate: The plate.
        matrix: Matrix of the calibration, about the centre of the surface; shape (6, 6); N, N m.

    Returns:
        Wrench about the origin of the sensor by channels, in the units of the file; shape (6, 6); of a plate of type 2
        the channels are its forces and moments; None for types whose channels are no wrench.
    """
    if plate.cal_matrix is None or plate.unit_factors is None or plate.origin_m is None:
        return None
    surface_X_sensor = np.eye(6)
    surface_X_sensor[3:, :3] = -skew(plate.origin_m)  # moment about the surface = moment + force x origin
    inner = np.linalg.solve(surface_X_sensor, matrix @ surface_X_sensor)
    return np.asarray((inner * plate.unit_factors / plate.unit_factors[:, None]) @ plate.cal_matrix, dtype=np.float64)


def _require_sign(where: str, raw: FloatArray, known: FloatArray) -> None:
    """Refuse measurements that fall where the loads rise."""
    measured, expected = raw - raw.mean(axis=0), known - known.mean(axis=0)
    size = np.repeat([1.0, _LEVER_M], 3)
    if ((measured / size) * (expected / size)).sum() < 0.0:
        raise FitError(
            f"{where}: expected channels with the sign of the loads, got the opposite: check --measure-direction, or "
            "--tip and --head exchanged"
        )


def _baseline(raw: FloatArray, known: FloatArray) -> FloatArray:
    """Constant part of the measurement; shape (6,); with gains of 1 where the loads do not separate it from them."""
    ones = np.ones(len(known))
    if np.abs(known @ np.linalg.lstsq(known, ones, rcond=None)[0] - ones).max() < ONE_MASS:
        return np.asarray((raw - known).mean(axis=0), dtype=np.float64)
    design = np.hstack([known, ones[:, None]])
    return np.asarray(np.linalg.lstsq(design, raw, rcond=None)[0][-1], dtype=np.float64)


def _gain_warnings(components: Sequence[ComponentRow]) -> tuple[str, ...]:
    far = [f"{row.component} {row.gain:.2f}" for row in components if abs(row.gain - 1.0) > FAR_GAIN]
    if not far:
        return ()
    return (
        f"expected gains within {100.0 * FAR_GAIN:.0f} % of 1, got {', '.join(far)}: check the loads, their times and "
        "units",
    )


def _rms(errors: FloatArray) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


def _component_rows(matrix: FloatArray, standard_error: FloatArray) -> tuple[ComponentRow, ...]:
    size = np.repeat([1.0, _LEVER_M], 3)
    share = np.abs(matrix) * size / size[:, None]
    np.fill_diagonal(share, 0.0)
    rows = []
    for k, component in enumerate(WRENCH_COMPONENTS):
        other = int(share[k].argmax())
        rows.append(
            ComponentRow(
                component=component,
                gain=float(matrix[k, k]),
                half_width_95=float(_NORMAL_95 * standard_error[k, k]),
                crosstalk_percent=float(100.0 * share[k, other]),
                crosstalk_half_width_95_percent=float(
                    100.0 * _NORMAL_95 * standard_error[k, other] * size[other] / size[k]
                ),
                crosstalk_of=WRENCH_COMPONENTS[other],
            )
        )
    return tuple(rows)


_CHANNELS = "SCALE, GEN_SCALE and CAL_MATRIX of the C3D file"
CHECK_CHANNELS: Final = f"check {_CHANNELS}"
"""Where to look if loads contradict the wrenches of the file."""
PLATE: Final = replace(
    WORKBENCH,
    gain_causes=(
        (300.0, 3000.0, "are weights given in t, or forces in kN?"),
        (7.0, 14.0, "are forces in kgf?"),
        (0.07, 0.14, "are weights in N given as masses in kg?"),
        (-0.1, 0.02, "are weights in g instead of kg?"),
    ),
    check_gain=f"check the weights, or the unit and the calibration of the load cell, and {_CHANNELS}",
    check_sign="is --measure-direction the right way round, or are --tip and --head exchanged?",
    check_axes="are CORNERS and CHANNEL of the C3D file in the order of the plate's axes?",
    check_moment="check the unit of lengths, POINT:UNITS of the C3D file or --recording length_unit=...",
    check_span="check that the loads are those of this trial, and --plate the one that bears them",
    give_mass="so nothing bears on the plate; give other loads",
)
"""A force plate under a pole or weights, whose measurements are wrenches already."""

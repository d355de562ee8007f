# SPDX-License-Identifier: BSD-3-Clause
"""Force plates with 2 % cross-talk and gain error and corners 3 mm off: centre of pressure before and after, and mass.

Each simulated plate is calibrated by 40 pushes of a pole, and then pressed at 20 other places: root mean square of the
centre of pressure there against the tip of the pole, in mm. A person stands on each plate, tared and not yet
calibrated.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks.harness import arguments, write_cases
from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.formats.c3d.force_platform import centre_of_pressure
from forcetorque.plates.applied_loads import AppliedLoads, loads_of_pole
from forcetorque.plates.plate_calibration import calibrate_loads
from forcetorque.plates.plate_file import PlateFile, read_plates
from forcetorque.plates.simulated_plates import SimulatedPlate, write_pole_trial, write_standing
from forcetorque.plates.weight_on_plates import weigh

PLATES, FIRST_SEED = 20, 9000
DIRECTION = MeasureDirection.PARENT_TO_CHILD
MASS_KG = 71.5


@dataclass(frozen=True, slots=True, kw_only=True)
class PlateCase:
    """A plate."""

    seed: int
    tip_error_mm: float
    """Error of the marker at the tip across the axis of the pole."""
    before_mm: float
    predicted_mm: float
    """Error after the calibration, by loads left out one by one."""
    after_mm: float
    weighed_kg: float
    """Mass of a person of 71.5 kg by the plate as it is, tared."""
    exact_kg: float
    exact_half_width_kg: float
    """The same by a plate without error, with the half-width of the 95 % interval."""


def _loads(plates: PlateFile) -> AppliedLoads:
    names = {"tip": "pole_tip", "head": "pole_head", "load_cell": "load_cell"}
    return loads_of_pole(plates, plates.plate(None), **names, serial="FP1", measure_direction=DIRECTION)


def _error_mm(wrench: FloatArray, loads: AppliedLoads) -> float:
    errors = 1e3 * (centre_of_pressure(wrench) - loads.centre_m)
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


def _weighed(path: Path, plate: SimulatedPlate, seed: int) -> tuple[float, float]:
    tared = replace(plate, baseline=np.zeros(6))
    write_standing(path, (tared,), np.random.default_rng([seed, 3]), mass_kg=MASS_KG)
    weighed = weigh(read_plates(path), gravity=STANDARD_GRAVITY)
    return weighed.mass_kg, weighed.half_width_95_kg


def run_case(seed: int, tip_error_mm: float) -> PlateCase:
    """Calibrate one plate.

    Args:
        seed: Seed of the plate, the pushes and the noise.
        tip_error_mm: Error of the marker at the tip.

    Returns:
        Its errors before and after.
    """
    plate, exact = (
        SimulatedPlate.draw(np.random.default_rng([seed, 0]), crosstalk=crosstalk, corner_error_m=corner)
        for crosstalk, corner in ((0.02, 0.003), (0.0, 0.0))
    )
    with tempfile.TemporaryDirectory() as name:
        fitted, new = Path(name) / "fitted.c3d", Path(name) / "new.c3d"
        write_pole_trial(fitted, plate, np.random.default_rng([seed, 1]), tip_error_m=1e-3 * tip_error_mm)
        write_pole_trial(new, plate, np.random.default_rng([seed, 2]), pushes=20)
        plates, loads = read_plates(fitted), _loads(read_plates(new))
        result = calibrate_loads(
            plates,
            plates.plate(None),
            _loads(plates),
            measure_direction=DIRECTION,
            code_version="0",
            created="2026-01-01",
        )
        mass, _ = _weighed(Path(name) / "standing.c3d", plate, seed)
        exact_mass, half_width = _weighed(Path(name) / "exact.c3d", exact, seed)
    model, raw = result.calibration, loads.bench.raw
    return PlateCase(
        seed=seed,
        tip_error_mm=tip_error_mm,
        before_mm=_error_mm(raw - plate.baseline, loads),
        predicted_mm=result.centre_after_mm,
        after_mm=_error_mm(raw @ model.matrix.T + model.offset, loads),
        weighed_kg=mass,
        exact_kg=exact_mass,
        exact_half_width_kg=half_width,
    )


def main() -> None:
    """Calibrate the plates, write every case, and print medians with the largest."""
    options = arguments(__doc__ or "")
    cases = []
    for tip_error_mm in (0.0, 2.0):
        own = [run_case(FIRST_SEED + k, tip_error_mm) for k in range(2 if options.quick else PLATES)]
        for field in ("before_mm", "predicted_mm", "after_mm"):
            values = [getattr(case, field) for case in own]
            print(f"tip {tip_error_mm:g} mm off, {field}: {np.median(values):.3f} ({max(values):.3f})")
        cases += own
    errors = [abs(case.weighed_kg - MASS_KG) for case in cases]
    held = sum(abs(case.exact_kg - MASS_KG) <= case.exact_half_width_kg for case in cases[: len(cases) // 2])
    print(f"mass, plates with errors: off by {np.median(errors):.2f} ({max(errors):.2f}) kg")
    print(f"mass, plates without: interval holds {held} of {len(cases) // 2}")
    write_cases(options.json, cases)


if __name__ == "__main__":
    main()

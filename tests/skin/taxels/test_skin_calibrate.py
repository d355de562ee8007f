# SPDX-License-Identifier: BSD-3-Clause
"""Taxels with known truth are calibrated to what noise and rounding allow, and broken ones are named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FitError, SkinError
from forcetorque.skin.simulation.recordings import REFERENCE_PA
from forcetorque.skin.taxels.calibrate import SkinCalibration, calibrate_skin
from forcetorque.skin.taxels.taxel_faults import TaxelFault
from tests.scenes.chambers import BROKEN, HIGHEST_PA, LATER, TAXELS, chamber, responses, write_chamber, write_chambers

DRAWS = 12
"""Patches of 60 taxels, of which six are broken: 648 sound ones and 72 broken ones."""
EXPECTED = 0.1
"""Share by which the error of a fit may differ from that of noise and rounding: 2500 samples and a curve that bends."""


def _calibrated(*files: Path, **options: object) -> SkinCalibration:
    return calibrate_skin(files, code_version="1", created="2020-01-01T00:00:00+00:00", **options)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def answer(tmp_path_factory: pytest.TempPathFactory) -> SkinCalibration:
    """Fitted to 50 kPa, judged to 80 kPa on another recording."""
    return _calibrated(*write_chambers(tmp_path_factory.mktemp("chambers")), highest_pa=REFERENCE_PA)


def test_broken_taxels_are_left_out_by_name(answer: SkinCalibration) -> None:
    """Those that were planted, each with its fault among the reasons, and no other."""
    reasons = {row.taxel: row.left_out for row in answer.taxels if row.left_out is not None}
    assert set(reasons) == set(BROKEN)
    for taxel, fault in BROKEN.items():
        assert fault.value in reasons[taxel].split(", ")
    assert (answer.valid_taxels, answer.left_out) == (TAXELS - len(BROKEN), len(BROKEN))


def test_health_is_per_recording(answer: SkinCalibration) -> None:
    """What breaks before the second recording is fitted, but does not judge there."""
    fit, kept = answer.recordings
    assert (fit.valid_taxels, kept.valid_taxels) == (TAXELS - len(BROKEN), TAXELS - len(BROKEN) - len(LATER))
    assert kept.jumps > fit.jumps
    row = next(row for row in answer.candidates if row.curve == "monotone" and row.recording == "all")
    assert (row.taxels, row.left_out) == (TAXELS - len(BROKEN) - len(LATER), len(BROKEN) + len(LATER))
    assert answer.taxels[50].range_counts is not None
    assert answer.taxels[50].inside_kPa is None


@pytest.mark.long
def test_no_fault_is_missed_or_made_up(tmp_path: Path) -> None:
    """Over twelve patches: both error rates are 0, so below 0.6 % of sound and 5 % of broken taxels at 95 %."""
    missed = false = 0
    for seed in range(DRAWS):
        file = write_chamber(tmp_path, f"c{seed}", chamber(responses(seed=seed), 100 + seed, broken=BROKEN))
        for row in _calibrated(file).taxels:
            named = (row.left_out or "").split(", ")
            fault = BROKEN.get(row.taxel)
            missed += fault is not None and fault.value not in named
            false += fault is None and row.left_out is not None
    assert (missed, false) == (0, 0)


def test_the_error_is_that_of_noise_and_rounding(tmp_path: Path) -> None:
    """Without hysteresis: the slope of the curve times 0.65 counts of noise and a twelfth of a count squared."""
    taxels = responses(hysteresis=False)
    answer = _calibrated(write_chamber(tmp_path, "fit", chamber(taxels, 21)))
    pressure = np.linspace(0.0, HIGHEST_PA, 500)
    fall = taxels.fall(pressure[:, None] * np.ones(TAXELS))
    slope = np.gradient(pressure)[:, None] / np.gradient(fall, axis=0)
    expected = 1e-3 * np.hypot(taxels.noise, np.sqrt(1.0 / 12.0)) * np.sqrt((slope**2).mean(axis=0))
    rmse = np.array([row.rmse_kPa for row in answer.taxels])
    assert np.median(rmse / expected) == pytest.approx(1.0, abs=EXPECTED)
    assert len(rmse) == TAXELS
    # the mean curve is ten times better than one reading, and hysteresis is found to be none
    assert np.median([row.error_kPa for row in answer.taxels if row.error_kPa]) < 0.3 * np.median(expected)
    assert max(abs(row.hysteresis_percent) for row in answer.taxels if row.hysteresis_percent is not None) < 1.0


def test_hysteresis_is_that_of_the_truth(tmp_path: Path) -> None:
    """The mean over levels of a parabola is two thirds of its peak."""
    taxels = responses()
    answer = _calibrated(write_chamber(tmp_path, "fit", chamber(taxels, 22)))
    shares = np.array([row.hysteresis_percent for row in answer.taxels])
    assert np.median(shares / (100.0 * taxels.hysteresis * 2.0 / 3.0)) == pytest.approx(1.0, abs=0.15)
    assert np.corrcoef(shares, taxels.hysteresis)[0, 1] > 0.95


def test_the_default_is_good_beyond_the_range(answer: SkinCalibration) -> None:
    """It nowhere falls, and errs less above the range than the fifth order by far."""
    total = {row.curve: row for row in answer.candidates if row.recording == "all"}
    assert set(total) == {"monotone", "line", "polynomial", "capacitor", "logarithmic"}
    assert total["monotone"].falling == 0
    assert total["polynomial"].falling > 0
    above = {name: row.above_kPa for name, row in total.items()}
    assert above["monotone"] is not None
    assert above["polynomial"] is not None
    assert above["monotone"] < 0.5 * above["polynomial"]
    above_without_falls = {name: above[name] for name, row in total.items() if not row.falling}
    assert answer.curve == "monotone"
    assert answer.least_above == min(above_without_falls, key=above_without_falls.__getitem__)


def test_the_rest_level_is_taken_anew(tmp_path: Path) -> None:
    """A recording that rests 10 counts lower is judged the same."""
    fit, _ = write_chambers(tmp_path)
    taxels = responses()
    errors = []
    for shift in (0.0, 10.0):
        moved = replace(taxels, rest=taxels.rest - shift)
        kept = write_chamber(tmp_path, f"kept_{shift:g}", chamber(moved, 31), use="validation")
        answer = _calibrated(fit, kept)
        errors.append(next(row.inside_kPa for row in answer.candidates if row.recording == "all"))
    assert errors[1] == pytest.approx(errors[0], rel=0.05)


def test_the_file_holds_what_was_fitted(answer: SkinCalibration) -> None:
    """Patch, range and inputs; a table per sound taxel that rises everywhere."""
    made = answer.calibration
    assert (made.patch, made.serial, made.columns) == ("palm", "P7", TAXELS)
    assert made.highest_pa == pytest.approx(REFERENCE_PA, rel=0.01)
    assert set(made.provenance.inputs_sha256) >= {"fit: fit.toml", "kept: kept.toml"}
    table = made.table()
    assert not table.falls().any()
    assert int(table.live.sum()) == answer.valid_taxels
    taxels = responses()
    pressure = np.full(TAXELS, 3e4)
    read = table.pressures(taxels.rest - taxels.fall(pressure), taxels.rest)[table.live]
    # of loading: a curve between it and unloading reads 5 % too little here, the worst 7 %
    assert np.abs(read / 3e4 - 1.0).max() < 0.02


def test_what_cannot_be_calibrated_is_refused(tmp_path: Path) -> None:
    """Nothing to fit, another patch, an unknown form, a pressure below all, and every taxel broken."""
    fit, kept = write_chambers(tmp_path)
    with pytest.raises(ExperimentError, match='expected an interval with use = "calibration"'):
        _calibrated(kept)
    with pytest.raises(
        FitError, match="no curve is called 'spline'; .*capacitor, line, logarithmic, monotone, polynomial"
    ):
        _calibrated(fit, curve="spline")
    with pytest.raises(FitError, match="highest pressure to fit"):
        _calibrated(fit, highest_pa=-1e4)
    with pytest.raises(ExperimentError, match="no patch is called 'sole'; known: palm"):
        _calibrated(fit, patch="sole")
    kept.write_text(kept.read_text(encoding="utf-8").replace("P7", "P8"), encoding="utf-8")
    with pytest.raises(ExperimentError, match=r"expected the patch 'palm' \(P7\) .* got 'palm' \(P8\)"):
        _calibrated(fit, kept)
    broken = chamber(responses(), 41, broken=dict.fromkeys(range(TAXELS), TaxelFault.NEVER_MOVES))
    with pytest.raises(FitError, match="expected a valid taxel to fit, got none of 60: they are never moves"):
        _calibrated(write_chamber(tmp_path, "dead", broken))


@pytest.mark.parametrize(
    ("start", "end", "message"),
    [
        (0.0, 25.0, "got one that only rises"),
        (0.0, 4.0, "it never rises"),
        (10.0, 49.0, "at least 20 messages at rest"),
    ],
)
def test_intervals_that_are_no_cycle_are_refused(tmp_path: Path, start: float, end: float, message: str) -> None:
    """By file, patch and interval."""
    file = write_chamber(tmp_path, "fit", chamber(responses(), 11))
    text = file.read_text(encoding="utf-8").replace("start_s = 0.0", f"start_s = {start}\nend_s = {end}")
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SkinError, match=rf"fit\.toml: patch 'palm': interval 'cycle': .*{message}"):
        _calibrated(file)

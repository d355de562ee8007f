# SPDX-License-Identifier: BSD-3-Clause
"""Weight of a simulated person on plates: mass within its interval, and plates that contradict each other."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.plates.plate_file import read_plates
from forcetorque.plates.result import PlateWeight
from forcetorque.plates.simulated_plates import SimulatedPlate, write_standing
from forcetorque.plates.weight_on_plates import weigh
from forcetorque.results.answer import MOST_LINES, answer_text
from tests.app.outcome import typed

MASS_KG = 71.5
PLATE = SimulatedPlate.draw(np.random.default_rng(1), crosstalk=0.0, corner_error_m=0.0)
EXACT = replace(PLATE, baseline=np.zeros(6))
"""A plate without baseline, as after a tare."""
OTHER = replace(EXACT, corners_m=EXACT.corners_m + np.array([0.6, 0.0, 0.0]))


def _weighed(path: Path, *plates: SimulatedPlate, **options: float) -> PlateWeight:
    write_standing(path, plates, np.random.default_rng(2), mass_kg=MASS_KG)
    return weigh(read_plates(path), gravity=STANDARD_GRAVITY, **options)


def test_the_mass_is_within_its_interval(tmp_path: Path) -> None:
    """On one plate, and on two; the centre of pressure too; the answer is short and has no contradiction."""
    for plates in ((EXACT,), (EXACT, OTHER)):
        weighed = _weighed(tmp_path / f"{len(plates)}.c3d", *plates)
        assert abs(weighed.mass_kg - MASS_KG) < weighed.half_width_95_kg < 0.1
        assert weighed.contradictions == ()
        loaded = [row for row in weighed.plates if row.centre_mm is not None]
        assert loaded
        for row in loaded:
            assert row.centre_mm is not None
            assert np.abs(row.centre_mm).max() < 10.5  # mm, the sway
        text = answer_text(list(weighed.answers()), 80)
        assert len(text.splitlines()) <= MOST_LINES
        assert "kg (95 %: ±" in text
        assert weighed.figure().get_suptitle().startswith(next(iter(weighed.answers())).verdict)
        assert "parent_to_child, the reaction" in text


def test_a_plate_with_another_gain_contradicts(tmp_path: Path) -> None:
    """A gain that is 3 % off is named with both masses, where each plate bore the person alone."""
    wrong = replace(OTHER, distortion=np.diag([1.0, 1.0, 1.03, 1.0, 1.0, 1.0]))
    weighed = _weighed(tmp_path / "a.c3d", EXACT, wrong)
    assert any("plate 2 alone weighs 73.6" in text and "kg apart" in text for text in weighed.contradictions)


def test_a_plate_with_another_sign_contradicts(tmp_path: Path) -> None:
    """Of the interval on both."""
    wrong = replace(OTHER, distortion=-np.eye(6))
    weighed = _weighed(tmp_path / "a.c3d", EXACT, wrong, start_s=8.0, end_s=10.0)
    assert any("Fz of plate 1 is below 0 and that of the others is not" in text for text in weighed.contradictions)
    assert weighed.mass_kg == pytest.approx(MASS_KG, abs=0.1)


def test_a_baseline_is_named(tmp_path: Path) -> None:
    """Of the plate that is free for a while."""
    weighed = _weighed(tmp_path / "a.c3d", replace(EXACT, baseline=np.array([0.0, 0.0, 3.0, 0.0, 0.0, 0.0])), OTHER)
    assert "plate 1 measures 3.0 N while nothing stands on it" in weighed.contradictions[0]


def test_cross_talk_pushes_who_stands_still_sideways(tmp_path: Path) -> None:
    """5 % of Fz on Fx."""
    distortion = np.eye(6)
    distortion[0, 2] = 0.05
    weighed = _weighed(tmp_path / "a.c3d", replace(EXACT, distortion=distortion))
    assert any(text.startswith("the plates together are pushed sideways by 3") for text in weighed.contradictions), (
        weighed.contradictions
    )


def test_wrong_moments_are_named(tmp_path: Path) -> None:
    """A centre of pressure outside of the plate."""
    distortion = np.eye(6)
    distortion[3, 2] = 0.3  # m
    weighed = _weighed(tmp_path / "a.c3d", replace(EXACT, distortion=distortion))
    assert any("outside of it: check ORIGIN, CORNERS" in text for text in weighed.contradictions)


def test_refusals_say_what_to_do(tmp_path: Path) -> None:
    """Nobody on the plate, an interval without load, and a key that is none."""
    path = tmp_path / "a.c3d"
    write_standing(path, [EXACT], np.random.default_rng(2), mass_kg=1.0)
    with pytest.raises(ExperimentError, match="nobody stands still; choose --start-s and --end-s"):
        weigh(read_plates(path), gravity=STANDARD_GRAVITY)
    with pytest.raises(ExperimentError, match="expected an interval with a load above 20 N"):
        weigh(read_plates(path), gravity=STANDARD_GRAVITY, start_s=0.0, end_s=0.2)
    with pytest.raises(FormatError, match=r"--recording: expected KEY=VALUE"):
        read_plates(path, ["surface"])
    with pytest.raises(ExperimentError, match=r"--plate: expected one of 1, got 7"):
        read_plates(path).plate(7)


@pytest.mark.parametrize("gravity", [0.0, -1.0, np.nan])
def test_gravity_is_above_zero(tmp_path: Path, gravity: float) -> None:
    """As of weights on a bench."""
    write_standing(tmp_path / "a.c3d", [EXACT], np.random.default_rng(2))
    with pytest.raises(ExperimentError, match="gravity: expected a number above 0 m/s2"):
        weigh(read_plates(tmp_path / "a.c3d"), gravity=gravity)


def test_a_unit_of_length_that_makes_plates_too_large_is_refused(tmp_path: Path) -> None:
    """And plates without corners are named."""
    path = tmp_path / "a.c3d"
    write_standing(path, [EXACT], np.random.default_rng(2))
    plates = read_plates(path)
    without = replace(plates, plates=tuple(replace(plate, corners_m=None) for plate in plates.plates))
    assert any("the corners of plate 1" in text for text in weigh(without, gravity=9.81).contradictions)
    content = path.read_bytes()
    assert content.count(b"mm") >= 1
    index = content.index(b"mm", content.index(b"UNITS"))
    path.write_bytes(content[:index] + b"  " + content[index + 2 :])
    with pytest.raises(FormatError, match="length_unit=m: expected edges of 0.05 to 10 m between CORNERS, got 400 to"):
        read_plates(path, ["length_unit=m"])
    assert read_plates(path, ["length_unit=mm"]).plates[0].corners_m is not None


def test_the_command_prints_the_mass_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the plates as a table and as JSON."""
    monkeypatch.chdir(tmp_path)
    write_standing(Path("a.c3d"), [EXACT, OTHER], np.random.default_rng(2), mass_kg=MASS_KG)
    done = typed("bench", "plate", "a.c3d", columns=80)
    assert done.code == 0, done.err
    assert "71.50" in done.out.splitlines()[0]
    assert "centre x" in typed("bench", "plate", "a.c3d", "--details", columns=120).out
    assert '"schema": "forcetorque/plate/1"' in typed("bench", "plate", "a.c3d", "--format", "json").out

# SPDX-License-Identifier: BSD-3-Clause
"""The example of a real insole in a pressure chamber: what its curves are worth where they were not fitted."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from forcetorque.skin.commands import calibrate_skin
from forcetorque.skin.taxels.calibrate import SkinCalibration
from forcetorque.skin.taxels.result import CandidateRow

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "skin" / "taxels.md").read_text(encoding="utf-8")
EXAMPLES = sorted((Path(__file__).resolve().parents[2] / "examples").glob("1[678]_insole_*.toml"))
HIGHEST_PA = 1.5e5
ABOVE_KPA, INSIDE_KPA, PRINTED_ABOVE_KPA = 25.0, 13.0, 1000.0
"""At most 0.25 bar above the fitted 1.5 bar, 0.13 bar inside; the fifth order has more than 10 bar above."""

pytestmark = [pytest.mark.real_data, pytest.mark.long]


@pytest.fixture(scope="module")
def insole(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> SkinCalibration:
    """Fitted to 1.5 bar on the calibration log, judged on validation logs 1 and 2 up to 3.4 bar."""
    assert len(EXAMPLES) == 3
    folder = tmp_path_factory.mktemp("insole")
    for example in EXAMPLES:
        text = example.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix())
        (folder / example.name).write_text(text, encoding="utf-8")
    return calibrate_skin(*sorted(folder.glob("*.toml")), highest_pa=HIGHEST_PA)


def _rows(insole: SkinCalibration, curve: str) -> dict[str, CandidateRow]:
    return {row.recording: row for row in insole.candidates if row.curve == curve}


def test_the_default_is_as_good_as_a_line_beyond_its_range(insole: SkinCalibration) -> None:
    """Medians over taxels that are sound in the fit and in the tested log, in each log and in both."""
    default, line = _rows(insole, "monotone"), _rows(insole, "line")
    assert len(default) == 3
    for name, row in default.items():
        assert row.inside_kPa is not None
        assert row.above_kPa is not None
        assert line[name].above_kPa is not None
        assert row.inside_kPa <= INSIDE_KPA
        assert row.above_kPa <= ABOVE_KPA
        assert row.above_kPa <= line[name].above_kPa
        assert row.taxels + row.left_out == 280
    assert [default[name].taxels for name in sorted(default)] == [179, 81, 179]


def test_the_default_rises_for_every_taxel_and_the_fifth_order_does_not(insole: SkinCalibration) -> None:
    """The fifth order says nothing beyond its range."""
    assert (insole.valid_taxels, insole.left_out) == (182, 98)
    assert not insole.calibration.table().falls().any()
    printed = _rows(insole, "polynomial")["all"]
    assert printed.falling > 100
    assert printed.above_kPa is not None
    assert printed.above_kPa > PRINTED_ABOVE_KPA


def test_health_is_needed_in_every_recording(insole: SkinCalibration) -> None:
    """Negative control: with the health of the fit alone the median of the first log is several times worse."""
    row = _rows(insole, "monotone")["insole held out 1: cycle"]
    assert row.above_any_kPa is not None
    assert row.above_kPa is not None
    assert row.above_any_kPa > 3.0 * row.above_kPa
    assert row.above_any_kPa > 37.0
    jumps = {row.recording: row.jumps for row in insole.recordings}
    assert jumps["insole held out 1: cycle"] > 2 * jumps["insole fit: cycle"]


def test_the_page_has_these_figures(insole: SkinCalibration) -> None:
    """Every line of its table, to its last digit; 1 bar is 100 kPa."""
    lines = re.findall(r"^\| `(\w+)` \| ([\d.]+) \| ([\d.]+) \| (\d+) \|$", PAGE, re.MULTILINE)
    assert [curve for curve, *_ in lines] == ["monotone", "line", "polynomial", "capacitor", "logarithmic"]
    for curve, inside, above, falling in lines:
        row = _rows(insole, curve)["all"]
        assert row.falling == int(falling)
        for figure, value in ((inside, row.inside_kPa), (above, row.above_kPa)):
            assert value is not None
            assert f"{value / 100.0:.{len(figure.partition('.')[2])}f}" == figure

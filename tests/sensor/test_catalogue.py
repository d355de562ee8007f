# SPDX-License-Identifier: BSD-3-Clause
"""The catalogue of sensors: figures as printed, look-up, filter, and broken catalogues."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import FormatError, SensorError
from forcetorque.sensor.catalogue import (
    CatalogueSensor,
    Technology,
    catalogue_with,
    find_sensor,
    read_catalogue,
    sensor_catalogue,
)

# Table 1.2 as printed, typed a second time: Fx and Fy, Fz, Tx and Ty, Tz, and the two dimensions in mm
TABLE_1_2 = {
    "AD2.5D": (2224, 4448, 112, 56, 63.5, 63.5),
    "FS6": (1100, 2200, 56, 28, 63.4, 37.8),
    "mini45": (580, 1160, 20, 20, 15.7, 45),
    "mini58": (1400, 3400, 60, 60, 30, 58),
    "75E20A4": (1000, 2000, 200, 200, 50.8, 191),
    "FTS-Theta": (2500, 6250, 400, 400, 61.1, 155),
    "3713A": (400, 800, 14, 14, 25, 135),
    "HEX-H": (200, 200, 15, 10, 43.5, 70),
    "Barrett": (80, 135, 2.75, 2.75, 12, 90),
    "30E12A4": (200, 400, 16, 16, 19, 45),
    "FT300": (300, 300, 30, 30, 37.5, 75),
    "FTC050": (450, 400, 7, 15, 48.5, 161),
    "FT nano 25": (250, 1000, 6, 6, 21.6, 25),
    "kms40": (120, 120, 3, 3, 27, 76),
    "Axia80": (500, 900, 20, 20, 25.4, 104),
}


def _figures(sensor: CatalogueSensor) -> tuple[float, ...]:
    axes = sensor.calibrations[0].range
    assert sensor.dimensions is not None
    return (axes.fxy, axes.fz, axes.txy, axes.tz, *(round(1e3 * length, 6) for length in sensor.dimensions))


@pytest.mark.parametrize("name", TABLE_1_2)
def test_figures_are_those_of_table_1_2(name: str) -> None:
    """Ranges and dimensions of each row."""
    assert _figures(find_sensor(name)) == TABLE_1_2[name]
    assert "Table 1.2" in find_sensor(name).source


def test_the_catalogue_holds_the_tables_and_nothing_else() -> None:
    """Fifteen rows of Table 1.2, and the two boards of the FTsense."""
    names = [sensor.name for sensor in sensor_catalogue()]
    assert names == [*TABLE_1_2, "FTsense Strain 1", "FTsense Strain 2"]
    assert sensor_catalogue() is sensor_catalogue()


def test_resolutions_are_those_of_the_appendix() -> None:
    """Tables A.1 and A.2, which prints the ranges of Table 1.2 again."""
    for name, last, ranges in (
        ("FTsense Strain 1", 0.004, (1500, 2000, 35, 25)),
        ("mini45", 0.0026, (580, 1160, 20, 20)),
    ):
        (calibration,) = find_sensor(name).calibrations
        resolution = calibration.resolution
        assert resolution is not None
        assert (resolution.fxy, resolution.fz, resolution.txy, resolution.tz) == (0.25, 0.25, 0.005, last)
        assert tuple(calibration.range.model_dump().values()) == ranges
    strain_1 = find_sensor("FTsense Strain 1")
    assert (strain_1.mass, strain_1.dimensions) == (0.122, (0.0184, 0.045))


def test_what_is_not_printed_is_left_out() -> None:
    """No technology for the kms40, no range for the Strain 2, whose gains decide, no sign for two of them."""
    assert find_sensor("kms40").technology is None
    strain_2 = find_sensor("FTsense Strain 2")
    assert strain_2.calibrations == ()
    assert (strain_2.lowest_gain, strain_2.highest_gain) == (2.67, 9600.0)
    unsigned = [s.name for s in sensor_catalogue() if any(not c.has_sign for c in s.calibrations)]
    assert unsigned == ["AD2.5D", "FTsense Strain 1"]
    assert find_sensor("HEX-H").technology is Technology.OPTICAL


def test_two_calibrations_of_one_sensor() -> None:
    """The Axia80 has a wide and a narrow range, the wide one first."""
    wide, narrow = find_sensor("Axia80").calibrations
    assert (wide.range.fz, narrow.range.fz, narrow.range.tz) == (900.0, 360.0, 8.0)


def test_names_are_found_in_any_letters() -> None:
    """Capital and small letters are alike."""
    assert find_sensor("MINI45") is find_sensor("mini45")


def test_an_unknown_name_lists_the_known_ones() -> None:
    """The likeliest name first, then all."""
    with pytest.raises(SensorError, match=r'no sensor .mini_45. .*did you mean "mini45"\? known: 30E12A4, '):
        find_sensor("mini_45")


GOOD = """
[[sensor]]
name = "a"
maker = "b"
source = ["c"]
"""


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GOOD + "weight = 3.0", "unknown key 'weight'"),
        (GOOD + "mass = -1.0", "mass: expected more than 0"),
        (GOOD + 'technology = "magic"', "technology"),
        (GOOD + 'mass = "0.1"', "mass: expected a valid number"),
        (GOOD + GOOD, "one sensor per name, got several of a"),
        (GOOD + "error = { percent = 1.0, force_N = 1.0 }", "expected percent, or force_N and moment_Nm"),
        (GOOD + "error = { force_N = 1.0 }", "expected percent, or force_N and moment_Nm"),
        ('[[sensor]]\nname = "a"', "maker: expected this key, there is none"),
        ("[[sensor", "expected TOML"),
    ],
)
def test_broken_catalogues_are_refused(text: str, message: str, tmp_path: Path) -> None:
    """Unknown keys, wrong numbers and doubled names are errors that name the file and the key."""
    file = tmp_path / "own.toml"
    file.write_text(GOOD, encoding="utf-8")
    assert read_catalogue(file)[0].name == "a"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=rf"own\.toml: .*{message}"):
        read_catalogue(file)


def test_own_entries_come_first_and_are_no_second_entry(tmp_path: Path) -> None:
    """A file adds sensors; a name of the library in any letters is refused."""
    file = tmp_path / "own.toml"
    file.write_text(GOOD, encoding="utf-8")
    assert catalogue_with(file) == (*read_catalogue(file), *sensor_catalogue())
    assert find_sensor("A", catalogue_with(file)).maker == "b"
    file.write_text(GOOD.replace('"a"', '"MINI45"'), encoding="utf-8")
    with pytest.raises(FormatError, match="expected one sensor per name, got several of mini45; rename one"):
        catalogue_with(file)


def test_stated_errors_are_the_printed_accuracies() -> None:
    """Percent of the range of each axis, or absolute; the upper end of a printed range; of the mini45 that of A.2.2."""
    stated = {sensor.name: sensor.error for sensor in sensor_catalogue() if sensor.error is not None}
    assert {name: error.percent for name, error in stated.items()} == {
        "mini45": 1.75,
        "mini58": 5.0,
        "75E20A4": 0.25,
        "FTS-Theta": 1.0,
        "FT300": None,
        "Axia80": 2.0,
    }
    assert all((sensor.error is None) == (sensor.accuracy is None) for sensor in sensor_catalogue())
    for name, errors in (("Axia80", [10, 10, 18, 0.4, 0.4, 0.4]), ("FT300", [1, 1, 1, 0.02, 0.02, 0.02])):
        assert stated[name].components(find_sensor(name).calibrations[0].range) == pytest.approx(errors)

# SPDX-License-Identifier: BSD-3-Clause
"""Which sensor holds a load: by hand from Table 1.2, the bound of combined loads, the order, and the command."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, SensorError
from forcetorque.sensor.catalogue import Axes, catalogue_with, sensor_catalogue
from forcetorque.sensor.choice.choice import range_shares, rank_sensors
from forcetorque.sensor.choice.load_case import LoadCase, read_load_cases
from forcetorque.sensor.choice.result import Holds
from forcetorque.sensor.commands import choose_sensor
from forcetorque.sensor.full_scale import RawLimits, reachable_full_scale
from forcetorque.simulation.sensor_family import FAMILIES
from tests.app.outcome import Run

STANCE = LoadCase(name="stance", force_N=(0.0, 0.0, 500.0), lever_m=(0.0, 0.01, 0.0))

OWN = """
[[sensor]]
name = "own"
maker = "us"
source = ["our data sheet"]
error = { force_N = 0.5, moment_Nm = 0.01 }
[[sensor.calibrations]]
range = { fxy = 500.0, fz = 2000.0, txy = 50.0, tz = 50.0 }
"""

LOADS = """
schema = "forcetorque/load_cases/1"
[[load]]
name = "stance"
force_N = [0.0, 0.0, 500.0]
lever_m = [0.0, 0.01, 0.0]
[[load]]
name = "push"
moment_Nm = [0.0, 15.0, 0.0]
"""


def test_a_lever_makes_a_moment() -> None:
    """500 N along z at 10 mm of y: 5 N m about x."""
    assert STANCE.wrench == pytest.approx([0, 0, 500, 5, 0, 0])


def test_shares_errors_and_order_are_those_of_the_table() -> None:
    """By hand: of the mini45 500 / 1160 and 5 / 20, together 68 %, with 20 % to spare; 1.75 % of 1160 N is 20.3 N."""
    choice = rank_sensors([STANCE], sensor_catalogue(), margin=0.2)
    rows = {(row.sensor, row.calibration): row for row in choice.sensors}
    mini45 = rows["mini45", 1]
    assert mini45.holds is Holds.HELD
    assert mini45.axis_percent == pytest.approx(100 * 500 / 1160)
    assert mini45.combined_percent == pytest.approx(100 * (500 / 1160 + 5 / 20))
    assert (mini45.error_force_N, mini45.error_moment_Nm) == pytest.approx((20.3, 0.35))
    assert mini45.error_of_load_percent == pytest.approx(100 * max(20.3 / 500, 0.35 / 5))
    assert (mini45.resolution_force_N, mini45.resolution_moment_Nm) == (0.25, 0.005)
    # 500 of 900 and 5 of 20 N m are below 80 % each, 80.6 % together
    assert rows["Axia80", 1].holds is Holds.AXIS_BY_AXIS
    assert rows["Axia80", 2].holds is Holds.EXCEEDED
    assert choice.without_range == ("FTsense Strain 2",)
    held = choice.held()
    known = [row.error_of_load_percent for row in held if row.error_of_load_percent is not None]
    unknown = [row.combined_percent for row in held if row.error_of_load_percent is None]
    assert len(known) >= 3
    assert known == sorted(known)
    assert len(unknown) >= 2
    assert unknown == sorted(unknown, reverse=True)
    assert [row.error_of_load_percent is None for row in held] == [False] * len(known) + [True] * len(unknown)
    assert [*dict.fromkeys(row.holds for row in choice.sensors)] == [*Holds]


def test_the_worst_load_of_several_decides() -> None:
    """15 N m about y pass the 14 N m of the 3713A, which holds 500 N and 5 N m axis by axis."""
    push = LoadCase(name="push", moment_Nm=(0.0, 15.0, 0.0))
    row = next(
        row for row in rank_sensors([STANCE, push], sensor_catalogue(), margin=0.0).sensors if row.sensor == "3713A"
    )
    assert (row.holds, row.load) == (Holds.EXCEEDED, "push")
    alone = next(row for row in rank_sensors([STANCE], sensor_catalogue(), margin=0.0).sensors if row.sensor == "3713A")
    assert (alone.holds, alone.load) == (Holds.HELD, "stance")


def _errors_of_load(*loads: LoadCase) -> dict[str, float]:
    rows = rank_sensors(loads, sensor_catalogue(), margin=0.0).sensors
    return {row.name: row.error_of_load_percent for row in rows if row.error_of_load_percent is not None}


@pytest.mark.parametrize(
    ("load", "alike"),
    [
        # along its lever but for the digits that are typed
        (
            LoadCase(name="pull", force_N=(127.8, 54.7, 9.2), lever_m=(0.02556, 0.01094, 0.00184)),
            LoadCase(name="pull", force_N=(127.8, 54.7, 9.2)),
        ),
        (
            LoadCase(name="press", force_N=(0.0, 0.0, 500.0), lever_m=(1e-6, 0.0, 0.0)),
            LoadCase(name="press", force_N=(0.0, 0.0, 500.0)),
        ),
        (
            LoadCase(name="turn", force_N=(1e-3, 0.0, 0.0), moment_Nm=(0.0, 5.0, 0.0)),
            LoadCase(name="turn", moment_Nm=(0.0, 5.0, 0.0)),
        ),
    ],
)
def test_an_error_is_not_related_to_what_is_negligible(load: LoadCase, alike: LoadCase) -> None:
    """A moment by rounding, or a force beside a moment, gives the errors and the order of none."""
    error, none = _errors_of_load(load), _errors_of_load(alike)
    assert len(error) >= 5
    assert list(error) == list(none)
    assert error == pytest.approx(none, rel=1e-4)


def test_the_error_is_related_to_the_largest_of_all_loads() -> None:
    """A small load beside a large one does not decide: the mini45 errs by 20.3 N of 500 N and 0.35 N m of 5 N m."""
    touch = LoadCase(name="touch", force_N=(0.0, 0.0, 1.0), lever_m=(0.0, 0.01, 0.0))
    assert _errors_of_load(STANCE, touch) == _errors_of_load(STANCE)
    assert _errors_of_load(touch)["mini45"] == pytest.approx(100 * 0.35 / 0.01)


@pytest.mark.parametrize("force", [(1.0, 2.0), (1.0, 2.0, float("nan")), (1e-300, 0.0, 0.0)])
def test_a_force_of_python_is_checked(force: tuple[float, ...]) -> None:
    """As one that is typed."""
    with pytest.raises(SensorError, match="force_N.2: expected|the load: expected a load of 1e-09 to 1e"):
        choose_sensor(force=force)  # type: ignore[arg-type]


def test_a_sum_of_shares_below_one_saturates_no_channel() -> None:
    """Of a simulated sensor whose range per axis is where its first channel saturates; axis by axis is not enough."""
    rng = np.random.default_rng(7)
    limits = RawLimits(
        matrix=np.linalg.inv(FAMILIES["standard"].draw(rng)),
        offset=np.zeros(6),
        lowest=np.full(6, -32768.0),
        highest=np.full(6, 32768.0),
    )
    fx, fy, fz, tx, ty, tz = reachable_full_scale(limits).positive  # symmetric without an offset
    range_ = Axes(fxy=min(fx, fy), fz=fz, txy=min(tx, ty), tz=tz)
    loads = rng.standard_normal((2000, 6)) * range_.components()
    together = loads / range_shares(loads, range_).sum(axis=1, keepdims=True)
    one_by_one = loads / range_shares(loads, range_).max(axis=1, keepdims=True)
    assert (np.abs(limits.raw(together)) <= 32768.0 * (1.0 + 1e-12)).all()
    assert (np.abs(limits.raw(one_by_one)) > 32768.0).any(axis=1).mean() > 0.5


def test_own_entries_are_ranked(tmp_path: Path) -> None:
    """A sensor of a file with the smallest error is the first."""
    file = tmp_path / "own.toml"
    file.write_text(OWN, encoding="utf-8")
    choice = rank_sensors([STANCE], catalogue_with(file), margin=0.2)
    assert choice.sensors[0].sensor == "own"
    assert choice.sensors[0].source == ("our data sheet",)


@pytest.mark.parametrize("margin", [-0.1, 1.0])
def test_a_margin_that_is_none_is_refused(margin: float) -> None:
    """Outside 0 to 1."""
    with pytest.raises(SensorError, match="margin: expected a share from 0 to below 1"):
        rank_sensors([STANCE], sensor_catalogue(), margin=margin)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (LOADS.replace("moment_Nm = [0.0, 15.0, 0.0]", ""), "expected a force_N or moment_Nm that is not zero"),
        (LOADS.replace('"push"', '"stance"'), "expected each name of a load once"),
        (LOADS.replace("moment_Nm", "torque"), "unknown key 'torque'"),
    ],
)
def test_broken_files_of_loads_are_refused(text: str, message: str, tmp_path: Path) -> None:
    """With the file and what is wrong."""
    file = tmp_path / "loads.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=rf"loads\.toml: .*{message}"):
        read_load_cases(file)


def test_the_command(run: Run, tmp_path: Path) -> None:
    """Of a file of loads and own entries, and of one load; the sensor is the first line."""
    for name, text in (("loads.toml", LOADS), ("own.toml", OWN)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    words = ("bench", "sensor", str(tmp_path / "loads.toml"), "--catalogue", str(tmp_path / "own.toml"))
    table = run(*words, "--figure", str(tmp_path / "choice.png"))
    assert table.code == 0, table.err
    assert table.out.startswith("1. own (us)")
    assert (tmp_path / "choice.png").read_bytes().startswith(b"\x89PNG")
    answer = run(*words, "--format", "json").result()
    assert (answer["loads"], answer["sensors"][0]["sensor"]) == (["stance", "push"], "own")
    assert [row["principle"] for row in answer["principles"]][-1] == "piezoelectric"
    one = run("bench", "sensor", "--force", "0,0,1e5")
    assert (one.code, "NO SENSOR HOLDS IT" in one.out) == (0, True)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "expected a file of loads, or --force or --moment"),
        (("--lever", "1,0,0", "--moment", "1,0,0"), "--lever only with --force"),
        (("--force", "0,0"), "expected three numbers x,y,z"),
        (("--force", "0,0,nan"), "expected three numbers x,y,z"),
        (("--force", "0,0,0"), "expected a load that is not zero"),
        (("--force", "1e-300,0,0"), "expected a load of 1e-09 to 1e+12 N or N m"),
        (("--force", "1e308,0,0", "--lever", "0,1e10,0"), "in its largest component, got inf"),
        (("loads.toml", "--force", "0,0,1"), "got both"),
    ],
)
def test_unclear_loads_are_refused(words: tuple[str, ...], message: str, run: Run) -> None:
    """One line and exit code 2."""
    outcome = run("bench", "sensor", *words)
    assert outcome.code == 2
    assert message in " ".join(outcome.err.split())

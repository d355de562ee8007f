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
    """By hand: of the mini45 500 / 1160 and 5 / 20, together 68 %, held with 20 % to spare; 5 % of 1160 N is 58 N."""
    choice = rank_sensors([STANCE], sensor_catalogue(), margin=0.2)
    rows = {(row.sensor, row.calibration): row for row in choice.sensors}
    mini45 = rows["mini45", 1]
    assert mini45.holds is Holds.HELD
    assert mini45.axis_percent == pytest.approx(100 * 500 / 1160)
    assert mini45.combined_percent == pytest.approx(100 * (500 / 1160 + 5 / 20))
    assert (mini45.error_force_N, mini45.error_moment_Nm) == pytest.approx((58.0, 1.0))
    assert mini45.error_of_load_percent == pytest.approx(100 * max(58 / 500, 1 / 5))
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
        (("loads.toml", "--force", "0,0,1"), "got both"),
    ],
)
def test_unclear_loads_are_refused(words: tuple[str, ...], message: str, run: Run) -> None:
    """One line and exit code 2."""
    outcome = run("bench", "sensor", *words)
    assert outcome.code == 2
    assert message in " ".join(outcome.err.split())

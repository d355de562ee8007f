# SPDX-License-Identifier: BSD-3-Clause
"""Known loads: Table 6.1 as it is printed, the sign rule, and tables that are no such thing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, MissingFileError, SensorError, UnitError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.workbench_file import THESIS_TABLE
from forcetorque.workbench.known_loads import BenchLoads, Weights, read_loads
from tests.scenes.benches import thesis_loads

PRINTED = """0.0000 0.0000 51.0120 -7.5243 0.0000 0.0000
0.0000 0.0000 51.0120 0.0000 -7.5243 0.0000
0.0000 0.0000 51.0120 7.5243 0.0000 0.0000
0.0000 0.0000 51.0120 0.0000 7.5243 0.0000
0.0000 0.0000 247.2120 0.0000 0.0000 0.0000
0.0000 0.0000 -247.2120 0.0000 0.0000 0.0000
-247.2120 0.0000 0.0000 0.0000 -1.2361 0.0000
247.2120 0.0000 0.0000 0.0000 1.2361 0.0000
123.6060 214.0919 0.0000 -1.0705 0.6180 0.0000
-123.6060 -214.0919 0.0000 1.0705 -0.6180 0.0000
123.6060 -214.0919 0.0000 1.0705 0.6180 0.0000
-123.6060 214.0919 0.0000 -1.0705 -0.6180 0.0000
-51.0120 0.0000 0.0000 0.0000 -0.2551 -7.1417
-51.0120 0.0000 0.0000 0.0000 -9.4372 0.0000
-51.0120 0.0000 0.0000 0.0000 -0.2551 7.1417
0.0000 -51.0120 0.0000 0.2551 0.0000 -7.1417
0.0000 -51.0120 0.0000 9.4372 0.0000 0.0000
0.0000 -51.0120 0.0000 0.2551 0.0000 7.1417
51.0120 0.0000 0.0000 0.0000 0.2551 -7.1417
51.0120 0.0000 0.0000 0.0000 9.4372 0.0000
51.0120 0.0000 0.0000 0.0000 0.2551 7.1417
0.0000 51.0120 0.0000 -0.2551 0.0000 -7.1417
0.0000 51.0120 0.0000 -9.4372 0.0000 0.0000
0.0000 51.0120 0.0000 -0.2551 0.0000 7.1417"""
"""Wrenches of thesis Table 6.1, digit by digit."""

HEAD = "# gravity_m_per_s2: 9.81\n"
COLUMNS = "name,mass_kg,x_m,y_m,z_m,dx,dy,dz\n"
ROW = "a,5,0,0.1,0,0,0,1\n"


def _printed(wrench: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> str:
    return "\n".join(" ".join(f"{value + 0.0:.4f}".replace("-0.0000", "0.0000") for value in row) for row in wrench)


def test_table_6_1_is_reproduced_to_the_last_printed_digit() -> None:
    """From direction and place of every position; the loads have rank 6."""
    wrench = thesis_loads().wrench
    assert _printed(wrench) == PRINTED
    assert np.linalg.matrix_rank(wrench - wrench.mean(axis=0)) == 6


def test_a_wrong_lever_is_noticed() -> None:
    """Negative control: half a millimetre changes a digit."""
    loads = thesis_loads()
    assert loads.weights is not None
    weights = loads.weights
    moved = Weights(
        mass_kg=weights.mass_kg,
        structure_kg=weights.structure_kg,
        position_m=weights.position_m + [0.0, 0.0, 5e-4],
        direction=weights.direction,
        gravity=weights.gravity,
    )
    assert _printed(moved.wrench(measure_direction=MeasureDirection.CHILD_TO_PARENT)) != PRINTED


def test_the_sign_is_that_of_the_measure_direction() -> None:
    """What acts on the sensor, or what the sensor acts with."""
    other = read_loads(THESIS_TABLE, measure_direction=MeasureDirection.PARENT_TO_CHILD)
    np.testing.assert_array_equal(other.wrench, -thesis_loads().wrench)


def test_masses_and_places_have_units(tmp_path: Path) -> None:
    """The same load in g and mm."""
    (tmp_path / "si.csv").write_text(HEAD + COLUMNS + ROW)
    (tmp_path / "g.csv").write_text(HEAD + "name,mass_g,x_mm,y_mm,z_mm,dx,dy,dz\na,5000,0,100,0,0,0,2\n")
    loads = [
        read_loads(tmp_path / name, measure_direction=MeasureDirection.CHILD_TO_PARENT) for name in ("si.csv", "g.csv")
    ]
    np.testing.assert_allclose(loads[0].wrench, loads[1].wrench, rtol=1e-14)  # rounding of the factors
    np.testing.assert_allclose(loads[0].wrench, [[0.0, 0.0, 49.05, 4.905, 0.0, 0.0]])


@pytest.mark.parametrize(
    ("text", "kind", "message"),
    [
        (COLUMNS + ROW, FormatError, "expected a line `# gravity_m_per_s2: 9.81`"),
        (HEAD + COLUMNS + "a,0,0,0.1,0,0,0,1\n", SensorError, "weight 1: expected a mass above 0 kg, got 0"),
        (HEAD + COLUMNS + "a,nan,0,0.1,0,0,0,1\n", FormatError, ":3: mass_kg: expected a finite number, got 'nan'"),
        (HEAD + COLUMNS + "a,5,0,147.5,0,0,0,1\n", SensorError, "is it in mm"),
        (HEAD + COLUMNS + "a,5,0,0.1,0,0,0,0\n", SensorError, "expected a direction of gravity"),
        (HEAD + COLUMNS + ROW + ROW, SensorError, "'a' again"),
        (HEAD + COLUMNS + "a,5,0,0.1\n", FormatError, ":3: expected 8 fields, got 4"),
        (HEAD + COLUMNS.replace("y_m", "y_mm") + ROW, UnitError, ":2: expected x, y and z in one unit"),
        (HEAD + COLUMNS.replace("mass_kg", "mass") + ROW, UnitError, ":2: expected one column mass_kg or mass_g"),
        (HEAD + COLUMNS, FormatError, "expected a heading and a row per position"),
    ],
)
def test_tables_that_are_none(tmp_path: Path, text: str, kind: type[Exception], message: str) -> None:
    """Each is refused by line and column."""
    path = tmp_path / "loads.csv"
    path.write_text(text)
    with pytest.raises(kind, match=message.replace("`", "`")):
        read_loads(path, measure_direction=MeasureDirection.CHILD_TO_PARENT)


def test_a_table_that_is_no_text_is_refused(tmp_path: Path) -> None:
    """With the byte where it ends to be one."""
    (tmp_path / "loads.csv").write_bytes(b"# gravity_m_per_s2: 9.81\nname,\xb5\n")
    with pytest.raises(
        FormatError, match=r"loads\.csv: expected a table of loads.* no text at byte 30; save it as UTF-8"
    ):
        read_loads(tmp_path / "loads.csv", measure_direction=MeasureDirection.CHILD_TO_PARENT)


def test_a_missing_table_leads_to_the_bundled_one(tmp_path: Path) -> None:
    """Its name stands in the message."""
    with pytest.raises(MissingFileError, match=THESIS_TABLE):
        read_loads(tmp_path / "none.csv", measure_direction=MeasureDirection.CHILD_TO_PARENT)


def test_some_positions_keep_their_weights() -> None:
    """Loads of a part are the part of the loads."""
    loads = thesis_loads()
    part = loads.select([3, 20])
    assert part.names == ("4", "21")
    assert part.weights is not None
    np.testing.assert_array_equal(
        part.weights.wrench(measure_direction=MeasureDirection.CHILD_TO_PARENT), loads.wrench[[3, 20]]
    )


def test_a_wrench_with_an_unknown_component_is_not_known() -> None:
    """One component is enough."""
    wrench = np.ones((2, 6))
    wrench[1, 3] = np.nan
    assert BenchLoads(names=("a", "b"), wrench=wrench, series=("s", "s")).known.tolist() == [True, False]

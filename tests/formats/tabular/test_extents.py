# SPDX-License-Identifier: BSD-3-Clause
"""Ranges of undeclared tables are of all rows, or say of how many: those of the beginning mislead."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.formats.tabular import row_readers as text
from forcetorque.formats.tabular.dialect import LOOKED_AT
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log

ROWS = 40_000
RNG = np.random.default_rng(3)
COLUMNS = {
    "t_s": np.arange(ROWS) * 1e-3,
    **{f"f{axis}": np.round(RNG.normal(0.0, 0.001 * np.arange(ROWS)), 6) for axis in "xyz"},
    **{f"t{axis}": np.round(RNG.normal(0.0, 0.001, ROWS), 6) for axis in "xyz"},
}


def _text(path: Path, last: str = "") -> Path:
    rows = zip(*(map(repr, values.tolist()) for values in COLUMNS.values()), strict=True)
    path.write_text("\n".join([",".join(COLUMNS), *map(",".join, rows)]) + "\n" + last, encoding="utf-8")
    assert path.stat().st_size > 2 * LOOKED_AT
    return path


@pytest.fixture(params=["csv", "parquet"])
def table(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A log whose forces grow to its end, of more rows than are looked at first."""
    path = tmp_path / f"log.{request.param}"
    if request.param == "csv":
        return _text(path)
    pq.write_table(pa.table(COLUMNS), path, row_group_size=ROWS // 4)
    return path


def test_ranges_are_those_of_all_rows(table: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the answer of `inspect`, and in the question of `init`; blocks are smaller than the file."""
    monkeypatch.setattr(text, "BLOCK_SIZE", 1 << 19)
    monkeypatch.setattr("forcetorque.formats.tabular.row_readers.BATCH_ROWS", 1 << 12)
    inspection = inspect_log(table)
    assert inspection.ranges_of is None
    for row in inspection.unread:
        values = COLUMNS[row.column]
        assert (row.rows, row.smallest, row.largest) == (ROWS, values.min(), values.max())
        assert row.mean == pytest.approx(values.mean())
    forces = np.stack([COLUMNS[f"f{axis}"] for axis in "xyz"])
    draft = draft_experiment([table])
    assert f"forces run from {forces.min():.4g} to {forces.max():.4g}, moments" in draft.content
    assert "in the first" not in draft.content


def test_a_row_that_cannot_be_read_ends_the_ranges(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both say of how many rows they are, and `inspect` where the bad one is."""
    monkeypatch.setattr(text, "BLOCK_SIZE", 1 << 19)
    table = _text(tmp_path / "log.csv", last="1.0,2.0,broken,3.0,4.0,5.0,6.0\n")
    inspection = inspect_log(table)
    assert inspection.ranges_of is not None
    assert inspection.ranges_of.startswith("of those in the first ")
    assert inspection.ranges_of.endswith(f"log.csv:{ROWS + 2}: column 'fy': expected a number, got 'broken'")
    rows = int(inspection.ranges_of.split()[5])
    assert ROWS // 2 < rows < ROWS
    assert inspection.unread[1].largest == COLUMNS["fx"][:rows].max()
    assert f"smallest, largest and mean are {inspection.ranges_of}" in "\n".join(map(str, inspection.blocks()))
    assert f" in the first {rows} rows" in draft_experiment([table]).content

# SPDX-License-Identifier: BSD-3-Clause
"""The described form is the written one: same files, columns, types, units and frames."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.recording.storage import recording_schema, write_recording
from forcetorque.recording.stream import QUANTITIES, Labels
from tests.recording.recordings import recording, signal, stream


@pytest.fixture
def written(tmp_path: Path) -> Path:
    """Folder of a recording with one stream that holds every quantity."""
    signals = [signal(name, np.ones((3, len(quantity.columns) or 4))) for name, quantity in QUANTITIES.items()]
    write_recording(tmp_path / "log", recording(stream([1, 2, 3], *signals, sequence=[4, 5, 6])))
    return tmp_path / "log"


def test_the_index_is_the_described_one(written: Path) -> None:
    """Name and version of the form stand in the index that the description names."""
    described = recording_schema()
    index = json.loads((written / described["index"]).read_text(encoding="utf-8"))
    assert index["schema"] == described["schema"]
    assert json.loads(json.dumps(described)) == described


def test_files_have_the_described_columns_and_types(written: Path) -> None:
    """Stamps, counter and every quantity are columns of the described types, and there are no others."""
    described = recording_schema()
    table = pq.read_schema(written / "s.parquet")
    columns = {key for key in described["stream_file"] if key != "QUANTITY"}
    assert columns == {"stamp_ns", "sequence"}
    assert set(table.names) == columns | set(described["quantities"])
    for name in columns:
        assert described["stream_file"][name].startswith("int64")
        assert table.field(name).type == pa.int64()
    assert described["stream_file"]["QUANTITY"].startswith("fixed-size list of float64")
    assert described["quantities"]
    for name in described["quantities"]:
        kind = table.field(name).type
        assert pa.types.is_fixed_size_list(kind)
        assert kind.value_type == pa.float64()


@pytest.mark.parametrize("name", sorted(QUANTITIES))
def test_every_quantity_is_described_as_it_is_written(written: Path, name: str) -> None:
    """Columns and units are those in the file, or the choice that they are from; frames are named or not."""
    described: dict[str, Any] = recording_schema()["quantities"][name]
    field = pq.read_schema(written / "s.parquet").field(name)
    metadata = {key.decode(): json.loads(value) for key, value in field.metadata.items() if not key.startswith(b"PAR")}
    assert set(metadata) == {"columns", "units", "frame"}
    assert len(metadata["columns"]) == len(metadata["units"]) == field.type.list_size
    if QUANTITIES[name].labels is Labels.FIXED:
        assert (described["columns"], described["units"]) == (metadata["columns"], metadata["units"])
    else:
        assert described["columns"].startswith("one per ")
        choice = described["units"]["one per column out of"]
        assert choice == "any" or set(metadata["units"]) <= set(choice)
        assert (choice == "any") is (name == "scalar")
    assert described["frame"] == ("none" if metadata["frame"] is None else "named")
    assert described["description"] == QUANTITIES[name].description


def test_the_page_of_recordings_has_every_quantity() -> None:
    """Its table of columns has a row for each, in the same order, and for nothing else."""
    page = (Path(__file__).parents[2] / "docs" / "recording.md").read_text(encoding="utf-8")
    table = page.partition("## Columns")[2].partition("\n## ")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == list(QUANTITIES)

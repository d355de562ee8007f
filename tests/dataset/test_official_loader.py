# SPDX-License-Identifier: BSD-3-Clause
"""A compensated copy in the official loader of lerobot, whose Python the environment names: it excludes our numpy."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.dataset import compensate_dataset
from tests.dataset.loader import require_loadable
from tests.formats.lerobot.datasets import FPS, tool_episodes, write_dataset

PYTHON = os.environ.get("LEROBOT_PYTHON")
SCRIPT = Path(__file__).with_name("open_in_lerobot.py")
LENGTHS = [40, 30, 30]

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(PYTHON is None, reason="LEROBOT_PYTHON names no Python that has lerobot"),
]


def _run(*words: str, home: Path) -> subprocess.CompletedProcess[str]:
    assert PYTHON is not None
    cleared = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment = cleared | {"HF_HUB_OFFLINE": "1", "HF_HOME": str(home)}
    return subprocess.run([PYTHON, *words], env=environment, capture_output=True, text=True, check=False)


def _opened(root: Path, folder: Path) -> Mapping[str, Any]:
    done = _run(str(SCRIPT), str(root), str(folder / "opened.npz"), home=folder / "hub")
    assert done.returncode == 0, done.stderr[-2000:]
    return np.load(folder / "opened.npz")


def _version(folder: Path) -> str:
    return _run("-c", "from importlib.metadata import version; print(version('lerobot'))", home=folder).stdout.strip()


@pytest.mark.parametrize("layout", ["v2.1", "v3.0"])
def test_the_official_loader_opens_the_copy(tmp_path: Path, layout: str) -> None:
    """It gives every frame of every feature, the task and the statistics that a policy normalises by."""
    release = _version(tmp_path)
    if layout == "v3.0" and release.startswith("0.3."):
        pytest.skip(f"lerobot {release} reads v2.1 only")
    source = write_dataset(tmp_path / "source", tool_episodes(LENGTHS, seed=1), version=layout, per_file=2)
    copy = tmp_path / "copy"
    stated = {"sense": "sensor_to_world", "direction": "child_to_parent", "force_unit": "N", "moment_unit": "N m"}
    compensate_dataset(source, copy, **stated, frame="world")  # type: ignore[arg-type]  # words, each of its choices
    expected = require_loadable(copy)
    opened = _opened(copy, tmp_path)
    assert (opened["episodes"], opened["fps"]) == (len(LENGTHS), FPS)
    assert set(opened["tasks"]) == {"hold"}
    assert {"observation.wrench_compensated", "observation.wrench_compensated_std"} < set(expected)
    for name, values in expected.items():
        np.testing.assert_array_equal(opened[name].reshape(values.shape), values.astype(opened[name].dtype))
        np.testing.assert_allclose(
            np.ravel(opened[f"stats/{name}/mean"]), np.ravel(values.mean(axis=0)), rtol=1e-4, atol=1e-4
        )


def test_the_official_loader_refuses_what_the_description_lacks(tmp_path: Path) -> None:
    """Negative control: a column that info.json does not name."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    if (release := _version(tmp_path)).startswith("0.3."):
        pytest.skip(f"lerobot {release} leaves such a column out")
    root = write_dataset(tmp_path / "source", tool_episodes(LENGTHS, seed=1))
    file = min((root / "data").rglob("*.parquet"))
    table = pq.read_table(file)
    pq.write_table(table.append_column("more", pa.array(np.zeros(len(table)))), file)
    done = _run(str(SCRIPT), str(root), str(tmp_path / "opened.npz"), home=tmp_path / "hub")
    assert done.returncode != 0
    assert not (tmp_path / "opened.npz").exists()

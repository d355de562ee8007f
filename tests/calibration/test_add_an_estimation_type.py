# SPDX-License-Identifier: BSD-3-Clause
"""An offset strategy is a member, a letter and the point about which columns are taken: three types come of it.

This is the recipe of docs/architecture.md, followed on a copy of the library with a sensor whose offset was taken off
before: no offset is estimated.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import forcetorque
from tests.scenes.experiments import edit

TYPE = ("forcetorque", "experiment", "calibration", "estimation_type.py")
MEMBER = '    ONE_SHOT = "one-shot"\n'
LETTER = 'OffsetStrategy.ONE_SHOT: "O"'
REGRESSION = ("forcetorque", "calibration", "thesis", "regression.py")
ORIGIN = "    if strategy is OffsetStrategy.CENTRALISED:\n"
NO_OFFSET = """\
    if strategy is OffsetStrategy.TARED:
        return np.concatenate([np.zeros(moments.channels), estimation.reference_values, zero])
"""

SCRIPT = """
import json
import numpy as np
from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, estimation_type
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.base.errors import FitError
from forcetorque.experiment.loading import fit_options
from forcetorque.experiment.experiment_file_tables import CalibrationTable
from forcetorque.study.candidate_fits import fit_candidates

rng = np.random.default_rng(1)
matrix, raw = rng.normal(size=(6, 6)), 100.0 * rng.normal(size=(200, 6)) + 50.0
data = DataSet(label="a", raw=raw, reference=raw @ matrix.T)
kind = estimation_type("TnTdTO")
try:
    model = calibrate([data], None, regularisation=0.0, kind=kind).fit.model
except FitError as error:
    print(json.dumps({"error": str(error)}))
else:
    study = fit_candidates(
        [data], {"a": ["a"]}, prior=None, variables=(), kinds=[kind], lambdas=[0.0], sphere=None
    )
    file = CalibrationTable.model_validate({"type": "TnTdTO"})
    print(json.dumps({
        "types": list(ESTIMATION_TYPES),
        "matrix_error": float(np.abs(model.matrix - matrix).max()),
        "offset": model.offset.tolist(),
        "studied": [candidate.kind.name for candidate in study.candidates],
        "schema": CalibrationTable.model_json_schema()["properties"]["type"],
        "file": fit_options(file).offset,
        "parts": fit_options(CalibrationTable.model_validate({"offset": "tared"})).offset,
    }))
"""


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """A copy of the library in which the strategy has its member and its letter."""
    source = Path(forcetorque.__file__).parent
    # with what is compiled of the files that stay as they are
    ignored = shutil.ignore_patterns("*.nbi", "*.nbc", "viewer", "report", "cli")
    shutil.copytree(source, tmp_path / "forcetorque", ignore=ignored)
    file = tmp_path.joinpath(*TYPE)
    edit(file, MEMBER, f'{MEMBER}    TARED = "tared"\n')
    edit(file, LETTER, f'{LETTER}, OffsetStrategy.TARED: "T"')
    return tmp_path


def _answer(library: Path) -> dict[str, object]:
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        env={**os.environ, "PYTHONPATH": str(library), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    answer: dict[str, object] = json.loads(done.stdout)
    return answer


def test_its_three_types_are_fitted_studied_and_stated_in_files(library: Path) -> None:
    """A tared sensor's matrix is exact without an offset, and files know the strategy and its types by name."""
    edit(library.joinpath(*REGRESSION), ORIGIN, NO_OFFSET + ORIGIN)
    answer = _answer(library)
    assert answer["types"][-3:] == ["TnTdTO", "TwTdTO", "TwTrTO"]
    assert len(answer["types"]) == 12
    assert answer["matrix_error"] < 1e-12
    assert answer["offset"] == [0.0] * 6
    assert answer["studied"] == ["TnTdTO"]
    assert "TwTrTO" in json.dumps(answer["schema"])
    assert answer["file"] == answer["parts"] == "tared"


@pytest.mark.long
def test_a_strategy_without_its_origin_is_refused(library: Path) -> None:
    """Negative control: it does not pass for one of the others."""
    assert _answer(library) == {"error": "type TnTdTO: no origin of the columns is stated for the offset 'tared'"}

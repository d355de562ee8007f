# SPDX-License-Identifier: BSD-3-Clause
"""A calibration that is put together from rows of others claims no more than they do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.experiment.calibration.calibration_file import Calibration, SessionOffset
from forcetorque.study.study import joined_by_axis
from tests.scenes.calibrations import make_calibration


def _rows(seed: int, values: Sequence[float | None]) -> list[Calibration]:
    """Calibrations with errors of their own; with a temperature that counts from a value, or without."""
    rng, rows = np.random.default_rng(seed), []
    variable = {
        "name": "temperature", "unit": "degC", "prior": None, "minimum": 20.0, "maximum": 30.0,
    }  # fmt: skip
    for value in values:
        plain = make_calibration(matrix=rng.normal(size=(6, 6)), offset=rng.normal(size=6))
        content = plain.model_dump() | {
            "matrix_standard_error": rng.uniform(1, 2, size=(6, 6)),
            "offset_standard_error": rng.uniform(1, 2, size=6),
            "residual_rms": rng.uniform(1, 2, size=6),
        }
        if value is not None:
            numbers = {"coefficients": rng.normal(size=6), "standard_error": rng.uniform(1, 2, size=6)}
            content["variables"] = [variable | numbers | {"reference_value": value}]
        rows.append(Calibration.model_validate(content))
    return rows


def test_standard_errors_of_joined_rows() -> None:
    """Row by row; zero for coefficients that a row does not have."""
    rows = _rows(1, [29.0, None, 29.0, None, 29.0, 29.0])
    joined = joined_by_axis(rows)
    assert joined.offset_standard_error is not None
    assert joined.matrix_standard_error is not None
    assert joined.variables[0].standard_error is not None
    for axis, row in enumerate(rows):
        assert row.offset_standard_error is not None
        assert row.matrix_standard_error is not None
        assert joined.offset[axis] == row.offset[axis]
        assert joined.offset_standard_error[axis] == row.offset_standard_error[axis]
        assert np.array_equal(joined.matrix_standard_error[axis], row.matrix_standard_error[axis])
        assert joined.residual_rms[axis] == row.residual_rms[axis]
        error = row.variables[0].standard_error if row.variables else np.zeros(6)
        assert error is not None
        assert joined.variables[0].standard_error[axis] == error[axis]


def test_an_offset_that_is_moved_to_another_temperature_has_no_standard_error() -> None:
    """It would be that of offset and coefficient together, which is not known; the other errors are."""
    joined = joined_by_axis(_rows(2, [29.0, 29.0, 0.0, 29.0, 29.0, 29.0]))
    assert joined.offset_standard_error is None
    assert joined.matrix_standard_error is not None
    assert joined.variables[0].reference_value == 29.0
    kept = joined_by_axis(_rows(2, [0.0] * 6))
    assert kept.offset_standard_error is not None


def test_what_one_row_lacks_nobody_claims() -> None:
    """A matrix without standard errors, from a single block, leaves none for the whole; no variable, no column."""
    rows = _rows(3, [None] * 6)
    rows[2] = rows[2].model_copy(update={"matrix_standard_error": None, "offset_standard_error": None})
    joined = joined_by_axis(rows)
    assert joined.matrix_standard_error is None
    assert joined.offset_standard_error is None
    assert joined.variables == ()


def test_joined_rows_are_worth_what_the_weakest_is() -> None:
    """Validity is that of the row whose data excite the fewest directions."""
    rows = _rows(4, [None] * 6)
    weak = rows[4].validity.model_copy(update={"excited": (True,) * 4 + (False,) * 2, "rank": 4})
    rows[4] = rows[4].model_copy(update={"validity": weak})
    assert joined_by_axis(rows).validity is weak


def test_every_session_has_the_offset_of_its_rows() -> None:
    """Also a session that some rows do not know, which give theirs; a drift or posterior of one row is nobody's."""
    rows = _rows(5, [None] * 6)
    rng = np.random.default_rng(6)
    for k, names in enumerate((("a", "b"), ("b",), (), ("a",), ("a", "b"), ("b",))):
        sessions = [
            SessionOffset(
                name=name, offset=rng.normal(size=6), standard_error=rng.uniform(1, 2, size=6), prior_offset=None
            )
            for name in names
        ]
        rows[k] = rows[k].model_copy(update={"sessions": tuple(sessions)})
    joined = joined_by_axis(rows)
    assert [session.name for session in joined.sessions] == ["a", "b"]
    for session in joined.sessions:
        expected = [row.in_session(session.name).offset[axis] for axis, row in enumerate(rows)]
        np.testing.assert_array_equal(session.offset, expected)
        assert session.standard_error is not None
        assert session.drift_per_s is None
    # negative control: the two sessions differ, and from the rest
    assert not np.array_equal(joined.sessions[0].offset, joined.sessions[1].offset)
    assert not np.array_equal(joined.sessions[0].offset, joined.offset)
    assert joined.posterior is None

# SPDX-License-Identifier: BSD-3-Clause
"""Arrays without rows come back from JSON, which keeps no lengths of lists that are not there."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import pytest
from pydantic import ValidationError

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.stored_table import StoredTable


class _Kept(StoredTable):
    table: Annotated[FloatArray, ArrayField((None, 3))]


class _Fixed(StoredTable):
    vector: Annotated[FloatArray, ArrayField((3,))]


def test_a_table_without_rows_keeps_its_columns() -> None:
    """Moments of a sensor without variables are kept so."""
    assert _Kept.model_validate_json(_Kept(table=np.zeros((0, 3))).model_dump_json()).table.shape == (0, 3)


def test_an_empty_list_is_no_vector() -> None:
    """A vector of three numbers is not made of none, nor a table of rows of another length."""
    with pytest.raises(ValidationError, match="shape"):
        _Fixed(vector=[])  # type: ignore[arg-type]
    with pytest.raises(ValidationError, match="shape"):
        _Kept(table=[[1.0, 2.0]])  # type: ignore[arg-type]

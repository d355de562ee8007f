# SPDX-License-Identifier: BSD-3-Clause
"""What every table of the experiment file shares: unknown keys are errors, numbers are numbers."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.errors import known_names


class Table(BaseModel):
    """A table of the file; a key that it does not know is an error that lists the known ones."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True)

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, values: Any) -> Any:
        known = {field.alias or name for name, field in cls.model_fields.items()}
        for key in values if isinstance(values, dict) else ():
            if key not in known:
                raise PydanticCustomError(
                    "unknown_key", "{message}", {"message": f"unknown key {key!r}; {known_names(key, known)}"}
                )
        return values


Text = Annotated[str, Field(min_length=1)]
# strict: a text or a flag is no number
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False, strict=True)]
Finite = Annotated[float, Field(allow_inf_nan=False, strict=True)]

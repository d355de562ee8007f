# SPDX-License-Identifier: BSD-3-Clause
"""Mappings that nobody can change, which one process may hand to another and a script may copy."""

from __future__ import annotations

import copyreg
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, TypeVar

_Key = TypeVar("_Key")
_Value = TypeVar("_Value")


def read_only_mapping(mapping: Mapping[_Key, _Value]) -> MappingProxyType[_Key, _Value]:
    """Copy a mapping to one that nobody can change afterwards.

    Args:
        mapping: Any mapping.

    Returns:
        The copy.
    """
    return MappingProxyType(dict(mapping))


def _reduced(
    mapping: MappingProxyType[Any, Any],
) -> tuple[Callable[..., MappingProxyType[Any, Any]], tuple[dict[Any, Any]]]:
    return read_only_mapping, (dict(mapping),)


# Python pickles and deep-copies everything that an experiment holds but these: without it no experiment goes to
# another process
copyreg.pickle(MappingProxyType, _reduced)

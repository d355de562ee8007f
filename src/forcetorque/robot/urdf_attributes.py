# SPDX-License-Identifier: BSD-3-Clause
"""Attributes of URDF elements: numbers and poses, with errors that name file, element and attribute."""

from __future__ import annotations

import math
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import make_pose, rotation_from_rpy


@dataclass(frozen=True, slots=True)
class UrdfPlace:
    """Where in a file we are, for messages."""

    text: str
    """File and elements, outermost first."""

    def inside(self, element: str) -> UrdfPlace:
        """Go one element deeper.

        Args:
            element: The element as a reader would recognise it.

        Returns:
            The place inside it.
        """
        return UrdfPlace(f"{self.text}: {element}")

    def error(self, expected: str, got: str) -> FormatError:
        """Build the error to raise here.

        Args:
            expected: What should stand here.
            got: What stands here.

        Returns:
            The error, not raised.
        """
        return FormatError(f"{self.text}: expected {expected}, got {got}")


def required(place: UrdfPlace, element: Element, attribute: str) -> str:
    """Give an attribute that must be there.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.

    Returns:
        Its text, not empty.

    Raises:
        FormatError: If it is missing or empty.
    """
    text = element.get(attribute)
    if not text:
        raise place.error(f"the attribute {attribute}", "none" if text is None else "an empty text")
    return text


def numbers(place: UrdfPlace, element: Element, attribute: str, *, count: int) -> FloatArray:
    """Give an attribute that holds numbers.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.
        count: How many numbers it must hold.

    Returns:
        The numbers; shape (count,).

    Raises:
        FormatError: If it does not hold that many finite numbers.
    """
    text = required(place, element, attribute)
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        raise place.error(f"{count} number(s) in {attribute}", f"{text!r}") from None
    if len(values) != count or not all(math.isfinite(value) for value in values):
        raise place.error(f"{count} finite number(s) in {attribute}", f"{text!r}")
    return np.array(values)


def number(place: UrdfPlace, element: Element, attribute: str, *, default: float | None = None) -> float:
    """Give an attribute that holds one number.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.
        default: Value of the specification where the attribute is absent; None if it must be there.

    Returns:
        The number.

    Raises:
        FormatError: If it is required and missing, or not one finite number.
    """
    if default is not None and element.get(attribute) is None:
        return default
    return float(numbers(place, element, attribute, count=1)[0])


def optional_number(place: UrdfPlace, element: Element, attribute: str) -> float | None:
    """Give an attribute that holds one number, if it is there.

    Args:
        place: Where the element is.
        element: The element.
        attribute: Name of the attribute.

    Returns:
        The number; None where the attribute is absent.

    Raises:
        FormatError: If it is there and not one finite number.
    """
    return None if element.get(attribute) is None else number(place, element, attribute)


def origin(place: UrdfPlace, element: Element | None) -> FloatArray:
    """Give the pose that an element's `<origin>` states; the identity where there is none.

    Args:
        place: Where the element is.
        element: Element that may hold an `<origin xyz=... rpy=...>`.

    Returns:
        Pose; shape (4, 4); translation in m.

    Raises:
        FormatError: If an attribute is not three finite numbers.
    """
    tag = None if element is None else element.find("origin")
    if tag is None:
        return np.eye(4)
    inner = place.inside("<origin>")
    vectors = {key: numbers(inner, tag, key, count=3) for key in ("xyz", "rpy") if tag.get(key) is not None}
    zero = np.zeros(3)
    return make_pose(rotation_from_rpy(vectors.get("rpy", zero)), vectors.get("xyz", zero))

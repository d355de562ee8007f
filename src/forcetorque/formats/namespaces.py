# SPDX-License-Identifier: BSD-3-Clause
"""Namespaces of topics, by which several robots in one log are told apart: `/right/tf` belongs to `/right/ft`."""

from __future__ import annotations


def namespace_of(topic: str) -> str:
    """Give the namespace of a topic.

    Args:
        topic: Its name.

    Returns:
        What stands in front of its last part, such as `/right`; empty for none.
    """
    return f"/{topic.strip('/')}".rpartition("/")[0]


def namespace_depth(topic: str, other: str) -> int:
    """Measure how near another topic is to a topic.

    Args:
        topic: The topic.
        other: The other topic.

    Returns:
        Length of the namespace of the other topic; -1 if the topic is not in that namespace.
    """
    namespace = namespace_of(other)
    return len(namespace) if f"/{topic.strip('/')}".startswith(f"{namespace}/") else -1

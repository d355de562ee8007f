# SPDX-License-Identifier: BSD-3-Clause
"""The messages of a topic, decoded to batches in which all fields lie at the same places."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from forcetorque.base.arrays import IntArray
from forcetorque.formats.kept_parts import are_kept, kept
from forcetorque.formats.ros.bag import Bag
from forcetorque.formats.ros.messages import MESSAGES, Batch, decode


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TopicBatch:
    """Messages of a topic that are alike; n of them."""

    batch: Batch
    """Where their fields lie."""
    numbers: IntArray
    """Their places among all messages of the topic; shape (n,)."""
    received: IntArray
    """When the recorder had them; shape (n,); ns."""


def topic_batches(bag: Bag, topic: str) -> Iterable[TopicBatch]:
    """Decode the messages of a topic, of a type in `MESSAGES`.

    Args:
        bag: The bag.
        topic: The topic.

    Returns:
        Its batches: all of them where parts are kept, else one after the other.
    """
    if not are_kept():
        return _decoded(bag, topic)
    return kept(bag.path, f"topic {topic}", lambda: tuple(_decoded(bag, topic)))


def _decoded(bag: Bag, topic: str) -> Iterator[TopicBatch]:
    find, first = MESSAGES[bag.types[topic]], 0
    for received, messages in bag.messages(topic):
        for batch in decode(messages, find, cdr=bag.cdr, topic=f"{bag.path}: {topic}"):
            yield TopicBatch(batch=batch, numbers=first + batch.rows, received=received[batch.rows])
        first += len(messages)

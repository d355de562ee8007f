# SPDX-License-Identifier: BSD-3-Clause
"""A peer of zenoh that carries messages of ROS 2; it listens on this machine only, and does without multicast."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from forcetorque.base.errors import RecordingError, needs_extra

ROUTER: Final = "tcp/localhost:7447"
"""Where `rmw_zenohd` listens."""


class ZenohSession:
    """Carries messages, as of `RosSession`."""

    def __init__(self, session: Any) -> None:
        """Begin.

        Args:
            session: An open session of zenoh.
        """
        self._session = session
        # what is declared lasts as long as it is held
        self._held: list[Any] = []

    def subscribe(self, key: str, take: Callable[[bytes, bytes | None], None]) -> None:
        """Hear messages, as of `RosSession`."""

        def received(sample: Any) -> None:
            attached = sample.attachment
            take(sample.payload.to_bytes(), None if attached is None else attached.to_bytes())

        self._held.append(self._session.declare_subscriber(key, received))

    def publisher(self, key: str) -> Callable[[bytes, bytes], None]:
        """Give what sends messages, as of `RosSession`."""
        publisher = self._session.declare_publisher(key)
        self._held.append(publisher)
        return lambda message, attached: publisher.put(message, attachment=attached)

    def announce(self, token: str) -> None:
        """Show something to the graph of ROS, as of `RosSession`."""
        named = token.replace("{zid}", str(self._session.info.zid()))
        self._held.append(self._session.liveliness().declare_token(named))


@contextmanager
def zenoh_session(endpoint: str = ROUTER) -> Iterator[ZenohSession]:
    """Open a peer.

    Args:
        endpoint: Router or peer that it connects to, again and again until it is there, as `tcp/localhost:7447`.

    Yields:
        The session.

    Raises:
        MissingExtraError: If zenoh is not installed.
        RecordingError: If the endpoint is none.
    """
    with needs_extra("--ros2: topics are carried by zenoh", "zenoh"):
        import zenoh
    config = zenoh.Config()
    try:
        config.insert_json5("mode", json.dumps("peer"))
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        config.insert_json5("listen/endpoints", json.dumps(["tcp/127.0.0.1:0"]))
        config.insert_json5("scouting/multicast/enabled", json.dumps(False))
        session: Any = zenoh.open(config)
    except zenoh.ZError as error:
        raise RecordingError(f"--router: expected an endpoint, as {ROUTER}, got {endpoint!r}: {error}") from None
    try:
        yield ZenohSession(session)
    finally:
        session.close()

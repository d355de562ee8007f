# SPDX-License-Identifier: BSD-3-Clause
"""A pool without processes, for tests of what plans do."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from forcetorque.base.errors import ForceTorqueError
from forcetorque.fleet.process_pool import Outcome, failed


class InProcess:
    """A pool that runs everything in this process, the last argument first."""

    def outcomes(self, function: Callable[[Any], Any], arguments: Sequence[Any]) -> Iterator[Outcome[Any]]:
        """Run the function, as processes do."""
        for index, argument in reversed(list(enumerate(arguments))):
            try:
                yield Outcome(index=index, value=function(argument))
            except ForceTorqueError as error:
                yield failed(index, error)

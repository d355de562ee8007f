# SPDX-License-Identifier: BSD-3-Clause
"""Run a function on many arguments in processes of this machine or on a Dask cluster; what fails is an outcome."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final, Generic, Protocol, TypeVar

from forcetorque.base.errors import ChangingFileError, ForceTorqueError, MissingFileError, OutputError, needs_extra

_Argument = TypeVar("_Argument")
_Value = TypeVar("_Value")

_THREADS: Final[Mapping[str, str]] = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_WAIT_S: Final = 10.0
"""How long a scheduler may take to answer; s."""
_LOOK_S: Final = 1.0
"""How often a cluster is looked after that gives no result; s."""
_LOOKS: Final = 60
"""How often in a row it may have no worker until what is left of the jobs is given up."""
_DIED: Final = "its process ended without a result: killed, or out of memory"
_LOST: Final = "the cluster lost the job: its scheduler was restarted, or all workers ended; run the plan again"


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome(Generic[_Value]):
    """What became of one argument."""

    index: int
    """Place of the argument."""
    value: _Value | None = None
    """What the function returned; None where it failed."""
    error: str | None = None
    """What went wrong, in one line; None where nothing did."""
    is_of_data: bool = False
    """Whether the same data give the error again: not of a process that was killed, a disk or a missing file."""


class Pool(Protocol):
    """Runs a function on arguments."""

    def outcomes(
        self, function: Callable[[_Argument], _Value], arguments: Sequence[_Argument]
    ) -> Iterator[Outcome[_Value]]:
        """Run a function on every argument.

        Args:
            function: Function of a module, which another process can import.
            arguments: Its arguments, which can be pickled.

        Yields:
            What became of each, as they are done, in any order.
        """


def failed(index: int, error: BaseException) -> Outcome[Any]:
    """Give the outcome of an argument whose function raised an error.

    Args:
        index: Place of the argument.
        error: The error.

    Returns:
        The error in one line; with its type where it is none of this library.
    """
    if type(error).__name__ == "KilledWorker":  # of distributed, an extra
        return Outcome(index=index, error=_DIED)
    text = " ".join(str(error).split())
    line = text if isinstance(error, ForceTorqueError | OSError) else f"{type(error).__name__}: {text}"
    passing = isinstance(error, ChangingFileError | MissingFileError | OutputError)
    return Outcome(index=index, error=line, is_of_data=isinstance(error, ForceTorqueError) and not passing)


def _outcome(index: int, future: Future[_Value]) -> Outcome[_Value]:
    if future.cancelled():  # by a cluster
        return Outcome(index=index, error=_LOST)
    error = future.exception()
    return Outcome(index=index, value=future.result()) if error is None else failed(index, error)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalPool:
    """Processes of this machine, started afresh and with one thread each."""

    workers: int
    """Number of processes."""

    def outcomes(
        self, function: Callable[[_Argument], _Value], arguments: Sequence[_Argument]
    ) -> Iterator[Outcome[_Value]]:
        """Run a function on every argument; one that ends its process takes nothing with it.

        Args:
            function: As of `Pool`.
            arguments: As of `Pool`.

        Yields:
            As of `Pool`.
        """
        waiting = list(enumerate(arguments))[::-1]
        with _one_thread_each():
            while waiting:
                suspects: list[tuple[int, _Argument]] = []
                yield from self._until_broken(function, waiting, suspects)
                for index, argument in suspects:
                    # whichever of them ended the process ends its own again
                    with self._executor(1) as alone:
                        (outcome,) = [_outcome(index, alone.submit(function, argument))]
                    died = outcome.error is not None and outcome.error.startswith(BrokenProcessPool.__name__)
                    yield Outcome(index=index, error=_DIED) if died else outcome

    def _until_broken(
        self,
        function: Callable[[_Argument], _Value],
        waiting: list[tuple[int, _Argument]],
        suspects: list[tuple[int, _Argument]],
    ) -> Iterator[Outcome[_Value]]:
        """Work off what is waiting; where a process dies, what ran then becomes suspect, and the rest keeps waiting."""
        running: dict[Future[_Value], tuple[int, _Argument]] = {}
        executor = self._executor(self.workers)
        try:
            while waiting or running:
                while waiting and len(running) < self.workers:
                    index, argument = waiting.pop()
                    running[executor.submit(function, argument)] = (index, argument)
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in done:
                    index, argument = running.pop(future)
                    if isinstance(future.exception(), BrokenProcessPool):
                        suspects.append((index, argument))
                    else:
                        yield _outcome(index, future)
                if suspects:
                    suspects.extend(running.values())
                    return
        except BrokenProcessPool:  # a process died between two jobs
            suspects.append((index, argument))
            suspects.extend(running.values())
        finally:
            executor.shutdown(wait=True, cancel_futures=True)

    @staticmethod
    def _executor(workers: int) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Let processes that are started inside have one thread of linear algebra each: there is one for every core."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(_THREADS)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@dataclass(frozen=True, slots=True, kw_only=True)
class DaskPool:
    """An existing cluster of `dask.distributed`, whose workers see the same folders."""

    address: str
    """Address of its scheduler, such as `tcp://127.0.0.1:8786`."""

    def outcomes(
        self, function: Callable[[_Argument], _Value], arguments: Sequence[_Argument]
    ) -> Iterator[Outcome[_Value]]:
        """Run a function on every argument.

        Args:
            function: As of `Pool`.
            arguments: As of `Pool`.

        Yields:
            As of `Pool`; jobs of a worker that ended run on another one.
        """
        with self._client() as client:
            executor = client.get_executor(pure=False)
            pending = {executor.submit(function, argument): index for index, argument in enumerate(arguments)}
            in_vain = 0
            while pending:
                done, _ = wait(pending, timeout=_LOOK_S, return_when=FIRST_COMPLETED)
                for future in done:
                    yield _outcome(pending.pop(future), future)
                in_vain = 0 if done or _has_worker(client) else in_vain + 1
                if in_vain == _LOOKS:
                    yield from (Outcome(index=index, error=_LOST) for index in pending.values())
                    return

    @contextmanager
    def _client(self) -> Iterator[Any]:
        with needs_extra("--dask needs dask.distributed", "fleet"):
            from distributed import Client
        try:
            connect: Any = Client  # without types of its own
            client = connect(self.address, timeout=_WAIT_S, set_as_default=False)
        except (OSError, ValueError, TimeoutError) as error:
            raise ForceTorqueError(
                f"--dask {self.address}: expected the scheduler of a Dask cluster, none answered within {_WAIT_S:g} s "
                f"({type(error).__name__}); start one with `dask scheduler`, or leave --dask out"
            ) from error
        with client:
            yield client


def _has_worker(client: Any) -> bool:
    """Whether a cluster answers and has a worker."""
    if client.status != "running":
        return False
    try:
        return bool(client.nthreads())
    except (OSError, TimeoutError):
        return False

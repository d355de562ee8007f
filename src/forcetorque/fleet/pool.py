# SPDX-License-Identifier: BSD-3-Clause
"""Run a function on many arguments in processes of this machine or on a Dask cluster; what fails is an outcome."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, as_completed, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Final, Generic, Protocol, TypeVar

from forcetorque.base.errors import ForceTorqueError, MissingExtraError, MissingFileError, OutputError, install_line

_Argument = TypeVar("_Argument")
_Value = TypeVar("_Value")

_THREADS: Final[Mapping[str, str]] = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_WAIT_S: Final = 10.0
"""How long a scheduler may take to answer; s."""
_DIED: Final = "its process ended without a result: killed, or out of memory"


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


def error_line(error: BaseException) -> str:
    """Write an error in one line.

    Args:
        error: The error.

    Returns:
        The message; with its type where it is none of this library.
    """
    text = " ".join(str(error).split())
    return text if isinstance(error, ForceTorqueError | OSError) else f"{type(error).__name__}: {text}"


def _outcome(index: int, future: Future[_Value]) -> Outcome[_Value]:
    error = future.exception()
    if error is None:
        return Outcome(index=index, value=future.result())
    of_data = isinstance(error, ForceTorqueError) and not isinstance(error, MissingFileError | OutputError)
    return Outcome(index=index, error=error_line(error), is_of_data=of_data)


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
            As of `Pool`.
        """
        with self._executor() as executor:
            futures = {executor.submit(function, argument): index for index, argument in enumerate(arguments)}
            for future in as_completed(futures):
                yield _outcome(futures[future], future)

    @contextmanager
    def _executor(self) -> Iterator[Executor]:
        try:
            from distributed import Client
        except ImportError:
            raise MissingExtraError(f"--dask needs dask.distributed: {install_line('fleet')}") from None
        try:
            client: Any = Client(self.address, timeout=_WAIT_S, set_as_default=False)
        except (OSError, ValueError, TimeoutError) as error:
            raise ForceTorqueError(
                f"--dask {self.address}: expected the scheduler of a Dask cluster, none answered within {_WAIT_S:g} s "
                f"({type(error).__name__}); start one with `dask scheduler`, or leave --dask out"
            ) from error
        with client:
            yield client.get_executor(pure=False)

# SPDX-License-Identifier: BSD-3-Clause
"""Live correction: cost of a call, bias of a tare on a moving arm, a drift that is tracked, losses, an hour of samples.

The peer is a plain loop of `matrix @ x + b` over six sensors in the same run; it gives no interval and no status.
"""

from __future__ import annotations

import gc
import resource
import threading
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from scipy.signal import lfilter

from benchmarks.harness import arguments, median_ratio, write_result
from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import NORMAL_95, STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.provenance import Provenance, Selection, SensorIdentity, Validity
from forcetorque.live.bias_tracking_and_tare import Tracking
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.loop import LiveLoop
from forcetorque.live.option_values import OffsetSource
from forcetorque.live.outputs import parquet_file
from forcetorque.live.packets import NUMBERS, Packet, PacketAccount, PacketCounts
from forcetorque.live.recent_samples import RecentSamples
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.motion import RootMotion
from forcetorque.simulation.simulated_sensor import y_shaped_matrix

SENSORS = 6
MATRIX = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
NOISE = np.repeat([0.05, 0.001], 3)
"""White noise of a sample; N, N m."""
TOOL = Tool(mass_kg=0.9, centre_m=np.array([0.01, -0.005, 0.06]))


def calibration_of(name: str) -> Calibration:
    """Make a calibration with a posterior of six rows."""
    posterior = Posterior(
        space="wrench", variables=(), sessions=("day",), drift=False, mean=np.zeros((6, 7)),
        covariance=np.broadcast_to(np.diag([1e-6] * 6 + [1e-3]), (6, 7, 7)),
        mean_covariance=np.broadcast_to(np.eye(6) * 1e-6, (6, 6, 6)), prior_covariance=None, to_wrench=np.eye(6),
        noise=(), accuracy=np.zeros(6), repeatability=0.0, load_centre=np.zeros(6),
    )  # fmt: skip
    return Calibration(
        sensor=SensorIdentity(
            name=name, serial=name, robot="simulated", frame="child", measure_direction=MeasureDirection.CHILD_TO_PARENT
        ),
        matrix=MATRIX, offset=np.zeros(6), estimation_type="generative", posterior=posterior,
        matrix_standard_error=None, offset_standard_error=None, residual_rms=np.ones(6), lambda_counts2=None,
        prior=None,
        validity=Validity(
            raw_minimum_counts=np.full(6, -3e4), raw_maximum_counts=np.full(6, 3e4), expected_wrench_sd=np.ones(6),
            rank=6, condition=1.0, directions=np.eye(6), variance_counts2=np.ones(6), explained=np.ones(6),
            excited=(True,) * 6,
        ),
        selection=Selection(rule="given"),
        provenance=Provenance(
            code_version="benchmark", created="", experiment="", intervals=(), samples=1, dropped=0, inputs_sha256={}
        ),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class ContactOutcome:
    """What tracking made of a drift and a contact."""

    error_N: float
    """Largest error of the bias of Fx outside the contact, from half of the time before it on; N."""
    moved_in_contact_N: float
    """How far the bias of Fx moved between the begin of the contact and its end; N."""
    contact_s: float
    """Time for which the filter saw a contact; s."""


def biased_contact(
    *, seconds: float, rate_hz: float, contact_s: tuple[float, float], seed: int, tracking: Tracking | None = None
) -> ContactOutcome:
    """Track a bias that drifts by 1 N per hour while 5 N touch for some time.

    Args:
        seconds: Length; s.
        rate_hz: Rate of samples; Hz.
        contact_s: Begin and end of the contact; s.
        seed: Of the noise.
        tracking: How it is tracked; as by default if None.

    Returns:
        What became of it.
    """
    options = CorrectorOptions(offset=OffsetSource.TRACKED, tare_s=5.0, tracking=tracking or Tracking())
    corrector, inverse = Corrector(calibration_of("leg"), options), np.linalg.inv(MATRIX)
    rng, count = np.random.default_rng(seed), round(seconds * rate_hz)
    times = np.arange(count) / rate_hz
    wrenches = rng.normal(0.0, NOISE, (count, 6))
    drift = times / 3600.0
    wrenches[:, 0] += drift
    touching = (times >= contact_s[0]) & (times < contact_s[1])
    wrenches[touching, 0] += 5.0
    samples = wrenches @ inverse.T
    bias, contact = np.zeros(count), 0
    for k in range(count):
        corrector.correct(samples[k], stamp_ns=round(times[k] * 1e9))
        bias[k] = corrector.bias[0, 0]
        contact += corrector.tracker is not None and bool(corrector.tracker.in_contact[0])
    settled = (times > contact_s[0] / 2.0) & ~touching
    begin, end = np.searchsorted(times, contact_s)
    return ContactOutcome(
        error_N=float(np.abs(bias - drift)[settled].max()),
        moved_in_contact_N=float(abs(bias[end - 1] - bias[begin - 1])),
        contact_s=contact / rate_hz,
    )


def tares_of_a_moving_arm(seeds: Iterable[int]) -> int:
    """Tare sensors that carry a tool on an arm that moves.

    The arm turns its wrist by up to a radian about two axes within seconds; the tool accelerates at random by 0.05
    m/s2, which the tare takes for noise, and the noise of the sensor is white with a slow part.

    Args:
        seeds: A run each.

    Returns:
        Runs in which the bias of one component, of the six in turn, lies in its 95 % interval.
    """
    inverse, inside = np.linalg.inv(MATRIX), 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        inside += _tare_holds(rng, inverse, component=seed % 6)
    return inside


def _tare_holds(rng: np.random.Generator, inverse: FloatArray, component: int) -> bool:
    rate_hz, seconds = 25.0, 20.0
    options = CorrectorOptions(offset=OffsetSource.TARE, tare_s=seconds, tool=TOOL)
    corrector = Corrector(calibration_of("wrist"), options)
    weight = TOOL.per_gravity(MeasureDirection.CHILD_TO_PARENT)
    bias = rng.normal(0.0, np.repeat([5.0, 0.2], 3))
    count = round(rate_hz * seconds) + 2
    times, phase = np.arange(count) / rate_hz, rng.uniform(0.0, 2.0 * np.pi, 2)
    a, b = np.sin(2.0 * np.pi * 0.21 * times + phase[0]), np.sin(2.0 * np.pi * 0.13 * times + phase[1])
    gravity = STANDARD_GRAVITY * np.column_stack([np.sin(b), -np.sin(a) * np.cos(b), -np.cos(a) * np.cos(b)])
    # both forget themselves within half a second
    acceleration = lfilter([0.4], [1.0, -0.92], rng.normal(0.0, 0.05, (count, 3)), axis=0)
    slow = lfilter([0.4], [1.0, -0.92], rng.normal(0.0, NOISE, (count, 6)), axis=0)
    wrenches = (gravity + acceleration) @ weight.T + bias + slow + rng.normal(0.0, NOISE, (count, 6))
    samples = wrenches @ inverse.T
    for k in range(count):
        corrector.correct(samples[k], stamp_ns=round(times[k] * 1e9), gravity=gravity[k])
    half_width = NORMAL_95 * np.sqrt(corrector.bias_variance[0, component])
    return bool(abs(corrector.bias[0, component] - bias[component]) <= half_width)


class _Simulated:
    """A source of one sensor at 1 kHz, which loses, repeats and delays packets."""

    def __init__(self, count: int) -> None:
        self.counts, self._count, self.lost = PacketCounts(), count, 0
        self.rate_hz: float | None = None
        self.numbers = NUMBERS

    def packets(self) -> Iterator[Packet | None]:
        rng = np.random.default_rng(0)
        samples = 300.0 + rng.normal(0.0, 2.0, (4096, 1, 6))
        for number in range(self._count):
            if number % 997 == 996:
                self.lost += 1
                continue
            packet = Packet(values=samples[number & 4095], stamp_ns=number * 1_000_000, sequence=number)
            yield packet
            if number % 1009 == 1008:
                yield packet


def one_hour(count: int) -> dict[str, float]:
    """Run samples of 1 kHz through the loop into a Parquet file, and look at time and memory."""
    source = _Simulated(count)
    loop_memory = []
    options = CorrectorOptions(offset=OffsetSource.TRACKED, limit_counts=32768.0)
    with TemporaryDirectory() as folder, parquet_file(Path(folder) / "hour.parquet") as output:
        loop = LiveLoop(source, [Corrector(calibration_of("leg"), options)], [output], clock=time.monotonic)
        packets = source.packets

        def watched() -> Iterator[Packet | None]:
            for number, packet in enumerate(packets()):
                if number % (count // 10) == 0:
                    loop_memory.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)
                yield packet

        source.packets = watched  # type: ignore[method-assign]
        begun = time.perf_counter()
        result = loop.result(loop.run())
        seconds = time.perf_counter() - begun
    return {
        "samples": count,
        "seconds": seconds,
        "times_real_time": count / 1000.0 / seconds,
        "memory_after_a_tenth_MB": loop_memory[1],
        "memory_at_the_end_MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        "lost_by_the_source": source.lost,
        "lost_as_counted": result.packets.lost or 0,
        "repeated_as_counted": result.packets.repeated,
    }


def miscounted_losses(seeds: Iterable[int], *, clock: float, jitter: float) -> tuple[int, int]:
    """Count losses by time where a sender of 500 Hz, as stated, is off its rate and 1 % of its samples are lost.

    Args:
        seeds: A run of 5000 samples each.
        clock: Its period over the stated one.
        jitter: Standard deviation of its stamps; periods.

    Returns:
        Largest difference between counted and lost samples of a run, and samples that were lost in all runs.
    """
    period_ns, worst, lost = 2e6, 0, 0
    for seed in seeds:
        rng, account = np.random.default_rng(seed), PacketAccount(500.0)
        sent = rng.random(5000) >= 0.01
        sent[[0, -1]] = True
        stamps = (clock * np.arange(5000) + rng.normal(0.0, jitter, 5000)) * period_ns
        for stamp in np.round(stamps[sent]).astype(np.int64).tolist():
            account.add(Packet(values=np.zeros((1, 6)), stamp_ns=stamp))
        worst = max(worst, abs(account.counts.lost - int((~sent).sum())))
        lost += int((~sent).sum())
    return worst, lost


def cost_of_calls(rounds: int) -> tuple[dict[str, list[float]], float]:
    """Time calls for six sensors, one by one, in turn with the peer.

    Returns:
        Seconds of every call by name, and the largest difference between the wrenches of both; N, N m.
    """
    calibrations = [calibration_of(f"sensor {k}") for k in range(SENSORS)]
    tracked = CorrectorOptions(offset=OffsetSource.TRACKED, tare_s=0.1)
    plain, tracking = Corrector(calibrations), Corrector(calibrations, tracked)
    samples = np.random.default_rng(0).normal(0.0, 300.0, (1000, SENSORS, 6))
    matrices, offsets = [one.matrix for one in calibrations], [one.offset for one in calibrations]
    seconds: dict[str, list[float]] = {"live": [], "tracked": [], "loop": []}
    difference, wrenches = 0.0, [np.zeros(6)] * SENSORS
    for number in range(rounds + 1000):
        sample, stamp = samples[number % 1000], number * 1_000_000
        times = [time.perf_counter()]
        given = plain.correct(sample, stamp_ns=stamp)
        times.append(time.perf_counter())
        tracking.correct(sample, stamp_ns=stamp)
        times.append(time.perf_counter())
        for k in range(SENSORS):
            wrenches[k] = matrices[k] @ sample[k] + offsets[k]
        times.append(time.perf_counter())
        if number < 1000:  # warming up
            difference = max(difference, float(np.abs(given.wrench - np.array(wrenches)).max()))
            continue
        for name, before, after in zip(seconds, times[:-1], times[1:], strict=True):
            seconds[name].append(after - before)
    return seconds, difference


def cost_of_being_shown(count: int, rounds: int) -> dict[str, float]:
    """Time the loop for six sensors alone, with the ring of a page, and with a thread that reads all of it.

    Args:
        count: Samples of a round.
        rounds: Rounds of all three in turn.

    Returns:
        Median over the rounds of the processor time of the run's own thread for a sample; us.
    """
    corrector = Corrector([calibration_of(f"sensor {k}") for k in range(SENSORS)])
    samples = np.random.default_rng(11).normal(0.0, 300.0, (1000, SENSORS, 6))
    seconds: dict[str, list[float]] = {"alone": [], "ring": [], "read": []}
    for _ in range(rounds + 1):
        for name, values in seconds.items():
            source = _Simulated(0)
            source.packets = lambda: (  # type: ignore[method-assign]
                Packet(values=samples[k % 1000], stamp_ns=k * 1_000_000, sequence=k) for k in range(count)
            )
            recent = None if name == "alone" else RecentSamples([corrector])
            corrector.restart_time()
            loop = LiveLoop(source, [corrector], [], clock=time.monotonic, recent=recent)
            ended = threading.Event()
            reader = threading.Thread(target=_read_all, args=(recent, ended)) if name == "read" and recent else None
            if reader is not None:
                reader.start()
            begun = time.thread_time()
            loop.run()
            values.append(time.thread_time() - begun)
            ended.set()
            if reader is not None:
                reader.join()
    return {f"shown_{name}_us": float(np.median(values[1:]) / count * 1e6) for name, values in seconds.items()}


def humanoid_by_sample(count: int) -> dict[str, float]:
    """Time seven contact wrenches and the torques of 32 joints of an iCub with six sensors, a sample per call.

    After each call a loop of plain arithmetic runs, which takes as long: what delays it is not of the library. A call
    of which the kernel took the processor away, or in which garbage was collected, is known as such.

    Args:
        count: Samples.

    Returns:
        By name: percentiles of a call by the clock and by the processor, and of the loop by the clock, us; of calls and
        loops that took more than five medians how many there were, and of how many calls the processor was taken away
        or garbage was collected.
    """
    from benchmarks.dynamics.problem import icub_problem  # needs the extra icub, which tests of the rest do not

    warm = 10
    problem = icub_problem(count + warm)
    question, root = problem.contact_question(), problem.root
    out, turns = Estimates.empty(question.layout, 1), 1
    calls: list[tuple[float, float, int, int]] = []
    loops: list[float] = []
    for k in range(count + warm):
        at = slice(k, k + 1)
        motion = RootMotion(
            proper_acceleration=root.proper_acceleration[at],
            angular_velocity=root.angular_velocity[at],
            angular_acceleration=root.angular_acceleration[at],
        )
        joints = problem.joints.samples(at)
        measured = Wrenches(names=problem.readings.names, values=problem.readings.values[at])
        before, begun = _interruptions(), (time.perf_counter(), time.thread_time())
        estimate(question, joints, motion, measured=measured, out=out, evaluator=Evaluator.COMPILED, threads=1)
        ended, after = (time.perf_counter(), time.thread_time()), _interruptions()
        calls.append((ended[0] - begun[0], ended[1] - begun[1], after[0] - before[0], after[1] - before[1]))
        if k == warm - 1:  # as many turns as take as long as a call
            undisturbed = min(_seconds_of_turns(1000) for _ in range(20))
            turns = round(float(np.median([call[0] for call in calls[2:]])) / undisturbed * 1000)
        loops.append(_seconds_of_turns(turns))
    clock, processor, taken, collected = np.array(calls[warm:]).T
    plain = np.array(loops[warm:])
    slow = clock > 5.0 * np.median(clock)
    figures = {
        f"humanoid_{name}_{label}_us": float(np.percentile(values * 1e6, percent))
        for name, values in (("clock", clock), ("processor", processor), ("plain_loop", plain))
        for label, percent in (("median", 50.0), ("percentile_99_9", 99.9), ("largest", 100.0))
    }
    return figures | {
        "humanoid_slow_calls": float(slow.sum()),
        "humanoid_slow_calls_without_processor": float((slow & (taken > 0)).sum()),
        "humanoid_slow_calls_with_garbage_collected": float((slow & (collected > 0)).sum()),
        "humanoid_slow_plain_loops": float((plain > 5.0 * np.median(plain)).sum()),
    }


def _interruptions() -> tuple[int, int]:
    """How often the kernel took the processor away from the process, and garbage was collected."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_nivcsw, sum(one["collections"] for one in gc.get_stats())


def _seconds_of_turns(turns: int) -> float:
    begun, value = time.perf_counter(), 0.0
    for _ in range(turns):
        value += 1.5 * value + 0.5
        value -= value
    return time.perf_counter() - begun


def _read_all(recent: RecentSamples, ended: threading.Event) -> None:
    """Ask ten times a second, as a page does."""
    number = 0
    while not ended.wait(0.1):
        number = recent.since(number, 10_000).next


def main() -> None:
    """Measure, and write the result."""
    options = arguments(__doc__.partition("\n")[0])
    rounds = 2000 if options.quick else 20000
    seconds, difference = cost_of_calls(rounds)
    microseconds = {
        f"{name}_{label}_us": float(np.percentile(values, percent) * 1e6)
        for name, values in seconds.items()
        for label, percent in (("median", 50.0), ("percentile_99_9", 99.9), ("least", 0.0))
    }
    contact = biased_contact(
        seconds=3600.0, rate_hz=20.0 if options.quick else 100.0, contact_s=(1800.0, 1860.0), seed=1
    )
    shown = cost_of_being_shown(2000 if options.quick else 20000, 2 if options.quick else 10)
    figures = (
        microseconds
        | shown
        | humanoid_by_sample(100 if options.quick else 3000)
        | {
            "tares_inside_of_100": tares_of_a_moving_arm(range(100)),
            "drift_error_N": contact.error_N,
            "moved_in_contact_of_5_N_for_60_s_N": contact.moved_in_contact_N,
            "losses_miscounted": {
                f"period {clock:g}, jitter {jitter:g}": miscounted_losses(range(21, 31), clock=clock, jitter=jitter)
                for clock in (0.9, 0.95, 0.98, 1.0, 1.02, 1.05, 1.07, 1.1)
                for jitter in (0.05, 0.1, 0.25, 0.35)
            },
            "hour": one_hour(36_000 if options.quick else 3_600_000),
        }
    )
    write_result(
        options.json,
        ratios={"live_over_plain_loop": median_ratio(seconds["live"], seconds["loop"])},
        seconds=seconds,
        accuracy={"largest_difference": difference},
        rounds=rounds,
        packages=("numpy",),
        figures=figures,
    )
    for name, value in figures.items():
        print(f"{name}: {value}")


if __name__ == "__main__":
    main()

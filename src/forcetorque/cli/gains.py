# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque gains`: how far the channels are from saturation, and which amplifier gains would suit them."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from forcetorque.analysis import SensorGains, select_gains
from forcetorque.analysis.applicability import one_per_sensor
from forcetorque.atomic import write_bytes_atomically
from forcetorque.cli.figure_file import refuse_figure
from forcetorque.cli.gains_result import ChannelRow, GainsResult, SensorRow, sensor_row
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named
from forcetorque.errors import ForceTorqueError
from forcetorque.evaluation import GainChange
from forcetorque.experiment import Experiment, ExperimentSensor

if TYPE_CHECKING:
    from rich.console import Console


def run(
    path: Path,
    *,
    sensors: list[str] | None,
    margin: float,
    amplifier_gain: str | None,
    allowed_gains: str | None,
    calibrations: list[Path] | None,
    figure: Path | None,
    output_format: Format,
) -> None:
    """Look how the sensors of an experiment use their range.

    Args:
        path: Experiment file.
        sensors: Names of sensors; None for all.
        margin: Share of the limit to keep free.
        amplifier_gain: Present gains in words, in place of the experiment's.
        allowed_gains: Allowed gains in words, in place of the experiment's.
        calibrations: Calibration files whose matrices tell what a count is worth.
        figure: PNG file to draw.
        output_format: Form of the result.

    Raises:
        ForceTorqueError: If a name, a number or a file is not what it should be.
    """
    log = start_logging()
    refuse_figure(figure)
    loaded = read_calibrations(calibrations)
    experiment = read_experiment(path, log)
    chosen = sensors_named(experiment, sensors)
    matrices = one_per_sensor(experiment, loaded)
    refuse_left_out(experiment, chosen, loaded)
    found = []
    for sensor in chosen:
        changed = _with_gains(experiment, sensor, amplifier_gain, allowed_gains)
        found.append(select_gains(experiment, changed, margin=margin, calibration=matrices.get(sensor.name)))
        _warn(log, found[-1])
    if figure is not None:
        from forcetorque.report.figures import gain_figure

        write_bytes_atomically(figure, gain_figure(found))
    result = GainsResult(
        experiment=experiment.name,
        margin=margin,
        figure=None if figure is None else str(figure),
        sensors=[sensor_row(each) for each in found],
    )
    print_result(
        result.model_dump(mode="json", by_alias=True),
        [
            {"sensor": row.sensor, "serial": row.serial, **channel.model_dump(mode="json")}
            for row in result.sensors
            for channel in row.channels
        ],
        output_format,
        show=lambda: _show(result),
    )


def _with_gains(
    experiment: Experiment, sensor: ExperimentSensor, amplifier_gain: str | None, allowed_gains: str | None
) -> ExperimentSensor:
    """The sensor with what the options say in place of what the experiment file says."""
    if amplifier_gain is not None:
        present = _numbers("--amplifier-gain", amplifier_gain)
        channels = len(experiment.recording.stream(sensor.stream).signal(sensor.quantity).columns)
        if len(present) not in (1, channels):
            raise ForceTorqueError(
                f"--amplifier-gain {amplifier_gain}: expected one number, or one for each of the {channels} channels "
                f"of {sensor.name!r}, got {len(present)}"
            )
        sensor = replace(sensor, amplifier_gain=present * channels if len(present) == 1 else present)
    if allowed_gains is not None:
        sensor = replace(sensor, allowed_gains=_numbers("--allowed-gains", allowed_gains))
    if sensor.allowed_gains is not None and sensor.amplifier_gain is None:
        raise ForceTorqueError(
            f"sensor {sensor.name!r}: expected the gains that it was recorded with beside the allowed ones; "
            "give --amplifier-gain, or amplifier_gain in the experiment file"
        )
    return sensor


def _numbers(option: str, text: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(word) for word in text.split(","))
    except ValueError as error:
        raise ForceTorqueError(f"{option} {text}: expected numbers with commas between them") from error
    if any(not 0.0 < number < float("inf") for number in numbers):
        raise ForceTorqueError(f"{option} {text}: expected finite numbers above 0")
    return numbers


def _warn(log: logging.Logger, found: SensorGains) -> None:
    if found.recovered:
        log.warning(
            "%s: counts were recovered through %s; an offset that the electronics took off is not in them",
            found.sensor,
            found.prior_source,
        )
    if found.frozen:
        log.warning(
            "%s: %d samples repeat one reading, as a board does that saturates; its range may be larger, repeat the "
            "motion with less gain",
            found.sensor,
            found.frozen,
        )
    for seen, advice in zip(found.ranges, found.advice, strict=True):
        if seen.saturated_samples:
            log.warning(
                "%s: %s saturates in %.2g %% of the samples, so its range is not known; lower its gain and repeat the "
                "motion",
                found.sensor,
                seen.channel,
                100.0 * seen.saturated_share,
            )
        if advice.change is GainChange.NONE_FITS:
            log.warning("%s: %s has too little head-room, and no lower gain is allowed", found.sensor, seen.channel)


def _advice(channel: ChannelRow) -> str:
    if channel.change in {GainChange.KEEP, GainChange.NONE_FITS}:
        return channel.change.value.replace("_", " ")
    target = f"to {channel.recommended_gain:g}" if channel.recommended_gain is not None else ""
    factor = f"x {channel.largest_factor:.3g}" if channel.largest_factor is not None else ""
    if channel.change is GainChange.LOWER_AND_REPEAT:
        return f"repeat {target.replace('to', 'at') or factor}"
    return f"{channel.change.value} {target or factor}"


def _show(result: GainsResult) -> None:
    screen = console()
    for row in result.sensors:
        made = table(
            "channel", "counts", "left -", "left +", "saturated", "gain", "advice", "counts then", "left -", "left +",
            title=f"{row.sensor} ({row.serial}), {row.samples} samples, limit {row.limit_counts:g} counts",
        )  # fmt: skip
        for channel in row.channels:
            made.add_row(
                channel.channel,
                f"{channel.smallest_counts:.0f} to {channel.largest_counts:.0f}",
                _percent(channel.headroom_below),
                _percent(channel.headroom_above),
                f"{100.0 * channel.saturated_share:.2g} %",
                "-" if channel.present_gain is None else f"{channel.present_gain:g}",
                _advice(channel),
                f"{channel.expected_smallest_counts:.0f} to {channel.expected_largest_counts:.0f}",
                _percent(channel.expected_headroom_below),
                _percent(channel.expected_headroom_above),
            )
        screen.print(made)
        _show_resolution(row, screen)
        whole = row.strongest[-1]
        joints = ", ".join(
            f"{joint.joint} {'-' if joint.position is None else f'{joint.position:.3f}'} {joint.unit}"
            for joint in whole.joints
        )
        screen.print(f"highest excitation at {whole.time_s:.2f} s: {joints or 'no joint was logged'}", soft_wrap=True)
    screen.print(f"left: share of the limit, to be kept above {100.0 * result.margin:g} %")
    if result.figure is not None:
        screen.print(f"drawn to {result.figure}", soft_wrap=True)


def _show_resolution(row: SensorRow, screen: Console) -> None:
    if not row.resolution:
        return
    made = table("one count is", *(f"{r.component}, m{r.unit.partition('/')[0]}" for r in row.resolution))
    for name in ("worst", "expected_worst", "rms", "expected_rms"):
        label = name.replace("expected_", "") + (", after" if name.startswith("expected") else ", now")
        made.add_row(label, *(f"{1e3 * getattr(r, name):.3g}" for r in row.resolution))
    screen.print(made)
    screen.print(
        f"by the matrix of {row.matrix}; worst: all channels off by one with the worst signs; rms: each by itself",
        soft_wrap=True,
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"

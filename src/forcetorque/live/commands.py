# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque live`: lines of samples in, lines of corrected wrenches out."""

from __future__ import annotations

import sys
from contextlib import ExitStack, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from forcetorque.base.output_file import declare_outputs
from forcetorque.live.option_values import FaultPolicy, HeldQuantity, Input, Lines, OffsetSource
from forcetorque.results.terminal.command_output import (
    Format,
    drawn_to,
    refuse_figure,
    refuse_standard_output,
    show,
    start_logging,
)
from forcetorque.results.terminal.options import DetailsOption, ForceOption

if TYPE_CHECKING:
    from forcetorque.live.loop import LivePage
    from forcetorque.live.outputs import Output

_STANDARD_INPUT = 0
"""Its descriptor."""


def live(
    calibrations: Annotated[list[Path], typer.Argument(help="Calibration file of each sensor; see docs/live.md.")],
    form: Annotated[
        Input | None, typer.Option("--input", help="Form of the lines on standard input. Nothing is guessed.")
    ] = None,
    quantity: Annotated[
        HeldQuantity | None,
        typer.Option(
            "--quantity",
            help="What samples hold: raw counts, or the wrench by the prior matrix of the calibration, N and N m.",
        ),
    ] = None,
    channels: Annotated[
        list[str] | None,
        typer.Option("--channels", help="Columns of a table, [SENSOR=]ch1,ch2,..., in the order of the calibration."),
    ] = None,
    variables: Annotated[
        list[str] | None,
        typer.Option(
            "--variable",
            help="Column of a variable, [SENSOR.]temperature=COLUMN, or its index in the temperatures of a device.",
        ),
    ] = None,
    status: Annotated[
        list[str] | None,
        typer.Option(
            "--status", help="Column with the code of the device, [SENSOR=]COLUMN; 0 is valid (YARP MAS_status)."
        ),
    ] = None,
    index: Annotated[
        list[str] | None,
        typer.Option(
            "--index", help="Index from 0 in the list of force-torque sensors of yarp-measures, [SENSOR=]INDEX."
        ),
    ] = None,
    stamp: Annotated[
        str | None,
        typer.Option("--stamp", help="Column with the time, COLUMN:UNIT in s, ms, us or ns. Default: arrival."),
    ] = None,
    sequence: Annotated[
        str | None,
        typer.Option(
            "--sequence",
            help="Column with the number of the packet; COLUMN:65536 where 0 follows 65535. Default: 2^32.",
        ),
    ] = None,
    gravity: Annotated[
        str | None,
        typer.Option("--gravity", help="Three columns with gravity in the frame of the reading, m/s2, for a tool."),
    ] = None,
    envelope: Annotated[
        bool, typer.Option("--envelope", help="Lines of yarp begin with number and time of the sender.")
    ] = False,
    frame: Annotated[
        list[str] | None,
        typer.Option(
            "--frame",
            help="Frame, [SENSOR=]FRAME: frame_id of messages of ROS 2; of wrenches of csv child, parent or sensor, as "
            "the calibration has it.",
        ),
    ] = None,
    rate: Annotated[
        float | None, typer.Option("--rate", help="Rate of the sender, Hz, so that gaps in time count as losses.")
    ] = None,
    replay: Annotated[
        Path | None, typer.Option("--replay", help="Experiment file (TOML) whose recording takes the place of input.")
    ] = None,
    speed: Annotated[
        float, typer.Option("--speed", help="Times as fast as it was recorded; 0 for as fast as possible.")
    ] = 1.0,
    ati: Annotated[str | None, typer.Option("--ati", help="Address of an ATI NET F/T box in place of input.")] = None,
    ati_port: Annotated[int, typer.Option("--ati-port", help="Port of the box.")] = 49152,
    ati_force: Annotated[
        str | None,
        typer.Option("--ati-force", help="Unit of a count of force, as '1e-6 N'. Default: what the box publishes."),
    ] = None,
    ati_torque: Annotated[
        str | None, typer.Option("--ati-torque", help="Unit of a count of moment, as '1e-6 N m'.")
    ] = None,
    ros2: Annotated[
        list[str] | None,
        typer.Option("--ros2", help="Topic of WrenchStamped of each sensor, [SENSOR=]TOPIC, by zenoh as of rmw_zenoh."),
    ] = None,
    publish: Annotated[
        list[str] | None, typer.Option("--publish", help="Topic for corrected WrenchStamped, [SENSOR=]TOPIC.")
    ] = None,
    domain: Annotated[int, typer.Option("--domain", help="ROS_DOMAIN_ID.")] = 0,
    router: Annotated[
        str, typer.Option("--router", help="Router of zenoh, which rmw_zenohd is.")
    ] = "tcp/localhost:7447",
    robot: Annotated[
        Path | None, typer.Option("--robot", help="URDF by which gravity for a tool follows from joint positions.")
    ] = None,
    joints: Annotated[str | None, typer.Option("--joints", help="Topic of JointState of this robot.")] = None,
    base_gravity: Annotated[
        str | None,
        typer.Option("--base-gravity", help="Free fall along the axes of its root link, x,y,z in m/s2: 0,0,-9.81."),
    ] = None,
    offset: Annotated[
        OffsetSource,
        typer.Option(
            "--offset",
            help="Where the offset comes from: fitted (of the calibration), tare (mean of the first seconds, without a "
            "tool's weight), or tracked from a tare on.",
        ),
    ] = OffsetSource.FITTED,
    session: Annotated[
        str | None, typer.Option("--session", help="Power cycle that gives the fitted offset. Default: the last.")
    ] = None,
    tare_s: Annotated[float, typer.Option("--tare-s", help="Time that a tare takes, s.")] = 1.0,
    tool_mass: Annotated[
        float | None, typer.Option("--tool-mass", help="Mass of the tool that a tare keeps, kg.")
    ] = None,
    tool_centre: Annotated[
        str | None, typer.Option("--tool-centre", help="Its centre of mass x,y,z in the frame of the reading, m.")
    ] = None,
    take_tool_off: Annotated[bool, typer.Option("--take-tool-off", help="Take the weight of the tool off.")] = False,
    random_walk: Annotated[
        str | None,
        typer.Option("--random-walk", help="How far a tracked bias moves in an hour: N,N m. Default: 1,0.02."),
    ] = None,
    tracking_noise: Annotated[
        str | None,
        typer.Option("--tracking-noise", help="What is neither bias nor load: N,N m. Default: 0.2,0.005."),
    ] = None,
    with_temperature: Annotated[
        bool, typer.Option("--with-temperature", help="Track a part that is linear in temperature too.")
    ] = False,
    policy: Annotated[
        FaultPolicy,
        typer.Option("--policy", help="Samples with a fault: flag them, hold the last good one, or write no line."),
    ] = FaultPolicy.FLAG,
    limit_counts: Annotated[
        float | None, typer.Option("--limit-counts", help="Largest magnitude of a raw sample; near it is saturated.")
    ] = None,
    frozen_after: Annotated[
        float, typer.Option("--frozen-after", help="Time for which all channels may repeat a reading, s; 0 for any.")
    ] = 0.5,
    silence: Annotated[float, typer.Option("--silence", help="Time without a packet that is counted, s.")] = 2.0,
    lines: Annotated[Lines, typer.Option("--lines", help="Form of the lines on standard output.")] = Lines.CSV,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="File of all corrected samples: .parquet, or .mcap for ROS 2.")
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG, SVG or PDF of the last 60 000 samples, with their intervals.")
    ] = None,
    udp: Annotated[
        str | None, typer.Option("--udp", help="Loopback address of a UDP server of PlotJuggler, as 127.0.0.1:9870.")
    ] = None,
    watch: Annotated[bool, typer.Option("--watch", help="Show the state on standard error, in place.")] = False,
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check",
            help="Compare with a program that is given a file, PROGRAM=FILE: wholebodydynamics, gravity-filter, ur, "
            "franka or kuka.",
        ),
    ] = None,
    sensor_pose: Annotated[
        tuple[float, float, float, float, float, float] | None,
        typer.Option(
            "--sensor-pose", help="Pose x y z (m) roll pitch yaw (rad) of the sensor in the flange, for an arm."
        ),
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: Annotated[
        Format, typer.Option("--format", help="Form of the account at the end, on standard error.")
    ] = Format.TABLE,
    page: Any = None,
) -> None:
    """Correct wrenches while the robot runs, of lines, recordings, a box or ROS 2.

    Example: forcetorque live leg.json --input yarp --quantity wrench

    Reads standard input, as `yarp read ... /robot/ft:o | forcetorque live ...`. Corrected samples go to standard
    output; what was lost and what is wrong goes to standard error at the end.

    Python: `live.Corrector(calibration).correct(counts)`
    """
    import signal
    import time

    from forcetorque.live.loop import LiveLoop
    from forcetorque.live.outputs import (
        MCAP,
        CsvOutput,
        JsonLinesOutput,
        McapOutput,
        UdpOutput,
        discard_standard_output,
        mcap_file,
        parquet_file,
        refuse_other_names,
    )
    from forcetorque.live.program_check import program_checks
    from forcetorque.live.recent_samples import KEPT, RecentSamples
    from forcetorque.live.ros_topics import RosOutput
    from forcetorque.live.run_from_settings import make_run, ros_topics
    from forcetorque.live.settings import by_sensor, read_settings
    from forcetorque.live.terminal_watch import Watch
    from forcetorque.live.zenoh_session import zenoh_session
    from forcetorque.results.terminal.command_inputs import read_calibrations

    log = start_logging()
    refuse_standard_output("--output", output)
    refuse_other_names(output)
    declare_outputs(output, force=force)
    refuse_figure(figure, force=force)
    settings = read_settings({
        "form": form, "quantity": quantity, "channels": channels, "variables": variables, "status": status,
        "index": index, "stamp": stamp, "sequence": sequence, "gravity": gravity, "envelope": envelope,
        "frame": frame, "rate_hz": rate, "replay": replay, "speed": speed, "ati": ati, "ati_port": ati_port,
        "ati_force": ati_force, "ati_torque": ati_torque, "ros2": ros2, "publish": publish, "domain": domain,
        "router": router, "robot": robot, "joints": joints, "base_gravity": base_gravity, "offset": offset,
        "session": session, "tare_s": tare_s,
        "tool_mass_kg": tool_mass, "tool_centre_m": tool_centre, "take_tool_off": take_tool_off,
        "random_walk": random_walk, "tracking_noise": tracking_noise, "with_temperature": with_temperature,
        "policy": policy, "limit_counts": limit_counts, "frozen_after_s": frozen_after, "shown": page is not None,
    })  # fmt: skip
    read = read_calibrations(calibrations, None)
    clock = time.monotonic
    with ExitStack() as stack:
        ros = stack.enter_context(zenoh_session(router)) if settings.ros2 else None
        source, correctors = make_run(
            settings, tuple(read.values()), descriptor=_STANDARD_INPUT, warn=log.warning, ros=ros
        )
        names = [one.sensor.name for one in read.values()]
        # a table has no names of frames
        named = by_sensor("--frame", settings.frame, names) if ros or form is Input.ROS2_CSV else {}
        frames = {name: named.get(name, name) for name in names}
        checks = program_checks(
            check or [], correctors, sensor_pose=sensor_pose, frame=next(iter(named.values()), None), warn=log.warning
        )
        outputs: list[Output] = []
        if ros is not None:
            sent = ros_topics(settings, names)[1]
            outputs.append(RosOutput(ros, sent, frames, domain=domain, with_faults=policy is FaultPolicy.HOLD))
        losing: list[UdpOutput | McapOutput] = []
        if lines is not Lines.NONE:
            outputs.append(CsvOutput(sys.stdout) if lines is Lines.CSV else JsonLinesOutput(sys.stdout))
        if udp is not None:
            datagrams = UdpOutput(udp)
            stack.callback(datagrams.close)
            outputs.append(datagrams)
            losing.append(datagrams)
        if output is not None and output.suffix == MCAP:
            bag = stack.enter_context(mcap_file(output, frames, with_faults=policy is FaultPolicy.HOLD))
            outputs.append(bag)
            losing.append(bag)
        elif output is not None:
            outputs.append(stack.enter_context(parquet_file(output)))
        shown = Watch(
            sys.stderr, clock=clock, period_s=0.2 if sys.stderr.isatty() else 1.0, in_place=sys.stderr.isatty()
        )
        shown_by: LivePage | None = None
        if page is not None:  # made at the top, which has the viewer: a context of settings, source and correctors
            shown_by = stack.enter_context(page(settings, source, correctors))
        recent = None if figure is None else RecentSamples(correctors)
        if shown_by is not None:
            recent = shown_by.recent
        loop = LiveLoop(
            source,
            correctors,
            outputs,
            clock=clock,
            silence_s=silence,
            warn=log.warning,
            checks=checks,
            recent=recent,
            **({"show": shown.show} if watch else {}),
        )
        if shown_by is not None:
            shown_by.follow(loop)
        # to be terminated ends a run as Ctrl-C does: with its file and its account
        stack.callback(signal.signal, signal.SIGTERM, signal.signal(signal.SIGTERM, signal.default_int_handler))
        ended_by = loop.run()
        if watch:
            shown.show(loop, at_once=True)
        if shown_by is not None:
            shown_by.end(ended_by)
    result = loop.result(ended_by, sum(one.lost for one in losing))
    result = result.model_copy(
        update={"replayed": replay is not None, "output_file": None if output is None else str(output)}
    )
    if figure is not None and recent is not None:
        result = drawn_to(result.model_copy(update={"kept": recent.since(0, KEPT)}), figure)
    with redirect_stdout(sys.stderr):  # standard output is for lines
        show(result, output_format, details=details)
    if ended_by == "closed output":
        discard_standard_output()

# SPDX-License-Identifier: BSD-3-Clause
"""Inspect, check, calibrate or weigh, evaluate, report, export; a stage stops it where the rest would mislead."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from time import monotonic

from forcetorque.app.run.double_support import double_support
from forcetorque.app.run.result import Stage, StageName, WholeRun
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, OutputError
from forcetorque.base.output_file import refuse_output
from forcetorque.base.toml_file import parsed_toml
from forcetorque.calibration.calibrate import SensorCalibration, SensorCalibrations, calibrate_for_file
from forcetorque.calibration.export.commands import export_calibrations
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.calibration.joint.calibrate import JOINT_FILE, calibrate_jointly, calibration_file
from forcetorque.evaluation.answers import is_for_inspect
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.evaluation import Evaluation
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, use_verdicts
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.answers import causes, has_proposal
from forcetorque.inspection.inspect import FindingRow, Inspection, inspected
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.load_on_wrist_sensor import wrist_loads
from forcetorque.payload.load_warnings import contradicted_statements
from forcetorque.recording.recording import Use
from forcetorque.report.report import report, require_writable
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.result import Result, created_now
from forcetorque.workbench.bench_recording import read_bench
from forcetorque.workbench.calibrate import workbench

Source = Path | str | Experiment
"""An experiment file, or an experiment that is read already."""
_WORKBENCH = "forcetorque/bench/"
"""What names of the schema of workbench files begin with."""
TABLE = "calibrations.csv"
"""Name of the file with the matrices of all sensors."""
_PAGE, _NUMBERS = "report.html", "report.numbers.json"
_OVERRIDE = 'or go on with --override "reason"'
_CHANNELS = 6
"""Channels of a sensor whose matrix the icub-matrix file holds."""


class _StoppedError(Exception):
    """A stage stopped the way; it is recorded already."""


@dataclass(slots=True, kw_only=True)
class _Way:
    """What has been done so far."""

    files: Sequence[Path]
    output: Path
    override: str | None
    force: bool
    progress: Callable[[str], None]
    stages: list[Stage] = field(default_factory=list)
    written: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    """What a person overruled, in words for the calibrations."""
    double_support: list[str] = field(default_factory=list)
    """What phases in which several links bear the robot say against the calibrations, or why they were not checked."""
    results: list[Result] = field(default_factory=list)
    answers: tuple[Answer, ...] = ()
    uses: tuple[LoadCaseVerdict, ...] = ()
    started: float = field(default_factory=monotonic)

    def begin(self, name: StageName) -> None:
        """Say what is done next."""
        self.progress(name)
        self.started = monotonic()

    def end(self, name: StageName, text: str, *, skipped: bool = False) -> None:
        """Record a stage that went well."""
        seconds = monotonic() - self.started
        self.stages.append(Stage(name=name, outcome="skipped" if skipped else "done", seconds=seconds, text=text))
        self.progress(f"{name}: {text} ({seconds:.1f} s)")

    def stop(
        self,
        name: StageName,
        reasons: Sequence[str],
        remedy: str,
        *command: str,
        lines: Sequence[str] = (),
        for_good: bool = False,
    ) -> None:
        """Record a stage after which the rest would mislead, and stop there unless a person gave a reason to go on."""
        text = "; ".join(reasons)
        seconds = monotonic() - self.started
        goes_on = self.override is not None and not for_good
        self.stages.append(
            Stage(
                name=name,
                outcome="overridden" if goes_on else "stopped",
                seconds=seconds,
                text=text,
                reasons=tuple(reasons),
                remedy=remedy if for_good else f"{remedy}; {_OVERRIDE}",
                lines=tuple(lines),
                command=typed(*command) if command else None,
            )
        )
        if not goes_on:
            raise _StoppedError
        self.doubts.append(f"kept by override ({self.override}), although {name} said: {text}")

    def result(self) -> WholeRun:
        """What came out."""
        return WholeRun(
            experiment=", ".join(map(str, self.files)),
            stages=tuple(self.stages),
            load_cases=self.uses,
            files=tuple(self.written),
            override=self.override,
            details_of=tuple(self.results),
            final=self.answers,
            warnings=tuple(sentence for result in self.results for sentence in result.warnings),
        )


def run(
    files: Source | Sequence[Source],
    output: Path | str,
    *,
    sensors: Sequence[str] | None = None,
    override: str | None = None,
    with_report: bool = True,
    force: bool = False,
    progress: Callable[[str], None] = lambda _: None,
) -> WholeRun:
    """Go the whole way with experiment files of the same sensors, or with workbench files.

    What a file holds decides: a workbench file is calibrated by its known loads, an unknown load on a wrist sensor is
    weighed, and sensors of a robot or with a known load are calibrated and evaluated.

    Args:
        files: Experiment files (TOML), experiments that are read already, or workbench files.
        output: Folder for calibrations, report and exported files; made if it is not there.
        sensors: Sensors; all of the first file if None.
        override: Reason to go on where a stage would stop; it is written into the calibrations and the report.
        with_report: Whether the report is drawn, which takes longest.
        force: Whether files of an earlier run in the folder may be replaced.
        progress: Called with a line for people as work goes on, such as `print`.

    Returns:
        Stages, verdicts and files; `exit_code` sums them up.

    Raises:
        ExperimentError: If there is no file, or a reason to go on is empty.
        OutputError: If the folder is a file, or holds an input, or files of an earlier run without `force`.
        ForceTorqueError: If a file cannot be read; the message names it.
    """
    sources = [files] if isinstance(files, Path | str | Experiment) else list(files)
    paths = [one.file if isinstance(one, Experiment) else Path(one) for one in sources]
    if not paths:
        raise ExperimentError("run: expected experiment files, got none")
    if override is not None and not override.strip():
        raise ExperimentError("override: expected the reason to go on, in words; got an empty one")
    refuse_a_file_twice(paths)
    way = _Way(files=paths, output=Path(output), override=override, force=force, progress=progress)
    if way.output.exists() and not way.output.is_dir():
        raise OutputError(f"{way.output}: expected a folder for the results, or a name for a new one, got a file")
    if (table := way.output / TABLE).exists() and not force:
        raise OutputError(f"{table}: an earlier run wrote it; name another folder, or replace its files by --force")
    try:
        if not any(isinstance(one, Experiment) for one in sources) and all(map(_is_workbench, paths)):
            _by_known_loads(way)
        else:
            read = {
                path: one if isinstance(one, Experiment) else load_experiment(path)
                for path, one in zip(paths, sources, strict=True)
            }
            _of_experiments(way, read, sensors, with_report=with_report)
    except _StoppedError:
        pass
    return way.result()


def _is_workbench(path: Path) -> bool:
    return str(parsed_toml(path, what="an experiment file")[1].get("schema", "")).startswith(_WORKBENCH)


def _by_known_loads(way: _Way) -> None:
    """Calibrate by the known loads of a workbench."""
    way.begin("workbench")
    try:
        recordings = [read_bench(path) for path in way.files]
        result = workbench(recordings, code_version=version("forcetorque"), created=created_now())
    except FitError as error:
        way.stop("workbench", [str(error)], "correct the loads or readings", for_good=True)
        return
    way.results.append(result)
    way.answers = tuple(result.answers())
    faults = [fault.message for fault in result.faults]
    unfitted = [f"{row.file}: {row.reason}" for row in result.sensors if not row.fitted]
    if not result.calibrations:
        reasons = [*faults, *unfitted] or ["no position has valid blocks, so that nothing is fitted"]
        way.stop("workbench", reasons, "correct the loads or readings, or record other loads", for_good=True)
    elif faults or unfitted:
        remedy = "record again what they name"
        lines: tuple[str, ...] = ()
        positions = [name for fault in result.faults for name in fault.positions]
        if len(recordings) == 1 and positions:
            names = list(dict.fromkeys([*recordings[0].left_out, *positions]))
            remedy += ", or leave it out by these lines of the file, after which faults are searched anew"
            lines = ("[loads]", f"leave_out = {json.dumps(names)}")
        way.stop("workbench", [*faults, *unfitted], remedy, lines=lines)
    way.output.mkdir(parents=True, exist_ok=True)
    stem = way.files[0].stem
    for one in (_doubted(one, way.doubts) for one in result.calibrations):
        alone = len(way.files) == 1
        file = way.output / (f"{stem}.json" if alone else calibration_file(one.sensor.name, one.sensor.serial))
        one.save(file, force=way.force)
        way.written.append(str(file))
    if len(way.written) == 1:
        way.answers = tuple(result.model_copy(update={"file": way.written[0]}).answers())
    way.end("workbench", f"{len(result.sensors)} sensor(s)")


def _of_experiments(
    way: _Way, experiments: Mapping[Path, Experiment], sensors: Sequence[str] | None, *, with_report: bool
) -> None:
    first = next(iter(experiments.values()))
    names = [first.sensor(name).name for name in sensors] if sensors else [sensor.name for sensor in first.sensors]
    if not names:
        raise ExperimentError(f"{way.files[0]}: expected a [[sensor]] to calibrate, got none")
    if all(interval.use is not Use.CALIBRATION for one in experiments.values() for interval in one.recording.intervals):
        inspects = typed("inspect", str(way.files[0]))
        raise ExperimentError(
            f'{way.files[0]}: expected an [[interval]] with use = "calibration", in which nothing that the file does '
            f"not state touches the limb; got none: state one; forcetorque {inspects} shows when something touches it"
        )
    _refuse_outputs(way, experiments, names)
    wrong, proposed = _inspect(way, experiments, names)
    campaigns = {
        name: Campaign([SensorRun(one, name) for one in experiments.values() if name in _names(one)]) for name in names
    }
    _check(way, campaigns, wrong, proposed)
    if (loads := wrist_loads(first)) is not None and not loads.are_stated:
        _weigh(way, campaigns[names[0]])
        return
    fitted = _calibrate(way, campaigns, list(experiments.values()))
    fitted = _held_against_double_support(way, list(experiments.values()), fitted)
    _evaluate(way, campaigns, fitted)
    fitted = fitted.model_copy(
        update={"calibrations": tuple(_with_doubts(one, way.doubts) for one in fitted.calibrations)}
    )
    saved = fitted.save(force=way.force)
    if not any(isinstance(one, Evaluation) for one in way.results):
        way.answers = tuple(saved.answers())
    way.written += [entry.file for entry in saved.calibrations]
    if with_report:
        _report(way, experiments, saved)
    _export(way, saved)


def _refuse_outputs(way: _Way, experiments: Mapping[Path, Experiment], names: Sequence[str]) -> None:
    """Refuse to replace inputs before anything is computed."""
    inputs = {digest for one in experiments.values() for digest in one.inputs_sha256.values()}
    first = next(iter(experiments.values()))
    serials = {name: first.sensor(name).serial for name in names}
    files = [TABLE, _PAGE, _NUMBERS, JOINT_FILE]
    files += [calibration_file(name, serial) for name, serial in serials.items()]
    files += [_matrix_file(serial) for serial in serials.values()]
    for file in (way.output / name for name in files):
        if file.exists():
            refuse_output(file, inputs_sha256=inputs, force=way.force)


def _matrix_file(serial: str) -> str:
    return f"matrix_{serial}.txt"


def _names(experiment: Experiment) -> list[str]:
    return [sensor.name for sensor in experiment.sensors]


def _inspect(
    way: _Way, experiments: Mapping[Path, Experiment], sensors: Sequence[str]
) -> tuple[list[str], Path | None]:
    """Look for contacts in what is to be fitted; what else is wrong by the robot model, in words.

    Args:
        way: What has been done.
        experiments: Experiments by file.
        sensors: Names of the sensors.

    Returns:
        What is wrong, and the first file of which `init --resume` proposes a change; None for none.
    """
    way.begin("inspect")
    touched: list[tuple[Path, str]] = []
    wrong, found = [], 0
    proposed: Path | None = None
    for path, experiment in experiments.items():
        inspection = inspected(experiment, sensors=sensors, progress=way.progress)
        way.results.append(inspection)
        found += sum(answer.verdict != "NOTHING FOUND" for answer in inspection.answers())
        wrong += [f"{path}: {row.stream}: {row.message}" for row in causes(inspection)]
        proposed = path if proposed is None and has_proposal(inspection) else proposed
        touched += [(path, f"{path}: {words}") for words in _contacts(experiment, inspection, sensors)]
    if touched:
        remedy = "leave the contact out of the [[interval]], state it as [[contact]]"
        way.stop("inspect", [words for _, words in touched], remedy, "init", "--resume", str(touched[0][0]))
    else:
        way.end(
            "inspect",
            f"{len(experiments)} recording(s), {found} with events, none of them a contact in a calibration interval",
        )
    return wrong, proposed


def _contacts(experiment: Experiment, inspection: Inspection, sensors: Sequence[str]) -> Iterator[str]:
    """Firm contacts of sensors in calibration intervals."""
    start_ns = experiment.recording.start_ns
    streams = {sensor.stream for sensor in experiment.sensors if sensor.name in sensors}
    for interval in (one for one in experiment.recording.intervals if one.use is Use.CALIBRATION):
        start, end = ((stamp - start_ns) * 1e-9 for stamp in (interval.start_ns, interval.end_ns))
        for row in inspection.findings:
            if row.kind == "contact" and row.stream in streams and _overlaps(row, start, end):
                yield f"{row.stream} is touched at {row.start_s:.1f}-{row.end_s:.1f} s, in interval {interval.label!r}"


def _overlaps(row: FindingRow, start: float, end: float) -> bool:
    return row.start_s is not None and row.end_s is not None and row.start_s < end and row.end_s >= start


def _check(way: _Way, campaigns: Mapping[str, Campaign], wrong: Sequence[str], proposed: Path | None) -> None:
    """Compare frames, senses, clocks and units that the files state with what the readings say.

    Args:
        way: What has been done.
        campaigns: Sensors by name.
        wrong: What `inspect` found to be wrong as a whole.
        proposed: File of which `init --resume` proposes a change; None for none.
    """
    way.begin("check")
    contradicted: list[str] = []
    inspections = [one for one in way.results if isinstance(one, Inspection)]
    streams = {run.sensor.stream for campaign in campaigns.values() for run in campaign.runs}
    unchecked = [
        f"{row.stream}: {row.message}"
        for one in inspections
        for row in one.findings
        if row.kind == "not_compared" and row.stream in streams
    ]
    for name, campaign in campaigns.items():
        for one in campaign.runs:
            try:
                contradicted += [f"{name}: {words}" for words in contradicted_statements(one, cautions=False)]
            except ForceTorqueError as error:
                unchecked.append(f"{name}: {error}")
    if contradicted or wrong:
        # a fault that explains the measurements comes first, a refusal that explains nothing last
        explained = any(row.kind != "implausible" for one in inspections for row in causes(one))
        reasons = list(dict.fromkeys([*wrong, *contradicted] if explained else [*contradicted, *wrong]))
        if proposed is None:
            way.stop("check", reasons, "correct what the file or the URDF states", "inspect", str(way.files[0]))
        else:
            remedy = "accept the change of the line, which is tried first"
            way.stop("check", reasons, remedy, "init", "--resume", str(proposed))
    else:
        way.end("check", f"{len(campaigns)} sensor(s): nothing contradicts the file{_not_checked(unchecked)}")


def _not_checked(unchecked: Sequence[str]) -> str:
    return f"; not checked: {unchecked[0]}" if unchecked else ""


def _weigh(way: _Way, campaign: Campaign) -> None:
    """Estimate the unknown load of a wrist sensor."""
    way.begin("payload")
    try:
        load = weigh_load(Campaign(campaign.runs_with(Use.CALIBRATION)))
    except FitError as error:
        way.stop("payload", [str(error)], "correct the file or record other poses", for_good=True)
        return
    way.results.append(load)
    way.answers = tuple(load.answers())
    way.end("payload", f"{campaign.sensor.name}: load estimated")


def _calibrate(way: _Way, campaigns: Mapping[str, Campaign], experiments: Sequence[Experiment]) -> SensorCalibrations:
    """Fit every sensor; where one cannot be fitted alone, all at once; those that cannot be fitted are named."""
    way.begin("calibrate")
    results, failures = [], []
    for name, campaign in campaigns.items():
        way.progress(f"fitting {name}")
        file = way.output / calibration_file(name, campaign.sensor.serial)
        try:
            fitted_runs = Campaign(campaign.runs_with(Use.CALIBRATION))
            results.append(
                calibrate_for_file(fitted_runs, file, code_version=version("forcetorque"), created=created_now())
            )
        except ForceTorqueError as error:
            failures.append(f"{name}: {error}")
    if failures and len(campaigns) > 1:
        try:
            return _calibrate_jointly(way, list(campaigns), experiments, failures[0])
        except ForceTorqueError as error:
            failures.append(f"all at once: {error}")
    if failures:
        way.stop("calibrate", failures, "correct the file or the recording", for_good=not results)
    fitted = SensorCalibrations.together(results)
    way.results.append(fitted)
    way.answers = tuple(fitted.answers())
    if not failures:
        way.end("calibrate", f"{len(results)} sensor(s)")
    return fitted


def _calibrate_jointly(
    way: _Way, sensors: Sequence[str], experiments: Sequence[Experiment], why: str
) -> SensorCalibrations:
    """Fit all sensors at once, since one of them cannot be fitted alone."""
    fitted = calibrate_jointly(
        experiments,
        way.output,
        sensors,
        code_version=version("forcetorque"),
        created=created_now(),
        progress=way.progress,
    )
    way.results.append(fitted)
    way.answers = tuple(fitted.answers())
    way.end("calibrate", f"{len(fitted.calibrations)} of {len(sensors)} sensors, all at once, since {why}")
    return fitted


_NOT_CHECKED = "double support not checked"


def _held_against_double_support(
    way: _Way, experiments: Sequence[Experiment], fitted: SensorCalibrations
) -> SensorCalibrations:
    """Doubt calibrations with which the feet together bear the robot's weight worse than with the priors."""
    doubts: dict[str, str] = {}
    for experiment in experiments:
        own = {e.file: e.calibration for e in fitted.calibrations if e.calibration.sensor.name in _names(experiment)}
        try:
            text = double_support(experiment, own)
        except ForceTorqueError as error:
            way.double_support.append(f"{_NOT_CHECKED}: {error}")
            continue
        if text is not None:
            way.double_support.append(text)
            doubts |= dict.fromkeys(own, text)
    calibrations = (_with_doubts(one, [doubts[one.file]] if one.file in doubts else []) for one in fitted.calibrations)
    return fitted.model_copy(update={"calibrations": tuple(calibrations)})


def _with_double_support(way: _Way) -> tuple[Answer, ...]:
    """The answers, of which one names what double support says, where no verdict does."""
    missing = [text for text in way.double_support if not any(text in why for one in way.answers for why in one.why)]
    if not missing or not way.answers:
        return way.answers
    first, *others = way.answers
    contradicted = any(not text.startswith(_NOT_CHECKED) for text in missing)
    concern = Concern.UNCERTAIN if contradicted and first.concern is Concern.NONE else first.concern
    return (replace(first, why=(*first.why[:1], *missing, *first.why[1:]), concern=concern), *others)


def _evaluate(way: _Way, campaigns: Mapping[str, Campaign], fitted: SensorCalibrations) -> None:
    """Evaluate on data that were not fitted; a calibration that must not be used is withheld."""
    way.begin("evaluate")
    evaluations: list[Evaluation] = []
    uses: list[LoadCaseVerdict] = []
    without: list[Answer] = []
    """On sensors of a joint calibration whose limb bears the robot: no wrench is expected of them alone."""
    for entry in fitted.calibrations:
        name = entry.calibration.sensor.name
        campaign, named = campaigns[name], {entry.file: entry.calibration}
        try:
            if any(one.has(Use.VALIDATION) for one in campaign.runs):
                evaluations.append(evaluate(campaign, named))
                uses += evaluations[-1].load_cases
            else:
                uses += use_verdicts(campaign, named)
        except ForceTorqueError as error:
            if fitted.joint is None:
                raise
            subject = f"{name} ({campaign.sensor.serial})"
            without.append(Answer(subject=subject, verdict="NO VERDICT", why=(str(error),), concern=Concern.UNCERTAIN))
    way.uses = tuple(uses)
    if evaluations:
        evaluation = Evaluation.together(evaluations)
        way.results.append(evaluation)
        way.answers = (*evaluation.answers(), *without)
    elif without:
        way.answers = tuple(without)
    if fitted.joint is not None:
        at_once = f"{len(fitted.calibrations)} sensors are fitted at once, as by `calibrate --jointly`"
        way.answers = tuple(replace(one, why=(*one.why[:1], at_once, *one.why[1:])) for one in way.answers)
    way.answers = _with_double_support(way)
    forbidden = [use for use in uses if use.decision == "do not use"]
    if forbidden:
        given = ([reason.remedy for reason in use.reasons if reason.remedy is not None] for use in forbidden)
        remedies = dict.fromkeys((own[0] if own else "keep the prior matrix").rstrip(".") for own in given)
        texts = [f"{use.sensor}: {use.message}" for use in forbidden]
        command = ("inspect", str(way.files[0])) if any(map(is_for_inspect, forbidden)) else ()
        way.stop("evaluate", texts, "; ".join(remedies), *command)
    elif evaluations or without:
        texts = [f"{use.sensor}: {use.decision}" for use in uses]
        texts += [f"{one.subject.split()[0]}: no verdict" for one in without]
        way.end("evaluate", "; ".join([", ".join(texts), *way.double_support]))
    else:
        way.end("evaluate", 'no interval with use = "validation": nothing tests the calibrations', skipped=True)


def _with_doubts(entry: SensorCalibration, doubts: Sequence[str]) -> SensorCalibration:
    return entry.model_copy(update={"calibration": _doubted(entry.calibration, doubts)}) if doubts else entry


def _doubted(calibration: Calibration, doubts: Sequence[str]) -> Calibration:
    return calibration.model_copy(update={"warnings": tuple(dict.fromkeys((*calibration.warnings, *doubts)))})


def _report(way: _Way, experiments: Mapping[Path, Experiment], saved: SensorCalibrations) -> None:
    way.begin("report")
    groups: dict[str, Mapping[str, Calibration]] = {
        entry.calibration.sensor.name: {entry.file: entry.calibration} for entry in saved.calibrations
    }
    page, numbers = way.output / _PAGE, way.output / _NUMBERS
    shown = [(str(path), experiment) for path, experiment in experiments.items()]
    try:
        require_writable([page])
        written = report(
            shown,
            [{name: own for name, own in groups.items() if name in _names(one)} for _, one in shown],
            created=created_now(),
            code_version=version("forcetorque"),
            progress=way.progress,
        )
        failures = written.save(page, numbers, force=way.force)
    except ForceTorqueError as error:  # the answer does not wait for a page, such as where an extra is missing
        way.end("report", f"not written: {error}", skipped=True)
        return
    way.written += [str(page), str(numbers)]
    way.end("report", "; ".join((str(page), *failures)))


def _export(way: _Way, saved: SensorCalibrations) -> None:
    """Write a table of all matrices and, per sensor that may be used, the file that an iCub's board reads."""
    way.begin("export")
    named = {entry.file: entry.calibration for entry in saved.calibrations}
    table = way.output / TABLE
    export_calibrations(named, ExportFormat.CSV).save(table, force=way.force)
    files, refused, later = [str(table)], [], []
    for file, calibration in named.items():
        if _is_of_icub(calibration):
            matrix = way.output / _matrix_file(calibration.sensor.serial)
            if not _may_be_used(way, calibration.sensor.name):
                later.append((matrix.name, typed("export", file, "--to", "icub-matrix", "-o", str(matrix))))
                continue
            try:
                export_calibrations({file: calibration}, ExportFormat.ICUB_MATRIX).save(matrix, force=way.force)
            except ForceTorqueError as error:  # such as a row that no full scale holds: the table has it
                refused.append(f"{matrix} is not written: {error}")
            else:
                files.append(str(matrix))
    if later:
        names = ", ".join(name for name, _ in later)
        refused.append(f"not written, for the sensor may not be used yet: {names}; forcetorque {later[0][1]} writes it")
    way.written += files
    way.end("export", "; ".join([", ".join(files), *refused]))


def _may_be_used(way: _Way, sensor: str) -> bool:
    decisions = {use.decision for use in way.uses if use.sensor == sensor}
    return way.override is not None or decisions == {"use"}


def _is_of_icub(calibration: Calibration) -> bool:
    """Whether the prior came from such a file, as that of an iCub's board is called."""
    prior = calibration.prior
    return (
        prior is not None
        and calibration.matrix.shape[1] == _CHANNELS
        and Path(prior.source).name.startswith("matrix_")
        and calibration.posterior is not None
    )

# SPDX-License-Identifier: BSD-3-Clause
"""The text of an experiment file: every key that is unknown, missing or wrong is named with its table."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from forcetorque.base.errors import FormatError, MissingFileError, OutputError
from forcetorque.base.run_files import declare_output, files_of_one_run
from forcetorque.experiment.experiment_file import ExperimentFile, parse_experiment
from forcetorque.experiment.experiment_file_tables import Smoothing
from forcetorque.formats.registry import ParquetLog
from forcetorque.formats.ros.log_format import RosLog
from forcetorque.formats.tabular.log_format import TabularLog
from forcetorque.formats.yarp.log_format import YarpLog
from forcetorque.formats.yarp.port_tables import StateExtPort
from forcetorque.recording.recording import Use
from tests.scenes.experiments import JOINTS, PARQUET, TEXTS, TWO, YARP

OPTIONAL = """
[processing]
derivatives = { window_s = 0.4, order = 4 }
smoothing = { window_s = 0.5, order = 2 }

[calibration]
lambda_counts2 = 1000
"""
NOT_NEEDED = {"tolerance", "prior", "end_s", "support", "derivatives", "smoothing", "lambda_counts2"}
"""Keys of the complete texts that have a default, or may be absent."""
DOCS = Path(__file__).parents[2] / "docs"


def _parse(folder: Path, text: str) -> ExperimentFile:
    file = folder / "experiment.toml"
    file.write_text(text, encoding="utf-8")
    return parse_experiment(file)


def _changed(text: str, old: str, new: str) -> str:
    assert text.count(old) == 1
    return text.replace(old, new)


def test_a_complete_file_is_read_with_every_key(tmp_path: Path) -> None:
    """What the file says arrives, key by key."""
    parsed = _parse(tmp_path, TEXTS[YARP] + OPTIONAL)
    assert (parsed.name, parsed.robot.urdf, parsed.robot.gravity) == ("small arm", Path("arm.urdf"), 9.80665)
    assert isinstance(parsed.recording, YarpLog)
    assert isinstance(parsed.recording.stream[1], StateExtPort)
    assert parsed.recording.stream[1].joints == JOINTS
    assert (parsed.sensor[0].serial, parsed.sensor[0].prior) == ("SIM001", Path("matrix_SIM001.txt"))
    assert parsed.support[0].gravity_direction.tolist() == [0.0, 0.0, -1.0]
    assert [(i.label, i.start_s, i.end_s, i.use) for i in parsed.interval] == [
        ("fit", 0.5, 14.0, Use.CALIBRATION),
        ("judge", 14.5, 23.5, Use.VALIDATION),
    ]
    assert parsed.processing.derivatives == Smoothing(window_s=0.4, order=4)
    assert parsed.processing.smoothing == Smoothing(window_s=0.5, order=2)
    assert parsed.calibration.lambda_counts2 == 1000.0


def test_what_may_be_left_out_has_a_default(tmp_path: Path) -> None:
    """Without its optional tables the file means derivatives of 0.3 s, no smoothing and lambda by held-out blocks."""
    parsed = _parse(tmp_path, TEXTS[TWO])
    assert isinstance(parsed.recording, ParquetLog)
    assert parsed.processing.derivatives == Smoothing(window_s=0.3, order=3)
    assert parsed.processing.smoothing is None
    assert parsed.calibration.lambda_counts2 is None
    assert parsed.sensor[1].joint == "tool_joint"
    assert parsed.sensor[1].frame is None


def _documented() -> list[str]:
    """Blocks of the page on experiment files, those of the page on YARP behind the first two."""
    file, yarp = (
        re.findall(r"```toml\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)
        for page in ("recording.md", "yarp.md")
    )
    blocks = [*file[:2], *yarp, *file[2:]]
    assert len(blocks) == 10
    return blocks


def test_the_documented_file_is_one(tmp_path: Path) -> None:
    """The example of the documentation, with every optional key, is accepted as it stands."""
    parsed = _parse(tmp_path, _documented()[0])
    assert parsed.calibration.lambda_counts2 is None
    assert parsed.calibration.type == "generative"
    assert parsed.processing.smoothing is not None
    assert (parsed.interval[0].kind, parsed.interval[0].session) == ("balancing support", "day 3")
    assert (parsed.trial.condition, parsed.trial.number) == ("2 N m", 1)


def test_the_documented_variables_fit_into_it(tmp_path: Path) -> None:
    """Two variables of the sensor, and the type in its parts, which takes the place of its name."""
    whole, variables, *_ = _documented()
    named = whole[whole.index("[calibration]") : whole.index("[[interval]]")]
    parsed = _parse(tmp_path, whole.replace(named, "").replace("[[support]]", f"{variables}\n[[support]]"))
    (sensor,), options = parsed.sensor, parsed.calibration
    assert [(v.name, v.stream, v.quantity, v.column) for v in sensor.variable] == [
        ("temperature", "right_leg_temperature", "temperature", None),
        ("supply", "board", "scalar", "volts"),
    ]
    assert sensor.variable[0].reference_value == 29.0
    assert sensor.variable[0].prior_coefficients is not None
    assert (options.offset, options.with_variables, options.from_reference) == ("sphere", True, False)
    assert options.sphere_intervals == ("moving",)


def test_the_documented_ports_and_imu_fit_into_it(tmp_path: Path) -> None:
    """The other kinds of ports and the moving support are accepted in place of their plain forms."""
    whole, _, ports, skin, events, moving, *_ = _documented()
    fixed = whole[whole.index("[[support]]") : whole.index("[processing]")]
    logged = f"{ports}\n{skin}\n{events}\n[[sensor]]"
    parsed = _parse(tmp_path, whole.replace("[[sensor]]", logged).replace(fixed, f"{moving}\n"))
    assert isinstance(parsed.recording, YarpLog)
    assert {port.kind for port in parsed.recording.stream} == {
        "analog",
        "state_ext",
        "measures",
        "inertial",
        "state",
        "skin",
        "skin_events",
    }
    assert parsed.support[0].imu == ("imu",)


def test_the_documented_wrist_is_complete_with_a_sensor_and_intervals(tmp_path: Path) -> None:
    """A load and a table in place of a robot and a YARP log."""
    head = 'schema = "forcetorque/experiment/1"\nname = "wrist"\n'
    sensor = '[[sensor]]\nname = "wrist"\nstream = "poses"\nserial = "FT1"\nprior = "identity"\n'
    interval = '[[interval]]\nlabel = "all"\nstart_s = 0\nuse = "calibration"\n'
    parsed = _parse(tmp_path, f"{head}{_documented()[6]}\n{sensor}{interval}")
    assert parsed.load is not None
    assert parsed.load[0].mass_kg == 0.932
    assert parsed.sensor[0].prior == "identity"


def test_the_documented_orientation_takes_the_place_of_gravity(tmp_path: Path) -> None:
    """A pose in the signals of the wrist's table."""
    head = 'schema = "forcetorque/experiment/1"\nname = "wrist"\n'
    sensor = '[[sensor]]\nname = "wrist"\nstream = "poses"\nserial = "FT1"\nprior = "identity"\n'
    interval = '[[interval]]\nlabel = "all"\nstart_s = 0\nuse = "calibration"\n'
    wrist, orientation = _documented()[6:8]
    plain = re.sub(r"signal = \[\n.*?\n\]\n", "", wrist, flags=re.DOTALL)
    assert plain != wrist
    recording = _parse(tmp_path, f"{head}{plain}\n{orientation}\n{sensor}{interval}").recording
    assert isinstance(recording, TabularLog)
    (signal,) = recording.stream[0].signal
    assert signal.orientation is not None
    assert signal.orientation.layout().sense == "sensor_to_world"


def test_the_documented_orientation_of_a_message_is_a_stream(tmp_path: Path) -> None:
    """Its sense and the world's gravity; the form is not asked."""
    head = 'schema = "forcetorque/experiment/1"\nname = "bag"\n[recording]\nformat = "ros"\npath = "bag"\n'
    interval = '[[interval]]\nlabel = "all"\nstart_s = 0\nuse = "ignore"\n'
    recording = _parse(tmp_path, f"{head}{_documented()[8]}\n{interval}").recording
    assert isinstance(recording, RosLog)
    (stream,) = recording.stream
    assert stream.orientation is not None
    assert (stream.orientation.sense, stream.orientation.gravity) == ("sensor_to_world", 9.82085)


def test_the_documented_contact_fits_into_it(tmp_path: Path) -> None:
    """Contacts and the length scale are accepted as they stand."""
    whole, *_, contact = _documented()
    parsed = _parse(tmp_path, f"{whole}\n{contact}")
    assert parsed.contact[0].intervals == ("moving",)
    assert parsed.estimation.length_scale_m == 0.2


@pytest.mark.parametrize(
    ("line", "attribute", "expected"),
    [
        ('lambda_counts2 = "held-out"', "lambda_counts2", None),
        ("lambda_counts2 = 0", "lambda_counts2", 0.0),
        ("lambda_counts2 = inf", "lambda_counts2", float("inf")),
    ],
)
def test_lambda_may_be_a_number_or_held_out(tmp_path: Path, line: str, attribute: str, expected: float | None) -> None:
    """Every documented value of lambda is accepted, the default spelled out too."""
    parsed = _parse(tmp_path, TEXTS[PARQUET] + f"\n[calibration]\n{line}\n")
    assert getattr(parsed.calibration, attribute) == expected


def test_derivatives_may_be_logged(tmp_path: Path) -> None:
    """The one word that `derivatives` knows is accepted."""
    parsed = _parse(tmp_path, TEXTS[PARQUET] + '\n[processing]\nderivatives = "logged"\n')
    assert parsed.processing.derivatives == "logged"


def _keys(text: str) -> list[str]:
    return [match[1] for match in re.finditer(r"^(\w+) = ", text, re.MULTILINE)]


@pytest.mark.parametrize("form", [YARP, TWO])
def test_every_misspelled_key_is_an_error_with_the_right_one(tmp_path: Path, form: str) -> None:
    """Two swapped letters in any key of any table lead to the key that was meant."""
    lines = (TEXTS[form] + OPTIONAL).splitlines()
    tried = 0
    for number, line in enumerate(lines):
        key, equals, value = line.partition(" = ")
        if not equals:
            continue
        wrong = key[:-2] + key[-1] + key[-2]
        text = "\n".join([*lines[:number], f"{wrong} = {value}", *lines[number + 1 :]])
        if key in ("format", "kind"):  # without it nobody knows which keys the table may have
            expected = f"{key}: expected this key"
        else:
            expected = f"unknown key '{wrong}'; did you mean \"{key}\"? known: "
        with pytest.raises(FormatError, match=re.escape(expected)) as caught:
            _parse(tmp_path, text)
        assert str(caught.value).startswith(f"{tmp_path / 'experiment.toml'}: ")
        tried += 1
    assert tried == len(_keys(TEXTS[form] + OPTIONAL)) > 20


@pytest.mark.parametrize("form", [YARP, TWO])
def test_every_missing_key_is_named(tmp_path: Path, form: str) -> None:
    """A file without one of its needed keys is refused with that key, one without an optional key is not."""
    lines = (TEXTS[form] + OPTIONAL).splitlines()
    refused = accepted = 0
    for number, line in enumerate(lines):
        key, equals, _ = line.partition(" = ")
        if not equals:
            continue
        text = "\n".join(lines[:number] + lines[number + 1 :])
        if key in NOT_NEEDED:
            _parse(tmp_path, text)
            accepted += 1
        else:
            with pytest.raises(FormatError, match=rf"{key}: expected this key|discriminator '{key}'|needs {key}"):
                _parse(tmp_path, text)
            refused += 1
    assert refused > 15
    assert accepted > 3


TABLES = {
    "[robot]": ("robot", "fixed, gravity, tolerance, urdf"),
    'path = "log"': ("recording", "continued_in, format, path, stream"),
    'kind = "analog"': (r"recording.stream\[0\]", "kind, name, port"),
    'kind = "state_ext"': (r"recording.stream\[1\]", "joints, kind, name, port"),
    "[[sensor]]": (
        r"sensor\[0\]",
        "allowed_gains, amplifier_gain, components, frame, full_scale, joint, limit_counts, measure_direction, "
        "measurement_noise, "
        "measurement_offset_sd, mount, name, prior, "
        "prior_uncertainty_percent, serial, stream, variable",
    ),
    "[[support]]": (r"support\[0\]", "frame, gravity_direction, imu"),
    'label = "judge"': (
        r"interval\[1\]",
        "contact_links, end_s, files, kind, label, load, session, start_s, support, use",
    ),
    "[processing]": ("processing", "derivatives, keep, smoothing"),
    "[calibration]": (
        "calibration",
        "accuracy, drift, from_reference, lambda_counts2, nonlinear, offset, repeatability, sphere_intervals, "
        "type, with_variables",
    ),
    'name = "small arm"': (
        "top level",
        "calibration, clock, contact, estimation, fusion, interval, load, load_case, motor, name, patch, plan, "
        "processing, recording, robot, schema, sensor, sole, support, transform, trial",
    ),
}


@pytest.mark.parametrize("line", TABLES)
def test_an_unknown_key_is_an_error_that_lists_the_known_ones(tmp_path: Path, line: str) -> None:
    """Each table says where it is and which keys it has."""
    place, known = TABLES[line]
    text = _changed(TEXTS[YARP] + OPTIONAL, f"{line}\n", f"{line}\nzzz = 1\n")
    with pytest.raises(FormatError, match=rf"toml: {place}: unknown key 'zzz'; known: {known}$"):
        _parse(tmp_path, text)


@pytest.mark.parametrize("key", ["derivatives", "smoothing"])
def test_an_unknown_key_of_a_filter_is_an_error(tmp_path: Path, key: str) -> None:
    """Inline tables are as strict."""
    text = _changed(TEXTS[YARP] + OPTIONAL, f"{key} = {{ window_s", f"{key} = {{ widow_s")
    with pytest.raises(FormatError, match=rf"processing\.{key}: unknown key 'widow_s'; did you mean \"window_s\"\?"):
        _parse(tmp_path, text)


WRONG: dict[str, tuple[str, str, str]] = {
    "another schema": ("experiment/1", "experiment/2", "schema: expected 'forcetorque/experiment/1', got"),
    "a number for a name": ('name = "small arm"', "name = 3", "name: expected a valid string, got 3"),
    "no name": ('name = "small arm"', 'name = ""', "name: String should have at least 1 character"),
    "a number for a path": ('urdf = "arm.urdf"', "urdf = 3", "robot.urdf: Input is not a valid path"),
    "weightlessness": ("[robot]", "[robot]\ngravity = 0", "robot.gravity: expected more than 0, got 0"),
    "a text for a number": ("[robot]", '[robot]\ngravity = "9.81"', "robot.gravity: expected a valid number"),
    "a flag for a number": ("[robot]", "[robot]\ngravity = true", "robot.gravity: expected a valid number"),
    "gravity is no number": ("[robot]", "[robot]\ngravity = nan", "robot.gravity: expected a finite number"),
    "another format": ('"yarp"', '"rosbag"', "recording.format: expected one of 'yarp', "),
    "another kind": ('"analog"', '"digital"', "recording.stream[0].kind: expected one of 'analog', "),
    "joints are no list": (str(list(JOINTS)).replace("'", '"'), '"elbow"', "recording.stream[1].joints: expected a li"),
    "no joints": (str(list(JOINTS)).replace("'", '"'), "[]", "recording.stream[1].joints: expected at least 1 value"),
    "one table for many": ("[[sensor]]", "[sensor]", "sensor: expected a list, written [[sensor]]"),
    "serial number as number": ('serial = "SIM001"', "serial = 1", "sensor[0].serial: expected a valid string"),
    "joint without direction": ("[[sensor]]", '[[sensor]]\njoint = "tool_joint"', "sensor[0]: a sensor without a URDF"),
    "direction without joint": (
        "[[sensor]]",
        '[[sensor]]\nmeasure_direction = "child_to_parent"',
        "sensor[0]: measure_direction and frame are for a sensor without a URDF tag, which also needs joint",
    ),
    "another direction": (
        "[[sensor]]",
        '[[sensor]]\njoint = "tool_joint"\nmeasure_direction = "up"',
        "sensor[0].measure_direction: expected 'child_to_parent' or 'parent_to_child', got 'up'",
    ),
    "another frame": (
        "[[sensor]]",
        '[[sensor]]\njoint = "tool_joint"\nmeasure_direction = "child_to_parent"\nframe = "world"',
        "sensor[0].frame: expected 'child', 'parent' or 'sensor', got 'world'",
    ),
    "allowed gains alone": ("[[sensor]]", "[[sensor]]\nallowed_gains = [8]", "sensor[0]: allowed_gains needs amplifi"),
    "full scale of three axes": (
        "[[sensor]]",
        "[[sensor]]\nfull_scale = [150, 150, 150]",
        "sensor[0].full_scale: expected six numbers, of fx, fy, fz in N and of tx, ty, tz in N m, got [150, 150, 150]",
    ),
    "no gain": (
        "[[sensor]]",
        "[[sensor]]\namplifier_gain = []",
        "sensor[0].amplifier_gain: expected at least 1 value",
    ),
    "a gain of zero": (
        "[[sensor]]",
        "[[sensor]]\namplifier_gain = [24, 0]",
        "sensor[0].amplifier_gain[1]: expected more than 0, got 0",
    ),
    "two components": ("[0.0, 0.0, -1.0]", "[0.0, -1.0]", "expected an array of shape (3), got (2,)"),
    "gravity is a word": ("[0.0, 0.0, -1.0]", '"down"', "support[0].gravity_direction: "),
    "gravity is a table": ("[0.0, 0.0, -1.0]", "{ z = -1 }", "support[0].gravity_direction: "),
    "gravity with nan": ("[0.0, 0.0, -1.0]", "[0.0, 0.0, nan]", "support[0].gravity_direction: "),
    "time as text": ("start_s = 0.5", 'start_s = "0.5"', "interval[0].start_s: expected a valid number, got "),
    "endless": ("end_s = 23.5", "end_s = inf", "interval[1].end_s: expected a finite number, got inf"),
    "another use": ('"calibration"', '"train"', "interval[0].use: expected 'calibration', 'validation' or 'ign"),
    "a filter is a number": (
        "{ window_s = 0.4, order = 4 }",
        "0.4",
        "processing.derivatives: expected a table, got 0.4",
    ),
    "another word": ("{ window_s = 0.4, order = 4 }", '"log"', "processing.derivatives: expected 'logged', got"),
    "no window": ("window_s = 0.4", "window_s = 0", "processing.derivatives.window_s: expected more than 0"),
    "half an order": ("order = 4", "order = 2.5", "processing.derivatives.order: expected a valid integer"),
    "negative order": ("order = 2", "order = -1", "processing.smoothing.order: expected at least"),
    "negative lambda": ("= 1000", "= -1", "calibration.lambda_counts2: expected at least 0"),
    "lambda is no number": ("= 1000", "= nan", "calibration.lambda_counts2: expected at least"),
    "lambda as text": (
        "= 1000",
        '= "1000"',
        "calibration.lambda_counts2: expected a number of at least 0 counts2 or `h",
    ),
    "lambda as flag": ("= 1000", "= true", "calibration.lambda_counts2: expected a valid number, got True"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_named_with_its_key(tmp_path: Path, name: str) -> None:
    """The one error says file, table, key, what was expected and what came, and claims no second one."""
    old, new, message = WRONG[name]
    with pytest.raises(FormatError, match=re.escape(message)) as caught:
        _parse(tmp_path, _changed(TEXTS[YARP] + OPTIONAL, old, new))
    assert str(caught.value).startswith(f"{tmp_path / 'experiment.toml'}: ")
    assert "more)" not in str(caught.value)
    assert "\n" not in str(caught.value)


def test_several_wrong_values_are_counted(tmp_path: Path) -> None:
    """The first is shown, the number of the others said."""
    text = TEXTS[YARP].replace("start_s = ", "start_s = -inf #").replace('"SIM001"', "1")
    with pytest.raises(FormatError, match=r"sensor\[0\]\.serial: .* \(and 2 more\)$"):
        _parse(tmp_path, text)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b'name = "\xff"', "expected TOML, got 'utf-8' codec can't decode byte 0xff in position 8"),
        (b"", r"schema: expected this key, there is none \(and 3 more\)"),
        (b"name = " + b"[" * 5000, "expected TOML, got maximum recursion depth exceeded"),
        (b"name = 1" + b"0" * 5000, "expected TOML, got Exceeds the limit"),
    ],
    ids=["encoding", "empty", "nested", "long number"],
)
def test_what_is_not_toml_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """No bytes lead to anything but one error that names the file."""
    file = tmp_path / "experiment.toml"
    file.write_bytes(content)
    with pytest.raises(FormatError, match=rf"experiment\.toml: {message}"):
        parse_experiment(file)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("start_s = 0.5", "start_s = half", "expected TOML, got Invalid value"),
        ('serial = "SIM001"', 'stream = "arm_ft"', "expected TOML, got Cannot overwrite a value"),
        ("[robot]", "[robot", "expected TOML, got Expected ']' at the end of a table declaration"),
    ],
)
def test_an_error_of_syntax_names_the_line(tmp_path: Path, old: str, new: str, message: str) -> None:
    """The line is that of the damage."""
    line = TEXTS[PARQUET].splitlines().index(old) + 1
    with pytest.raises(FormatError, match=rf"toml: {re.escape(message)} \(at line {line}, column \d+\)$"):
        _parse(tmp_path, _changed(TEXTS[PARQUET], f"{old}\n", f"{new}\n"))


@pytest.mark.parametrize(("name", "got"), [("nowhere.toml", "there is none"), (".", "got a folder")])
def test_a_missing_file_is_named(tmp_path: Path, name: str, got: str) -> None:
    """Neither nothing nor a folder is an experiment file."""
    with pytest.raises(MissingFileError, match=f"expected an experiment file, {got}$"):
        parse_experiment(tmp_path / name)


def test_a_file_that_changed_is_parsed_again(tmp_path: Path) -> None:
    """One that did not is not; each time it is an input of the run, which no output may replace."""
    first = _parse(tmp_path, TEXTS[PARQUET])
    assert _parse(tmp_path, TEXTS[PARQUET]) is first
    changed = _parse(tmp_path, TEXTS[PARQUET].replace(f'name = "{first.name}"', 'name = "another"', 1))
    assert (changed.name, first.name == "another") == ("another", False)
    file = tmp_path / "experiment.toml"
    with files_of_one_run():
        declare_output(file)
        with pytest.raises(OutputError, match=r"experiment\.toml"):
            parse_experiment(file)


def test_a_log_is_not_taken_for_an_experiment_file(tmp_path: Path) -> None:
    """The error names its format and the command that begins an experiment file of it."""
    log = tmp_path / "log.csv"
    log.write_text("time,fx\n0.0,1.0\n", encoding="utf-8")
    message = rf"expected an experiment file, got a log of the format tabular; `forcetorque init {re.escape(str(log))}`"
    with pytest.raises(FormatError, match=message):
        parse_experiment(log)

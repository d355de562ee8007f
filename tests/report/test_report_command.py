# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque report`: the numbers of the other commands in one document, verdict first, and what it refuses."""

from __future__ import annotations

import json
import re
import shutil
from contextlib import chdir
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from forcetorque.report.sorted_input_files import sort_sources
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.browser import Visit
from tests.scenes.experiments import PARQUET, TWO, add, edit, snapshot

EXAMPLES = Path(__file__).parents[2] / "examples"
YOGA = EXAMPLES / "02_icub_yoga_forward.toml"
LIMITS = """schema = "forcetorque/acceptance/1"
name = "limits"

[evaluate]
force_error_mean_N = 1.0

[matrix]
condition = 0.5
"""
NORMAL_BYTES = 2_000_000
"""Largest size of the document of a normal study."""


class _Words(HTMLParser):
    """The text of a page without its style, line by line."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[str] = []
        self._inside: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "style":
            self._inside.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag == "style":
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        if not self._inside and data.strip():
            self.lines.append(" ".join(data.split()))


def _words(path: str) -> list[str]:
    page = _Words()
    page.feed(Path(path).read_text(encoding="utf-8"))
    return page.lines


def _sensor(result: Any) -> Any:
    ((sensor,),) = [each["sensors"] for each in result["experiments"]]
    return sensor


@pytest.fixture(scope="module")
def reported(intact: Path, run: Run, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder in which a report was written of a calibrated sensor, limits and the result of another command."""
    folder = Path(shutil.copytree(intact, tmp_path_factory.mktemp("reported") / "arm"))
    (folder / "limits.toml").write_text(LIMITS, encoding="utf-8")
    with chdir(folder):
        gains = run("bench", "gains", PARQUET, "--format", "json").result()
        Path("gains.json").write_text(json.dumps(gains | {"experiment": "<b>bold</b>"}), encoding="utf-8")
        files = (PARQUET, "gains.json", "-c", "fitted.json", "limits.toml")
        printed = run("report", *files, "-o", "report.html", "-o", "report.pdf", "--format", "json")
    (folder / "printed.json").write_text(printed.out, encoding="utf-8")
    return folder


@pytest.fixture
def result(reported: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """What was printed; its folder is the working folder."""
    monkeypatch.chdir(reported)
    return json.loads(Path("printed.json").read_text(encoding="utf-8"))


def test_the_numbers_are_those_of_the_other_commands(result: Any, run: Run) -> None:
    """Row by row; the file beside the document holds what is printed, and it fits its schema."""
    assert faults(result, run("schema", "report").result()) == []
    assert json.loads(Path("report.numbers.json").read_text(encoding="utf-8")) == result
    sensor = _sensor(result)
    same = ("-c", "fitted.json", "--format", "json")
    assert sensor["evaluation"] == run("evaluate", PARQUET, *same).result()["verdicts"]
    validated = run("study", "validate", PARQUET, *same).result()
    for key in ("contact_forces", "joint_torques", "best"):
        assert sensor[key] == validated[key]
        assert sensor[key]
    assert sensor["spheres"] == run("study", "sphere", PARQUET, *same).result()["rows"]
    accepted = json.loads(run("accept", PARQUET, "--spec", "limits.toml", *same).out)
    assert (sensor["criteria"], sensor["static"]) == (accepted["criteria"], accepted["measured"])
    assert result["experiments"][0]["findings"] == run("inspect", PARQUET, "--format", "json").result()["findings"]
    assert sensor["not_evaluated"] == {}


def test_evaluate_and_validate_say_what_the_report_says(result: Any, run: Run) -> None:
    """Word by word, of every offset; who is best in one is so in the others."""
    sensor = _sensor(result)
    sentences = [line["text"] for line in sensor["verdict"] if "samples that were not fitted" in line["text"]]
    assert len(sentences) == 2
    shown = " ".join(run("evaluate", PARQUET, "-c", "fitted.json", "--details").out.split())
    assert all(sentence in shown for sentence in sentences)
    assert {row["conclusion"] for row in sensor["comparisons"]} == {"better"}
    assert {best["conclusion"] for best in sensor["best"]} == {"better"}
    shown = " ".join(run("study", "validate", PARQUET, "-c", "fitted.json", "--details").out.split())
    lines = [line for line in _words("report.html") if "best is fitted.json" in line]
    assert len(lines) == 2
    assert all(line in shown for line in lines)


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_the_decision_comes_first_and_says_what_the_numbers_say(result: Any, run: Run) -> None:
    """The word on the use, the figure and the steps, then all else, folded; the JSON has the same verdict and steps."""
    (use,) = result["load_cases"]
    assert result["undecided"] == []
    assert (use["sensor"], use["calibration"], use["specified"]) == ("arm_ft", "fitted.json", False)
    lines = _words("report.html")
    said = use["message"].removeprefix(use["decision"]).strip()
    (steps,) = result["next_steps"]
    first_step = steps["steps"][0].split("`")[0].strip()
    order = [
        lines.index(text)
        for text in (result["title"], f"fitted.json, {said}.", "What to do next", first_step, "Better than the prior?")
    ]
    assert order == sorted(order)
    assert any(line.endswith(use["decision"]) for line in lines[: order[1]])
    assert any("Check that this is your use." in step for step in steps["steps"])
    csv = run("report", PARQUET, "fitted.json", "-o", "again.html", "--format", "csv").out.splitlines()
    assert csv[0] == "experiment,sensor,serial,tone,text"
    assert csv[1].startswith(",arm_ft,SIM001,")
    assert use["decision"] in csv[1]


def test_the_sentences_about_the_recording_say_what_the_numbers_say(result: Any) -> None:
    """A failed limit is the first sentence; better by far is good, with both numbers of the evaluation."""
    sensor = _sensor(result)
    first, second, *_ = sensor["verdict"]
    assert first["tone"] == "bad"
    assert "fitted.json is not accepted: 1 of 2 criteria fail: matrix.condition" in first["text"]
    force, moment = (row for row in sensor["comparisons"] if row["offset"] == "fitted")
    assert (second["tone"], force["quantity"], moment["quantity"]) == ("good", "force", "moment")
    assert (
        f"force error {force['mean']:.2f} N against {force['prior_mean']:.2f} N with the prior (better"
        in second["text"]
    )
    assert f"moment error {moment['mean']:.3f} N m against {moment['prior_mean']:.3f} N m" in second["text"]
    lines = _words("report.html")
    title, verdict, measured = (
        lines.index(text) for text in (result["title"], first["text"].removeprefix("fitted.json: "), "Intervals")
    )
    assert title < verdict < measured


def test_the_document_holds_the_tables_and_pictures(result: Any) -> None:
    """Every section of a calibrated sensor, the cells of its tables, one picture each; less than 2 MB."""
    sensor = _sensor(result)
    lines = _words("report.html")
    for title in (
        "Errors on data that was not fitted",
        "Force and moment space",
        "Contact force where nothing touches",
        "Joint torques",
        "Information gained from the recordings",
        "Uncertainty",
        "What the sensor can do",
        "Acceptance",
        "Provenance",
    ):
        assert title in lines
    for title in ("Choice of lambda", "Excitation"):  # the generative model has neither
        assert title not in lines
    assert sensor["information_gain"]["fitted.json"][2]["direction"] == "fz"
    for row in sensor["evaluation"]:
        assert all(f"{value:.3f}" in lines for value in row["rmse"])
    matrix = sensor["calibrations"]["fitted.json"]["matrix"]
    assert any(line.startswith(f"{matrix[2][3]:.3e} ±") for line in lines)
    html = Path("report.html").read_bytes()
    assert html.count(b"<img ") == 7
    assert len(html) < NORMAL_BYTES
    assert Path("report.pdf").read_bytes().startswith(b"%PDF")


def test_results_of_other_commands_are_shown_as_they_are(result: Any) -> None:
    """A table per list of rows; markup in their words does not become markup."""
    gains = json.loads(Path("gains.json").read_text(encoding="utf-8"))
    assert result["results"] == {"gains.json": gains}
    assert "Result of gains" in _words("report.html")
    assert b"<b>bold" not in Path("report.html").read_bytes()


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_without_a_calibration_the_priors_are_shown(arm: Path, run: Run) -> None:
    """Of all sensors; the verdict says that there is nothing to compare them with."""
    result = run("report", TWO, "-o", "report.html", "--format", "json").result()
    sensors = result["experiments"][0]["sensors"]
    assert [sensor["sensor"] for sensor in sensors] == ["arm_ft", "tool_ft"]
    for sensor in sensors:
        assert {row["calibration"] for row in sensor["evaluation"]} == {"prior"}
        assert sensor["verdict"][0]["tone"] == "unknown"
        assert sensor["verdict"][0]["text"].endswith("no calibration was given to compare it with")
    assert result["load_cases"] == []
    assert [row["sensor"] for row in result["undecided"]] == ["arm_ft", "tool_ft"]
    assert "forcetorque calibrate two.toml --sensor arm_ft" in result["next_steps"][0]["steps"][0]


@pytest.mark.usefixtures("blank_pictures")
def test_what_cannot_be_judged_is_said_and_the_rest_is_shown(arm: Path, run: Run) -> None:
    """No interval to judge on: no errors, but spheres, static checks and uncertainty."""
    edit(arm / PARQUET, 'use = "validation"', 'use = "ignore"')
    sensor = _sensor(run("report", PARQUET, "fitted.json", "-o", "report.html", "--format", "json").result())
    assert sensor["not_evaluated"]
    assert sensor["evaluation"] == []
    assert sensor["spheres"]
    assert sensor["static"]
    unknown = [line["text"] for line in sensor["verdict"] if line["tone"] == "unknown"]
    assert any(text.startswith("not evaluated: errors of fitted.json: ") for text in unknown)
    assert "Errors on data that was not fitted" not in _words("report.html")
    assert "Uncertainty" in _words("report.html")


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_nothing_is_shown_of_a_calibration_on_data_that_it_was_fitted_on(arm: Path, run: Run) -> None:
    """Fitted and judged intervals change places: another calibration is judged, the fitted one is not."""
    edit(arm / PARQUET, 'label = "fit"\nstart_s = 0.5\nend_s = 14.0', 'label = "fit"\nstart_s = 0.5\nend_s = 7.0')
    assert run("calibrate", PARQUET, "-o", "early.json").code == 0
    edit(arm / PARQUET, "start_s = 14.5\nend_s = 23.5", "start_s = 8.0\nend_s = 13.0")
    words = (PARQUET, "fitted.json", "early.json", "-o", "report.html", "--format", "json")
    result = run("report", *words).result()
    sensor = _sensor(result)
    assert [row["calibration"] for row in result["load_cases"]] == ["early.json"]
    (unjudged,) = result["undecided"]
    assert unjudged["calibration"] == "fitted.json"
    assert "was fitted on the interval" in unjudged["reason"]
    assert "was fitted on the interval" in sensor["not_evaluated"]["errors of fitted.json"]
    for rows in ("evaluation", "contact_forces", "joint_torques", "comparisons", "independence"):
        assert {row["calibration"] for row in sensor[rows]} <= {"prior", "early.json"}
        assert "early.json" in {row["calibration"] for row in sensor[rows]}
    flattered = [line for line in sensor["verdict"] if "which flatters: it was fitted on" in line["text"]]
    assert all(line["tone"] == "caution" for line in flattered)


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_the_order_of_intervals_in_the_file_does_not_matter(arm: Path, run: Run) -> None:
    """Two judged intervals, the later one first: figures and numbers come in the order of time."""
    later = 'label = "judge"\nstart_s = 19.0\nend_s = 23.5\nuse = "validation"\nsupport = "base"\n'
    first = '\n[[interval]]\nlabel = "first"\nstart_s = 14.5\nend_s = 18.5'
    edit(arm / PARQUET, 'label = "judge"\nstart_s = 14.5\nend_s = 23.5', later + first)
    sensor = _sensor(run("report", PARQUET, "fitted.json", "-o", "report.html", "--format", "json").result())
    assert sensor["not_evaluated"] == {}
    assert sensor["comparisons"]


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_load_cases_of_the_acceptance_file_are_judged(arm: Path, run: Run) -> None:
    """Each has a verdict; one that the sensor cannot read is said in a line, and the rest of the report is there."""
    case = '\n[[load_case]]\nname = "{}"\nforce_N = {}\nradius_m = 0.1\n'
    Path("limits.toml").write_text(LIMITS + case.format("light", 2.0) + case.format("firm", 5.0), encoding="utf-8")
    words = (PARQUET, "fitted.json", "limits.toml", "-o", "report.html", "--format", "json")
    result = run("report", *words).result()
    assert [(row["load_case"], row["specified"]) for row in result["load_cases"]] == [("light", True), ("firm", True)]
    assert not any("Check that this is your use" in step for step in result["next_steps"][0]["steps"])
    Path("limits.toml").write_text(LIMITS + case.format("giant", 1e6) + case.format("light", 2.0), encoding="utf-8")
    result = run("report", *words).result()
    assert [row["load_case"] for row in result["load_cases"]] == ["light"]
    (undecided,) = result["undecided"]
    assert "load case 'giant': reaches" in undecided["reason"]
    assert _sensor(result)["evaluation"]


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_a_load_case_that_cannot_be_had_costs_no_errors(arm: Path, run: Run) -> None:
    """Also where the experiment file states it: what is measured does not hang on what the sensor is for."""
    add(arm / PARQUET, '\n[[load_case]]\nname = "giant"\nforce_N = 1e6\nradius_m = 0.1\n')
    result = run("report", PARQUET, "fitted.json", "-o", "report.html", "--format", "json").result()
    assert result["load_cases"] == []
    assert ["load case 'giant': reaches" in row["reason"] for row in result["undecided"]] == [True]
    sensor = _sensor(result)
    assert sensor["evaluation"]
    assert sensor["comparisons"]
    assert sensor["not_evaluated"] == {}
    assert "load case 'giant': reaches" in run("evaluate", PARQUET, "-c", "fitted.json").error()


USE = """
[[load_case]]
name = "push"
force_N = 20.0
radius_m = 0.2
offset = "tared"
force_error_N = {allowed}

[plan]
clearance_deg = {clearance}
"""


@pytest.mark.usefixtures("blank_pictures")
@pytest.mark.long
def test_what_to_record_first_is_said_where_limits_are_stated(arm: Path, run: Run) -> None:
    """Of a use whose predicted error is too large: postures, and the error to expect; else why it is not known."""
    text = (arm / PARQUET).read_text(encoding="utf-8")
    words = ("report", PARQUET, "fitted.json", "-o", "report.html", "--format", "json")

    def steps(rest: str) -> list[str]:
        (arm / PARQUET).write_text(text + rest, encoding="utf-8")
        return list(run(*words).result()["next_steps"][0]["steps"])

    planned = [step for step in steps(USE.format(allowed=1e-3, clearance=12)) if step.startswith("For “push”, ")]
    assert len(planned) == 1
    pattern = r"record first \d+ postures in \d+ s, .*: the expected error falls from .* N m to .* N \(95 %: "
    assert re.search(pattern, planned[0])
    impossible = steps(USE.format(allowed=1e-3, clearance=900))
    assert any("For “push”, no recording could be planned: plan: joint" in step for step in impossible)
    # negative control: an error that is allowed
    assert not any("For “push”" in step for step in steps(USE.format(allowed=5.0, clearance=12)))


def test_a_viewer_without_a_sensor_is_left_out_with_its_reason(arm: Path, run: Run) -> None:
    """The rest of the report is written."""
    text = Path(PARQUET).read_text(encoding="utf-8")
    bare = re.sub(r"(?ms)^\[\[sensor\]\].*?(?=^\[|\Z)", "", text)
    assert bare != text
    Path("bare.toml").write_text(bare, encoding="utf-8")
    assert run("report", "bare.toml", "--viewer", "-o", "report.html").code == 0
    assert any("The viewer could not be made: " in line and "got none" in line for line in _words("report.html"))


def test_a_folder_stands_for_the_calibrations_in_it(arm: Path) -> None:
    """As `calibrate` and `run` write it for several sensors."""
    (arm / "folder").mkdir()
    shutil.copy(arm / "fitted.json", arm / "folder/arm.json")
    _, calibrations, _, _ = sort_sources([arm / PARQUET, arm / "folder"])
    assert list(calibrations) == [str(arm / "folder/arm.json")]


REFUSED = {
    "no experiment": (["fitted.json"], r"expected an experiment file among the files, its samples are drawn; got none"),
    "missing file": ([PARQUET, "none.json"], r"none.json: expected a file to report on, there is none"),
    "folder": (
        [PARQUET, "recording"],
        r"recording: expected a folder of calibrations, .json; it holds none",
    ),
    "not JSON": ([PARQUET, "broken.json"], r"broken.json: expected an experiment file, .*: Expecting "),
    "no suffix": ([PARQUET, "prior"], r"prior: expected .*, whose names end in .toml or .json"),
    "no schema": ([PARQUET, "other.json"], r"other.json: expected .*, got the schema None"),
    "a list": ([PARQUET, "list.json"], r"list.json: expected .*, got a list"),
    "two limits": ([PARQUET, "a.toml", "b.toml"], r"expected one acceptance file, got 2"),
    "foreign calibration": (
        [PARQUET, "foreign.json"],
        r"foreign.json: calibrates leg_ft \(SIM001\), which none of the experiments has; they have arm_ft \(SIM001\)",
    ),
    "other serial": ([PARQUET, "serial.json"], r"serial.json: calibrates arm_ft \(SIM009\), which none"),
    "no result": ([PARQUET, "truth.json"], r"truth.json: expected .*, got the schema 'forcetorque/truth/1'"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_one_line_and_nothing_is_written(arm: Path, run: Run, name: str) -> None:
    """Each says which file, what was expected and what came."""
    Path("broken.json").write_text("{", encoding="utf-8")
    Path("other.json").write_text("{}", encoding="utf-8")
    shutil.copy("fitted.json", "prior")
    Path("list.json").write_text("[]", encoding="utf-8")
    for limits in ("a.toml", "b.toml"):
        Path(limits).write_text(LIMITS, encoding="utf-8")
    content = json.loads(Path("fitted.json").read_text(encoding="utf-8"))
    content["sensor"]["name"] = "leg_ft"
    Path("foreign.json").write_text(json.dumps(content), encoding="utf-8")
    content["sensor"] |= {"name": "arm_ft", "serial": "SIM009"}
    Path("serial.json").write_text(json.dumps(content), encoding="utf-8")
    Path("truth.json").write_text('{"schema": "forcetorque/truth/1"}', encoding="utf-8")
    files, message = REFUSED[name]
    before = snapshot(arm)
    ended = run("report", *files, "-o", "report.html")
    assert ended.code == 2
    assert re.search(message, ended.error())
    assert snapshot(arm) == before


def test_other_kinds_of_files_are_refused_before_anything_is_read(arm: Path, run: Run) -> None:
    """The second file to write counts too."""
    ended = run("report", PARQUET, "-o", "report.html", "-o", "report.docx")
    assert ended.code == 2
    assert "--output report.docx: expected a name that ends in .html or .pdf" in ended.error()
    assert not Path("report.html").exists()


@pytest.mark.parametrize(
    ("outputs", "message"),
    [
        (["limits.html"], "limits.numbers.json: expected a file to write that is not read, got an input"),
        (["none/report.html"], "none/report.html: expected an existing folder to write to, got none"),
    ],
)
def test_no_file_to_read_is_written_over(arm: Path, run: Run, outputs: list[str], message: str) -> None:
    """Neither a document nor its numbers take the place of an input; it is said before the work."""
    shutil.copy("fitted.json", "limits.numbers.json")
    before = snapshot(arm)
    ended = run("report", PARQUET, "limits.numbers.json", *(word for file in outputs for word in ("-o", file)))
    assert ended.code == 2
    assert message in ended.error()
    assert ended.log == []
    assert snapshot(arm) == before


@pytest.mark.real_data
@pytest.mark.long
def test_a_real_leg(data_dir: Path, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The verdict on the yoga log: errors fall, but the recording is too short to call that better."""
    monkeypatch.chdir(tmp_path)
    assert run("calibrate", YOGA, "-o", "leg.json").code == 0
    sensor = _sensor(run("report", YOGA, "leg.json", "-o", "leg.html", "-o", "leg.pdf", "--format", "json").result())
    own, of_judged, *rest = sensor["verdict"]
    for line in (own, of_judged):
        assert line["tone"] == "caution"
        assert not {"(better:", "(worse:"} & set(line["text"].split())
    assert re.search(r"inconclusive: the errors repeat themselves, and are worth [12] segments? only", own["text"])
    assert re.search(r"inconclusive: 0\.\d\d of it, 0\.\d\d to 1\.\d\d over \d segments", of_judged["text"])
    # three times smaller in the mean, and yet: sixteen seconds of slow errors are worth a handful of samples
    force = next(row for row in sensor["comparisons"] if (row["offset"], row["quantity"]) == ("fitted", "force"))
    assert force["mean"] < 0.4 * force["prior_mean"]
    assert (force["conclusion"], force["ratio_low"]) == ("inconclusive", None)
    assert any("for fx, fy, fz, ty, tz the prior decides" in line["text"] for line in rest)
    assert any("independent samples" in line["text"] for line in rest)
    assert Path("leg.html").stat().st_size < NORMAL_BYTES
    assert min(count for row in sensor["independence"] for count in row["independent"]) < 200


@pytest.mark.browser
def test_the_verdict_is_on_the_first_screen(visit: Visit, reported: Path) -> None:
    """Title, then verdict, both without scrolling; every picture is drawn."""
    page = visit.blank()
    page.goto((reported / "report.html").as_uri())
    assert page.get_by_role("heading", level=1).is_visible()
    verdict = page.locator(".verdict").first.bounding_box()
    assert verdict is not None
    assert verdict["y"] + verdict["height"] < page.viewport_size["height"]  # type: ignore[index]
    widths = page.locator("img").evaluate_all("images => images.map(image => image.complete ? image.naturalWidth : 0)")
    assert len(widths) == 7
    assert min(widths) >= 1000

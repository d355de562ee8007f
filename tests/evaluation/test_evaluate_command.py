# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`: its numbers against plain NumPy, its forms, and what it refuses to judge."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, YARP, edit, snapshot
from tests.scenes.warm_experiments import TEMPERATURE

ROUNDING = 1e-9
"""N, N m: sums of 1e3 products of counts up to 2e4 and coefficients up to 0.03, in another order."""
OFFSETS = ("fitted", "judged-mean")


def _verdicts(result: Any) -> dict[tuple[str, str], Any]:
    return {(row["calibration"], row["offset"]): row for row in result["verdicts"]}


def _samples(form: str, use: Use) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    experiment = load_experiment(form)
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(use)
    return part.raw, part.samples.reference


def _by_hand(error: npt.NDArray[np.float64]) -> dict[str, Any]:
    """Every statistic of one verdict, from the errors alone."""
    expected: dict[str, Any] = {
        "samples": len(error),
        "rmse": [float(np.sqrt(sum(column**2) / len(column))) for column in error.T],
        "bias": [float(sum(column) / len(column)) for column in error.T],
        "largest": [max(float(column.max()), float(-column.min())) for column in error.T],
    }
    for name, norm in (
        ("force_error_{}_N", np.sqrt((error[:, :3] ** 2).sum(axis=1))),
        ("moment_error_{}_Nm", np.sqrt((error[:, 3:] ** 2).sum(axis=1))),
    ):
        expected[name.format("mean")] = norm.mean()
        expected[name.format("largest")] = norm.max()
    return expected


def _differs(row: dict[str, Any], expected: dict[str, Any]) -> list[str]:
    assert row.keys() >= expected.keys()
    return [key for key in expected if np.abs(np.subtract(row[key], expected[key])).max() > ROUNDING]


@pytest.mark.parametrize("form", [PARQUET, YARP])
def test_the_numbers_are_those_of_plain_numpy(arm: Path, run: Run, form: str) -> None:
    """Matrix and offset of the file, on the judged samples, give every number of the result; a wrong sign does not."""
    fitted = json.loads(Path("fitted.json").read_text(encoding="utf-8"))
    rows = _verdicts(run("evaluate", form, "--calibration", "fitted.json", "--format", "json").result())
    assert list(rows) == [(candidate, offset) for candidate in ("prior", "fitted.json") for offset in OFFSETS]
    raw, reference = _samples(form, Use.VALIDATION)
    raw_fitted, reference_fitted = _samples(form, Use.CALIBRATION)
    assert len(raw) > 400
    for candidate, stored in (("prior", fitted["prior"]), ("fitted.json", fitted)):
        matrix, offset = np.array(stored["matrix"]), np.array(stored["offset"])
        if candidate == "prior":  # its offset is the mean on the fitted data
            offset = (reference_fitted - raw_fitted @ matrix.T).mean(axis=0)
        error = raw @ matrix.T + offset - reference
        assert _differs(rows[candidate, "fitted"], _by_hand(error)) == []
        assert _differs(rows[candidate, "judged-mean"], _by_hand(error - error.mean(axis=0))) == []
        wrong = _by_hand(raw @ matrix.T - offset - reference)
        assert _differs(rows[candidate, "fitted"], wrong) == [key for key in wrong if key != "samples"]


def test_the_json_fits_the_printed_schema(arm: Path, run: Run) -> None:
    """The result is what `forcetorque schema evaluate` promises; a damaged one is noticed."""
    result = run("evaluate", PARQUET, "-c", "fitted.json", "--format", "json").result()
    schema = run("schema", "evaluate").result()
    assert (result["schema"], result["experiment"]) == ("forcetorque/evaluate/2", "small arm")
    assert faults(result, schema) == []
    for key in ("samples", "rmse", "offset"):
        row = {**result["verdicts"][0], key: "no such word"}
        assert faults({**result, "verdicts": [row]}, schema) != []
    assert {key for row in result["verdicts"] for key in row} == set(schema["$defs"]["CalibrationErrors"]["properties"])


def test_the_csv_holds_the_same_numbers(arm: Path, run: Run) -> None:
    """One row per verdict, equally long, with units in the names of the columns."""
    verdicts = run("evaluate", PARQUET, "-c", "fitted.json", "--format", "json").result()["verdicts"]
    rows = run("evaluate", PARQUET, "-c", "fitted.json", "--format", "csv").rows()
    assert len(rows) == len(verdicts) == 4
    for row, verdict in zip(rows, verdicts, strict=True):
        assert (row["calibration"], row["offset"]) == (verdict["calibration"], verdict["offset"])
        assert abs(float(row["rmse_fz_N"]) - verdict["rmse"][2]) < ROUNDING
        assert abs(float(row["bias_tx_Nm"]) - verdict["bias"][3]) < ROUNDING
        assert abs(float(row["largest_tz_Nm"]) - verdict["largest"][5]) < ROUNDING
        assert abs(float(row["moment_error_mean_Nm"]) - verdict["moment_error_mean_Nm"]) < ROUNDING


def test_the_table_is_the_default(arm: Path, run: Run) -> None:
    """Without --format people get the verdict first, and in the details a line per candidate with its RMSE."""
    verdicts = run("evaluate", PARQUET, "-c", "fitted.json", "--format", "json").result()["verdicts"]
    shown = run("evaluate", PARQUET, "-c", "fitted.json", "--details")
    assert shown.code == 0
    assert shown.err.splitlines() == shown.log
    answer, details = shown.out.split("\n\n", maxsplit=1)
    assert answer.splitlines()[0].split() == ["arm_ft", "(SIM001),", "fitted.json", "NOT", "ENOUGH", "DATA"]
    lines = details.splitlines()
    assert lines[0].rstrip() == f"small arm: arm_ft (SIM001), {verdicts[0]['samples']} samples that were not fitted"
    errors = lines[: lines.index("mean error, by its own offset")]
    rows = [line.split() for line in errors if line.startswith((" prior", " fitted.json"))]
    assert [row[:2] for row in rows] == [[verdict["calibration"], verdict["offset"]] for verdict in verdicts]
    for row, verdict in zip(rows, verdicts, strict=True):
        assert row[2:8] == [f"{value:.3f}" for value in verdict["rmse"]]


def test_several_calibrations_are_compared(arm: Path, run: Run) -> None:
    """Each has its rows, a shared prior comes once under the first, and every sensor is judged by itself."""
    assert run("calibrate", TWO, "-o", "made", "--lambda", "5").code == 0
    ours, tool = "made/arm_ft_SIM001.json", "made/tool_ft_SIM%2F002.json"
    rows = run("evaluate", TWO, "-c", "fitted.json", "-c", tool, "-c", ours, "--format", "csv").rows()
    assert [(row["sensor"], row["calibration"]) for row in rows[::2]] == [
        ("arm_ft", "prior of fitted.json"),
        ("arm_ft", "fitted.json"),
        ("arm_ft", ours),
        ("tool_ft", "prior"),
        ("tool_ft", tool),
    ]
    shown = " ".join(run("evaluate", TWO, "-c", "fitted.json", "-c", tool, "-c", ours, "--details").out.split())
    assert f"arm_ft: {Path(ours).name} with its own offset, " in shown
    assert f"tool_ft: {Path(tool).name} with its own offset, " in shown


def test_the_folder_of_several_sensors_is_evaluated(arm: Path, run: Run) -> None:
    """As its files one by one; of one sensor by --sensor, which files by name may not contradict."""
    assert run("calibrate", TWO, "-o", "made", "--lambda", "5").code == 0
    Path("made/other.json").write_text('{"schema": "forcetorque/evaluate/2"}', encoding="utf-8")
    ours, tool = "made/arm_ft_SIM001.json", "made/tool_ft_SIM%2F002.json"
    form = ("--format", "json")
    by_file = run("evaluate", TWO, "-c", ours, "-c", tool, *form).result()
    assert run("evaluate", TWO, "-c", "made", *form).result()["verdicts"] == by_file["verdicts"]
    one = run("evaluate", TWO, "-c", "made", "--sensor", "tool_ft", *form).result()["verdicts"]
    assert one == [row for row in by_file["verdicts"] if row["sensor"] == "tool_ft"]
    assert "which --sensor leaves out" in run("evaluate", TWO, "-c", ours, "--sensor", "tool_ft").error()
    Path("empty").mkdir()
    assert "empty: expected a folder of calibrations" in run("evaluate", TWO, "-c", "empty").error()


def test_the_table_tells_files_of_one_name_apart(arm: Path, run: Run) -> None:
    """Folders are left out of the table, also those with spaces, but not where two files share a name."""
    folder = Path("a b")
    folder.mkdir()
    assert run("calibrate", PARQUET, "-o", folder / "new.json", "--lambda", "5").code == 0
    short = run("evaluate", PARQUET, "-c", "fitted.json", "-c", folder / "new.json", "--details").out
    assert " prior of fitted.json " in short
    assert "\n new.json " in short
    assert "a b" not in short
    shutil.copyfile("fitted.json", folder / "fitted.json")
    long = run("evaluate", PARQUET, "-c", "fitted.json", "-c", folder / "fitted.json", "--details").out
    assert "\n fitted.json " in long
    assert "\n a b/fitted.json " in long


def test_findings_of_the_log_are_warnings(arm: Path, run: Run) -> None:
    """A verdict on a log with findings says so."""
    judged = run("evaluate", YARP, "-c", "fitted.json", "--details")
    assert [line.partition(":")[0] for line in judged.log] == ["INFO", "INFO", "WARNING", "WARNING", "WARNING"]
    assert "readings lie outside what was fitted" in judged.log[-1]
    assert judged.err.splitlines() == judged.log


def test_the_temperature_of_the_judged_samples_is_used(warm: Path, run: Run) -> None:
    """The exact calibration with temperature leaves nothing; where the file states no temperature it is refused."""
    rows = _verdicts(run("evaluate", PARQUET, "-c", "warm.json", "--format", "json").result())
    for offset in OFFSETS:
        assert max(rows["warm.json", offset]["rmse"]) < 1e-5 < 0.1 < max(rows["prior", offset]["rmse"])
    edit(warm / PARQUET, TEMPERATURE, "")
    error = run("evaluate", PARQUET, "-c", "warm.json").error()
    assert error == (
        "error: parquet.toml: sensor 'arm_ft': expected the variable 'temperature', the experiment specifies none; add "
        "it as [[sensor.variable]]"
    )


def _set(path: str, value: Any) -> Callable[[dict[str, Any]], None]:
    def change(content: Any) -> None:
        *parts, last = path.split(".")
        for part in parts:
            content = content[part]
        content[last] = value

    return change


CORRUPT: dict[str, tuple[Callable[[dict[str, Any]], None], str]] = {
    "another schema": (_set("schema", "forcetorque/calibration/9"), "cut.json: expected the schema 'forcetorque/cali"),
    "NaN": (_set("matrix", [[float("nan")] * 6] * 6), "cut.json: matrix: expected finite numbers"),
    "five rows": (
        _set("matrix", [[0.0] * 6] * 5),
        "cut.json: matrix: array: expected an array of shape",
    ),
    "five channels": (
        _set("matrix", [[0.01] * 5] * 6),
        "toml: sensor 'arm_ft': cut.json: matrix: expected an array of",
    ),
    "ragged": (_set("matrix", [[0.0] * 6] * 5 + [[0.0]]), "cut.json: matrix: "),
    "prior of five channels": (
        _set("prior.matrix", [[0.0] * 5] * 6),
        "prior of cut.json: matrix: expected an array of",
    ),
    "unknown key": (_set("sensor.colour", "red"), "cut.json: sensor.colour: expected no such key"),
    "offset is a word": (_set("offset", "none"), "cut.json: offset: "),
    "no prior": (lambda content: content.pop("prior"), "cut.json: prior: expected this key, there is none"),
    "another serial": (
        _set("sensor.serial", "SIM009"),
        "sensor 'arm_ft': cut.json: calibration of sensor 'SIM009': ",
    ),
    "another sensor": (
        _set("sensor.name", "leg_ft"),
        "cut.json: experiment",
    ),
    "another sign": (
        _set("sensor.measure_direction", "parent_to_child"),
        "calibration 'cut.json': expected readings",
    ),
}


@pytest.mark.parametrize("name", CORRUPT)
def test_a_corrupt_or_foreign_calibration_is_refused(arm: Path, run: Run, name: str) -> None:
    """One line names file and key; a good calibration beside it does not help."""
    change, message = CORRUPT[name]
    content = json.loads(Path("fitted.json").read_text(encoding="utf-8"))
    change(content)
    Path("cut.json").write_text(json.dumps(content), encoding="utf-8")
    before = snapshot(arm)
    assert message in run("evaluate", PARQUET, "-c", "fitted.json", "-c", "cut.json").error()
    assert snapshot(arm) == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "cut.json: expected JSON, got Expecting value: line 1 column 1"),
        (
            '{"schema": "forcetorque/calibration/4",\n "sensor": ',
            "cut.json: expected JSON, got Expecting value: line 2",
        ),
        ("[1, 2]", "cut.json: expected the schema 'forcetorque/calibration/4', got None"),
        ("[" * 9999, "cut.json: expected JSON, got maximum recursion depth"),
        ("\udcff", "cut.json: expected JSON, got 'utf-8' codec can't decode byte 0xff in position 0"),
    ],
    ids=["empty", "cut", "list", "nested", "binary"],
)
def test_what_is_no_calibration_file_is_refused(arm: Path, run: Run, text: str, message: str) -> None:
    """Whatever the bytes are, one line names the file."""
    Path("cut.json").write_bytes(text.encode(errors="surrogateescape"))
    assert message in run("evaluate", PARQUET, "-c", "cut.json").error()


def test_a_missing_calibration_is_named(arm: Path, run: Run) -> None:
    """The line says which command makes one."""
    error = run("evaluate", PARQUET, "-c", "nowhere.json").error()
    assert error.startswith(
        "error: nowhere.json: expected a calibration file, there is none; `forcetorque calibrate` m"
    )


def test_what_was_fitted_is_not_judged(arm: Path, run: Run) -> None:
    """A file that was fitted on part of the judged interval is refused, whichever form of the log is judged."""
    for form in (PARQUET, YARP):
        edit(arm / form, "end_s = 14.0", "end_s = 5.0")
        edit(arm / form, "start_s = 14.5", "start_s = 9.0")
        error = run("evaluate", form, "-c", "fitted.json").error()
        assert error.startswith(
            f"error: {form}: sensor 'arm_ft': calibration 'fitted.json' was fitted on the interval "
        )
        edit(arm / form, "start_s = 9.0", "start_s = 14.0")
        assert run("evaluate", form, "-c", "fitted.json").code == 0


def test_an_experiment_without_validation_judges_nothing(arm: Path, run: Run) -> None:
    """The line names the use that is missing."""
    edit(arm / PARQUET, '"validation"', '"ignore"')
    error = run("evaluate", PARQUET, "-c", "fitted.json").error()
    assert error.endswith('expected an interval with use = "validation", it has none')


def test_temperatures_that_were_not_fitted_are_named(warm: Path, run: Run) -> None:
    """A calibration of a narrower range is used, with a warning that states both; one that holds them gives none."""
    content = json.loads(Path("warm.json").read_text(encoding="utf-8"))
    content["variables"][0] |= {"minimum": 25.0, "maximum": 40.0}
    Path("warm.json").write_text(json.dumps(content), encoding="utf-8")
    assert not [line for line in run("evaluate", PARQUET, "-c", "warm.json", "--details").log if "fitted were" in line]
    content["variables"][0] |= {"minimum": 10.0, "maximum": 20.0}
    Path("warm.json").write_text(json.dumps(content), encoding="utf-8")
    (line,) = [line for line in run("evaluate", PARQUET, "-c", "warm.json", "--details").log if "fitted were" in line]
    assert line.startswith("WARNING: warm.json: temperature is ")
    assert line.endswith("degC, fitted were 10 to 20")


def test_a_verdict_where_the_choice_was_made_is_said_to_flatter(arm: Path, run: Run) -> None:
    """A calibration that was chosen on the judged interval is judged, with a warning that names the interval."""
    content = json.loads(Path("fitted.json").read_text(encoding="utf-8"))
    assert not [line for line in run("evaluate", PARQUET, "-c", "fitted.json", "--details").log if "flatters" in line]
    judged = load_experiment(PARQUET).intervals(Use.VALIDATION)[0]
    span = {"label": "there", "start_ns": judged.end_ns - 1, "end_ns": judged.end_ns + 5}
    content["selection"]["chosen_on"] = [span]
    Path("fitted.json").write_text(json.dumps(content), encoding="utf-8")
    (line,) = [line for line in run("evaluate", PARQUET, "-c", "fitted.json", "--details").log if "flatters" in line]
    assert line == "WARNING: fitted.json was chosen among others on 'judge' too, so the verdict on it flatters"

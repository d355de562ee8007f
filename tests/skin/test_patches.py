# SPDX-License-Identifier: BSD-3-Clause
"""Patches of skin in an experiment file: read without robot or sensor, and refused by name where they do not fit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, RecordingError
from forcetorque.experiment.loading import load_experiment
from forcetorque.inspection.findings import taxel_findings
from forcetorque.recording.recording import Use
from forcetorque.skin.section import load_patches
from forcetorque.skin.taxels.taxel_faults import TaxelFault
from tests.scenes.chambers import TAXELS, TEXT, chamber, responses, write_chamber
from tests.scenes.patches import cylinder_patch, position_text


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """An experiment of a patch alone."""
    return write_chamber(tmp_path, "fit", chamber(responses(), 11))


def _changed(file: Path, old: str, new: str) -> Path:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")
    return file


def test_a_patch_alone_is_read(file: Path) -> None:
    """Streams, columns and intervals; every column is a taxel where no layout says otherwise."""
    experiment = load_patches(file)
    patch = experiment.patch(None)
    assert (patch.name, patch.serial, patch.columns) == ("palm", "P7", TAXELS)
    assert patch.taxels.tolist() == list(range(TAXELS))
    assert [(interval.label, interval.use) for interval in experiment.intervals] == [("cycle", Use.CALIBRATION)]
    assert set(experiment.inputs_sha256) >= {"fit.toml"}
    assert experiment.patch("palm") is patch
    assert repr(experiment) == "<PatchExperiment 'fit': palm (60 taxels)>"


def test_broken_taxels_are_named_without_a_pressure(tmp_path: Path) -> None:
    """Those at a rail, and those that wrap; what a contact may do is no fault, and without faults there is none."""
    broken = {7: TaxelFault.RAILS, 9: TaxelFault.JUMPS}
    for name, faults, expected in (("broken", broken, {"taxel_rails": 1}), ("sound", {}, {})):
        file = write_chamber(tmp_path, name, chamber(responses(), 11, broken=faults))
        found = taxel_findings(load_patches(_changed(file, 'pressure = "chamber"\n', "")))
        assert {finding.kind: finding.count for finding in found} == expected
        assert all(finding.message == "palm: rails: 1 of 60 taxels in the log: 7" for finding in found)


def test_lost_messages_and_columns_hide_no_fault_and_make_none(tmp_path: Path) -> None:
    """Messages of zeros are counted; a column without counts takes nothing from the others."""
    recording = chamber(responses(), 11, broken={7: TaxelFault.RAILS})
    stream = recording.stream("counts")
    signal = stream.signal("taxel_counts")
    values = signal.values.copy()
    values[100:103] = 0.0
    values[:, 20] = np.nan
    values[40:50, 21] = np.nan
    lost = replace(stream, signals={"taxel_counts": replace(signal, values=values)})
    recording = replace(recording, streams={**recording.streams, "counts": lost})
    file = _changed(write_chamber(tmp_path, "lost", recording), 'pressure = "chamber"\n', "")
    assert [(one.kind, one.count, one.message) for one in taxel_findings(load_patches(file))] == [
        ("missing", 3, f"palm: 3 of {len(values)} messages of zeros, without power or lost"),
        ("taxel_rails", 1, "palm: rails: 1 of 60 taxels in the log: 7"),
    ]


def test_other_questions_refuse_it(file: Path) -> None:
    """By a sentence that says which commands read it."""
    with pytest.raises(
        ExperimentError, match=r"expected \[\[sensor\]\], .* got patches of skin only; `forcetorque skin`"
    ):
        load_experiment(file)


WRONG: list[tuple[str, str, type[ForceTorqueError], str]] = [
    ('counts = "counts"', 'counts = "skin"', RecordingError, r"patch\[0\]: the recording has no stream 'skin'"),
    ('counts = "counts"', 'counts = "chamber"', RecordingError, "stream 'chamber' has no taxel_counts"),
    ('pressure = "chamber"', 'pressure = "counts"', RecordingError, "stream 'counts' has no pressure"),
    ('counts = "counts"\n', "", FormatError, r"patch\[0\]\.counts: expected this key, there is none"),
    ('serial = "P7"', 'serial = ""', FormatError, r"patch\[0\]\.serial"),
    ("start_s = 0.0", "start_s = 99.0", ExperimentError, "expected a span inside the log"),
    (
        TEXT[TEXT.index("[[patch]]") : TEXT.index("[[interval]]")],
        "",
        ExperimentError,
        r"expected \[\[patch\]\], a patch of skin, got none",
    ),
    (
        "[[interval]]",
        '[[patch]]\nname = "palm"\ncounts = "counts"\n\n[[interval]]',
        ExperimentError,
        "'palm' is listed twice",
    ),
]


@pytest.mark.parametrize(("old", "new", "error", "message"), WRONG)
def test_what_does_not_fit_is_refused(
    file: Path, old: str, new: str, error: type[ForceTorqueError], message: str
) -> None:
    """By file and table."""
    with pytest.raises(error, match=rf"fit\.toml.*{message}"):
        load_patches(_changed(file, old, new))


def test_one_of_several_must_be_named(file: Path) -> None:
    """The known ones are listed."""
    _changed(file, "[[interval]]", '[[patch]]\nname = "sole"\ncounts = "counts"\n\n[[interval]]')
    experiment = load_patches(file)
    assert experiment.patch("sole").pressure is None
    with pytest.raises(ExperimentError, match="expected the name of a patch, one of palm, sole"):
        experiment.patch(None)
    with pytest.raises(ExperimentError, match="no patch is called 'knee'; known: palm, sole"):
        experiment.patch("knee")


def test_a_layout_says_which_columns_are_taxels(file: Path) -> None:
    """Thermal pads are none; counts of another number of columns are of another patch."""
    layout = cylinder_patch(across=5, along=1)
    assert layout.columns == TAXELS
    (file.parent / "shank.txt").write_text(position_text(layout), encoding="utf-8")
    _changed(file, 'name = "palm"', 'name = "palm"\nlayout = "shank.txt"')
    experiment = load_patches(file)
    assert experiment.patch(None).taxels.tolist() == layout.taxels.tolist()
    assert "shank.txt" in experiment.inputs_sha256
    larger = position_text(cylinder_patch(across=5, along=2))
    (file.parent / "shank.txt").write_text(larger, encoding="utf-8")
    with pytest.raises(ExperimentError, match=r"patch\[0\]: expected counts of 120 columns, .* got 60 in the stream"):
        load_patches(file)

# SPDX-License-Identifier: BSD-3-Clause
"""Saved samples, the intervals between them, and what becomes of both."""

from __future__ import annotations

import csv
import io
import tomllib
from typing import TYPE_CHECKING

import numpy as np
import pytest

from forcetorque.experiment.experiment_file import Interval
from forcetorque.viewer.annotations import Annotations, intervals_toml
from tests.viewer.browser.arm_scene import COORDINATES, SAMPLES, WALL, Arm
from tests.viewer.browser.press import download

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = [pytest.mark.browser, pytest.mark.long]

HALF_DIGIT = 0.51e-4
"""Degrees and metres are written to four digits or more."""


def save(page: Page, sample: int, kind: str) -> None:
    """Save a sample as a point, begin or end."""
    page.evaluate(f"window.ft.show({sample})")
    page.get_by_role("radiogroup", name="Saved sample is").get_by_text(kind, exact=True).click()
    page.get_by_role("button", name="Save sample").click()


def test_saved_samples_are_listed_labelled_and_deleted(page: Page) -> None:
    """The list is in the order of time; labels stay when others are added; each entry leads back to its sample."""
    save(page, 300, "point")
    save(page, 20, "point")
    entries = page.get_by_role("list", name="Saved samples").get_by_role("listitem")
    assert [entries.nth(k).get_by_role("button").first.text_content() for k in range(2)] == ["20", "300"]
    page.get_by_label("Label of sample 20").fill('first, "lowest"')
    page.get_by_label("Label of sample 20").press("Tab")
    save(page, 100, "point")
    assert page.get_by_label("Label of sample 20").input_value() == 'first, "lowest"'
    page.get_by_role("button", name="Go to sample 300").click()
    assert page.evaluate("window.ft.sample()") == 300
    page.get_by_role("button", name="Delete sample 100").click()
    assert entries.count() == 2
    assert page.get_by_role("status").text_content() == "Saved sample 100 at 2.250 s as point."


def test_table_holds_the_joint_configuration(page: Page, arm: Arm) -> None:
    """Each row has sample, time, mark, label, and the joints in degrees, or metres where they slide (Table 4.2)."""
    save(page, 300, "point")
    save(page, 20, "begin")
    page.get_by_label("Label of sample 20").fill('first, "lowest"')
    page.get_by_label("Label of sample 20").press("Enter")
    name, content = download(page, "Samples as CSV")
    assert name == "arm_at_the_wall_samples.csv"
    rows = list(csv.DictReader(io.StringIO(content.decode())))
    assert list(rows[0]) == ["sample", "time_s", "mark", "label", "turn_deg", "lift_deg", "reach_m"]
    assert [(row["sample"], row["mark"], row["label"]) for row in rows] == [
        ("20", "begin", 'first, "lowest"'),
        ("300", "point", ""),
    ]
    for row in rows:
        at = int(row["sample"])
        assert float(row["time_s"]) == pytest.approx(arm.time_s[at], abs=1e-9)
        found = [float(row[f"{joint}_{unit}"]) for joint, unit in zip(COORDINATES, ("deg", "deg", "m"), strict=True)]
        wanted = [*np.rad2deg(arm.positions[at, :2]), arm.positions[at, 2]]
        np.testing.assert_allclose(found, wanted, atol=HALF_DIGIT)


def test_begin_and_end_make_an_interval_of_the_experiment_file(page: Page, arm: Arm) -> None:
    """The text is what the experiment file takes, end excluded, with the support of the interval around it."""
    save(page, 50, "begin")
    assert page.get_by_label("end", exact=True).is_checked(), "after a begin comes an end"
    save(page, 60, "end")
    save(page, 310, "begin")
    save(page, 320, "end")
    page.get_by_label("Label of sample 50").fill('cover \\ "left"')
    page.get_by_label("Label of sample 50").press("Tab")
    page.get_by_label("Use of marked", exact=True).select_option("validation")
    name, content = download(page, "Intervals as TOML")
    assert name == "arm_at_the_wall_intervals.toml"
    tables = tomllib.loads(content.decode())["interval"]
    first, second = (Interval.model_validate(table) for table in tables)
    assert (first.label, first.use, first.support) == ('cover \\ "left"', "ignore", "base")
    assert first.start_s == pytest.approx(arm.time_s[50], abs=1e-9)
    assert first.end_s == pytest.approx(arm.time_s[61], abs=1e-9), "the saved end is the last sample inside"
    assert (second.label, second.use, second.support) == ("marked", "validation", "base")


def test_the_library_writes_the_same_text(page: Page, arm: Arm) -> None:
    """Inside, across and outside the experiment's intervals, up to the last sample, for every use."""
    marked = ((5, 20, "validation"), (40, 50, "calibration"), (60, 70, "ignore"), (280, 310, "validation"))
    for begin, end, _ in marked:
        save(page, begin, "begin")
        save(page, end, "end")
    save(page, 570, "begin")
    save(page, SAMPLES - 1, "end")
    for k, (*_, use) in enumerate(marked):
        page.get_by_label("Use of marked", exact=False).nth(k).select_option(use)
    _, content = download(page, "Intervals as TOML")
    tables = tomllib.loads(content.decode())["interval"]
    assert [table["use"] for table in tables] == [*(use for *_, use in marked), "ignore"]
    assert tables[-1]["end_s"] == pytest.approx(arm.built.scene.end_s, abs=1e-9), "cut off where the log ends"
    sent = [{name: table[name] for name in ("label", "start_s", "end_s", "use")} for table in tables]
    wanted = intervals_toml(Annotations.model_validate({"samples": [], "intervals": sent}), arm.built)
    assert content.decode() == wanted
    assert wanted.count("# support") == 2
    assert '# overlaps "moving", "held out": shorten' in wanted
    assert page.get_by_text("overlaps moving, held out: shorten it there").is_visible()


def test_what_makes_no_interval_is_said(page: Page) -> None:
    """A begin before another begin, an end without a begin, and a begin at the very end."""
    for at, kind in ((10, "end"), (20, "begin"), (30, "begin"), (40, "end"), (50, "begin")):
        save(page, at, kind)
    rows = page.get_by_role("list", name="Marked intervals").get_by_role("listitem")
    said = ["end at 10 has no begin", "begin at 20 has no end", "begin at 50 has no end"]
    assert rows.all_text_contents()[1:] == said
    page.get_by_role("button", name="Delete sample 20").click()
    assert rows.count() == 3


def test_labels_of_intervals_are_unique(page: Page) -> None:
    """An experiment file needs that; also towards its own intervals."""
    for begin, end in ((50, 60), (70, 80), (90, 95)):
        save(page, begin, "begin")
        save(page, end, "end")
    page.get_by_label("Label of sample 90").fill("moving")
    page.get_by_label("Label of sample 90").press("Enter")
    _, content = download(page, "Intervals as TOML")
    labels = [table["label"] for table in tomllib.loads(content.decode())["interval"]]
    assert labels == ["marked", "marked 2", "moving 2"]


def test_ignored_intervals_leave_the_cloud(page: Page, arm: Arm) -> None:
    """As in figure 4.7: the experiment's ignored interval goes with the box, a marked one as soon as it is complete."""
    page.get_by_label("Hide ignored intervals").check()
    page.evaluate("window.ft.show(0)")
    shown = page.evaluate("window.ft.cloudSamples()")
    assert set(range(len(arm.time_s))) - set(shown) == set(range(WALL.start, WALL.stop))
    save(page, 10, "begin")
    save(page, 19, "end")
    assert set(range(len(arm.time_s))) - set(page.evaluate("window.ft.cloudSamples()")) == {
        *range(10, 20),
        *range(WALL.start, WALL.stop),
    }
    page.get_by_label("Hide ignored intervals").uncheck()
    assert len(page.evaluate("window.ft.cloudSamples()")) == len(arm.time_s)

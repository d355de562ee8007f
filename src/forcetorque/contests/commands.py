# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench contest`: sensors and methods through one motion, on loads not fitted."""

from contextlib import nullcontext
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from pathlib import Path

    from forcetorque.contests.contest_file import Entries
    from forcetorque.contests.contest_scores import Contest


@command("errors by component and load, with their intervals")
def contest(
    entries: Annotated[
        "Entries | Path | str", Option("File of the contest (TOML): runs and contestants; see docs/contests.md.")
    ],
) -> "Contest":
    """Rank sensors and calibration methods on the same loads.

    Example: forcetorque bench contest contest.toml --figure contest.png

    Python: `forcetorque.contest("contest.toml")`

    Returns:
        Ranks, scores and pairs; contestants that lack what their method needs are named, the others go on.

    Raises:
        ExperimentError: If fewer than two can be compared, on loads that all share and no contestant was fitted on.
    """
    from importlib.metadata import version

    from forcetorque.contests.contest_file import Entries, read_entries
    from forcetorque.contests.contest_scores import ranking
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.result import created_now

    content = entries if isinstance(entries, Entries) else read_entries(entries)
    with nullcontext() if isinstance(entries, Entries) else stated_in(str(entries)):
        return ranking(content, code_version=version("forcetorque"), created=created_now())

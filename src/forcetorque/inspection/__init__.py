# SPDX-License-Identifier: BSD-3-Clause
"""Contents of a log, findings about it, and a draft of its experiment file."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.inspection.draft.draft import draft_experiment as draft_experiment
    from forcetorque.inspection.draft.questions import resume_experiment as resume_experiment
    from forcetorque.inspection.inspect import inspect_log as inspect_log, inspected as inspected

CAPABILITY = Capability(
    page="recording.md",
    needs=("skin",),
    commands=(
        "forcetorque.inspection.commands:init",
        "forcetorque.inspection.commands:inspect",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    draft_experiment="forcetorque.inspection.draft.draft",
    inspect_log="forcetorque.inspection.inspect",
    inspected="forcetorque.inspection.inspect",
    resume_experiment="forcetorque.inspection.draft.questions",
)

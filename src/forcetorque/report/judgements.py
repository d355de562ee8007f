# SPDX-License-Identifier: BSD-3-Clause
"""Whether calibrations are better than their priors, and what makes that doubtful: each sentence once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from forcetorque.analysis import Assessment, ExperimentAssessment
from forcetorque.report.document import Block, Section, Tone, Verdict
from forcetorque.report.repeated import gathered
from forcetorque.result import short_names, table_of

TITLE = "Better than the prior?"
"""Title of the section."""


def judgement_section(experiments: Sequence[ExperimentAssessment]) -> Section:
    """Put together what the judged data say of every calibration against its prior.

    Args:
        experiments: What is said about every experiment.

    Returns:
        A section: sentences, each once with the names of those whom it is about, then the numbers of each sensor.
    """
    assessments = {
        f"{sensor.sensor}, {experiment.experiment}": sensor
        for experiment in experiments
        for sensor in experiment.sensors
    }
    sentences = gathered(
        pair
        for name, assessment in assessments.items()
        for pair in _sentences(name if len(assessments) > 1 else "", assessment)
    )
    blocks: list[Block] = [
        Verdict(tone=tone, text=f"{', '.join(names)}: {text}" if any(names) else text)
        for names, (tone, text) in sentences
    ]
    for name, assessment in assessments.items():
        if assessment.comparisons:
            whose = f"{name}: " if len(assessments) > 1 else ""
            blocks.append(
                table_of(
                    assessment.comparisons,
                    f"{whose}mean norm of the error (not the root mean square, by which the verdict on the first page "
                    "goes) against that of the prior on the same samples, and the ratio of the errors with its 95 % "
                    "interval over independent stretches of time; another offset would take away what is constant",
                )
            )
    return Section(title=TITLE, blocks=tuple(blocks))


def _sentences(whose: str, assessment: Assessment) -> Iterator[tuple[str, tuple[Tone, str]]]:
    """By whom they are about: a calibration that stands in front of a sentence, or the sensor."""
    calibrations = short_names(list(assessment.calibrations)).values()
    for line in assessment.verdict:
        name = next((one for one in calibrations if line.text.startswith(f"{one}: ")), None)
        if name is None:
            yield whose, (Tone(line.tone), line.text)
        else:
            about = f"{whose}, {name}" if whose else name
            yield about, (Tone(line.tone), line.text.removeprefix(f"{name}: "))

# SPDX-License-Identifier: BSD-3-Clause
"""Calibrate the taxels of a patch in a pressure chamber or a vacuum bag, and compare forms of curves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.base.errors import ExperimentError, FitError, known_names
from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
from forcetorque.experiment.recording_notes import ADDED, added_to, with_recording_notes
from forcetorque.recording.recording import Use
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, optional_table, table_of
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.section import load_patches
from forcetorque.skin.taxels.curve_comparison import FittedSamples, calibrated_taxel, compare_curves, fitted_samples
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import (
    CalibratedTaxel,
    PatchCalibration,
    PatchProvenance,
    write_pressure_table,
)
from forcetorque.skin.taxels.pressure_cycles import PatchRecording, of_use, patch_recordings, same_patch
from forcetorque.skin.taxels.result import (
    CandidateRow,
    SkinRecordingRow,
    TaxelPicture,
    TaxelRow,
    recording_name,
    recording_row,
    taxel_picture,
    taxel_row,
)
from forcetorque.skin.taxels.taxel_curve import CurveKind, TaxelCurve
from forcetorque.skin.temperature.warm_up_calibration import WarmUpRow, learn_warm_up, warm_up_row

_SHOWN = 12
"""Taxels of the table; JSON and CSV have all."""


class SkinCalibration(DrawnResult):
    """Curves of the taxels of a patch, what they are worth, and which taxels have none."""

    drawn_by: ClassVar[str] = "forcetorque.skin.figures:taxel_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("picture",)
    answered_by: ClassVar[str | None] = "forcetorque.skin.answers:skin_calibration_answer"

    schema_name: Literal["forcetorque/skin_calibrate/2"] = Field(default="forcetorque/skin_calibrate/2", alias="schema")
    """Form of the result."""
    patch: str
    """Name of the patch."""
    serial: str | None
    """Its serial number, if it has one."""
    curve: str
    """Form of the curves that were kept."""
    highest_kPa: float
    """Highest pressure above rest that was fitted."""
    valid_taxels: int
    """Taxels with a curve."""
    left_out: int
    """Taxels without."""
    least_inside: str | None
    """Candidate with the least error at fitted pressures where it was not fitted; None where nothing was kept back."""
    least_above: str | None
    """The same at higher pressures, among those that nowhere fall."""
    file: str | None = None
    """File of the calibration."""
    taxels: tuple[TaxelRow, ...]
    """Taxels in the order of their columns."""
    candidates: tuple[CandidateRow, ...]
    """Forms of curves on each recording that was not fitted, and on all."""
    recordings: tuple[SkinRecordingRow, ...]
    """Recordings, and how many taxels are valid in each."""
    warm_up: WarmUpRow | None = None
    """What was estimated of heat; None without a warm-up."""
    table_file: str | None = Field(default=None, exclude=True, repr=False)
    """File of the pressures by counts; None where none was written."""
    calibration: PatchCalibration = Field(exclude=True, repr=False)
    """The curves."""
    picture: TaxelPicture = Field(exclude=True, repr=False)
    """Samples and curves, for figures."""

    def blocks(self) -> Iterator[Table | str]:
        """Give recordings, candidates, the first taxels, and a sentence.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.recordings, f"{self.patch}: taxels by recording")
        yield from optional_table(self.candidates, "where they were not fitted: medians over taxels of their rmse")
        yield table_of(self.taxels[:_SHOWN], f"taxels with the curve {self.curve}")
        if len(self.taxels) > _SHOWN:
            yield f"{len(self.taxels) - _SHOWN} more taxels; --format csv or json has all"
        yield (
            f"{self.valid_taxels} of {len(self.taxels)} taxels have a curve ({self.curve}, fitted up to "
            f"{self.highest_kPa:.0f} kPa); {self.left_out} were left out"
        )
        if self.warm_up is not None:
            yield table_of([self.warm_up], "heat: gains from thermal pads to taxels")
        if self.least_inside is not None:
            above = "" if self.least_above is None else f"; above them, of those that nowhere fall, {self.least_above}"
            yield f"least error at fitted pressures: {self.least_inside}{above}"
        if self.file is not None:
            yield f"kept in {self.file}"

    def save(self, path: Path | str) -> None:
        """Write the curves.

        Args:
            path: File to write or to replace.
        """
        self.calibration.save(path)


@with_recording_notes
def calibrate_skin(
    experiments: Sequence[Path | str | PatchExperiment],
    *,
    code_version: str,
    created: str,
    patch: str | None = None,
    curve: str = CurveKind.MONOTONE,
    highest_pa: float | None = None,
    warm_up: Path | str | PatchExperiment | None = None,
) -> SkinCalibration:
    """Fit a curve to every valid taxel of a patch.

    All forms of curves are fitted to the calibration intervals and evaluated on the validation intervals; one is kept.

    Args:
        experiments: Experiment files with the patch, or what was read of them.
        code_version: Version of this library.
        created: Date and time, ISO 8601, UTC.
        patch: Name of the patch; None for the only one.
        curve: Form to keep: one of `CurveKind`.
        highest_pa: Highest pressure above rest to fit; Pa; None for all.
        warm_up: Experiment file of a recording without contact while the robot warms up, or what was read of it; heat
            is not separable from pressure without one.

    Returns:
        The curves, and what they are worth.

    Raises:
        FitError: If there is no such form, or no taxel is valid.
        ExperimentError: If no interval is for calibration.
    """
    if curve not in list(CurveKind):
        raise FitError(f"no curve is called {curve!r}; {known_names(curve, CurveKind)}")
    contents = read_patches(experiments)
    patches = same_patch(contents, patch)
    logs = [log for content, own in zip(contents, patches, strict=True) for log in patch_recordings(content, own)]
    if not of_use(logs, Use.CALIBRATION):
        raise ExperimentError(f'{contents[0].file}: expected an interval with use = "calibration", got none')
    samples = fitted_samples(of_use(logs, Use.CALIBRATION), highest_pa)
    curves = {kind: samples.fit(kind) for kind in CurveKind}
    kept = CurveKind(curve)
    artefact = _artefact(contents, patches[0], logs, samples, curves[kept], kept, code_version, created)
    warnings = dict.fromkeys(
        f"{content.file}: {finding.stream}: {finding.message}"
        for content in contents
        for finding in content.recording.findings
        if finding.kind not in ADDED
    )
    warnings |= dict.fromkeys(sentence for content in contents for sentence in added_to(content.recording))
    result = _result(artefact, logs, samples, curves, warnings=tuple(warnings))
    return result if warm_up is None else _with_warm_up(result, warm_up, patches[0])


def _with_warm_up(
    result: SkinCalibration, warm_up: Path | str | PatchExperiment, patch: ExperimentPatch
) -> SkinCalibration:
    """Add what a warm-up shows of the same patch."""
    learned, warnings, inputs = learn_warm_up(warm_up, patch)
    provenance = result.calibration.provenance
    both = {**provenance.inputs_sha256, **inputs}
    changed = {"warm_up": learned, "provenance": provenance.model_copy(update={"inputs_sha256": both})}
    return result.model_copy(
        update={
            "warm_up": warm_up_row(learned),
            "calibration": result.calibration.model_copy(update=changed),
            "warnings": (*result.warnings, *warnings),
        }
    )


def save_pressure_table(result: SkinCalibration, path: Path) -> None:
    """Write the pressure of every taxel by its counts as CSV.

    Args:
        result: The result.
        path: File to write or to replace.
    """
    write_pressure_table(path, result.calibration.table())


def read_patches(experiments: Sequence[Path | str | PatchExperiment]) -> list[PatchExperiment]:
    """Read the patches of experiment files.

    Args:
        experiments: Files, or what was read of them.

    Returns:
        What they hold.

    Raises:
        ExperimentError: If there is no file.
    """
    if not experiments:
        raise ExperimentError("expected an experiment file with [[patch]], got none")
    refuse_a_file_twice([Path(entry) for entry in experiments if isinstance(entry, (Path, str))])
    return [load_patches(entry) if isinstance(entry, (Path, str)) else entry for entry in experiments]


def _artefact(
    contents: Sequence[PatchExperiment],
    patch: ExperimentPatch,
    logs: Sequence[PatchRecording],
    samples: FittedSamples,
    curves: Sequence[TaxelCurve | None],
    kind: CurveKind,
    code_version: str,
    created: str,
) -> PatchCalibration:
    fitted = of_use(logs, Use.CALIBRATION)
    return PatchCalibration(
        patch=patch.name,
        serial=patch.serial,
        columns=patch.columns,
        curve=kind,
        highest_pa=samples.highest,
        taxels=tuple(_taxel(int(column), k, curves[k], samples) for k, column in enumerate(patch.taxels)),
        provenance=PatchProvenance(
            code_version=code_version,
            created=created,
            experiments=tuple(content.name for content in contents),
            intervals=tuple(recording_name(log) for log in fitted),
            samples=len(samples.pressure),
            inputs_sha256={
                f"{content.name}: {name}": digest
                for content in contents
                for name, digest in content.inputs_sha256.items()
            },
        ),
    )


def _taxel(column: int, k: int, curve: TaxelCurve | None, samples: FittedSamples) -> CalibratedTaxel:
    if curve is None:
        return CalibratedTaxel(taxel=column, left_out=tuple(reason.value for reason in samples.faults[k]))
    return calibrated_taxel(column, curve, samples.fall[:, k], samples.pressure, samples.unloading)


def _result(
    artefact: PatchCalibration,
    logs: Sequence[PatchRecording],
    samples: FittedSamples,
    curves: dict[CurveKind, list[TaxelCurve | None]],
    *,
    warnings: tuple[str, ...],
) -> SkinCalibration:
    held_out, fitted = of_use(logs, Use.VALIDATION), of_use(logs, Use.CALIBRATION)[0]
    comparison = compare_curves(curves, held_out, samples.highest)
    inside, above = comparison.rmse(artefact.curve)
    columns = [taxel.taxel for taxel in artefact.taxels]
    left_out = sum(taxel.coefficients is None for taxel in artefact.taxels)
    return SkinCalibration(
        patch=artefact.patch,
        serial=artefact.serial,
        curve=artefact.curve.value,
        highest_kPa=1e-3 * artefact.highest_pa,
        valid_taxels=len(columns) - left_out,
        left_out=left_out,
        least_inside=comparison.least_inside,
        least_above=comparison.least_above,
        taxels=tuple(taxel_row(*taxel) for taxel in zip(artefact.taxels, inside, above, strict=True)),
        candidates=comparison.rows,
        recordings=tuple(recording_row(log) for log in logs),
        calibration=artefact,
        picture=taxel_picture(fitted, recording_name(fitted), columns, curves, samples.highest),
        warnings=(
            *(() if held_out else ("no interval for validation: nothing says how good the curves are elsewhere",)),
            *warnings,
        ),
    )

# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque study fits` and `study skin`: all fits of thesis 5.3, and thesis 7.3 on skin."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.results.command import SENSORS, Option, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.study.result import Studies
    from forcetorque.study.skin.result import SkinStudy
    from forcetorque.study.study import SensorStudy


@command("the error of every candidate beside the workbench matrix")
def study(
    *experiments: Annotated["Path | str", Option("Experiment files (TOML) with the same sensors.")],
    folder: Annotated[
        "Path | str | None",
        Option("Folder to make, with a folder per sensor.", "--output", "-o", required=True, folder=True),
    ] = None,
    sensors: Annotated[Collection[str], SENSORS] = (),
    data_sets: Annotated[
        "Mapping[str, Sequence[str]] | None",
        Option(
            "NAME=LABEL,LABEL: intervals, by label or kind, that are fitted together. Default: every combination of "
            "kinds.",
            "--data-set",
            typed=list[str],
            reads="forcetorque.study.commands:data_sets_of",
        ),
    ] = None,
    kinds: Annotated[Collection[str], Option("Estimation type, SnTdTO to OwTrTO. Default: all nine.", "--type")] = (),
    lambdas: Annotated[
        Sequence[float],
        Option(
            "Lambda of the thesis' equation (5.4) in counts2, as `calibrate` takes it. Default: the thirteen of its "
            "tables, six times as printed there.",
            "--lambda",
        ),
    ] = (),
    sphere: Annotated[
        Collection[str],
        Option("Interval whose motion draws a sphere, for the types S... Default: what the files say."),
    ] = (),
    progress: Annotated["Progress", Option("Called with a line for people at every step, such as `print`.")] = (
        lambda _: None
    ),
) -> "Studies":
    """Fit every estimation type, lambda and data set, and choose.

    Example: forcetorque study fits simulated/*.toml --sphere grid -o study

    Python: `app.study("first.toml", "second.toml", folder="study")`

    Returns:
        The choice for every sensor; `records()` has every candidate. Tables, figures and calibrations of the best are
        in the folder, if there is one.

    Raises:
        ForceTorqueError: If there is nothing to study, or the folder is there already.
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import refuse_existing
    from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, estimation_type
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.result import created_now
    from forcetorque.study.candidate_selection import SWEEP_LAMBDAS
    from forcetorque.study.result import Studies, studied_sensor, study_warnings
    from forcetorque.study.study import study_sensor
    from forcetorque.study.study_data import read_study_data
    from forcetorque.study.study_folder import write_study_folder

    if folder is not None:
        refuse_existing(Path(folder))
    types = [estimation_type(name) for name in kinds or ESTIMATION_TYPES]
    values = _lambdas(lambdas or SWEEP_LAMBDAS)
    created = created_now()
    studied = read_study_data([Path(file) for file in experiments], list(sensors), progress=progress)

    def studies() -> Iterator["SensorStudy"]:
        for data in studied:
            progress(f"studying {data.identity.name} ({data.identity.serial})")
            with stated_in(f"sensor {data.identity.name!r}"):
                yield study_sensor(
                    data,
                    data_sets=data_sets,
                    kinds=types,
                    lambdas=values,
                    sphere=sphere or None,
                    code_version=version("forcetorque"),
                    created=created,
                    progress=progress,
                )

    names = tuple(map(str, experiments))
    if folder is not None:
        return write_study_folder(folder, studies(), experiments=names, progress=progress)
    fitted = list(studies())
    return Studies(
        experiments=names,
        folder=None,
        sensors=tuple(studied_sensor(one) for one in fitted),
        warnings=tuple(sentence for one in fitted for sentence in study_warnings(one)),
    )


@command("errors of forces and torques by load and angle, beside the thesis")
def study_skin(
    layout: Annotated[
        "Path | str",
        Option(
            "File with the layout of the skin of a shin, such as iCub's right_leg_lower.txt: x to the front, z to the "
            "knee, which is the origin. Normals are rebuilt."
        ),
    ],
    *,
    trials: Annotated[int, Option("Trials, in which taxels, noise, offset and positions are drawn anew.")] = 10,
    seed: Annotated[int, Option("Seed of the first trial; the others follow.")] = 1,
    progress: Annotated["Progress", Option("Called with a line for people as work goes on.")] = lambda _: None,
) -> "SkinStudy":
    """Repeat the weights on a leg with skin of thesis 7.3 in simulation.

    Example: forcetorque study skin right_leg_lower.txt --figure skin.png

    Python: `study.study_skin("right_leg_lower.txt", progress=print)`, minutes

    Returns:
        Tables 7.1 to 7.3 against the truth, and what the thesis prints.

    Raises:
        SkinError: If there is no trial, the layout is not valid, or has no skin where a load rests.
    """
    from tempfile import TemporaryDirectory

    from forcetorque.base.errors import SkinError
    from forcetorque.base.progress import TimeLeft
    from forcetorque.skin.layout.formats.registry import read_layout
    from forcetorque.study.skin.load_trial import STEPS, LoadTrial, trial
    from forcetorque.study.skin.result import skin_study

    if trials < 1 or seed < 0:
        raise SkinError(f"expected --trials of at least 1 and --seed of at least 0, got {trials} and {seed}")
    skin = read_layout(layout, rebuild_normals=True)
    if not len(skin.thermal_pads):
        raise SkinError(f"{layout}: expected thermal pads, got none; without them heat is not separable from pressure")
    left, steps, done = TimeLeft(progress, "simulated trials", STEPS * trials), count(1), list[list[LoadTrial]]()
    for k in range(trials):
        with TemporaryDirectory() as folder:
            done.append(trial(Path(folder), skin, seed=seed + k, done=lambda: left.at(next(steps))))
    return skin_study(done, layout=Path(layout).name, taxels=len(skin), seed=seed)


def data_sets_of(texts: Sequence[str]) -> dict[str, list[str]]:
    """Read data sets as they are typed.

    Args:
        texts: `NAME=LABEL,LABEL` each.

    Returns:
        Labels or kinds by name.

    Raises:
        ForceTorqueError: If one has no name or no label, or a name comes twice.
    """
    combinations: dict[str, list[str]] = {}
    for text in texts:
        name, _, words = text.partition("=")
        labels = [word.strip() for word in words.split(",") if word.strip()]
        if not name.strip() or not labels:
            raise ForceTorqueError(f"--data-set: expected NAME=LABEL,LABEL with labels or kinds, got {text!r}")
        if name.strip() in combinations:
            raise ForceTorqueError(f"--data-set: the name {name.strip()!r} comes twice; name the data sets apart")
        combinations[name.strip()] = labels
    return combinations


def _lambdas(given: Sequence[float]) -> tuple[float, ...]:
    lambdas = tuple(sorted(set(given)))
    if not all(0.0 <= value < float("inf") for value in lambdas):
        raise FitError(f"--lambda: expected numbers of at least 0 counts2, got {list(lambdas)}")
    return lambdas

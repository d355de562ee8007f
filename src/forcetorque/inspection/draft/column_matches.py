# SPDX-License-Identifier: BSD-3-Clause
"""Quantities that columns and arrays of a log match by their headings and names."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from forcetorque.base.toml_file import OPEN
from forcetorque.base.units import SI_FACTORS
from forcetorque.formats.headings import Heading, is_time_name
from forcetorque.formats.log_format import SketchedColumns
from forcetorque.recording.orientation import OrientationForm

_APART = r"[ _./:\-\[\]]*"
_FORCE = re.compile(rf"^(?P<before>.*?)(?:force|f){_APART}(?P<axis>[xyz])(?P<behind>[^a-z]*)$")
_MOMENT = re.compile(rf"^(?P<before>.*?)(?:torque|moment|tau|mu|t|m){_APART}(?P<axis>[xyz])(?P<behind>[^a-z]*)$")
_VECTORS = tuple(
    (re.compile(rf"^(?P<before>|.*[ _./:]){words}{_APART}(?P<axis>[xyz])$"), quantity, question)
    for words, quantity, question in (
        (r"(?:linear_acceleration|acceleration|accel|acc|a)", "proper_acceleration", ""),
        (r"(?:angular_velocity|gyroscope|gyro|omega|w)", "angular_velocity", ""),
        (r"(?:gravity)", "gravity", ""),
        (r"(?:g)", OPEN, "gravity or angular_velocity"),
    )
)
_QUATERNION = re.compile(
    r"^(?P<before>.*?)(?:quaternion|orientation|rotation|quat|rot|q|r|o)" + _APART + r"(?P<axis>[xyzw])$"
)
_ANGLES = re.compile(
    r"^(?P<before>|.*(?:euler|rpy|orientation|rotation|pose|imu|tcp|ee|tool|flange|sensor)[ _./]+)"
    r"(?P<axis>roll|pitch|yaw)$"
)
"""Alone or of a frame: those of a neck or a hip are joints."""
_ROTATION_VECTOR = re.compile(
    rf"^(?P<before>|.*[ _./:])(?:rotation_vector|rotvec|rotation|rot|rv|r){_APART}(?P<axis>[xyzw])$"
)
_WITH_AXIS = re.compile(rf"^(?P<before>.*?){_APART}(?P<axis>[xyz])$")
_MATRIX = re.compile(r"^(?P<before>.*?)r" + _APART + r"(?P<axis>[123]_?[123])$")
_NUMBERED = re.compile(r"^(?P<before>.*?)(?P<number>\d+)(?P<behind>\D*)$")
_ELEMENT = re.compile(r"^(?P<before>.+)\[(?P<number>\d+)\]$")
_OF_ANGLES = (None, "rad", "deg")
_OF_TEMPERATURE = (None, "degC", "K")
_OF_COUNTS = (None, "counts")
"""Units that headings of such columns may have; None for none."""
_ORIENTATIONS = (
    (_MATRIX, [f"{row}{column}" for row in "123" for column in "123"], OrientationForm.MATRIX_ROWS, None),
    (_QUATERNION, "xyzw", OrientationForm.QUAT_XYZW, None),
    (_ANGLES, ("roll", "pitch", "yaw"), OrientationForm.EULER, _OF_ANGLES),
    (_ROTATION_VECTOR, "xyz", OrientationForm.ROTATION_VECTOR, _OF_ANGLES),
)
"""Axes of orientations in their order, forms, and units of the columns; None for any."""
FORMS_OF_THREE = (OrientationForm.EULER, OrientationForm.ROTATION_VECTOR)
"""Forms that three numbers may have, which their headings do not tell apart for sure."""
_ORDERS = (OrientationForm.QUAT_XYZW, OrientationForm.QUAT_WXYZ)
_TAXELS = re.compile(r"(?:^|_)(?:taxels?|skin)$")
"""Cells are none: they may be of a battery."""
_FEWEST_TAXELS = 10
"""Of a module of iCub's skin."""
_CHANNELS = re.compile(r"(?:ch|channel|raw|gauge|gage|strain|sg|adc|ai|v)$")
_MOTIONS = {
    "": "position",
    "j": "position",
    "q": "position",
    "pos": "position",
    "position": "position",
    "angle": "position",
    "joint": "position",
    "joints": "position",
    "actual_q": "position",
    "qd": "velocity",
    "dq": "velocity",
    "v": "velocity",
    "vel": "velocity",
    "velocity": "velocity",
    "qdd": "acceleration",
    "ddq": "acceleration",
    "acc": "acceleration",
    "acceleration": "acceleration",
    "tau": "torque",
    "torque": "torque",
    "effort": "torque",
    "current": "motor_current",
}
_STATES = re.compile(r"^(?:.*_)?joint_states?_|^field_(?=position|velocity|effort)")
"""Prefixes of tables of joint messages that programs of ROS write."""
_ESTIMATED = re.compile(
    r"(?:^|_)(?:(?:external|estimated)_wrench(?:es)?|wrench_estimat(?:e[ds]?|ion|or)|f_ext)(?:_|$)(?!.*sensor)"
)
"""Names of wrenches that controllers compute from the torques of joints."""
_WANTED = re.compile(r"(?:^|_)(?:target|desired|cmd|command(?:s|ed)?|ref(?:erence)?|set_?point|goal|soll)(?:_|$)")
_OF_JOINTS = {"j", "joint", "joints"}
"""Words of columns that are of joints, however many they are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ColumnMatch:
    """Columns that look like one quantity."""

    quantity: str
    """The quantity; `?` where the headings fit several."""
    columns: tuple[int, ...]
    """Indices of the columns in the table, in the order of the quantity."""
    names: tuple[str, ...] | None = None
    """Joints of the robot by the columns; None where the quantity has fixed names, or they are unknown."""
    form: OrientationForm | None = None
    """Form of an orientation; None for a quaternion of unknown order."""
    words: str = ""
    """Possible quantities, for the question."""


def time_column(headings: Sequence[Heading], steps: Sequence[float | None]) -> int | None:
    """Find the column that looks like the time.

    Args:
        headings: Headings of the table.
        steps: Median step of each column that rises as times do; None for the others.

    Returns:
        Its index: the first rising column with such a name, else the first column if it rises; None for none.
    """
    named = [k for k, heading in enumerate(headings) if is_time_name(heading.name) and steps[k] is not None]
    return next(iter(named), 0 if steps and steps[0] is not None else None)


def column_matches(
    headings: Sequence[Heading], joints: Sequence[str], unit_fours: Sequence[int] = (), time: int | None = None
) -> tuple[ColumnMatch, ...]:
    """Match the columns of a table with quantities, by their headings.

    Args:
        headings: Headings of the columns.
        joints: Joints of the robot that move.
        unit_fours: First columns of four whose norm is 1 in every row.
        time: Column of the time, which is no temperature; None for none.

    Returns:
        Groups of columns, in the order of their first columns; columns without a match are in none.
    """
    used: set[int] = set()
    groups: list[ColumnMatch] = []
    units = [heading.unit for heading in headings]
    searches: tuple[Callable[[Mapping[int, str], Sequence[str]], Sequence[ColumnMatch]], ...] = (
        _of_joints,
        _wrenches,
        *(partial(_orientations, units, *one) for one in _ORIENTATIONS),
        _vectors,
        partial(_temperatures, units, time),
        partial(_listed_quaternions, unit_fours),
        _lists,
        partial(_numbered, units),
        partial(_pressures, groups),
        partial(_wrenches_by_unit, headings, groups),
    )
    for search in searches:
        free = {k: heading.name.strip().lower() for k, heading in enumerate(headings) if k not in used}
        for group in search(free, joints):
            if used.isdisjoint(group.columns):
                groups.append(group)
                used.update(group.columns)
    return tuple(sorted(groups, key=lambda group: group.columns[0]))


def is_estimated(name: str) -> bool:
    """Check whether a wrench is called one that a controller computes from the torques of joints.

    Args:
        name: Its stream, topic or heading.

    Returns:
        Whether it is.
    """
    return _ESTIMATED.search(_plain(name)) is not None


def is_measured(name: str) -> bool:
    """Check whether a heading is of a measurement, not of a desired or estimated value.

    Args:
        name: The heading.

    Returns:
        Whether it is.
    """
    return not is_estimated(name) and _WANTED.search(_plain(name)) is None


def _plain(text: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", text.lower()).strip("_")


def _of_joints(free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    """Headings with the name of a joint in them, by what else is in them."""
    by_length = sorted(joints, key=len, reverse=True)
    groups: dict[str, dict[str, int]] = {}
    for k, name in free.items():
        text = f"_{_plain(name)}_"
        joint = next((joint for joint in by_length if f"_{_plain(joint)}_" in text), None)
        if joint is not None:
            rest = text.replace(f"_{_plain(joint)}_", "_", 1).strip("_")
            groups.setdefault(rest, {}).setdefault(joint, k)
    return [
        ColumnMatch(quantity=quantity, columns=tuple(members.values()), names=tuple(members))
        for rest, members in groups.items()
        if (quantity := _motion(rest)) is not None
    ]


def _motion(words: str) -> str | None:
    """The quantity of joints that words name, without a program or topic in front."""
    return _MOTIONS.get(words.removeprefix("actual_") or words) or _MOTIONS.get(_STATES.sub("", words))


def _axes(free: Mapping[int, str], pattern: re.Pattern[str]) -> dict[tuple[str, str], dict[str, int]]:
    """Columns by axis, of each group of what stands before and behind."""
    groups: dict[tuple[str, str], dict[str, int]] = {}
    for k, name in free.items():
        match = pattern.match(name)
        if match:
            parts = match.groupdict()
            groups.setdefault((parts["before"], parts.get("behind") or ""), {}).setdefault(match["axis"], k)
    return groups


def _wrenches(free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    moments = _axes(free, _MOMENT)
    wrenches = []
    for key, force in _axes(free, _FORCE).items():
        moment = moments.get(key, {})
        if len(force) == len(moment) == 3:
            columns = tuple(axes[axis] for axes in (force, moment) for axis in "xyz")
            wrenches.append(ColumnMatch(quantity="wrench", columns=columns))
    return wrenches


def _with_units(free: Mapping[int, str], units: Sequence[str | None], allowed: Sequence[str | None]) -> dict[int, str]:
    return {k: name for k, name in free.items() if units[k] in allowed}


def _orientations(
    units: Sequence[str | None],
    pattern: re.Pattern[str],
    axes: Sequence[str],
    form: OrientationForm,
    allowed: Sequence[str | None] | None,
    free: Mapping[int, str],
    joints: Sequence[str],
) -> list[ColumnMatch]:
    free = free if allowed is None else _with_units(free, units, allowed)
    groups = ({axis.replace("_", ""): k for axis, k in named.items()} for named in _axes(free, pattern).values())
    return [
        ColumnMatch(quantity="orientation", columns=tuple(named[axis] for axis in axes), form=form)
        for named in groups
        if set(named) == set(axes)
    ]


def _wrenches_by_unit(
    headings: Sequence[Heading], matched: Sequence[ColumnMatch], free: Mapping[int, str], joints: Sequence[str]
) -> list[ColumnMatch]:
    """The only three columns x, y, z in units of force and of moment, by names of any language."""
    if any(group.quantity == "wrench" for group in matched):
        return []
    parts = []
    for si_unit in ("N", "N m"):
        names = {
            k: heading.name.strip().lower()
            for k, heading in enumerate(headings)
            if SI_FACTORS.get(heading.unit or "", ("",))[0] == si_unit
        }
        (axes, *others) = _axes(names, _WITH_AXIS).values() or ({},)
        if others or len(axes) < 3:
            return []
        parts += [axes[axis] for axis in "xyz"]
    return [ColumnMatch(quantity="wrench", columns=tuple(parts))]


def _vectors(free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    return [
        ColumnMatch(quantity=quantity, columns=tuple(axes[axis] for axis in "xyz"), words=question)
        for pattern, quantity, question in _VECTORS
        for axes in _axes(free, pattern).values()
        if len(axes) == 3
    ]


def _temperatures(
    units: Sequence[str | None], time: int | None, free: Mapping[int, str], joints: Sequence[str]
) -> list[ColumnMatch]:
    likely = _with_units(free, units, _OF_TEMPERATURE)
    warm = [k for k, name in likely.items() if k != time and re.split("[./]", name)[-1].startswith("temp")]
    return [ColumnMatch(quantity="temperature", columns=(k,)) for k in warm[:1]]


def _pressures(matched: Sequence[ColumnMatch], free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    """The gauge of a skin, beside its taxels alone: that of the air is none."""
    gauges = [k for k, name in free.items() if _plain(name).rpartition("_")[2] == "pressure"]
    is_skin = any(group.quantity == "taxel_counts" for group in matched)
    return [ColumnMatch(quantity="pressure", columns=tuple(gauges))] if is_skin and len(gauges) == 1 else []


def _numbered(units: Sequence[str | None], free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    """Channels of electronics, and as many joints by number as the robot has."""
    groups: dict[tuple[str, str], list[tuple[int, int]]] = {}
    for k, name in free.items():
        match = _NUMBERED.match(name)
        if match:
            groups.setdefault((match["before"], match["behind"]), []).append((int(match["number"]), k))
    patches: list[ColumnMatch] = []
    others: list[ColumnMatch] = []
    for (before, behind), members in groups.items():
        columns = tuple(k for _, k in sorted(members))
        word = _plain(before or behind)
        if _TAXELS.search(word) and len(columns) >= _FEWEST_TAXELS:
            if all(units[k] in _OF_COUNTS for k in columns):
                patches.append(ColumnMatch(quantity="taxel_counts", columns=columns))
        elif _CHANNELS.search(word) and len(columns) >= 6:
            others.append(ColumnMatch(quantity="raw", columns=columns))
        quantity = _motion(_plain(behind) or word) or _motion(word)
        of_joints = word in _OF_JOINTS or _STATES.match(word) is not None
        counted = len(columns) == len(joints) or (of_joints and 1 < len(columns) <= len(joints))
        if word and quantity is not None and counted:
            others.append(ColumnMatch(quantity=quantity, columns=columns))
    return [*patches, *others]


def _listed_quaternions(unit_fours: Sequence[int], free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    """Four elements of one list, `pose[3]` to `pose[6]`, of norm 1; their order only where the name states it."""
    quaternions = []
    for first in unit_fours:
        columns = tuple(range(first, first + 4))
        elements = [_ELEMENT.match(free.get(k, "")) for k in columns]
        lists = {None if element is None else element["before"] for element in elements}
        if len(lists) == 1 and (name := lists.pop()) is not None:
            form = next((form for form in _ORDERS if form.value.removeprefix("quat_") in name), None)
            quaternions.append(ColumnMatch(quantity="orientation", columns=columns, form=form))
    return quaternions


def _lists(free: Mapping[int, str], joints: Sequence[str]) -> list[ColumnMatch]:
    """Elements of lists, `wrench[0]` and so on, by what an array of that name and width looks like."""
    members: dict[str, list[int]] = {}
    for k, name in free.items():
        match = _ELEMENT.match(name)
        if match and int(match["number"]) == len(members.get(match["before"], ())):
            members.setdefault(match["before"], []).append(k)
    arrays = [SketchedColumns(name=name, rows=0, columns=len(columns)) for name, columns in members.items()]
    places = list(members.values())
    return [
        ColumnMatch(quantity=group.quantity, columns=tuple(places[group.columns[0]]), form=group.form)
        for group in array_groups(arrays, joints)
    ]


_ARRAY_WORDS = {
    "wrench": ("wrench", "ft", "force_torque", "forcetorque"),
    "position": ("pos", "position", "positions", "q"),
    "velocity": ("vel", "velocity", "velocities", "dq", "qd"),
    "acceleration": ("accelerations", "ddq", "qdd"),
    "torque": ("torque", "torques", "tau", "effort"),
    "proper_acceleration": ("acc", "accel", "accelerometer", "acceleration"),
    "angular_velocity": ("gyro", "omega", "gyroscope", "angular"),
    "temperature": ("temp", "temperature"),
}
_WIDTHS = {"wrench": 6, "proper_acceleration": 3, "angular_velocity": 3, "temperature": 1}


def array_groups(members: Sequence[SketchedColumns], joints: Sequence[str]) -> Iterable[ColumnMatch]:
    """Say what arrays look like by the words in their names, as far as their width fits; each quantity once.

    Args:
        members: Arrays with the same number of rows.
        joints: Joints of the robot that move; none if it is not known.

    Yields:
        What they look like.
    """
    quantities: set[str] = set()
    for k, array in sorted(enumerate(members), key=lambda one: not is_measured(one[1].name)):
        words = set(array_words(array.name))
        for quantity, likely in _ARRAY_WORDS.items():
            width = _WIDTHS.get(quantity)
            fits = array.columns == width if width else 1 < array.columns <= max(len(joints), 64)
            joint_like = width or "joint" in words or "joints" in words or array.columns == len(joints)
            if quantity not in quantities and fits and joint_like and words & set(likely):
                quantities.add(quantity)
                yield ColumnMatch(quantity=quantity, columns=(k,))
                break


def array_words(name: str) -> list[str]:
    """Take the name of an array apart.

    Returns:
        Its words, in small letters.
    """
    apart = "".join(f" {c.lower()}" if c.isupper() else c if c.isalnum() else " " for c in name)
    return apart.split()

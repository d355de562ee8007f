# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on skin as known wrenches of an estimation, and the stream at whose instants is estimated.

The push of a contact on skin is measured, its tangential force is not.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import EstimationError, ExperimentError
from forcetorque.estimation.uncertain.estimate_with_covariance import UncertainEstimates
from forcetorque.estimation.uncertain.input_errors import SLIPPING, Tangents, Uncertainty, square_root, tangent_maps
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.recording.stream import Stream
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.skin.contact.contact_clusters import SkinContacts
from forcetorque.skin.section import PATCHES, force_patches
from forcetorque.skin.wrench.skin_wrench import PatchFrames, patch_frames

TILT_RAD: Final = 0.011
"""Standard deviation of the direction of a skin's force about either tangent: root mean square of 157 simulated
contacts on a lower leg, in range and off its edge. The covariance of pressures holds some of it already, so this is on
the safe side: normalised errors of other contacts are 0.6 to 0.7 in root mean square."""
PLACE_M: Final = 0.0006
"""The same of the place of a contact along either tangent, of the same contacts; m."""
TWIST_M: Final = 7e-5
"""Moment about the normal over the push that the covariance of pressures lacks: with it normalised errors of 489 such
contacts are 1 in root mean square, and were 1.4 without; evaluated on others; m."""
OLDEST_S: Final = 0.5
"""How much older than a pose the frame of pressures that belongs to it may be; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkinSource:
    """A contact on a patch, sample by sample, and perhaps the next when it was let go; all is 0 where there is none."""

    contact: Contact
    """Known contact in the frame of the link."""
    wrench: FloatArray
    """What the pressure does to the link; shape (n, 6); N, N m."""
    covariance: FloatArray
    """Covariance of its error; shape (n, 6, 6)."""
    tangents: Tangents | None
    """The tangential force that skin does not feel; None for skin without friction."""
    centre: FloatArray
    """Centre of pressure; NaN where there is no contact; shape (n, 3); m."""
    beyond_range: BoolArray
    """Whether a taxel reads more than it was calibrated for; shape (n,)."""
    identity: IntArray
    """Number that the contact keeps; 0 where there is none; shape (n,)."""

    def errors(self, noise_share: float) -> tuple[FloatArray, FloatArray]:
        """Give its errors, where friction bounds what it does not feel, as noise and as what lasts while it is touched.

        Args:
            noise_share: Share of their covariance that differs from sample to sample.

        Returns:
            Covariance of the noise, and what one standard deviation of each lasting error adds; shape (n, 6, 6) each.

        Raises:
            EstimationError: If nothing is known of its tangential force.
        """
        covariance = self.covariance
        if self.tangents is not None:
            if self.tangents.sd_N is None:
                raise EstimationError(
                    f"contact {self.contact.name!r}: expected friction, which bounds the force along the skin: without "
                    "it skin alone determines no torque; state a coefficient in [[patch]], such as 0.3"
                )
            slanted = self.tangents.maps * self.tangents.sd_N[:, None, None]
            covariance = covariance + slanted @ slanted.transpose(0, 2, 1)
        return noise_share * covariance, square_root((1.0 - noise_share) * covariance)

    def with_change_until(self, later: SkinSource) -> SkinSource:
        """Count what changes until the next frame among the errors: a sample may be anywhere between both.

        Args:
            later: The same contact in the frames after; n samples.

        Returns:
            The contact with the larger covariance: the mean square of a part from 0 to 1 is a third.
        """
        change = later.wrench - self.wrench
        return replace(self, covariance=self.covariance + change[:, :, None] * change[:, None] / 3.0)

    def of_samples(self, kept: BoolArray) -> SkinSource:
        """Keep some samples.

        Args:
            kept: Which; shape (n,).

        Returns:
            The same contact in those.
        """
        tangents = None if self.tangents is None else self.tangents.of_samples(kept)
        names = ("wrench", "covariance", "centre", "beyond_range", "identity")
        return SkinSource(
            contact=self.contact, tangents=tangents, **{name: getattr(self, name)[kept] for name in names}
        )


def frames_before(frame_ns: IntArray, at_ns: IntArray, *, patch: str, oldest_s: float = OLDEST_S) -> IntArray:
    """Give the newest frame of a patch at each instant.

    Args:
        frame_ns: Stamps of frames, increasing; shape (f,); ns.
        at_ns: Instants; shape (n,); ns.
        patch: Name of the patch, for messages.
        oldest_s: How old a frame may be; s.

    Returns:
        Index of a frame for each; shape (n,).

    Raises:
        EstimationError: If the newest frame is older at an instant, or there is none yet.
    """
    newest = np.searchsorted(frame_ns, at_ns, side="right") - 1
    early = np.flatnonzero(newest < 0)
    if len(early):
        raise EstimationError(
            f"patch {patch!r}: expected a frame of pressures before sample {early[0]}, the first one comes later "
            f"({len(early)} of {len(at_ns)} samples are before it); start the interval later"
        )
    age_ns = at_ns - frame_ns[newest]
    old = np.flatnonzero(age_ns > round(1e9 * oldest_s))
    if len(old):
        raise EstimationError(
            f"patch {patch!r}: expected a frame of pressures at most {oldest_s:g} s older than the pose, got "
            f"{1e-9 * age_ns[old].max():.3g} s ({len(old)} of {len(at_ns)} samples, the first is {old[0]}); the patch "
            "did not send: leave these samples out of the interval, or state a larger oldest_s in [[patch]] if nothing "
            "moved"
        )
    return np.asarray(newest, dtype=np.int64)


def skin_sources(
    patch: str,
    link: str,
    frames: Sequence[SkinContacts],
    rows: IntArray,
    *,
    friction: float | None = None,
) -> tuple[SkinSource, ...]:
    """Make known wrenches of the contacts on a patch, as many as there are at most at once.

    A contact stays the same one as long as it is there; when it is let go, the next that begins may take its place.
    Friction may also turn a contact about its normal; that is left out, as it is small where contacts are.

    Args:
        patch: Name of the patch.
        link: Link that it is on, in whose frame its contacts are.
        frames: Contacts of each frame.
        rows: Frame of each sample; shape (n,).
        friction: Coefficient that bounds the tangential force; 0 for none; None where nothing is known of it.

    Returns:
        As many as the most contacts in one frame, named `PATCH 1`, `PATCH 2` and so on.

    Raises:
        EstimationError: If the coefficient is negative, or the covariance of a contact is not known.
    """
    if friction is not None and not 0.0 <= friction < math.inf:
        raise EstimationError(f"patch {patch!r}: friction: expected a coefficient of at least 0, got {friction}")
    places = _places(frames)
    most = max((int(places[row].max(initial=-1)) + 1 for row in np.unique(rows)), default=0)
    return tuple(_source(f"{patch} {k + 1}", link, frames, rows, places, k, friction) for k in range(most))


def _places(frames: Sequence[SkinContacts]) -> list[IntArray]:
    """Source of each contact of each frame: that which it had before, or the first one that is free."""
    held: dict[int, int] = {}
    places = []
    for contacts in frames:
        present = contacts.identity.tolist()
        held = {identity: place for identity, place in held.items() if identity in present}
        for identity in present:
            if identity not in held:
                held[identity] = next(place for place in range(len(held) + 1) if place not in held.values())
        places.append(np.array([held[identity] for identity in present], dtype=np.int64))
    return places


def _source(
    name: str,
    link: str,
    frames: Sequence[SkinContacts],
    rows: IntArray,
    places: Sequence[IntArray],
    place: int,
    friction: float | None,
) -> SkinSource:
    wrench, covariance = np.zeros((len(frames), 6)), np.zeros((len(frames), 6, 6))
    centre, normal = np.full((len(frames), 3), np.nan), np.full((len(frames), 3), np.nan)
    force, beyond = np.zeros(len(frames)), np.zeros(len(frames), dtype=np.bool_)
    identity = np.zeros(len(frames), dtype=np.int64)
    for k in np.unique(rows).tolist():
        if place in places[k]:
            contacts, number = frames[k], int(np.flatnonzero(places[k] == place)[0])
            identity[k] = contacts.identity[number]
            wrench[k], covariance[k] = contacts.wrench[number], contacts.covariance[number]
            centre[k], normal[k] = contacts.centre_of_pressure[number], contacts.normal[number]
            force[k], beyond[k] = contacts.normal_force_N[number], contacts.beyond_range[number]
    if np.isnan(covariance).any():
        raise EstimationError(
            f"{name!r}: expected the covariance of its wrench, which only the methods kriging and linear give"
        )
    maps = tangent_maps(centre[rows], normal[rows])
    tangents = None
    if friction is None:
        tangents = Tangents(maps=maps)
    elif friction > 0.0:
        tangents = Tangents(maps=maps, sd_N=SLIPPING * friction * force[rows])
    tilted = TILT_RAD * force[rows, None, None] * maps
    # a push that acts elsewhere has another moment, by the way along the skin times the force
    shifted = PLACE_M * np.cross(maps[:, :3], wrench[rows, :3, None], axis=1)
    moved = np.concatenate([np.zeros_like(shifted), shifted], axis=1)
    about = np.where(np.isnan(normal[rows]), 0.0, normal[rows])
    turned = TWIST_M * force[rows, None, None] * np.concatenate([np.zeros_like(about), about], axis=1)[:, :, None]
    return SkinSource(
        contact=Contact(link=link, name=name, type=ContactType.KNOWN),
        wrench=wrench[rows],
        covariance=covariance[rows] + sum(one @ one.transpose(0, 2, 1) for one in (tilted, moved, turned)),
        tangents=tangents,
        centre=centre[rows],
        beyond_range=beyond[rows],
        identity=identity[rows],
    )


def frames_of_patches(experiment: Experiment) -> tuple[PatchFrames, ...]:
    """Read what the patches say over the whole recording: their rest is at its beginning.

    Returns:
        Contacts of every patch that has a table; none where there is no skin.
    """
    skin = experiment.section(PATCHES)
    if skin is None:
        return ()
    return tuple(patch_frames(skin, patch.table, patch=patch.name) for patch in skin.patches if patch.table is not None)


def sources_at(experiment: Experiment, patches: Sequence[PatchFrames], at_ns: IntArray) -> tuple[SkinSource, ...]:
    """Give the contacts on skin at instants, each as the newest frame before has it.

    Args:
        experiment: The experiment.
        patches: What its patches say.
        at_ns: Instants; shape (n,); ns.

    Returns:
        A source for each contact.
    """
    return tuple(source for frames in patches for source in _sources(experiment, frames, at_ns))


def _sources(experiment: Experiment, frames: PatchFrames, at_ns: IntArray) -> Iterator[SkinSource]:
    patch, start_ns = frames.patch, experiment.recording.start_ns
    frame_ns = start_ns + np.array([np.rint(1e9 * middle) for middle, _, _ in frames.read.frames], dtype=np.int64)
    oldest_s = OLDEST_S if patch.oldest_s is None else patch.oldest_s
    rows = frames_before(frame_ns, at_ns, patch=patch.name, oldest_s=oldest_s)
    link = frames.skin.layout.frame if patch.link is None else patch.link
    contacts = [contacts for _, _, contacts in frames.read.frames]
    both = np.concatenate([rows, np.minimum(rows + 1, len(contacts) - 1)])
    now = np.arange(len(both)) < len(rows)
    for source in skin_sources(patch.name, link, contacts, both, friction=patch.friction):
        yield source.of_samples(now).with_change_until(source.of_samples(~now))


def uncertainty_of(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    sources: Sequence[SkinSource],
    measured: Wrenches,
    *,
    label: str,
) -> Uncertainty:
    """Give the errors of skin and sensors: sensors as their calibration predicts at these measurements.

    Args:
        experiment: The experiment.
        corrections: How its sensors are read.
        sources: Contacts on skin.
        measured: Readings; n samples.
        label: Label of the interval, for its session.

    Returns:
        Covariances; a sensor that no calibration with a posterior reads counts as exact.
    """
    sessions = experiment.session_names(label)
    return Uncertainty(
        measured={
            name: covariance
            for name, correction in corrections.items()
            if (covariance := _predicted(correction, measured.of_name(name), sessions)) is not None
        },
        known={source.contact.name: source.covariance for source in sources},
        tangents={source.contact.name: source.tangents for source in sources if source.tangents is not None},
    )


def _predicted(correction: Correction, readings: FloatArray, sessions: Sequence[str]) -> FloatArray | None:
    posterior = None if correction.calibration is None else correction.calibration.posterior
    if posterior is None:
        return None
    session = next((name for name in sessions if name in posterior.sessions), None)
    whole: BoolArray = np.all(np.isfinite(readings), axis=1)
    predicted = posterior.error_covariance(np.where(whole[:, None], readings, 0.0), session=session)
    return np.where(whole[:, None, None], predicted, np.nan)


def with_skin(plain: Estimates, uncertain: UncertainEstimates) -> Estimates:
    """Put what skin and sensors say together in place of what sensors say beside the push of the skin.

    Args:
        plain: Estimates in which skin has no friction and no error.
        uncertain: Estimates with both, of the same samples.

    Returns:
        The former with contacts and torques of the latter.
    """
    columns = [uncertain.contacts.index(name) for name in plain.layout.contacts]
    wrenches = np.ascontiguousarray(uncertain.contact_wrenches[:, columns])
    fields = {name: getattr(plain, name) for name in plain.layout.shapes(0)}
    fields |= {"contact_wrenches": wrenches, "torques": np.ascontiguousarray(uncertain.torques)}
    return Estimates(layout=plain.layout, **fields)


def clock_stream(experiment: Experiment) -> Stream:
    """Give the stream at whose instants is estimated.

    Returns:
        The stream of the first sensor, or of the first patch where there is none.

    Raises:
        ExperimentError: If there is neither.
    """
    if experiment.sensors:
        return experiment.recording.stream(experiment.sensors[0].stream)
    patches = force_patches(experiment)
    if not patches:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [[sensor]], or a [[patch]] with a table, got neither; "
            "`forcetorque skin calibrate` makes a table"
        )
    return experiment.recording.stream(patches[0].counts)

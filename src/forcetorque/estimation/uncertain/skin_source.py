# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on skin as known wrenches: the push is felt, with its point; the tangential force is not (thesis 7.3)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.errors import EstimationError
from forcetorque.estimation.contact import Contact, ContactType
from forcetorque.estimation.uncertain.covariance import square_root
from forcetorque.estimation.uncertain.uncertainty import SLIPPING, Tangents, tangent_maps
from forcetorque.skin.contact import SkinContacts

TILT_RAD: Final = 0.011
"""Standard deviation of the direction of a skin's force about either tangent: root mean square of 157 simulated
contacts on a lower leg, in range and off its edge. The covariance of pressures holds some of it already, so this is on
the safe side: normalised errors of other contacts are 0.6 to 0.7 in root mean square."""
PLACE_M: Final = 0.0006
"""The same of the place of a contact along either tangent, of the same contacts; m."""
TWIST_M: Final = 7e-5
"""Moment about the normal over the push that the covariance of pressures lacks: with it normalised errors of 489 such
contacts are 1 in root mean square, and were 1.4 without; judged on others; m."""
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
                    "it skin alone tells no torque; state a coefficient in [[patch]], such as 0.3"
                )
            slanted = self.tangents.maps * self.tangents.sd_N[:, None, None]
            covariance = covariance + slanted @ slanted.transpose(0, 2, 1)
        return noise_share * covariance, square_root((1.0 - noise_share) * covariance)

    def on_the_way_to(self, later: SkinSource) -> SkinSource:
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
            f"{name!r}: expected the covariance of its wrench, which only the methods kriging and linear tell"
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

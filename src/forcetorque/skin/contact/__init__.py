# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on a patch of skin: which taxels feel the same one, where it is, and what it does to the link."""

from forcetorque.skin.contact.clusters import NO_CONTACT, clusters
from forcetorque.skin.contact.contacts import SkinContacts, find_contacts
from forcetorque.skin.contact.following import PatchFollower
from forcetorque.skin.contact.frame import PressureFrame
from forcetorque.skin.contact.lives import ContactLife, ContactLives, followed_places
from forcetorque.skin.contact.lobes import lobes
from forcetorque.skin.contact.reading import PatchReader
from forcetorque.skin.contact.release import Release

__all__ = [
    "NO_CONTACT",
    "ContactLife",
    "ContactLives",
    "PatchFollower",
    "PatchReader",
    "PressureFrame",
    "Release",
    "SkinContacts",
    "clusters",
    "find_contacts",
    "followed_places",
    "lobes",
]

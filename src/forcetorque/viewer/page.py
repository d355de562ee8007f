# SPDX-License-Identifier: BSD-3-Clause
"""The page of the viewer: one file that needs nothing else, or one that fetches its arrays from the server."""

from __future__ import annotations

import base64
import hashlib
import html
import re
from dataclasses import replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.files import write_bytes_atomically
from forcetorque.viewer.build import BuiltScene
from forcetorque.viewer.scene import scene_json

MOST_SAMPLES = 200_000
"""Samples above which a page is not written as one file: that of a humanoid then has some 90 MB, read at once."""

ASSETS: Traversable = files("forcetorque.viewer") / "assets"
"""The page's template, and the bundle that `make web` builds."""

BUNDLE = ("viewer.js", "viewer.css", "THIRD_PARTY_LICENSES.txt")
"""Files of the bundle."""


def page_of(
    built: BuiltScene,
    *,
    data_url: str | None = None,
    annotations_url: str | None = None,
    assets: Traversable | None = None,
) -> bytes:
    """Write the page of a scene.

    Nothing in it can reach another machine: its security policy allows its own scripts only, and no
    connection but to the server that it came from.

    Args:
        built: The scene.
        data_url: Where the page fetches the arrays; they are inside it if None.
        annotations_url: Where the page sends saved samples; nowhere if None.
        assets: Folder of the template and the bundle; that of the package if None.

    Returns:
        HTML.

    Raises:
        MissingFileError: If the bundle has not been built.
    """
    folder = assets or ASSETS
    for name in BUNDLE:
        if not (folder / name).is_file():
            raise MissingFileError(f"{folder / name}: expected the viewer's bundle, there is none; run `make web`")
    script, style, licences = ((folder / name).read_text(encoding="utf-8") for name in BUNDLE)
    scene = replace(built.scene, annotations_url=annotations_url)
    # neither must end the element early; in strings and regular expressions both mean the same as before
    inline = re.sub("</(?=script)", r"<\\/", script, flags=re.IGNORECASE).replace("<!--", r"\x3c!--")
    parts = {
        "policy": _policy(inline, served=data_url is not None),
        "title": html.escape(scene.title),
        # a comment must not end early
        "licences": licences.replace("--", "- -"),
        "style": style.replace("</style", "<\\/style"),
        "scene": scene_json(scene).replace("<", "\\u003c"),
        "data-url": "" if data_url is None else f' data-url="{html.escape(data_url)}"',
        "data": "" if data_url is not None else base64.b64encode(built.block).decode(),
        "script": inline,
    }
    text = (folder / "page.html").read_text(encoding="utf-8")
    first, *pieces = text.split("{{")
    page = [first]
    for piece in pieces:
        name, _, rest = piece.partition("}}")
        page += [parts[name], rest]
    return "".join(page).encode()


def write_page(path: Path, built: BuiltScene, *, assets: Traversable | None = None) -> int:
    """Write the page as one file that works offline, also from disk.

    Args:
        path: File to write or to replace.
        built: The scene.
        assets: Folder of the template and the bundle; that of the package if None.

    Returns:
        Its size; bytes.

    Raises:
        ForceTorqueError: If there are too many samples for one file.
    """
    if built.scene.samples > MOST_SAMPLES:
        raise ForceTorqueError(
            f"{path}: expected at most {MOST_SAMPLES} samples for one file, got {built.scene.samples}; leave out "
            "--output to look at all of them from this machine"
        )
    page = page_of(built, assets=assets)
    write_bytes_atomically(path, page)
    return len(page)


def _policy(script: str, *, served: bool) -> str:
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    rules = (
        "default-src 'none'",
        f"script-src 'sha256-{digest}'",
        "style-src 'unsafe-inline'",
        "img-src data: blob:",
        "media-src data: blob:",
        "connect-src 'self'" if served else "connect-src 'none'",
        "base-uri 'none'",
        "form-action 'none'",
    )
    return "; ".join(rules)

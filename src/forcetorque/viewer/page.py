# SPDX-License-Identifier: BSD-3-Clause
"""The page of the viewer: as one file, or served to the browsers of this machine, which may save annotations."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import secrets
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from types import TracebackType
from typing import Any

from pydantic import ValidationError

from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.progress import Progress
from forcetorque.base.toml_file import first_error
from forcetorque.viewer.annotations import Annotations, save_annotations, saved_files
from forcetorque.viewer.packing import packed
from forcetorque.viewer.scene import scene_json
from forcetorque.viewer.scene_builder import BuiltScene

MOST_SAMPLES = 200_000
"""Samples above which a page is not written as one file: that of a humanoid with six sensors then has some 40 MB."""

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


def require_few_samples(asked_by: str, samples: int) -> None:
    """Refuse a page of so many samples that no browser opens it.

    Args:
        asked_by: Option or file that asks for it, for the message.
        samples: Number of samples.

    Raises:
        ForceTorqueError: If there are too many for one file.
    """
    if samples > MOST_SAMPLES:
        raise ForceTorqueError(
            f"{asked_by}: expected at most {MOST_SAMPLES} samples in one page, got {samples}; `forcetorque view` "
            "without --output serves them all"
        )


def write_page(
    path: Path, built: BuiltScene, *, assets: Traversable | None = None, progress: Progress = lambda _: None
) -> int:
    """Write the page as one file that works offline, also from disk.

    Args:
        path: File to write or to replace.
        built: The scene.
        assets: Folder of the template and the bundle; that of the package if None.
        progress: As of `packed`.

    Returns:
        Its size; bytes.

    Raises:
        ForceTorqueError: If there are too many samples for one file.
    """
    require_few_samples(str(path), built.scene.samples)
    page = page_of(packed(built, progress), assets=assets)
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


DATA_URL, ANNOTATIONS_URL, STREAM_URL = "data.bin", "annotations", "stream"
"""Addresses relative to that of the page."""

_STREAM = rf"{STREAM_URL}\?after=(-?\d{{1,15}})"

MOST_BYTES = 1 << 20
"""Largest list of saved samples."""

_PATIENCE_S = 30.0
"""Time after which a silent connection is closed."""

Save = Callable[[Annotations], Sequence[str]]
"""Saves what was annotated and gives the names of the files."""

Stream = Callable[[int], bytes]
"""Gives what came of a stream from a number on; nothing but its state for a number below 0."""


class ViewerServer:
    """A server on 127.0.0.1, started and stopped with a `with` block."""

    def __init__(
        self, page: bytes, data: bytes, save: Save | None, *, port: int = 0, stream: Stream | None = None
    ) -> None:
        """Take a port; nothing is answered before the block begins.

        Args:
            page: The page.
            data: Its arrays.
            save: Saves what was annotated; None to accept nothing.
            port: Port; 0 for any that is free.
            stream: Gives what a page that follows a stream asks for; None for none.

        Raises:
            ForceTorqueError: If the port is taken or may not be used.
        """
        token = secrets.token_urlsafe(16)
        content = _Content(page=page, data=data, save=save, token=token, stream=stream)
        try:
            self._server = _Server(("127.0.0.1", port), partial(_Handler, content))
        except (OSError, OverflowError) as error:
            raise ForceTorqueError(f"port {port} of 127.0.0.1: {error}; leave out --port to take a free one") from error
        self._thread = threading.Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True)
        self.url = f"http://127.0.0.1:{self._server.server_port}/{token}/"
        """Address of the page."""

    def __enter__(self) -> ViewerServer:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def wait(self) -> None:
        """Wait until somebody interrupts."""
        while self._thread.is_alive():
            self._thread.join(timeout=1.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Content:
    """What is served."""

    page: bytes
    data: bytes
    save: Save | None
    token: str
    stream: Stream | None


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Keep silent: a browser that closes its window in the middle of an answer is no error."""


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "forcetorque", ""
    timeout = _PATIENCE_S

    def __init__(self, content: _Content, *args: Any) -> None:
        self.content = content
        super().__init__(*args)  # answers at once

    def do_GET(self) -> None:
        """Give the page or its data."""
        if not self._is_for_us():
            return
        if self.path == f"/{self.content.token}/":
            self._send(HTTPStatus.OK, self.content.page, "text/html; charset=utf-8")
        elif self.path == f"/{self.content.token}/{DATA_URL}":
            self._send_data()
        elif self.content.stream and (asked := re.fullmatch(f"/{self.content.token}/{_STREAM}", self.path)):
            self._send(HTTPStatus.OK, self.content.stream(int(asked[1])), "application/octet-stream")
        else:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here; use the address that the command printed")

    do_HEAD = do_GET

    def do_POST(self) -> None:
        """Save what was annotated."""
        if not self._is_for_us():
            return
        if self.path != f"/{self.content.token}/{ANNOTATIONS_URL}" or self.content.save is None:
            self._refuse(HTTPStatus.NOT_FOUND, "nothing can be saved here")
        elif self.headers.get("Origin") not in self._origins():
            self._refuse(HTTPStatus.FORBIDDEN, "expected a request of the page itself")
        elif self.headers.get_content_type() != "application/json":
            self._refuse(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, "expected application/json")
        elif not re.fullmatch(r"\d{1,18}", self.headers.get("Content-Length", "")):
            self._refuse(HTTPStatus.LENGTH_REQUIRED, "expected a Content-Length")
        elif int(self.headers["Content-Length"]) > MOST_BYTES:
            self._refuse(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"expected at most {MOST_BYTES} bytes")
        else:
            self._save(self.content.save, self.rfile.read(int(self.headers["Content-Length"])))

    def _save(self, save: Save, body: bytes) -> None:
        try:
            annotations = Annotations.model_validate_json(body)
        except ValidationError as error:
            self._refuse(HTTPStatus.BAD_REQUEST, first_error(error, whole="annotations"))
            return
        try:
            names = list(save(annotations))
        except ForceTorqueError as error:
            self._refuse(HTTPStatus.BAD_REQUEST, str(error))
        except OSError as error:
            self._refuse(HTTPStatus.INTERNAL_SERVER_ERROR, f"not saved: {error}")
        else:
            self._send(HTTPStatus.OK, json.dumps({"files": names}).encode(), "application/json")

    def _send_data(self) -> None:
        wanted, total = self.headers.get("Range"), len(self.content.data)
        if wanted is None:
            self._send(HTTPStatus.OK, self.content.data, "application/octet-stream", {"Accept-Ranges": "bytes"})
            return
        span = byte_range(wanted, total)
        if span is None:
            self._refuse(
                HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE,
                f"expected one range inside {total} bytes",
                {"Content-Range": f"bytes */{total}"},
            )
            return
        start, end = span
        headers = {"Accept-Ranges": "bytes", "Content-Range": f"bytes {start}-{end - 1}/{total}"}
        body = memoryview(self.content.data)[start:end]
        self._send(HTTPStatus.PARTIAL_CONTENT, body, "application/octet-stream", headers)

    def _is_for_us(self) -> bool:
        if self.headers.get("Host") in self._hosts():
            return True
        self._refuse(HTTPStatus.FORBIDDEN, "expected a request to 127.0.0.1 or localhost")
        return False

    def _hosts(self) -> tuple[str, ...]:
        port = self.connection.getsockname()[1]
        return (f"127.0.0.1:{port}", f"localhost:{port}")

    def _origins(self) -> tuple[str, ...]:
        return tuple(f"http://{host}" for host in self._hosts())

    def _refuse(self, status: HTTPStatus, message: str, headers: dict[str, str] | None = None) -> None:
        self.close_connection = True  # its body was not read
        self._send(
            status, f"{message}\n".encode(), "text/plain; charset=utf-8", {**(headers or {}), "Connection": "close"}
        )

    def _send(
        self, status: HTTPStatus, body: bytes | memoryview, kind: str, headers: dict[str, str] | None = None
    ) -> None:
        self.send_response(status)
        common = {
            "Content-Type": kind,
            "Content-Length": str(len(body)),
            "Cache-Control": "no-store",
            "Content-Security-Policy": "frame-ancestors 'none'",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
        }
        for name, value in (common | (headers or {})).items():
            self.send_header(name, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing."""


def open_in_browser(url: str) -> bool:
    """Open an address in the browser of the user.

    Args:
        url: The address.

    Returns:
        Whether there is one.
    """
    import webbrowser

    try:
        return webbrowser.open(url)
    except webbrowser.Error:
        return False


def byte_range(text: str, total: int) -> tuple[int, int] | None:
    """Understand a Range of HTTP.

    Args:
        text: Value of the header: `bytes=0-99`, `bytes=100-` or `bytes=-100`.
        total: Length of what is asked for; bytes.

    Returns:
        First byte, and first byte after the range; None if it is not one range that begins inside.
    """
    match = re.fullmatch(r"bytes=(\d{0,18})-(\d{0,18})", text.strip())
    if match is None or match.groups() == ("", ""):
        return None
    first, last = match.groups()
    if not first:
        return (max(total - int(last), 0), total) if int(last) and total else None
    start, end = int(first), min(int(last) + 1 if last else total, total)
    return (start, end) if start < end else None


class Session:
    """Writes what the page saves; files of an earlier session are kept once under another name."""

    def __init__(self, experiment: Path, built: BuiltScene, say: Callable[[str], None]) -> None:
        """Start a session.

        Args:
            experiment: The experiment file, beside which is saved.
            built: Its scene.
            say: Called with a line for people at every file.
        """
        self._experiment, self._built, self._say = experiment, built, say
        self._is_first, self._lock = True, threading.Lock()

    def save(self, annotations: Annotations) -> list[str]:
        """Save what was annotated, in place of what this session saved before.

        Args:
            annotations: Samples and intervals.

        Returns:
            Names of the files.
        """
        with self._lock:  # two windows may save at once
            files = [file for file in saved_files(self._experiment) if self._is_first and file.is_file()]
            earlier = {file: file.read_bytes() for file in files}
            written = save_annotations(annotations, self._built, self._experiment)
            self._is_first = False
            for file, content in earlier.items():
                kept = file.with_name(f"{file.stem}.previous{file.suffix}")
                write_bytes_atomically(kept, content)
                self._say(f"{file} of an earlier session is now {kept}")
        self._say(f"saved {len(annotations.samples)} sample(s) to {written[0]} and {written[1]}")
        return [file.name for file in written]

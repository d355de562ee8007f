# SPDX-License-Identifier: BSD-3-Clause
"""The server gives its page to this machine and nothing else to anybody."""

from __future__ import annotations

import http.client
import json
import socket
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.viewer.annotations import Annotations
from forcetorque.viewer.page import MOST_BYTES, ViewerServer, byte_range

PAGE, DATA = b"<!DOCTYPE html>page", bytes(range(256)) * 40
SAVED = {"samples": [{"sample": 1, "time_s": 0.5, "mark": "point", "label": "a", "use": "ignore"}], "intervals": []}


@dataclass(frozen=True)
class Answer:
    """What came back."""

    status: int
    headers: dict[str, str]
    body: bytes


@dataclass(frozen=True)
class Client:
    """Asks the server, as itself or under another name."""

    url: str
    received: list[Annotations]

    @property
    def host(self) -> str:
        """Host and port."""
        return urlsplit(self.url).netloc

    def ask(self, method: str, place: str, body: bytes | None = None, **headers: str) -> Answer:
        """Send one request; underscores in names of headers are dashes, an empty value leaves one out."""
        connection = http.client.HTTPConnection("127.0.0.1", urlsplit(self.url).port, timeout=10)
        wanted = {"Host": self.host} | {name.replace("_", "-"): value for name, value in headers.items()}
        path = place if place.startswith("/") else urlsplit(self.url).path + place
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in wanted.items():
            if value:
                connection.putheader(name, value)
        if body is not None and "Content-Length" not in wanted:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        found = Answer(answer.status, {k.lower(): v for k, v in answer.getheaders()}, answer.read())
        connection.close()
        return found

    def post(self, content: Any = SAVED, **headers: str) -> Answer:
        """Send what a page saves."""
        body = content if isinstance(content, bytes) else json.dumps(content).encode()
        given = {"Origin": f"http://{self.host}", "Content_Type": "application/json"} | headers
        return self.ask("POST", "annotations", body, **given)


def _save(received: list[Annotations], annotations: Annotations) -> list[str]:
    if annotations.samples[:1] and annotations.samples[0].label == "full disk":
        raise OSError("no space left")
    if annotations.samples[:1] and annotations.samples[0].sample > 10:
        raise ForceTorqueError("sample: expected less")
    received.append(annotations)
    return ["x.samples.csv", "x.intervals.toml"]


@pytest.fixture
def client() -> Iterator[Client]:
    """A server that has been started, and what it received."""
    received: list[Annotations] = []
    with ViewerServer(PAGE, DATA, lambda annotations: _save(received, annotations)) as server:
        yield Client(server.url, received)


def test_the_page_and_its_data_are_given(client: Client) -> None:
    """With their types and lengths; they are not kept by the browser nor shown in the frame of another site."""
    page, data = client.ask("GET", ""), client.ask("GET", "data.bin")
    assert (page.status, page.body, page.headers["content-type"]) == (200, PAGE, "text/html; charset=utf-8")
    assert (data.status, data.body, data.headers["accept-ranges"]) == (200, DATA, "bytes")
    for answer in (page, data):
        assert answer.headers["cache-control"] == "no-store"
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["cross-origin-resource-policy"] == "same-origin"
        assert answer.headers["content-security-policy"] == "frame-ancestors 'none'"
    head = client.ask("HEAD", "data.bin")
    assert (head.status, head.body, head.headers["content-length"]) == (200, b"", str(len(DATA)))


@pytest.mark.parametrize(
    ("wanted", "start", "end"),
    [("bytes=0-0", 0, 1), ("bytes=100-199", 100, 200), ("bytes=10000-", 10000, 10240), ("bytes=-40", 10200, 10240),
     ("bytes=10000-99999", 10000, 10240), ("bytes=-99999", 0, 10240)],
)  # fmt: skip
def test_pieces_are_given(client: Client, wanted: str, start: int, end: int) -> None:
    """A range gives these bytes and says which of how many they are."""
    answer = client.ask("GET", "data.bin", Range=wanted)
    assert (answer.status, answer.body) == (206, DATA[start:end])
    assert answer.headers["content-range"] == f"bytes {start}-{end - 1}/{len(DATA)}"


@pytest.mark.parametrize(
    "wanted",
    [
        "bytes=10240-",
        "bytes=5-4",
        "bytes=-",
        "bytes=-0",
        "bytes=a-b",
        "lines=0-1",
        "bytes=0-1,3-4",
        "bytes=" + "9" * 40,
    ],
)
def test_bad_ranges_are_refused(client: Client, wanted: str) -> None:
    """The answer says how long the data are."""
    answer = client.ask("GET", "data.bin", Range=wanted)
    assert (answer.status, answer.headers["content-range"]) == (416, f"bytes */{len(DATA)}")
    assert byte_range(wanted, len(DATA)) is None


@pytest.mark.parametrize(
    "place", ["/", "/data.bin", "x", "../", "/etc/passwd", "data.bin/..", "%2e%2e/", "data.bin?x=1"]
)
def test_nothing_else_is_served(client: Client, place: str) -> None:
    """There are two addresses, both under the secret part."""
    assert client.ask("GET", place).status == 404


@pytest.mark.parametrize("method", ["PUT", "DELETE", "OPTIONS", "PATCH"])
def test_other_methods_are_refused(client: Client, method: str) -> None:
    """In particular no permission is given to ask from another site."""
    answer = client.ask(method, "")
    assert answer.status == 501
    assert not any(name.startswith("access-control") for name in answer.headers)


@pytest.mark.parametrize(
    "host", ["example.org", "example.org:80", "127.0.0.1", "127.0.0.1:1", "[::1]", "", "localhost"]
)
def test_a_foreign_host_is_refused(client: Client, host: str) -> None:
    """A name that somebody points at 127.0.0.1 reaches neither page, data nor files."""
    for answer in (client.ask("GET", "", Host=host), client.ask("GET", "data.bin", Host=host), client.post(Host=host)):
        assert answer.status == 403
    assert client.received == []


def test_localhost_is_this_machine(client: Client) -> None:
    """Both of its names may be used, also to save."""
    name = client.host.replace("127.0.0.1", "localhost")
    assert client.ask("GET", "", Host=name).status == 200
    assert client.post(Host=name, Origin=f"http://{name}").status == 200


def test_saved_samples_arrive(client: Client) -> None:
    """The answer names the files that were written."""
    answer = client.post()
    assert (answer.status, json.loads(answer.body)) == (200, {"files": ["x.samples.csv", "x.intervals.toml"]})
    (annotations,) = client.received
    assert annotations.samples[0].label == "a"


@pytest.mark.parametrize(
    ("status", "headers"),
    [
        (403, {"Origin": "http://example.org"}),
        (403, {"Origin": "null"}),
        (403, {"Origin": ""}),
        (403, {"Origin": "https://127.0.0.1"}),
        (415, {"Content_Type": "text/plain"}),
        (415, {"Content_Type": ""}),
        (411, {"Content_Length": "many"}),
        (411, {"Content_Length": "-1"}),
        (413, {"Content_Length": str(MOST_BYTES + 1)}),
    ],
)
def test_what_does_not_come_from_the_page_is_refused(client: Client, status: int, headers: dict[str, str]) -> None:
    """Another site cannot write files, nor can a request without a length or of a length beyond the limit."""
    answer = client.post(**headers)
    assert answer.status == status
    assert answer.headers["connection"] == "close"
    assert client.received == []


def test_only_one_address_accepts_anything(client: Client) -> None:
    """The page and the data are read, not written."""
    origin = f"http://{client.host}"
    for place in ("", "data.bin", "/annotations"):
        assert client.ask("POST", place, b"{}", Origin=origin, Content_Type="application/json").status == 404


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "annotations: Invalid JSON"),
        (b"\xff\xfe", "annotations: Invalid JSON"),
        (b"[" * 5000, "annotations: Invalid JSON"),
        ({}, "samples: expected this key, there is none"),
        (SAVED | {"more": 1}, "more: expected no such key"),
        ({"samples": [{"sample": "x"}], "intervals": []}, "samples.0.sample: expected"),
        ({"samples": [SAVED["samples"][0] | {"sample": 11}], "intervals": []}, "sample: expected less"),
    ],
)
def test_damaged_annotations_are_refused(client: Client, content: Any, message: str) -> None:
    """The answer is one line that says where and what."""
    answer = client.post(content)
    assert answer.status == 400
    assert answer.body.decode().startswith(message)
    assert answer.body.count(b"\n") == 1
    assert client.received == []


def test_a_failed_write_is_an_answer(client: Client) -> None:
    """The page can say that nothing was saved."""
    answer = client.post({"samples": [SAVED["samples"][0] | {"label": "full disk"}], "intervals": []})
    assert (answer.status, answer.body) == (500, b"not saved: no space left\n")


def test_a_page_without_saving_accepts_nothing() -> None:
    """What is served to be filmed only is not written to."""
    with ViewerServer(PAGE, DATA, None) as server:
        assert Client(server.url, []).post().status == 404


def test_it_listens_on_this_machine_only_and_stops(client: Client) -> None:
    """The address is 127.0.0.1 with a secret part; after the block the port is free and no thread is left."""
    before = threading.active_count()
    with ViewerServer(PAGE, DATA, None) as server:
        parts = urlsplit(server.url)
        assert parts.hostname == "127.0.0.1"
        assert len(parts.path) > 20
        assert server.url != client.url
        assert Client(server.url, []).ask("GET", "").status == 200
    assert threading.active_count() <= before
    with socket.socket() as again:
        again.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        again.bind(("127.0.0.1", int(parts.port or 0)))


@pytest.mark.parametrize("port", [-1, 70_000])
def test_an_impossible_port_is_refused(port: int) -> None:
    """The message names it and says what to do."""
    with pytest.raises(ForceTorqueError, match=f"port {port} of 127.0.0.1: .*; leave out --port"):
        ViewerServer(PAGE, DATA, None, port=port)


def test_a_taken_port_is_refused(client: Client) -> None:
    """Two servers do not share one."""
    port = int(urlsplit(client.url).port or 0)
    with pytest.raises(ForceTorqueError, match=f"port {port} of 127.0.0.1: .*in use"):
        ViewerServer(PAGE, DATA, None, port=port)


def test_a_client_that_goes_away_disturbs_nobody(client: Client) -> None:
    """A request that ends in the middle is forgotten."""
    with socket.create_connection(("127.0.0.1", int(urlsplit(client.url).port or 0))) as half:
        half.sendall(b"GET / HTTP/1.1\r\nHos")
    assert client.ask("GET", "").status == 200

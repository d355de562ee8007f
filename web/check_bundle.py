# SPDX-License-Identifier: BSD-3-Clause
"""Check that the committed bundle is what its sources give.

Where npm works, the bundle is built again in a temporary folder and compared byte by byte. Where it does not, the
hashes that the last build wrote down are compared with the sources and with the bundle.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

WEB = Path(__file__).resolve().parent
ASSETS = WEB.parent / "src" / "forcetorque" / "viewer" / "assets"
HASHES = "bundle.sha256"
PATIENCE_S = 300


def main() -> int:
    """Run the check; 0 if the bundle is up to date."""
    wrong = stale_files()
    reason = "npm is not installed"
    if shutil.which("npm") and shutil.which("node"):
        with tempfile.TemporaryDirectory() as folder:
            built, reason = build(Path(folder))
            if built is not None:
                wrong += [f"{name}: another build gives other bytes" for name in differing(built)]
    for line in wrong:
        sys.stderr.write(f"{line}\n")
    if wrong:
        sys.stderr.write("the viewer's bundle is not what its sources give; run `make web` and commit the result\n")
        return 1
    how = "its sources give the same bytes" if not reason else f"only hashes were compared: {reason}"
    sys.stdout.write(f"the viewer's bundle is up to date ({how})\n")
    return 0


def stale_files() -> list[str]:
    """Name what differs from the recorded hashes, and sources that are not recorded."""
    recorded = dict(reversed(line.split("  ", 1)) for line in (ASSETS / HASHES).read_text().splitlines())
    sources = [WEB / name for name in ("build.mjs", "package-lock.json", "package.json", "tsconfig.json")]
    sources += [path for path in (WEB / "src").rglob("*") if path.is_file()]
    present = {f"web/{path.relative_to(WEB).as_posix()}": path for path in sources}
    present |= {name: ASSETS / name for name in recorded if not name.startswith("web/")}
    names = sorted(recorded.keys() | present.keys())
    return [
        f"{name}: not as the last build saw it" for name in names if digest(present.get(name)) != recorded.get(name)
    ]


def digest(path: Path | None) -> str | None:
    """Hash of a file; None if it is absent."""
    return hashlib.sha256(path.read_bytes()).hexdigest() if path is not None and path.is_file() else None


def build(folder: Path) -> tuple[Path | None, str]:
    """Build in another folder; gives the result, or why there is none."""
    copy, out = folder / "web", folder / "assets"
    shutil.copytree(WEB, copy, ignore=shutil.ignore_patterns("node_modules"))
    for command in (["npm", "ci"], ["npm", "run", "build", "--", str(out)]):
        try:
            done = subprocess.run(command, cwd=copy, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        except subprocess.TimeoutExpired:
            return None, f"{' '.join(command)} took more than {PATIENCE_S} s"
        if done.returncode != 0:
            output = (done.stdout + done.stderr).strip()
            if command == ["npm", "ci"]:  # no network: the sources can still be compared
                return None, f"npm ci failed: {output.splitlines()[-1] if output else 'no message'}"
            raise SystemExit(f"{' '.join(command)} failed:\n{output}")
    return out, ""


def differing(built: Path) -> list[str]:
    """Files of a build that are not those of the repository."""
    return [path.name for path in sorted(built.iterdir()) if digest(path) != digest(ASSETS / path.name)]


if __name__ == "__main__":
    sys.exit(main())

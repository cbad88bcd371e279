"""Names by digest what a release is built with: `make pin`, which asks GitHub and the registries of images.

An action as `owner/name@COMMIT # tag`, an image as `name:tag@sha256:DIGEST`. What has a digest already gets that of
today's tag for images, and stays for actions. `release.py` releases nothing while something is named by tag alone.
"""

from __future__ import annotations

import json
import re
import sys
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.response import addinfourl

ROOT = Path(__file__).resolve().parents[1]
FILES = (".github/workflows/ci.yml", ".github/workflows/release.yml", "action.yml", "packaging/docker/Dockerfile")
_ACTION = re.compile(r"(?m)(?<=uses: )(?P<name>[\w.-]+/[\w./-]+)@(?P<ref>\S+)(?P<tag> # \S+)?$")
_IMAGE = re.compile(
    r"(?m)(?:(?<=container: )|(?<=image: )|(?<=^FROM ))(?P<name>[\w./:-]+)(?:@(?P<digest>sha256:\w+))?(?=\s|$)"
)
"""Without variables: which image of ROS is built on the user chooses, by a distribution."""
_COMMIT = re.compile(r"[0-9a-f]{40}")
_MANIFESTS = ", ".join(
    f"application/vnd.{kind}+json"
    for kind in ("oci.image.index.v1", "docker.distribution.manifest.list.v2", "oci.image.manifest.v1")
)


def by_tag(text: str) -> Iterator[str]:
    """What a file names by a tag alone, which may be another thing tomorrow."""
    yield from (found[0] for found in _ACTION.finditer(text) if not _COMMIT.fullmatch(found["ref"]))
    stages = _stages(text)
    yield from (f["name"] for f in _IMAGE.finditer(text) if f["digest"] is None and f["name"] not in stages)


def _stages(text: str) -> set[str]:
    """The stages of a Dockerfile, which are no images of a registry."""
    return set(re.findall(r"(?m)^FROM .* AS (\S+)$", text))


def all_by_tag() -> list[str]:
    """Those of all files."""
    return [f"{file}: {each}" for file in FILES for each in by_tag((ROOT / file).read_text(encoding="utf-8"))]


def pinned(text: str, commit: Callable[[str, str], str], digest: Callable[[str], str]) -> str:
    """The text of a file with digests: `commit` has that of an action's tag, `digest` that of an image."""

    def action(found: re.Match[str]) -> str:
        if _COMMIT.fullmatch(found["ref"]):
            return found[0]
        repository = "/".join(found["name"].split("/")[:2])
        return f"{found['name']}@{commit(repository, found['ref'])} # {found['ref']}"

    def image(found: re.Match[str]) -> str:
        return found[0] if found["name"] in stages else f"{found['name']}@{digest(found['name'])}"

    stages = _stages(text)
    return _IMAGE.sub(image, _ACTION.sub(action, text))


def commit_of(repository: str, tag: str) -> str:
    """The commit of a tag, by GitHub's API. Raises `OSError`."""
    found = json.load(_asked(f"https://api.github.com/repos/{repository}/commits/{tag}"))["sha"]
    return _checked(str(found), _COMMIT)


def digest_of(image: str) -> str:
    """The digest of an image for all processors, by its registry (distribution API v2). Raises `OSError`."""
    name, _, tag = image.partition(":")
    host, _, path = name.partition("/") if "." in name.partition("/")[0] else ("registry-1.docker.io", "", name)
    if host == "registry-1.docker.io":
        path = path if "/" in path else f"library/{path}"
        service = "auth.docker.io/token?service=registry.docker.io"
    else:
        service = f"{host}/token?service={host}"
    token = json.load(_asked(f"https://{service}&scope=repository:{path}:pull"))["token"]
    headers = {"Authorization": f"Bearer {token}", "Accept": _MANIFESTS}
    answer = _asked(f"https://{host}/v2/{path}/manifests/{tag or 'latest'}", "HEAD", headers)
    return _checked(answer.headers["Docker-Content-Digest"], re.compile(r"sha256:[0-9a-f]{64}"))


def _asked(url: str, method: str = "GET", headers: dict[str, str] | None = None) -> addinfourl:
    request = urllib.request.Request(url, method=method, headers=headers or {})  # noqa: S310 - all are https
    found: addinfourl = urllib.request.urlopen(request, timeout=30)  # noqa: S310 - likewise
    return found


def _checked(text: str, form: re.Pattern[str]) -> str:
    if not form.fullmatch(text):
        raise OSError(f"{text!r} is no digest")
    return text


def main() -> int:
    """Write the files."""
    for file in FILES:
        path = ROOT / file
        before = path.read_text(encoding="utf-8")
        after = pinned(before, commit_of, digest_of)
        if after != before:
            path.write_text(after, encoding="utf-8")
            print(file)
    return 0


if __name__ == "__main__":
    sys.exit(main())

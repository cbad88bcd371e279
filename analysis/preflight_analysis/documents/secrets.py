"""What never becomes a value: secret files, contents and environment variables. The one policy for all who ask.

A launch file may name any path and any variable of the user. Its text is not to be believed: so a path counts by where
it really leads, and only the user can allow a secret, never a workspace.
"""

from __future__ import annotations

import contextlib
import functools
import os
import pwd
import re
from collections.abc import Collection, Mapping
from pathlib import Path

from preflight_analysis.dataclass import dataclass

ALLOWED = "ROS_PREFLIGHT_ALLOW_SECRETS"
"""The variable of our own process that names what may be read all the same: paths and names of variables, with `:`
between them. Only the user sets it: it is not read from what a workspace's set-up makes of the environment."""
REMEDY = f"{ALLOWED} allows it"

_OURS = str(Path(__file__).resolve().parent.parent)
"""The data of the catalogue, which may be installed in a dot folder."""
_SYSTEM = (
    "/proc",
    "/sys",
    "/run/secrets",
    "/run/credentials",
    "/run/user",
    "/var/run/secrets",
    "/etc/shadow",
    "/etc/shadow-",
    "/etc/gshadow",
    "/etc/gshadow-",
    "/etc/ssl/private",
    "/etc/sudoers",
    "/etc/sudoers.d",
    "/etc/NetworkManager/system-connections",
    "/etc/wpa_supplicant",
)
_OF_INSTALLATION = (
    *("/etc/ros", "/etc/lsb-release", "/etc/os-release", "/etc/mime.types", "/etc/fonts", "/etc/ssl/openssl.cnf"),
    "/etc/machine-id",  # Fast DDS, from version 3 on
    *("/etc/ld.so.cache", "/etc/ld.so.preload", "/etc/localtime", "/etc/timezone", "/etc/locale.alias"),
    *("/etc/passwd", "/etc/group", "/etc/nsswitch.conf", "/etc/services", "/etc/protocols"),
    *("/etc/hosts", "/etc/host.conf", "/etc/resolv.conf", "/etc/gai.conf"),
)
"""What ROS, its middleware, Python and libc read of the system for themselves, whatever a node does."""
_OPEN_DOT_FOLDERS = frozenset((".ros",))
_KEY_FOLDERS = frozenset((".ssh", ".gnupg", ".aws", ".azure", ".kube", ".docker"))
_KEY_FILES = re.compile(
    r"id_(?:rsa|dsa|ecdsa|ed25519|xmss)(?:[._-](?!pub$).*)?|[._]netrc|\.env(?:\..+)?|\.envrc|\.pgpass|\.git-credentials|\.npmrc|\.pypirc|\.htpasswd"
    r"|\.vault-token|.+\.(?:pem|key|p12|pfx|ppk|jks|keystore|kdbx)"
)
_EXAMPLES = re.compile(r"\.env\.(?:example|sample|template|dist)")
_OF_GIT = frozenset(("config", "config.worktree", "credentials", "FETCH_HEAD"))
_PRIVATE_KEY = re.compile(r"^[ \t]*-----BEGIN (?:[A-Z0-9]+ )*PRIVATE KEY(?: BLOCK)?-----", re.MULTILINE)
_SHOWN_KEY = re.compile(r"-----BEGIN (?:[A-Z0-9]+ )*PRIVATE KEY(?: BLOCK)?-----")
_PRIVATE_KEY_BYTES = re.compile(_PRIVATE_KEY.pattern.encode(), re.MULTILINE)
_SOURCES = (".py", ".c", ".cc", ".cpp", ".cxx", ".h", ".hpp", ".md", ".rst")
"""What speaks of private keys in its tests and examples."""

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_SECRET_WORD = re.compile(
    r"TOKENS|SECRETS|PASSWORDS|CREDENTIAL|CREDS|AUTH|AUTHORIZATION|COOKIES?|BEARER|JWT|APIKEYS|WEBHOOK"
    r"|[A-Z0-9]*(?:TOKEN|SECRET|PASSWORD|PASSWD|PASSPHRASE|APIKEY|CREDENTIALS)"
)
_KEY_KIND = re.compile(r"API|ACCESS|SECRET|PRIVATE|DEPLOY|SIGNING|ENCRYPTION")
_AFTER_KEY = re.compile(r"ID|DATA|BASE64|B64|BASE|B|PEM|CONTENTS?|VALUE|TEXT|PROD|DEV|STAGING|TEST|\d+")
_FILTER = re.compile(r"LOW|HIGH|BAND|ALL|BY")
_KNOWN = re.compile(r"SSHPASS|MYSQL_PWD|\w*_PAT|AZURE_STORAGE_CONNECTION_STRING|SENTRY_DSN|KUBECONFIG_DATA")
"""Of CI services and clouds, without a word that says it."""
_SWITCHES = frozenset(("", "0", "1", "true", "false", "yes", "no", "on", "off", "none"))
"""Values of variables that say whether there is a secret."""
_SECRET_VALUE = re.compile(
    r"://[^/?#\s@:]*:[^/?#\s@]+@"  # an address with a password in it (RFC 3986, section 3.2.1)
    r"|\b(?:gh[pousr]_[A-Za-z0-9]{20,}|github_pat_\w{20,}|glpat-[\w-]{16,}|xox[abeoprs]-[\w-]{10,}"
    r"|(?:AKIA|ASIA)[0-9A-Z]{16}\b|sk-[\w-]{20,}|npm_[A-Za-z0-9]{30,}|pypi-[\w-]{40,}|AIza[\w-]{30,}|hf_[A-Za-z0-9]{30,}"
    r"|dckr_pat_[\w-]{20,}|eyJ[\w-]{8,}\.eyJ[\w-]{8,}\.[\w-]{8,})"
    r"|-----BEGIN (?:[A-Z0-9]+ )*PRIVATE KEY"
)


@dataclass(frozen=True, slots=True)
class Access:
    """What may be read for a workspace. `named`: folders that the user named (the workspace, what is sourced), as they
    really are; `allowed`: secrets that the user allows, paths and names of variables; `outside`: whether files may be
    read that lie in none of the named folders."""

    named: tuple[str, ...] = ()
    allowed: tuple[str, ...] = ()
    outside: bool = True

    def refusal(self, path: str) -> str | None:
        """Why the existing file at `path` is not read as a secret, a phrase that goes on from its name; None where it
        may be."""
        real = _real(path)
        if self._is_allowed(real):
            return None
        for place in dict.fromkeys((os.path.normpath(path), real)):
            region = _private_region(place)
            if region is not None and not any(within(folder, region[0]) for folder in self.named):
                return f"is not read: {region[1]}; {REMEDY}"
            if (kind := _kind_of_file(place)) is not None:
                return f"is not read: it is {kind}; {REMEDY}"
        return None

    def out_of_reach(self, path: str) -> str | None:
        """The same for a file that is out of the workspace's reach."""
        if self.outside or not self.is_outside(path) or self._is_allowed(_real(path)):
            return None
        return "is not read: it is outside of the workspace, which is not trusted to read there"

    def refusal_of_content(self, path: str) -> str | None:
        """The same for a file with a private key in it."""
        return None if self._is_allowed(_real(path)) else f"is not read: it has a private key; {REMEDY}"

    def is_outside(self, path: str) -> bool:
        """Whether a path leads out of the workspace and of all that the user named."""
        real = _real(path)
        return not within(real, _OURS) and not any(within(real, folder) for folder in self.named)

    def is_text_elsewhere(self, path: str) -> bool:
        """Whether it is a file out there that a program may have made its output of: code is none."""
        name = os.path.basename(path)
        is_code = name.endswith((".py", ".pyc", ".so")) or ".so." in name
        of_system = any(within(path, each) for each in _OF_INSTALLATION)
        return not is_code and not of_system and os.path.isfile(path) and self.is_outside(path)

    def _is_allowed(self, real: str) -> bool:
        allowed = [os.path.expanduser(each) for each in self.allowed if "/" in each]
        return any(within(real, each) or within(real, _real(each)) for each in allowed) or within(real, _OURS)


def allowed_by_user() -> tuple[str, ...]:
    """The secrets that the user allows."""
    return tuple(each for each in os.environ.get(ALLOWED, "").split(os.pathsep) if each)


def within(path: str, folder: str) -> bool:
    """Whether `path` is `folder` or lies below it."""
    return path == folder or path.startswith(folder.rstrip("/") + "/")


def withheld(variables: Mapping[str, str], allowed: Collection[str]) -> frozenset[str]:
    """The names of the variables whose values are secrets that nobody allows."""
    return frozenset(n for n, value in variables.items() if n not in allowed and is_secret_variable(n, value))


def is_secret_variable(name: str, value: str) -> bool:
    """Whether a variable's value is a secret, by its name or by the value."""
    if _SECRET_VALUE.search(value) is not None:
        return True
    return value.strip().lower() not in _SWITCHES and _is_secret_name(name)


def _is_secret_name(name: str) -> bool:
    if _KNOWN.fullmatch(name.upper()):
        return True
    words = [word.upper() for word in _WORD.findall(name)]
    for before, word, at in zip(("", *words), words, range(len(words)), strict=False):
        after = words[at + 1 :]
        if _SECRET_WORD.fullmatch(word):
            return True
        if word in ("KEY", "KEYS") and (_KEY_KIND.fullmatch(before) or all(map(_AFTER_KEY.fullmatch, after))):
            return True
        if word == "PASS" and not after and not _FILTER.fullmatch(before):
            return True
    return False


def is_key_file(name: str) -> bool:
    """Whether a file of this name holds a key or passwords."""
    return _KEY_FILES.fullmatch(name) is not None and _EXAMPLES.fullmatch(name) is None


def has_private_key(path: str, content: str | bytes) -> bool:
    """Whether what is in a file has a private key in it, as PEM, OpenSSH and PGP write it."""
    if path.endswith(_SOURCES):
        return False
    if isinstance(content, bytes):
        return b"PRIVATE KEY" in content and _PRIVATE_KEY_BYTES.search(content) is not None
    return "PRIVATE KEY" in content and _PRIVATE_KEY.search(content) is not None


def shows_private_key(text: str) -> bool:
    """Whether a private key is somewhere in what a program printed."""
    return "PRIVATE KEY" in text and _SHOWN_KEY.search(text) is not None


def dot_folder(real: str) -> str | None:
    """The hidden folder (or file) of a home folder that a path is, or is in."""
    homes = [*_own_homes(), "/root"]
    if real.startswith("/home/"):
        homes.append("/".join(real.split("/")[:3]))
    for home in homes:
        if home != "/" and real.startswith(home + "/."):
            return home + "/" + real[len(home) + 1 :].partition("/")[0]
    return None


def _private_region(path: str) -> tuple[str, str] | None:
    """The folder or file around a path that is nobody's business, and why it is not."""
    for folder in _SYSTEM:
        if within(path, folder):
            return folder, f"{folder} is the system's"
    region = dot_folder(path)
    if region is not None and os.path.basename(region) not in _OPEN_DOT_FOLDERS:
        return region, "it is in a dot folder of a home folder"
    other = _home_of_others(path)
    if other is not None:
        return other, "it is in another user's home folder"
    return None


def _kind_of_file(path: str) -> str | None:
    parts = path.split("/")
    if is_key_file(parts[-1]):
        return "a file with a key or a password"
    if any(part in _KEY_FOLDERS for part in parts[:-1]):
        return "in a folder of keys"
    if ".git" in parts[:-1] and parts[-1] in _OF_GIT:
        return "a file of git, which may have a token"
    return None


def _home_of_others(path: str) -> str | None:
    own = _own_homes()
    others = ["/root"]
    if path.startswith("/home/"):
        others.append("/".join(path.split("/")[:3]))
    for home in others:
        # A home folder may lie in another one, as a test's does.
        if within(path, home) and path != home and not any(within(path, mine) for mine in own):
            return home
    return None


def _own_homes() -> tuple[str, ...]:
    return _homes_of(os.path.expanduser("~"), os.getuid())


@functools.lru_cache(maxsize=8)
def _homes_of(home: str, user: int) -> tuple[str, ...]:
    found = {os.path.realpath(home)}
    with contextlib.suppress(KeyError):  # a container may run as a user whom nobody knows
        found.add(os.path.realpath(pwd.getpwuid(user).pw_dir))
    return tuple(sorted(found - {"/"}))


def _real(path: str) -> str:
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return path

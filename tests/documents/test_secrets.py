"""What is a secret: names of variables, values, paths and contents; and who may allow one."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.secrets import Access, has_private_key, is_key_file, is_secret_variable, withheld

PRIVATE_KEY = "-----BEGIN OPENSSH PRIVATE KEY-----\nb3BlbnNzaC1rZXk\n-----END OPENSSH PRIVATE KEY-----\n"
SECRET_NAMES = """TOKEN GITHUB_TOKEN API_KEY OPENAI_API_KEY API_KEY_PROD KEY ROBOT_KEY MY_SECRET PASS DB_PASS
DB_PASSWORD PGPASSWORD SSHPASS MYSQL_PWD AWS_ACCESS_KEY_ID AWS_SECRET_ACCESS_KEY SSH_PRIVATE_KEY_BASE64 AUTH
SSH_AUTH_SOCK GOOGLE_APPLICATION_CREDENTIALS SESSION_COOKIE GITHUB_PAT SYSTEM_ACCESSTOKEN CI_JOB_JWT
CI_JOB_JWT_V2 apiKey"""
OTHER_NAMES = """TURTLEBOT3_MODEL ROS_AUTOMATIC_DISCOVERY_RANGE ROS_DOMAIN_ID KEYBOARD_LAYOUT KEYBOARD ROBOT_KEY_FRAME
KEYFRAME MONKEY HOTKEY_MAP BYPASS BYPASS_CAMERA COMPASS COMPASS_TOPIC PASS_THROUGH LOW_PASS PASSENGERS AUTHOR
AUTHOR_NAME XAUTHORITY TOKENIZERS_PARALLELISM ROS_SECURITY_KEYSTORE PWD OLDPWD PATH HOME PATTERN"""
SECRET_VALUES = (
    "https://user:hunter2@example.org/robot.git",
    "ghp_0123456789abcdefghijABCDEFGHIJ012345",
    "github_pat_0123456789abcdefghij_ABCDEF",
    "glpat-0123456789abcdefghij",
    "xoxb-0123456789-abcdef",
    "AKIAABCDEFGHIJKLMNOP",
    "sk-0123456789abcdefghijABCD",
    "eyJhbGciOiJIUzI1NiJ9.eyJzdWIiOiIxMjM0In0.dBjftJeZ4CVP",
    PRIVATE_KEY,
)


@pytest.mark.parametrize("name", SECRET_NAMES.split())
def test_the_name_of_a_variable_says_that_it_is_a_secret(name: str) -> None:
    assert is_secret_variable(name, "hunter22")


@pytest.mark.parametrize("name", OTHER_NAMES.split())
def test_ordinary_names_are_none(name: str) -> None:
    assert not is_secret_variable(name, "hunter22")


@pytest.mark.parametrize("value", SECRET_VALUES)
def test_the_value_of_a_variable_says_that_it_is_a_secret(value: str) -> None:
    assert is_secret_variable("ROBOT", value)


@pytest.mark.parametrize("value", ["burger", "https://example.org/a@b", "sk-learn", "tcp://10.0.0.1:80", ""])
def test_ordinary_values_are_none(value: str) -> None:
    assert not is_secret_variable("ROBOT", value)


@pytest.mark.parametrize("value", ["true", "0", "off", ""])
def test_a_switch_is_no_secret(value: str) -> None:
    assert not is_secret_variable("USE_AUTH", value)


def test_the_user_allows_a_variable_by_name() -> None:
    variables = {"ROBOT_KEY": "hunter22", "API_KEY": "hunter22", "ROBOT": "burger"}
    assert withheld(variables, ("ROBOT_KEY",)) == {"API_KEY"}


@pytest.mark.parametrize("name", ["id_rsa", "id_ed25519_robot", ".netrc", ".env", ".env.local", "ca.pem", "robot.key"])
def test_files_with_keys_by_name(name: str) -> None:
    assert is_key_file(name)


@pytest.mark.parametrize("name", ["id_rsa.pub", "id_map.yaml", "id_server", ".env.example", "keys.yaml", "key.launch"])
def test_other_files_by_name(name: str) -> None:
    assert not is_key_file(name)


def test_a_private_key_in_a_source_is_an_example() -> None:
    assert has_private_key("/robot/anything", PRIVATE_KEY)
    assert has_private_key("/robot/params.yaml", "key: |\n  " + PRIVATE_KEY)
    assert has_private_key("/robot/anything", PRIVATE_KEY.encode())
    assert not has_private_key("/robot/test_keys.py", PRIVATE_KEY)
    assert not has_private_key("/robot/a.yaml", "hint: the file begins with -----BEGIN PRIVATE KEY-----")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    home = tmp_path / "home"
    for name in (".ssh/config", ".config/app/a.txt", ".ros/camera_info/a.yaml", "robot/a.yaml", ".bashrc", "ws/id_rsa"):
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_text("a: 1")
    monkeypatch.setenv("HOME", str(home))
    return home


def _read(path: Path | str, access: Access = Access()) -> str:  # noqa: B008  # frozen
    disk = Disk()
    disk.access = access
    found = disk.text(str(path))
    data = disk.data(str(path))
    assert isinstance(found, Unreadable) == isinstance(data, Unreadable)
    return found.text if isinstance(found, Document) else f"{found.kind}: {found.reason}"


@pytest.mark.parametrize("name", [".ssh/config", ".config/app/a.txt", ".bashrc", "ws/id_rsa"])
def test_secret_files_are_not_read(home: Path, name: str) -> None:
    assert _read(home / name).startswith("withheld: is not read: ")
    assert "ROS_PREFLIGHT_ALLOW_SECRETS" in _read(home / name)


@pytest.mark.parametrize("name", [".ros/camera_info/a.yaml", "robot/a.yaml"])
def test_other_files_are_read(home: Path, name: str) -> None:
    assert _read(home / name) == "a: 1"


@pytest.mark.parametrize("path", ["/proc/self/environ", "/proc/self/status", "/sys/kernel/profiling"])
def test_files_of_the_kernel_are_not_read(path: str) -> None:
    assert _read(path).startswith("withheld: ")


def test_links_count_by_where_they_lead(home: Path) -> None:
    (home / "robot/link.yaml").symlink_to(home / ".ssh/config")
    (home / "robot/folder").symlink_to(home / ".config")
    (home / "robot/root").symlink_to("/proc/self/root")
    assert _read(home / "robot/link.yaml").startswith("withheld: ")
    assert _read(home / "robot/folder/app/a.txt").startswith("withheld: ")
    assert _read(f"{home}/robot/root{home}/.ssh/config").startswith("withheld: ")
    assert _read(f"/proc/self/root{home}/robot/a.yaml").startswith("withheld: ")


def test_a_private_key_under_any_name_is_not_read(home: Path) -> None:
    (home / "robot/notes.txt").write_text(PRIVATE_KEY)
    assert _read(home / "robot/notes.txt").startswith("withheld: is not read: it has a private key")


def test_what_is_missing_is_missing(home: Path) -> None:
    assert _read(home / ".ssh/other").startswith("missing: ")


def test_a_workspace_in_a_dot_folder_is_read(home: Path) -> None:
    named = (str(home / ".config/app"),)
    assert _read(home / ".config/app/a.txt", Access(named)) == "a: 1"
    assert _read(home / ".ssh/config", Access(named)).startswith("withheld: ")
    assert _read(home / ".ssh/config", Access((str(home),))).startswith("withheld: ")


@pytest.mark.parametrize("allowed", ["{}/.config", "~/.config/app/a.txt"])
def test_the_user_allows_a_path(home: Path, allowed: str) -> None:
    access = Access(allowed=(allowed.format(home),))
    assert _read(home / ".config/app/a.txt", access) == "a: 1"
    assert _read(home / ".ssh/config", access).startswith("withheld: ")


def test_an_editor_has_no_other_rights(home: Path) -> None:
    disk = Disk()
    disk.open(str(home / ".ssh/config"), "Host robot")
    found = disk.text(str(home / ".ssh/config"))
    assert isinstance(found, Unreadable)
    assert found.kind == "withheld"


def test_without_trust_nothing_outside_is_read(home: Path) -> None:
    access = Access((str(home / "ws"),), outside=False)
    (home / "ws/b.yaml").write_text("b: 1")
    (home / "ws/link.yaml").symlink_to(home / "robot/a.yaml")
    assert _read(home / "ws/b.yaml", access) == "b: 1"
    assert _read(home / "robot/a.yaml", access).startswith("withheld: is not read: it is outside of the workspace")
    assert _read(home / "ws/link.yaml", access).startswith("withheld: ")


def test_without_trust_what_the_user_has_open_is_read(home: Path) -> None:
    disk = Disk()
    disk.access = Access((str(home / "ws"),), outside=False)
    disk.open(str(home / "robot/a.yaml"), "a: 2")
    found = disk.text(str(home / "robot/a.yaml"))
    assert isinstance(found, Document)
    assert found.text == "a: 2"


def test_what_is_allowed_is_noticed(home: Path) -> None:
    disk = Disk()
    path = str(home / ".config/app/a.txt")
    assert isinstance(disk.text(path), Unreadable)
    disk.access = Access(allowed=(path,))
    assert isinstance(disk.text(path), Document)
    disk.access = Access()
    assert isinstance(disk.text(path), Unreadable)

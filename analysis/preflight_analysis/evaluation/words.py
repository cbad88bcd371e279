"""The words of command lines."""

import re
import shlex
from collections.abc import Iterator, Sequence

_PLAIN = re.compile(r"[ \t\r\n!#-&(-\[\]-~]*\Z")
"""ASCII without quotes and backslashes, of which blanks alone make words: most texts, and `shlex` is slow."""


def words_of(text: str) -> list[str]:
    """The words of a command line; split at blanks where a quote is left open."""
    if _PLAIN.match(text) is not None:
        return text.split()
    try:
        return shlex.split(text)
    except ValueError:
        return text.split()


def beside_ros(words: Sequence[str]) -> Iterator[str]:
    """Without what ROS 2 takes for itself, all between `--ros-args` and `--`
    (https://design.ros2.org/articles/160_ros_command_line_arguments.html)."""
    inside = False
    for word in words:
        if inside or word == "--ros-args":
            inside = word != "--"
        else:
            yield word

"""LCH019: a suppression comment that silences nothing."""

import pytest
from support.check import check
from support.fixes import fixed


@pytest.mark.parametrize(
    ("comment", "after"),
    [
        ("\n  <!-- preflight: ignore[LCH004] old -->\n  <group/>", "\n  <group/>"),
        ("<group/> <!-- preflight: ignore[LCH004] -->", "<group/> "),
        ("<ours/><!-- preflight: ignore[LCH004, LCH005] -->", "<ours/><!-- preflight: ignore[LCH004] -->"),
        ("<ours/><!-- preflight: ignore[LCH005, LCH004] -->", "<ours/><!-- preflight: ignore[LCH004] -->"),
    ],
)
def test_an_unused_suppression_is_removed(comment: str, after: str) -> None:
    assert fixed(comment, "LCH019") == after


def test_comments_of_ours_in_yaml() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          # preflight: <topics><topic name="chatter" type="std_msgs/msg/String" class="pub"/></topics>
          - node: {pkg: p, exec: talker, name: talker}
          # preflight: <topics>
          #   <topic name="chater" type="std_msgs/msg/String" class="sub"/>
          # </topics>
          - node:
            ^^^^ warning[TOP001] '/chater' has no publisher (subscriber: /listener); did you mean '/chatter'
              pkg: p
              exec: listener
              name: listener
          # preflight: ignore[LCH016] two of them, on purpose
          - node: {pkg: p, exec: talker, name: talker}
          - log: {message: $(var nothing)}  # preflight: ignore[ARG001] never reached
          - log: {message: hello}  # preflight: ignore[ARG001] not needed
                                                       ^^^^^^ warning[LCH019]
    """)


@pytest.mark.silent
def test_comments_that_silence_something() -> None:
    check("""
        <launch>
          <robots/>  <!-- preflight: ignore[LCH004] of another tool -->
          <!-- preflight: ignore[LCH004] -->
          <robots/>
        </launch>
    """)

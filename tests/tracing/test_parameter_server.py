"""What is made of a launch's parameters is made once for all of its nodes."""

from __future__ import annotations

from preflight_analysis.tracing.parameter_server import SharedParams

VALUES = {"/a": {"b": 1, "blob": b"\x00"}, "/a/b/c": [1, "x"], "/none": None, "/rate": 5.0}


def test_the_tree_is_that_of_the_server_and_one_object() -> None:
    params = SharedParams(VALUES)
    assert params.tree is params.tree
    assert params.tree.get("/a") == {"b": {"c": [1, "x"]}, "blob": {"$binary": "AA=="}}
    assert "/none" not in params.tree.names(), "the server cannot hold None"


def test_making_it_leaves_the_values_alone() -> None:
    params = SharedParams(VALUES)
    assert params.tree.has("/a/b/c")
    assert params == VALUES == {**VALUES, "/a": {"b": 1, "blob": b"\x00"}}

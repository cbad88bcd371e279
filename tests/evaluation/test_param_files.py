"""Parameter files of ROS 2, whatever stands in them."""

from preflight_analysis.evaluation.ros2.param_files import read_param_file


def bomb(leaf: str, mark: str) -> str:
    lines = [f"a0: &a0 {leaf}"]
    for level in range(1, 30):
        keys = ", ".join(f"k{key}: *a{level - 1}" for key in range(10))
        lines.append(f"a{level}: &a{level} {{{keys}}}")
    return "\n".join([*lines, f"node: {{{mark}: *a29}}", ""])


def test_aliases_of_aliases_end() -> None:
    for leaf in ("{}", "1"):
        for mark in ("ros__parameters", "inner"):
            assert len(read_param_file(bomb(leaf, mark)).sections) <= 1


def test_a_list_of_lists_of_lists_ends() -> None:
    lines = ["a0: &a0 [1, 2]", *(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 30))]
    (section,) = read_param_file("\n".join([*lines, "node: {ros__parameters: {x: *a29}}"])).sections
    assert section.params[0].value == [None] * 10


def test_patterns() -> None:
    def fits(pattern: str, node: str) -> bool:
        (section,) = read_param_file(f'"{pattern}": {{ros__parameters: {{a: 1}}}}').sections
        return section.fits(node)

    assert fits("/**", "/a/b/c")
    assert fits("/*/camera", "/robot/camera")
    assert not fits("/*/camera", "/a/b/camera")
    assert fits("/robot/**", "/robot/arm/hand")
    assert not fits("camera", "/robot/camera")
    assert not fits("/**" * 40 + "/x", "/a" * 60), "and says so at once"

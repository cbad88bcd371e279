"""Parameter files of ROS 2, whatever stands in them."""

from preflight_analysis.evaluation.ros2.param_files import read_made_param_file


def bomb(leaf: str, mark: str) -> str:
    lines = [f"a0: &a0 {leaf}"]
    for level in range(1, 30):
        keys = ", ".join(f"k{key}: *a{level - 1}" for key in range(10))
        lines.append(f"a{level}: &a{level} {{{keys}}}")
    return "\n".join([*lines, f"node: {{{mark}: *a29}}", ""])


def test_aliases_of_aliases_end() -> None:
    for leaf in ("{}", "1"):
        for mark in ("ros__parameters", "inner"):
            assert len(read_made_param_file(bomb(leaf, mark)).sections) <= 1


def test_a_list_of_lists_of_lists_ends() -> None:
    lines = ["a0: &a0 [1, 2]", *(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 30))]
    (section,) = read_made_param_file("\n".join([*lines, "node: {ros__parameters: {x: *a29}}"])).sections
    assert section.params[0].value == [None] * 10


def test_patterns() -> None:
    def fits(pattern: str, node: str) -> bool:
        (section,) = read_made_param_file(f'"{pattern}": {{ros__parameters: {{a: 1}}}}').sections
        return section.fits(node)

    assert fits("/**", "/a/b/c")
    assert fits("/*/camera", "/robot/camera")
    assert not fits("/*/camera", "/a/b/camera")
    assert fits("/robot/**", "/robot/arm/hand")
    assert not fits("camera", "/robot/camera")
    assert not fits("/**" * 40 + "/x", "/a" * 60), "and says so at once"


def test_sections_that_reach_a_node_are_found_by_name_and_in_order() -> None:
    keys = ("a", "/**", "b", "/x/a", "/*", "/a", "/x/**", "/**/a", "/x/*")
    file = read_made_param_file("".join(f'"{key}": {{ros__parameters: {{p: 1}}}}\n' for key in keys))
    for node in ("/a", "/b", "/c", "/x/a", "/x/y/a"):
        for composable in (False, True):
            fitting = [section for section in file.sections if section.reaches(node, composable=composable)]
            assert file.reaching(node, composable=composable) == fitting
    assert [section.key for section in file.reaching("/a")] == ["a", "/**", "/*", "/a", "/**/a"]

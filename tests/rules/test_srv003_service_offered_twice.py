"""SRV003: two nodes offer one service."""

import pytest
from support.check import check


def test_a_service_that_two_nodes_offer() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="left"/>
          <node pkg="p" type="t" name="right"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV003] services '/reset' and '/stop' have 2 servers (/left
        </launch>
        //- interfaces
        {"/left": {"services": {"reset": "std_srvs/Empty", "stop": "std_srvs/Empty", "~own": "std_srvs/Empty"}},
         "/right": {"services": {"reset": "std_srvs/Empty", "stop": "std_srvs/Empty", "~own": "std_srvs/Empty"}}}
    """
    (finding,) = check(text)
    assert [related.message for related in finding.related] == ["/left serves /reset"]


def test_a_service_that_two_nodes_of_ros2_offer() -> None:
    check("""
        //- /main.launch.xml
        <launch>
          <node pkg="p" exec="t" name="left"/>
          <node pkg="p" exec="t" name="right"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[SRV003] service '/reset' has 2 servers (/left and /right):
        </launch>
        //- interfaces
        {"/left": {"services": {"reset": "std_srvs/srv/Trigger"}},
         "/right": {"services": {"reset": "std_srvs/srv/Trigger"}}}
    """)


@pytest.mark.parametrize(
    ("manager", "said"),
    [("one", "their manager /one accepts only the first"), ("two", "only the last to register receives calls")],
)
def test_nodelets_of_one_manager_are_one_node(manager: str, said: str) -> None:
    right = f'<node pkg="nodelet" type="nodelet" name="right" args="load p/T {manager}"/>'
    (finding,) = check(f"""
        <launch>
          <node pkg="nodelet" type="nodelet" name="one" args="manager"/>
          <node pkg="nodelet" type="nodelet" name="two" args="manager"/>
          <node pkg="nodelet" type="nodelet" name="left" args="load p/T one"/>
          {right}
          {"^" * len(right)} warning[SRV003] service '/reset' has 2 servers (/left and /right)
        </launch>
        //- /nodelet/package.xml
        <package><name>nodelet</name></package>
        //- /nodelet/nodelet
        //- interfaces
        {{"/one": {{}}, "/two": {{}}, "/left": {{"services": {{"reset": "std_srvs/Empty"}}}},
         "/right": {{"services": {{"reset": "std_srvs/Empty"}}}}}}
    """)
    assert finding.message.endswith(f": {said}")


@pytest.mark.silent
def test_services_of_two_namespaces_and_those_of_every_node_are_not_offered_twice() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base" ns="left"/>
          <node pkg="p" type="t" name="base" ns="right"/>
        </launch>
        //- interfaces
        {"/left/base": {"services": {"reset": "std_srvs/Empty", "/x": "y/Z"}, "builtin": ["/x"]},
         "/right/base": {"services": {"reset": "std_srvs/Empty", "/x": "y/Z"}, "builtin": ["/x"]}}
    """)

"""What nodes make only once somebody is at the other end of one of their topics."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.tracing.agents import xml_rpc
from support.tracing_harness import own, trace, write_node

LAZY = """
    import rospy
    from std_msgs.msg import String

    class Listener(rospy.SubscribeListener):
        def peer_subscribe(self, topic, publish, peer_publish):
            rospy.Subscriber("news", String, lambda message: None)

    rospy.init_node("n")
    rospy.Publisher("headlines", String, subscriber_listener=Listener(), queue_size=1)
    rospy.Publisher("weather", String, queue_size=1)
    rospy.spin()
"""


@pytest.mark.ros
def test_a_lazy_node_is_given_a_subscriber(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, LAZY), "/a/n", remaps=(("headlines", "/moved"),))
    assert found.outcome.status == "spinning"
    assert {(e.role, e.name, "on demand" in e.evidence.doubts) for e in found.endpoints if not e.builtin} == {
        ("publisher", "headlines", False),
        ("publisher", "weather", False),
        ("subscriber", "news", True),
    }


@pytest.mark.ros
def test_a_node_that_ends_of_a_visit_was_spinning(tmp_path: Path) -> None:
    ending = LAZY.replace('rospy.Subscriber("news", String, lambda message: None)', "import os; os._exit(3)")
    found = trace(write_node(tmp_path, ending))
    assert found.outcome.status == "spinning"


RELAY = """
    import rospy
    from rospy.msg import AnyMsg

    def passed_on(message):
        kind = message._connection_header["type"]
        class Same(AnyMsg):
            _type, _md5sum, _full_text = kind, message._connection_header["md5sum"], ""
        rospy.Publisher("out", Same, queue_size=1)

    rospy.init_node("n")
    rospy.Subscriber("in", AnyMsg, passed_on)
    rospy.spin()
"""


@pytest.mark.ros
def test_a_node_that_passes_on_any_type_is_given_a_message(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, RELAY))
    assert own(found) == {("subscriber", "in", "*"), ("publisher", "out", "*")}
    assert [e.name for e in found.endpoints if "on demand" in e.evidence.doubts] == ["out"]


FLEETING = """
    import rospy
    from std_msgs.msg import String
    rospy.init_node("n")
    rospy.Publisher("for_a_while", String, queue_size=1).unregister()
    rospy.Publisher("again", String, queue_size=1).unregister()
    rospy.Publisher("again", String, queue_size=1)
    rospy.Subscriber("heard_once", String, lambda message: None).unregister()
    rospy.spin()
"""


@pytest.mark.ros
def test_a_topic_that_was_offered_for_a_while_only_is_left_out(tmp_path: Path) -> None:
    found = own(trace(write_node(tmp_path, FLEETING)))
    assert {(role, name) for role, name, _ in found} == {("publisher", "again"), ("subscriber", "heard_once")}


LIAR = """
    import os, socket, threading, time
    from xmlrpc.client import ServerProxy
    master = ServerProxy(os.environ["ROS_MASTER_URI"])
    listening = socket.socket()
    listening.bind(("127.0.0.1", 0))
    listening.listen(5)
    port = listening.getsockname()[1]
    for number, api in enumerate(["http://127.0.0.1:99999/", "nonsense", f"http://127.0.0.1:{port}/"]):
        master.registerPublisher("/n", f"/t{number}", "std_msgs/String", api)
        with open(os.environ["PREFLIGHT_EVENTS"], "w") as events:
            events.write('{"ev": "endpoint", "role": "publisher", "name": "/t%d", "resolved": "/t%d",'
                         ' "awaits": true}\\n' % (number, number))
            events.write('{"ev": "state", "state": "spin"}\\n')
    while True:
        connection = listening.accept()[0]
        connection.sendall(b"HTTP/1.1 200 OK\\r\\nContent-Length: 99999999999\\r\\n\\r\\n" + b"x" * 100000)
"""


@pytest.mark.ros
def test_a_node_that_lies_about_its_address_holds_nothing_up(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, LIAR))
    assert found.outcome.status == "spinning"
    assert found.outcome.stderr_tail == ()


def test_what_the_visitor_calls_can_be_read_as_a_call() -> None:
    body = xml_rpc.call("requestTopic", "/me", "/a<b", [["TCPROS"]])
    assert xml_rpc.read_call(body.encode()) == ("requestTopic", ("/me", "/a<b", [["TCPROS"]]))
    assert xml_rpc.read_answer(xml_rpc.answer([1, "", 0]).encode()) == [1, "", 0]
    with pytest.raises(ValueError, match="not an answer"):
        xml_rpc.read_answer(b"<methodResponse><params/></methodResponse>")

"""Simulated time, where the parameter says so (http://wiki.ros.org/Clock)."""

import importlib

from .. import msproxy, rostime


def init_simtime() -> None:
    """Subscribe to the clock."""
    code, _, value = msproxy.call("getParam", "/use_sim_time")
    if code == 1 and value:
        rostime.simulate()
        topics = importlib.import_module("rospy.topics")
        topics.Subscriber("/clock", importlib.import_module("rosgraph_msgs.msg").Clock, queue_size=1)

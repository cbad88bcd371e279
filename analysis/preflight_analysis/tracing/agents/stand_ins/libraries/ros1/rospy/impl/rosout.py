"""The topic of all logs."""

import importlib


def init_rosout() -> None:
    """Publish it."""
    topics = importlib.import_module("rospy.topics")
    topics.Publisher("/rosout", importlib.import_module("rosgraph_msgs.msg").Log, latch=True, queue_size=100)

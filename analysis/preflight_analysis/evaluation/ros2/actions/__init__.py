"""One module an action of ROS 2's launch files, with the parts that belong to it: `registry.py` finds them."""

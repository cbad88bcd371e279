"""What Python nodes import and this machine does not have: the ROS libraries, messages, and any other module.

The real thing is used wherever it is there. `finder` is asked last of all for a module, gives the libraries of
`libraries/` and the classes that `interfaces` makes of message definitions, and says that it did. The stand-ins of
rospy and rclpy connect to nobody; the same is woven into them as into the real ones, and tells what a node makes.
"""

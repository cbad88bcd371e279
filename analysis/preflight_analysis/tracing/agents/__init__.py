"""What runs inside the sandbox, in the interpreter of the user's nodes (3.8 to 3.14): standard library and aspectlib.

Mounted there as the package `preflight_agents`; `supervisor` starts the node and is its ROS master, `sitecustomize`
and `rospy_weave` run in the node's own process.
"""

"""Stand-ins of libraries of ROS 1."""

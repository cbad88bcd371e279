"""Stand-ins of libraries that ROS 1 and ROS 2 have by the same name."""

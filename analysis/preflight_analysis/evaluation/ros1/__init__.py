"""ROS 1: what roslaunch makes of a launch file (http://wiki.ros.org/roslaunch/XML), without starting anything."""

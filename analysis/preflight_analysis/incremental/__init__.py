"""Values made from values, remembered until what they were made from changes. Knows nothing of ROS."""

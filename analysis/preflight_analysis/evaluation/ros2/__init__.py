"""What `ros2 launch` makes of a launch file, whatever its format."""

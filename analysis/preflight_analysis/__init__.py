"""What ros-preflight knows about launch configurations: plain data and pure functions, no editor types."""

__version__ = "0.1.0"

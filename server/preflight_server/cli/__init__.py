"""The command `ros-preflight`: one module per verb."""

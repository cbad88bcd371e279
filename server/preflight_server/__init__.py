"""ros-preflight for editors and terminals: conversions around `preflight_analysis`, no analysis of its own."""

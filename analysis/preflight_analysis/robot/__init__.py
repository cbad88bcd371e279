"""Robot descriptions: what a URDF text says, where the launch gets it from, and where it is written."""

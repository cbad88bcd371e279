"""The known good graph: what a launch configuration is expected to start, kept in a file and compared."""

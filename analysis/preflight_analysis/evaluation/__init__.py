"""LaunchFile to LaunchTree: what the launcher would start, every value with its origin and certainty."""

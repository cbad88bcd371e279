"""The running system beside the expected one: what is missing, extra or of the wrong type."""

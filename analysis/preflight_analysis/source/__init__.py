"""Source code to what a node may do, without running it: the last resort for a node that cannot be run."""

"""What the nodes of a launch do: each source of knowledge gives its part, of which `merge.py` makes interfaces."""

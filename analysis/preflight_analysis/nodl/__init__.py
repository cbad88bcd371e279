"""NoDL, the community's description of what a node does (https://nodl.readthedocs.io)."""

"""Parameters that change while a node runs (http://wiki.ros.org/dynamic_reconfigure)."""

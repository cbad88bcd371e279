"""The stand-ins of libraries, each under the name of the real one. Only what a node calls by itself is there."""

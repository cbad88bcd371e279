"""The start of a node, which needs no time here."""

import time

__all__ = ["time"]

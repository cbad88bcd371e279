"""Kinds of clocks."""

from .clock import ClockType

__all__ = ["ClockType"]

"""Edits of files: their shape, a writer for each format, and the gate that each passes before it is offered."""

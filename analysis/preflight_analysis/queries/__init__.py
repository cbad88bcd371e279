"""Position to answer: what is at an offset of a file, as plain data that an editor or a command can show."""

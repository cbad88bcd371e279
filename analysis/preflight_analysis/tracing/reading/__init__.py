"""Python launch files that are read: their code is interpreted, nothing of it is executed."""

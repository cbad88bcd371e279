"""What everybody uses, known where it is not installed: data that `make catalogue` writes. Read when asked for."""

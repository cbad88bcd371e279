"""What parameters of common packages mean: data that is written by hand, with its source, and read when asked for."""

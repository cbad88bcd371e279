"""Commands for developers. Tests run some of them in short."""

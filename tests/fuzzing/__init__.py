"""What is fuzzed, and with which inputs: `tests/tools/fuzz.py` and the tests here do it."""

"""What holds for all tests."""

import signal


def pytest_configure() -> None:
    """A shell that starts the tests in the background lets them ignore interrupts, and with them each program that a
    test starts and interrupts."""
    signal.signal(signal.SIGINT, signal.default_int_handler)

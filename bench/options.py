"""What every benchmark takes from the command line."""

from __future__ import annotations

import argparse


class Options(argparse.ArgumentParser):
    """`-n`, and `--quick` for as little as shows that the benchmark still runs."""

    def __init__(
        self, text: str | None, *, n: int, quick: int, metavar: str = "ROUNDS", help: str | None = None
    ) -> None:
        super().__init__(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
        self._quick = quick
        amount = self.add_mutually_exclusive_group()
        amount.add_argument("-n", type=int, default=n, metavar=metavar, help=help)
        amount.add_argument("--quick", action="store_true", help="in seconds; the figures say nothing")

    def read(self) -> argparse.Namespace:
        """What was given, `n` for `--quick` too."""
        given = self.parse_args()
        given.n = self._quick if given.quick else given.n
        return given

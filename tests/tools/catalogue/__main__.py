"""Writes the catalogue of what everybody uses: `make catalogue SOURCES=FOLDER`.

  python tests/tools/catalogue --sources FOLDER [--only OWNER/NAME]... [released] [messages] [interfaces] [launches]
                           [descriptions]...

The folder has snapshots of public repositories, `OWNER+NAME/repo`. What is known of a repository that it lacks, or
that `--only` does not name, stays as it is. Facts alone are taken from them: names, types,
defaults, ranges, conditions and QoS, by this project's own analysis. `catalogue/data/README.md` says more.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))  # tests/, as pytest has it

from tools.catalogue.descriptions import write_descriptions
from tools.catalogue.interfaces import write_interfaces
from tools.catalogue.launches import write_launches
from tools.catalogue.messages import write_messages
from tools.catalogue.released import write_released

PARTS = {
    "released": write_released,
    "messages": write_messages,
    "interfaces": write_interfaces,
    "launches": write_launches,
    "descriptions": write_descriptions,
}


def main() -> None:
    """Write the parts that are asked for, all without any."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sources", type=Path, required=True)
    parser.add_argument("--only", action="append", default=[], help="OWNER/NAME; all that are there without")
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help="default: all")
    options = parser.parse_args()
    for part in options.parts or PARTS:
        PARTS[part](options.sources, options.only)


if __name__ == "__main__":
    main()

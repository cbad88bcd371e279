"""`python -m preflight_server`: the same as the command `ros-preflight`."""

import sys

from preflight_server.cli.main import main

sys.exit(main())

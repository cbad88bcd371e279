"""What may be said of every process: nodes, containers and other programs."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import flag
from preflight_analysis.launch.schema import Attribute

OUTPUTS = ("screen", "log", "both", "own_log", "full")
"""What `launch.logging.get_output_loggers` takes as a text; in Python it may be a dict, too."""
PROCESS = (
    Attribute("cwd", "The working directory of the process.", "file"),
    Attribute("on_exit", "`shutdown`: end the whole launch when the process ends.", "choice", ("shutdown",)),
    Attribute("launch-prefix", "A command to put before the process's own, such as `gdb -ex run --args`."),
    Attribute("output", "Where the output goes.", "text", OUTPUTS),
    flag("respawn", "Start the process again whenever it ends.", taken="text"),
    Attribute("respawn_max_retries", "How often to start it again; below 0 without end.", "integer", default="-1"),
    Attribute("respawn_delay", "Seconds to wait before it is started again.", "number", taken="seconds"),
    Attribute("sigkill_timeout", "Seconds from SIGTERM to SIGKILL at shutdown.", "number", taken="seconds"),
    Attribute("sigterm_timeout", "Seconds from SIGINT to SIGTERM at shutdown.", "number", taken="seconds"),
    flag("shell", "Run the command in a shell."),
    flag("emulate_tty", "Give the process a terminal, so that its output is not buffered."),
)

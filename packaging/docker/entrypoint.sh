#!/usr/bin/env bash
# Sources ROS, and the workspace in the current folder if it was built, then runs ros-preflight.
set -eo pipefail
# shellcheck disable=SC1090 # which file it is depends on the image and on the workspace
for setup in "/opt/ros/$ROS_DISTRO/setup.bash" install/setup.bash devel/setup.bash; do
    if [ -f "$setup" ]; then source "$setup"; fi
done
exec ros-preflight "$@"

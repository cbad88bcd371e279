#!/usr/bin/env bash
# Installs rclpy of ROS 2 Kilted, or with the argument `jazzy` of Jazzy, with a middleware and a few messages, from PyPI
# alone, in out/ros2-kilted or out/ros2-jazzy, with `jazzy-messages` all common messages. Does nothing where it is there. Tests that run ROS 2 nodes call this
# themselves.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
python=${PYTHON:-python3}
distribution=${1:-kilted}
place=$root/out/ros2-$distribution
case $distribution in
  kilted) packages=(ros-rclpy==9.1.2 ros-rmw-fastrtps-cpp==9.3.3 ros-std-msgs==5.5.1 ros-std-srvs==5.5.1
    ros-geometry-msgs==5.5.1) ;;
  jazzy) packages=(ros-rclpy==7.1.6 ros-rmw-fastrtps-cpp==8.4.3 ros-std-msgs==5.3.6 ros-std-srvs==5.3.6) ;;
  jazzy-messages) packages=(ros-rclpy==7.1.6 ros-rmw-fastrtps-cpp==8.4.3 ros-common-interfaces==5.3.6) ;;
  *) echo "usage: $0 [kilted|jazzy|jazzy-messages]" >&2; exit 2 ;;
esac

mkdir -p "$root/out"
exec 9>"$place.lock"
flock 9
wanted="${packages[*]} $("$python" --version)"
[ "$(cat "$place/.ready" 2>/dev/null)" = "$wanted" ] && exit 0
rm -rf "$place"
"$python" -m venv "$place"
log=$(mktemp)
if ! "$place/bin/python" -m pip install --quiet "${packages[@]}" >"$log" 2>&1; then
  cat "$log" >&2
  rm -f "$log"
  exit 2
fi
rm -f "$log"
echo "$wanted" >"$place/.ready"

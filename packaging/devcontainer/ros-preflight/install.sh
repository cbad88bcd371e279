#!/bin/sh
# Installs ros-preflight in a virtual environment of its own; called as root while the container is built.
set -eu
# packaging/apply.py writes the next line.
DEFAULT="git+https://github.com/OWNER/ros-preflight"
SOURCE="${SOURCE:-$DEFAULT}"
FOLDER="${ROS_PREFLIGHT_FOLDER:-/opt/ros-preflight}"
LINK="${ROS_PREFLIGHT_LINK:-/usr/local/bin/ros-preflight}"

if command -v apt-get >/dev/null && ! { command -v bwrap && command -v git && python3 -c 'import ensurepip'; } >/dev/null 2>&1; then
    apt-get update
    apt-get install -y --no-install-recommends bubblewrap git python3-venv
    rm -rf /var/lib/apt/lists/*
fi
if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))'; then
    echo "ros-preflight needs Python 3.10 or newer; $(python3 --version) is installed" >&2
    exit 1
fi
python3 -m venv "$FOLDER"
"$FOLDER/bin/python" -m pip install --quiet --disable-pip-version-check "$SOURCE"
ln -sf "$FOLDER/bin/ros-preflight" "$LINK"

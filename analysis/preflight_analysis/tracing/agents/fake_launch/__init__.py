"""The interface of `launch`, `launch_ros` and `ament_index_python` without ROS: actions are remembered, not executed.

A Python launch file that imports them gets these instead (`modules.py`). What it makes is serialized as JSON
(`serialize.py`) and evaluated by the host like the actions of any other launch file. Only what depends on code of the
file itself, opaque functions and substitutions of its own, is executed here, each in a run for itself (`main.py`).
"""

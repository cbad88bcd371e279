"""Links of rule pages: what ROS itself says of a subject. Pages of this project are relative to `docs/rules/`."""

from __future__ import annotations

_DESIGN = "https://design.ros2.org/articles"
_DOCS = "https://docs.ros.org/en/rolling"
_REP = "https://www.ros.org/reps"
_WIKI = "https://wiki.ros.org"

ACTIONLIB = f"[ROS 1: actionlib]({_WIKI}/actionlib)"
ACTIONS = f"[ROS 2 design: Actions]({_DESIGN}/actions.html)"
ANNOTATIONS = "[Annotations](../annotations.md)"
ANONYMOUS_NAMES = f"[ROS 1: roslaunch XML, substitution args]({_WIKI}/roslaunch/XML#substitution_args)"
BEHAVIOR_TREES = (
    "[Nav2: Behavior-tree navigator](https://docs.nav2.org/configuration/packages/configuring-bt-navigator.html)"
)
CLOCK = f"[ROS 1: Clock]({_WIKI}/Clock)"
CLOCK_AND_TIME = f"[ROS 2 design: Clock and time]({_DESIGN}/clock_and_time.html)"
COMMAND_LINE = f"[ROS 2 design: ROS command line arguments]({_DESIGN}/ros_command_line_arguments.html)"
CMAKE_TARGETS = (
    "[CMake: Binary targets](https://cmake.org/cmake/help/latest/manual/cmake-buildsystem.7.html#binary-targets)"
)
CMAKE_VARIABLES = "[CMake: Variables](https://cmake.org/cmake/help/latest/manual/cmake-language.7.html#variables)"
COMPOSITION = f"[ROS 2: About composition]({_DOCS}/Concepts/Intermediate/About-Composition.html)"
CONTROLLER_MANAGER = (
    "[ros2_control: Controller manager]"
    "(https://control.ros.org/master/doc/ros2_control/controller_manager/doc/userdoc.html)"
)
DOMAINS = f"[ROS 2: The ROS_DOMAIN_ID]({_DOCS}/Concepts/Intermediate/About-Domain-ID.html)"
ENTRY_POINTS = "[setuptools: Entry points](https://setuptools.pypa.io/en/latest/userguide/entry_point.html)"
FILE_SYSTEM = f"[REP 122: Filesystem hierarchy layout]({_REP}/rep-0122.html)"
FORMATS = (
    f"[ROS 2: Using XML, YAML, and Python for launch files]({_DOCS}/How-To-Guides/Launch-file-different-formats.html)"
)
FRAMES = "[Frames](../frames.md)"
DEVIANT_BEHAVIOR = "[Engler et al.: inferring errors in systems code (SOSP 2001)](https://web.stanford.edu/~engler/deviant-sosp-01.pdf)"
LARGE_PROJECTS = (
    f"[ROS 2: Managing large projects]({_DOCS}/Tutorials/Intermediate/Launch/Using-ROS2-Launch-For-Large-Projects.html)"
)
LAUNCH_DESIGN = f"[ROS 2 design: launch]({_DESIGN}/roslaunch.html)"
LAUNCH_XML_DESIGN = f"[ROS 2 design: XML format of launch]({_DESIGN}/roslaunch_xml.html)"
LIFECYCLE = f"[ROS 2 design: Managed nodes]({_DESIGN}/node_lifecycle.html)"
LIFECYCLE_MANAGER = "[Nav2: Lifecycle manager](https://docs.nav2.org/configuration/packages/configuring-lifecycle.html)"
MANIFEST_2 = f"[REP 140: Package manifest format 2]({_REP}/rep-0140.html)"
MANIFEST_3 = f"[REP 149: Package manifest format 3]({_REP}/rep-0149.html)"
MASTER = f"[ROS 1: Master]({_WIKI}/Master)"
MIDDLEWARE = (
    "[ROS 2: Working with multiple RMW implementations]"
    f"({_DOCS}/How-To-Guides/"
    "Working-with-multiple-RMW-implementations.html)"
)
MIGRATING_LAUNCH = (
    f"[ROS 2: Migrating launch files]({_DOCS}/How-To-Guides/Migrating-from-ROS1/Migrating-Launch-Files.html)"
)
MOVEIT_CONTROLLERS = (
    "[MoveIt: Low level controllers]"
    "(https://moveit.picknik.ai/main/doc/examples/controller_configuration/controller_configuration_tutorial.html)"
)
MOVEIT_CPP_INTERFACE = (
    "[MoveIt: Move Group C++ interface]"
    "(https://moveit.picknik.ai/main/doc/examples/move_group_interface/move_group_interface_tutorial.html)"
)
MOVEIT_KINEMATICS = (
    "[MoveIt: Kinematics configuration]"
    "(https://moveit.picknik.ai/main/doc/examples/kinematics_configuration/kinematics_configuration_tutorial.html)"
)
MOVEIT_SRDF = "[MoveIt: URDF and SRDF](https://moveit.picknik.ai/main/doc/examples/urdf_srdf/urdf_srdf_tutorial.html)"
NAMES = f"[ROS 1: Names]({_WIKI}/Names)"
NAV2 = "[Nav2: Configuration guide](https://docs.nav2.org/configuration/index.html)"
NODELET = f"[ROS 1: nodelet]({_WIKI}/nodelet)"
NODES = f"[ROS 1: Nodes]({_WIKI}/Nodes)"
NODE_ARGUMENTS = f"[ROS 2: Passing ROS arguments to nodes]({_DOCS}/How-To-Guides/Node-arguments.html)"
OUR_SETTINGS = "[Settings](../settings.md)"
PACKAGE_NAMES = f"[REP 144: ROS package naming]({_REP}/rep-0144.html)"
PARAMETERS = f"[ROS 2: About parameters]({_DOCS}/Concepts/Basic/About-Parameters.html)"
PARAMETERS_DESIGN = f"[ROS 2 design: Parameters]({_DESIGN}/ros_parameters.html)"
PARAMETER_SERVER = f"[ROS 1: Parameter server]({_WIKI}/Parameter%20Server)"
PLUGINLIB = f"[ROS 1: pluginlib]({_WIKI}/pluginlib)"
PLUGINS = f"[ROS 2: Creating and using plugins]({_DOCS}/Tutorials/Beginner-Client-Libraries/Pluginlib.html)"
PYTHON_PACKAGES = f"[ROS 2: Developing a ROS 2 package]({_DOCS}/How-To-Guides/Developing-a-ROS-2-Package.html)"
QOS = (
    f"[ROS 2: About quality of service settings]({_DOCS}/Concepts/Intermediate/About-Quality-of-Service-Settings.html)"
)
QOS_DESIGN = f"[ROS 2 design: Deadline, liveliness and lifespan]({_DESIGN}/qos_deadline_liveliness_lifespan.html)"
REMAPPING = f"[ROS 1: Remapping arguments]({_WIKI}/Remapping%20Arguments)"
REMAPPING_DESIGN = f"[ROS 2 design: Remapping names]({_DESIGN}/static_remapping.html)"
ROSBAG = f"[ROS 1: rosbag command line]({_WIKI}/rosbag/Commandline)"
ROSBAG2 = (
    "[ROS 2: Recording and playing back data]"
    f"({_DOCS}/Tutorials/Beginner-CLI-Tools/Recording-And-Playing-Back-Data/"
    "Recording-And-Playing-Back-Data.html)"
)
ROSDEP = f"[ROS 2: Managing dependencies with rosdep]({_DOCS}/Tutorials/Intermediate/Rosdep.html)"
ROSLAUNCH = f"[ROS 1: roslaunch XML]({_WIKI}/roslaunch/XML)"
ROSLAUNCH_ARG = f"[ROS 1: roslaunch XML, <arg>]({_WIKI}/roslaunch/XML/arg)"
ROSLAUNCH_ARCHITECTURE = f"[ROS 1: roslaunch architecture]({_WIKI}/roslaunch/Architecture)"
ROSLAUNCH_GROUP = f"[ROS 1: roslaunch XML, <group>]({_WIKI}/roslaunch/XML/group)"
ROSLAUNCH_INCLUDE = f"[ROS 1: roslaunch XML, <include>]({_WIKI}/roslaunch/XML/include)"
ROSLAUNCH_MACHINE = f"[ROS 1: roslaunch XML, <machine>]({_WIKI}/roslaunch/XML/machine)"
ROSLAUNCH_NODE = f"[ROS 1: roslaunch XML, <node>]({_WIKI}/roslaunch/XML/node)"
ROSLAUNCH_PARAM = f"[ROS 1: roslaunch XML, <param>]({_WIKI}/roslaunch/XML/param)"
ROSLAUNCH_REMAP = f"[ROS 1: roslaunch XML, <remap>]({_WIKI}/roslaunch/XML/remap)"
ROSLAUNCH_ROSPARAM = f"[ROS 1: roslaunch XML, <rosparam>]({_WIKI}/roslaunch/XML/rosparam)"
SECURITY = "[Security](../security.md)"
SERVICES = f"[ROS 1: Services]({_WIKI}/Services)"
SERVICES_2 = f"[ROS 2: About services]({_DOCS}/Concepts/Basic/About-Services.html)"
LAUNCH_SUBSTITUTIONS = f"[ROS 2: Using substitutions]({_DOCS}/Tutorials/Intermediate/Launch/Using-Substitutions.html)"
SETUP_CFG = (
    "[setuptools 78.0.2: dash-separated fields in setup.cfg](https://setuptools.pypa.io/en/latest/history.html#v78-0-2)"
)
TF2 = f"[ROS 2: tf2]({_DOCS}/Concepts/Intermediate/About-Tf2.html)"
TOPICS = f"[ROS 1: Topics]({_WIKI}/Topics)"
TOPICS_2 = f"[ROS 2: About topics]({_DOCS}/Concepts/Basic/About-Topics.html)"
TOPIC_NAMES = f"[ROS 2 design: Topic and service name mapping]({_DESIGN}/topic_and_service_names.html)"
ROS_CONTROL_GAZEBO = "[Gazebo: ros_control](https://classic.gazebosim.org/tutorials?tut=ros_control)"
ROS_GZ_BRIDGE = "[ros_gz_bridge](https://docs.ros.org/en/jazzy/p/ros_gz_bridge/)"
ROS2_CONTROL_GAZEBO = "[gazebo_ros2_control](https://control.ros.org/humble/doc/gazebo_ros2_control/doc/index.html)"
ROS2_CONTROLLERS = "[ros2_controllers](https://control.ros.org/master/doc/ros2_controllers/doc/controllers_index.html)"
ROS2_CONTROL_URDF = (
    "[ros2_control: URDF](https://control.ros.org/master/doc/ros2_control/hardware_interface/doc/"
    "hardware_components_userdoc.html)"
)
URDF = f"[ROS: URDF]({_WIKI}/urdf/XML/model)"
URDF_GAZEBO = "[Gazebo: URDF in Gazebo](https://classic.gazebosim.org/tutorials?tut=ros_urdf)"
URDF_JOINT = f"[ROS: URDF, <joint>]({_WIKI}/urdf/XML/joint)"
URDF_LINK = f"[ROS: URDF, <link>]({_WIKI}/urdf/XML/link)"
RUNS = "[What a run shows of a node](../tracing.md)"
XACRO = f"[ROS 1: xacro]({_WIKI}/xacro)"
XML_STANDARD = "[XML 1.0](https://www.w3.org/TR/xml/)"
YAML_STANDARD = "[YAML 1.1](https://yaml.org/spec/1.1/)"

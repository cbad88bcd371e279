"""What rclcpp nodes do, read from their source."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.tracing.interface import NOT_RUN, Interface, Range
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

MANIFEST = "<package><name>p</name><export><build_type>ament_cmake</build_type></export></package>"
CMAKE = "project(p)\nadd_executable(t src/t.cpp)\n"
HEAD = """#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"
"""
NODE = '<node pkg="p" exec="t" name="n">{inner}</node>'
Ends = list[tuple[str, str, str | None]]


class Harness:
    """A workspace that was never built, with one package."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.write("package.xml", MANIFEST)
        self.write("CMakeLists.txt", CMAKE)

    def write(self, name: str, text: str) -> None:
        path = self.folder / "src/p" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))

    def start(self, launch: str) -> tuple[Interface, list[Finding]]:
        self.write("main.launch.xml", f"<launch>{launch}</launch>")
        environment = detect_environment(str(self.folder), {}, root=str(self.folder / "nothing"))
        workspace = Workspace(environment, Sources())
        analysis = workspace.static(str(self.folder / "src/p/main.launch.xml"))
        done = workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), "not run here")
        assert done.graph is not None
        return done.graph.interfaces[-1], list(done.findings)

    def read(self, text: str, inner: str = "", node: str = NODE) -> Interface:
        self.write("src/t.cpp", HEAD + textwrap.dedent(text))
        return self.start(node.format(inner=inner))[0]

    def main(self, body: str, inner: str = "", before: str = "") -> Interface:
        start = "int main(int argc, char ** argv) {\nrclcpp::init(argc, argv);\n"
        made = 'auto node = rclcpp::Node::make_shared("t");\n'
        return self.read(f"{before}\n{start}{made}{textwrap.dedent(body)}\nrclcpp::spin(node);\n}}\n", inner)


def ends(found: Interface) -> Ends:
    return [(e.role, e.name, e.type) for e in found.endpoints if not e.builtin]


def params(found: Interface) -> dict[str, Any]:
    return {use.name: use.default for use in found.params}


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def test_headers_lie_where_the_build_says(harness: Harness) -> None:
    harness.write("CMakeLists.txt", f"{CMAKE}target_include_directories(t PRIVATE src/parts/headers)\n")
    harness.write(
        "src/parts/headers/part.hpp",
        "struct Part { std::shared_ptr<rclcpp::Node> node; rclcpp::Publisher<std_msgs::msg::String>::SharedPtr out; };",
    )
    found = harness.main(
        """
        Part part{node};
        part.out = part.node->create_publisher<std_msgs::msg::String>("out", 1);
        """,
        before='#include "part.hpp"',
    )
    assert ends(found) == [("publisher", "out", "std_msgs/msg/String")]


CLASS = """
#include "rclcpp_action/rclcpp_action.hpp"
#include "nav2_msgs/action/navigate_to_pose.hpp"
#include "sensor_msgs/msg/laser_scan.hpp"
#include "std_srvs/srv/empty.hpp"
using std::placeholders::_1;
namespace p {
class Driver : public rclcpp::Node {
public:
  using Navigate = nav2_msgs::action::NavigateToPose;
  explicit Driver(const rclcpp::NodeOptions & options = rclcpp::NodeOptions()) : Node("driver", options) {
    this->declare_parameter("cmd_topic", "cmd_vel");
    declare_parameter<double>("limits.speed", 2);
    auto enabled = declare_parameter<bool>("service", true);
    std::string topic = this->get_parameter("cmd_topic").as_string();
    auto latched = rclcpp::QoS(1);
    latched.transient_local();
    maps_ = create_publisher<std_msgs::msg::String>("map", latched);
    scans_ = this->create_subscription<sensor_msgs::msg::LaserScan>(
      "scan", rclcpp::SensorDataQoS(), std::bind(&Driver::heard, this, _1));
    commands_ = create_subscription<std_msgs::msg::String>(topic, 10, [this](std_msgs::msg::String::SharedPtr) {});
    server_ = rclcpp_action::create_server<Navigate>(this, "navigate", nullptr, nullptr, nullptr);
    if (enabled) {
      service_ = create_service<std_srvs::srv::Empty>("~/reset", nullptr);
    }
  }
private:
  void heard(const sensor_msgs::msg::LaserScan & scan) {
    client_ = create_client<std_srvs::srv::Empty>("/global/reset");
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr maps_;
};
}
"""
MAIN = "int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<p::Driver>()); }\n"
DRIVER = [
    ("publisher", "map", "std_msgs/msg/String"),
    ("subscriber", "scan", "sensor_msgs/msg/LaserScan"),
    ("subscriber", "cmd_vel", "std_msgs/msg/String"),
    ("action_server", "navigate", "nav2_msgs/action/NavigateToPose"),
    ("service", "~/reset", "std_srvs/srv/Empty"),
    ("client", "/global/reset", "std_srvs/srv/Empty"),
]


def test_a_node_of_a_class_of_its_own(harness: Harness) -> None:
    found = harness.read(CLASS + MAIN)
    assert found.source == "source"
    assert ends(found) == DRIVER
    assert all(e.evidence.inferred for e in found.endpoints)
    assert params(found) == {"~cmd_topic": "cmd_vel", "~limits.speed": 2.0, "~service": True}
    assert {e.name: dict(e.qos) for e in found.endpoints if e.qos} == {
        "map": {"reliability": "reliable", "durability": "transient_local", "depth": 1},
        "scan": {"reliability": "best_effort", "durability": "volatile", "depth": 5},
        "cmd_vel": {"reliability": "reliable", "durability": "volatile", "depth": 10},
    }
    line = next(e.source_line for e in found.endpoints if e.name == "map")
    assert (HEAD + CLASS).splitlines()[(line or 0) - 1].strip().startswith("maps_ =")


def test_a_base_class_that_a_macro_names(harness: Harness) -> None:
    chosen = "#if PLAIN\n#define FATHER rclcpp::Node\n#else\n#define FATHER rclcpp_lifecycle::LifecycleNode\n#endif\n"
    assert ends(harness.read(chosen + CLASS.replace("public rclcpp::Node", "public FATHER") + MAIN)) == DRIVER


def test_what_the_launch_file_sets_decides(harness: Harness) -> None:
    found = harness.read(CLASS + MAIN, '<param name="service" value="false"/><param name="cmd_topic" value="drive"/>')
    names = [e.name for e in found.endpoints]
    assert "drive" in names and "cmd_vel" not in names and "~/reset" not in names


COMPONENT = """<node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">
<composable_node pkg="p" plugin="{plugin}" name="driver"/></node_container>"""
REGISTER = "#include <rclcpp_components/register_node_macro.hpp>\nRCLCPP_COMPONENTS_REGISTER_NODE(p::Driver)\n"
LIBRARY = """project(p)
add_library(driver SHARED src/t.cpp)
rclcpp_components_register_node(driver PLUGIN "${PROJECT_NAME}::Driver" EXECUTABLE t)
"""


def test_a_component(harness: Harness) -> None:
    harness.write("CMakeLists.txt", LIBRARY)
    assert ends(harness.read(CLASS + REGISTER, node=COMPONENT.format(plugin="p::Driver"))) == DRIVER


def test_the_executable_of_a_component(harness: Harness) -> None:
    harness.write("CMakeLists.txt", LIBRARY)
    assert ends(harness.read(CLASS + REGISTER)) == DRIVER
    _, findings = harness.start(NODE.format(inner=""))
    assert [(f.rule, f.severity) for f in findings if f.rule == "PKG002"] == [("PKG002", "hint")]


def test_a_component_that_only_its_source_tells_of(harness: Harness) -> None:
    harness.write("CMakeLists.txt", "project(p)\nadd_library(driver SHARED src/t.cpp)\nour_macro(driver)\n")
    assert ends(harness.read(CLASS + REGISTER, node=COMPONENT.format(plugin="p::Driver"))) == DRIVER


def test_a_component_that_is_registered_within_its_namespace(harness: Harness) -> None:
    harness.write("CMakeLists.txt", LIBRARY.replace("${PROJECT_NAME}::Driver", "Driver"))
    within = CLASS + "namespace p {\nRCLCPP_COMPONENTS_REGISTER_NODE(Driver)\n}\n"
    assert ends(harness.read(within)) == DRIVER
    assert ends(harness.read(within, node=COMPONENT.format(plugin="Driver"))) == DRIVER


def test_targets_made_by_a_function_with_keywords(harness: Harness) -> None:
    harness.write(
        "CMakeLists.txt",
        """
        function(our_library plugin executable)
          cmake_parse_arguments(ARG "" "" "FILES;DEPENDENCIES" ${ARGN})
          set(library ${executable}_library)
          add_library(${library} SHARED ${ARG_FILES})
          rclcpp_components_register_node(${library} PLUGIN ${plugin} EXECUTABLE ${executable})
        endfunction()
        our_library("p::Driver" t FILES src/t.cpp DEPENDENCIES rclcpp::rclcpp)
        """,
    )
    assert ends(harness.read(CLASS + REGISTER)) == DRIVER


def test_targets_made_of_a_folder(harness: Harness) -> None:
    harness.write(
        "CMakeLists.txt",
        """
        project(p)
        ament_auto_add_library(driver SHARED DIRECTORY src)
        rclcpp_components_register_node(driver PLUGIN "p::Driver" EXECUTABLE t)
        """,
    )
    assert ends(harness.read(CLASS + REGISTER)) == DRIVER


def test_a_base_class_of_another_package(harness: Harness) -> None:
    base = """
        #pragma once
        namespace project::filters {
        class Filter : public rclcpp::Node {
        public:
          explicit Filter(const std::string & name, const rclcpp::NodeOptions & options);
        };
        }
        """
    made = """
        #include "project/filters/filter.hpp"
        project::filters::Filter::Filter(const std::string & name, const rclcpp::NodeOptions & options)
        : Node(name, options) { pub_ = create_publisher<std_msgs::msg::String>("output", 1); }
        """
    harness.write("../project_filters/package.xml", MANIFEST.replace("<name>p<", "<name>project_filters<"))
    harness.write("../project_filters/CMakeLists.txt", "add_library(filters src/filter.cpp)\n")
    harness.write("../project_filters/include/project/filters/filter.hpp", base)
    harness.write("../project_filters/src/filter.cpp", made)
    found = harness.main(
        'auto n = std::make_shared<Crop>("crop", rclcpp::NodeOptions());',
        before="""
        #include "project/filters/filter.hpp"
        class Crop : public project::filters::Filter { public: using Filter::Filter;
          Crop(const std::string & n, const rclcpp::NodeOptions & o) : Filter(n, o) { declare_parameter("size", 1.0); }
        };
        """,
    )
    assert [e.name for e in found.endpoints] == ["output"]
    assert params(found) == {"~size": 1.0}


@pytest.mark.parametrize(
    ("used", "cls"),
    [
        ("using robot::sensors::Driver;", "Driver"),
        ("namespace rs = robot::sensors;", "rs::Driver"),
        ("using namespace robot::sensors;", "Driver"),
        ("", "robot::sensors::Driver"),
    ],
)
def test_members_are_defined_by_a_shorter_name_of_their_class(harness: Harness, used: str, cls: str) -> None:
    before = f"""
        namespace robot {{ namespace sensors {{
        class Driver : public rclcpp::Node {{ public: Driver(); void more(); }};
        }} }}
        {used}
        {cls}::Driver() : rclcpp::Node("driver") {{ more(); }}
        void {cls}::more() {{ create_publisher<std_msgs::msg::String>("state", 1); }}
        """
    found = harness.main("auto driver = std::make_shared<robot::sensors::Driver>();", before=before)
    assert [e.name for e in found.endpoints] == ["state"]


def test_a_base_class_that_is_not_there(harness: Harness) -> None:
    before = """
        class Driver : public vendor::DriverNode {
        public:
          Driver() : DriverNode("driver") {
            pub_ = create_publisher<std_msgs::msg::String>("state", 1);
            declare_parameter("rate", 1.0);
          }
        };
        """
    found = harness.main("auto driver = std::make_shared<Driver>();", before=before)
    assert [e.name for e in found.endpoints] == ["state"]
    assert [use.name for use in found.params] == ["/", "~rate"]


def test_what_a_class_has_in_the_place_of_a_method_of_rclcpp(harness: Harness) -> None:
    before = """
        class Base : public rclcpp::Node {
        public:
          explicit Base(const std::string & name) : Node(name) {}
          template<typename T> auto create_publisher(const std::string & topic) {
            if (!has_parameter("introspection")) { declare_parameter("introspection", false); }
            return rclcpp::create_publisher<T>(*this, topic, rclcpp::QoS(10));
          }
        };
        class Driver : public Base {
        public:
          Driver() : Base("driver") {
            pub_ = create_publisher<std_msgs::msg::String>("state");
          }
        };
        """
    found = harness.main("auto driver = std::make_shared<Driver>();", before=before)
    assert ends(found) == [("publisher", "state", "std_msgs/msg/String")]
    assert params(found) == {"~introspection": False}
    text = (harness.folder / "src/p/src/t.cpp").read_text().splitlines()
    assert '("state")' in text[(found.endpoints[0].source_line or 0) - 1]


def test_the_type_of_an_action_is_as_ros_2_has_it(harness: Harness) -> None:
    harness.write("CMakeLists.txt", CMAKE)
    harness.read(CLASS + MAIN)
    environment = detect_environment(str(harness.folder), {}, root=str(harness.folder / "nothing"))
    workspace = Workspace(environment, Sources())
    analysis = workspace.static(str(harness.folder / "src/p/main.launch.xml"))
    graph = workspace.with_interfaces(analysis, [NOT_RUN], "not run here").graph
    assert graph is not None
    providers = [offer.endpoint.type for offer in graph.actions["/navigate"].providers]
    assert providers == ["nav2_msgs/action/NavigateToPose"]


def test_parameters_of_a_mode_that_is_off_are_declared_by_name(harness: Harness) -> None:
    body = """
        if (node->declare_parameter("filter", false)) {
          node->declare_parameter("width", 1.5);
          auto filtered = node->create_publisher<std_msgs::msg::String>("filtered", 1);
        } else {
          node->declare_parameter("rate", 2.0);
        }
        if (!node->get_parameter("filter").as_bool()) { rclcpp::spin(node); return 0; }
        node->declare_parameter("rate", 7);
        node->declare_parameter("height", 0.5);
        auto late = node->create_publisher<std_msgs::msg::String>("late", 1);
        """
    found = harness.main(body)
    assert params(found) == {"~filter": False, "~rate": 2.0, "~width": 1.5, "~height": 0.5}
    assert ends(found) == []
    on = harness.main(body, '<param name="filter" value="true"/>')
    assert params(on) == {"~filter": False, "~rate": 7, "~width": 1.5, "~height": 0.5}
    assert [e.name for e in on.endpoints] == ["filtered", "late"]


def test_parameters_after_two_ways_out(harness: Harness) -> None:
    body = """
        if (!node->declare_parameter("first", false)) { throw std::runtime_error("first"); }
        if (!node->declare_parameter("second", false)) { throw std::runtime_error("second"); }
        if (node->declare_parameter("third", true)) { node->declare_parameter("a", 1.0); }
        else { node->declare_parameter("b", 1.0); }
        """
    assert list(params(harness.main(body))) == ["~first", "~second", "~third", "~a", "~b"]


LIFECYCLE = """
#include "rclcpp_lifecycle/lifecycle_node.hpp"
class Talker : public rclcpp_lifecycle::LifecycleNode {
public:
  Talker() : rclcpp_lifecycle::LifecycleNode("talker") {}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {
    auto node = shared_from_this();
    pub_ = node->create_publisher<std_msgs::msg::String>(topic(), rclcpp::QoS(rclcpp::KeepLast(3)).best_effort());
    return CallbackReturn::SUCCESS;
  }
private:
  std::string topic() { return prefix_ + "/chatter"; }
  std::string prefix_{"robot"};
};
int main(int, char **) { auto node = std::make_shared<Talker>(); rclcpp::spin(node->get_node_base_interface()); }
"""


def test_what_a_lifecycle_node_makes_once_it_is_configured(harness: Harness) -> None:
    found = harness.read(LIFECYCLE)
    assert ends(found) == [("publisher", "robot/chatter", "std_msgs/msg/String")]
    (publisher,) = (e for e in found.endpoints if e.role == "publisher")
    assert publisher.qos == {"reliability": "best_effort", "durability": "volatile", "depth": 3}
    assert [e.type for e in found.endpoints if e.name == "~/change_state"] == ["lifecycle_msgs/srv/ChangeState"]


CONFIGURED = """
#include "rclcpp_lifecycle/lifecycle_node.hpp"
class Talker : public rclcpp_lifecycle::LifecycleNode {
public:
  Talker() : rclcpp_lifecycle::LifecycleNode("talker"), qos_(10) {}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {
    try {
      this->declare_parameter<std::string>("durability", "transient_local");
      const std::string durability = this->get_parameter("durability").as_string();
      qos_ = profile(durability);
      return CallbackReturn::SUCCESS;
    } catch (const std::exception &) {
      return CallbackReturn::FAILURE;
    }
  }
  CallbackReturn on_activate(const rclcpp_lifecycle::State &) override {
    try {
      pub_ = this->create_publisher<std_msgs::msg::String>("chatter", qos_);
      return CallbackReturn::SUCCESS;
    } catch (const std::exception &) {
      return CallbackReturn::FAILURE;
    }
  }
private:
  rclcpp::QoS profile(const std::string & durability) {
    rclcpp::QoS qos(7);
    if (durability == "transient_local") {
      qos.durability(RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
    } else {
      qos.durability(RMW_QOS_POLICY_DURABILITY_VOLATILE);
    }
    return qos;
  }
  rclcpp::QoS qos_;
};
int main(int, char **) { auto node = std::make_shared<Talker>(); rclcpp::spin(node->get_node_base_interface()); }
"""


def test_a_profile_that_an_earlier_transition_makes(harness: Harness) -> None:
    (publisher,) = (e for e in harness.read(CONFIGURED).endpoints if e.name == "chatter")
    assert publisher.qos == {"reliability": "reliable", "durability": "transient_local", "depth": 7}


@pytest.mark.parametrize(
    ("qos", "expected"),
    [
        ("rclcpp::SystemDefaultsQoS()", {}),
        ("rclcpp::QoS(4).reliable()", {"reliability": "reliable", "durability": "volatile", "depth": 4}),
        ("computed()", {}),
        (
            "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data))",
            {"reliability": "best_effort", "durability": "volatile", "depth": 5},
        ),
        (
            "rclcpp::QoS(2).reliability(rclcpp::ReliabilityPolicy::BestEffort)",
            {"reliability": "best_effort", "durability": "volatile", "depth": 2},
        ),
    ],
)
def test_qos(harness: Harness, qos: str, expected: dict[str, Any]) -> None:
    found = harness.main(f'auto pub = node->create_publisher<std_msgs::msg::String>("a", {qos});')
    assert dict(found.endpoints[0].qos) == expected


def test_qos_that_depends_on_what_is_not_known(harness: Harness) -> None:
    body = """
        rclcpp::QoS qos(5);
        if (std::getenv("LATCH")) { qos.transient_local(); }
        auto pub = node->create_publisher<std_msgs::msg::String>("a", qos);
        """
    assert dict(harness.main(body).endpoints[0].qos) == {}


def test_libraries_that_get_the_node(harness: Harness) -> None:
    body = """
        tf2_ros::TransformBroadcaster broadcaster(node);
        message_filters::Subscriber<sensor_msgs::msg::Image> filtered(node.get(), "left", rmw_qos_profile_sensor_data);
        auto it = image_transport::ImageTransport(node);
        auto camera = image_transport::create_camera_subscription(node.get(), "cam/image", cb, "raw");
        auto action = rclcpp_action::create_client<example::action::Fly>(node, "fly");
        """
    assert ends(harness.main(body)) == [
        ("publisher", "/tf", "tf2_msgs/msg/TFMessage"),
        ("subscriber", "left", "sensor_msgs/msg/Image"),
        ("subscriber", "cam/image", "sensor_msgs/msg/Image"),
        ("subscriber", "cam/camera_info", "sensor_msgs/msg/CameraInfo"),
        ("action_client", "fly", "example/action/Fly"),
    ]


def test_ways_to_declare_parameters(harness: Harness) -> None:
    body = """
        double rate = 10;
        int size;
        node->declare_parameter("rate", rate);
        node->declare_parameter("size", 3);
        node->get_parameter("size", size);
        node->declare_parameter<std::string>("frame");
        node->declare_parameter("gain", rclcpp::ParameterValue(1.5));
        node->declare_parameter("list", std::vector<double>({1, 2}));
        node->declare_parameter("typed", rclcpp::PARAMETER_DOUBLE);
        node->declare_parameters<double>("pid", {{"p", 1}, {"i", 0.5}});
        nav2_util::declare_parameter_if_not_declared(node, "tolerance", rclcpp::ParameterValue(0.2));
        auto pub = node->create_publisher<std_msgs::msg::String>("a" + std::to_string(size), 1);
        """
    found = harness.main(body, '<param name="size" value="7"/>')
    assert params(found) == {
        "~rate": 10.0,
        "~size": 3,
        "~frame": None,
        "~gain": 1.5,
        "~list": [1.0, 2.0],
        "~typed": None,
        "~pid.p": 1.0,
        "~pid.i": 0.5,
        "~tolerance": 0.2,
    }
    assert [use.name for use in found.params if not use.has_default] == ["~frame", "~typed"]
    assert [use.name for use in found.params if use.mandatory] == ["~frame"]
    assert found.endpoints[0].name == "a7"


@pytest.mark.parametrize(
    "body",
    [
        "node->declare_parameter(name_of(1), 3);",
        "other_library::Helper helper(node);",
        'rclcpp::NodeOptions o; o.allow_undeclared_parameters(true); auto n = std::make_shared<rclcpp::Node>("m", o);',
        'pluginlib::ClassLoader<nav2_core::Controller> loader("nav2_core", "nav2_core::Controller");',
    ],
)
def test_nothing_is_undeclared_where_not_all_is_known(harness: Harness, body: str) -> None:
    found = harness.main('node->declare_parameter("a", 1);\n' + body, '<param name="zzz" value="7"/>')
    assert ("list", "/") in [(use.access, use.name) for use in found.params]
    assert not [f for f in harness.start(NODE.format(inner='<param name="zzz" value="7"/>'))[1] if f.rule == "PRM013"]


def test_the_type_of_a_declaration_decides_over_its_default(harness: Harness) -> None:
    body = """
        node->declare_parameter<bool>("avoid", 0);
        node->declare_parameter<int>("count", true);
        """
    found = params(harness.main(body))
    assert found == {"~avoid": False, "~count": 1}
    assert [type(value) for value in found.values()] == [bool, int]


def test_a_parameter_that_is_not_declared(harness: Harness) -> None:
    inner = '<param name="max_presure" value="4.5"/>'
    found = harness.main('node->declare_parameter("max_pressure", 1.0);', inner)
    assert params(found) == {"~max_pressure": 1.0}
    findings = [f for f in harness.start(NODE.format(inner=inner))[1] if f.rule == "PRM013"]
    assert ["did you mean 'max_pressure'?" in f.message for f in findings] == [True]


def test_what_a_function_does_without_is_not_mandatory(harness: Harness) -> None:
    before = 'void start(rclcpp::Node::SharedPtr node) { node->declare_parameter<int>("of_another"); }'
    body = """
        try { node->declare_parameter<int>("optional"); } catch (const std::exception &) { /* it has a default */ }
        try { node->declare_parameter<int>("needed"); } catch (const std::exception &) { return 1; }
        try { start(node); } catch (const std::exception & error) { RCLCPP_ERROR(node->get_logger(), "failed"); }
        node->declare_parameter<int>("after");
        """
    found = harness.main(body, before=before)
    assert [use.name for use in found.params if use.mandatory] == ["~needed", "~of_another", "~after"]


def test_a_second_node_with_arguments_of_its_own(harness: Harness) -> None:
    body = """
        auto options = rclcpp::NodeOptions().arguments({"--ros-args", "-r", "__ns:=/maps", "-r", "__node:=local"});
        auto other = std::make_shared<rclcpp::Node>("other", options);
        auto a = other->create_publisher<std_msgs::msg::String>("grid", 1);
        auto b = other->create_publisher<std_msgs::msg::String>("~/info", 1);
        """
    assert [e.name for e in harness.main(body).endpoints] == ["/maps/grid", "/maps/local/info"]


def test_a_second_node_with_the_options_of_the_first(harness: Harness) -> None:
    harness.write(
        "CMakeLists.txt", 'project(p)\nadd_library(m src/t.cpp)\nrclcpp_components_register_nodes(m "p::Map")\n'
    )
    found = harness.read(
        """
        namespace nav2 {
        template<typename T> T declare_or_get_parameter(rclcpp::Node * node, const std::string & name, const T & value);
        class Node : public rclcpp::Node {
        public:
          Node(const std::string & name, const std::string & ns, const rclcpp::NodeOptions & options)
          : rclcpp::Node(name, ns, options) {}
          template<typename T> T declare_or_get_parameter(const std::string & name, const T & value) {
            return nav2::declare_or_get_parameter(this, name, value);
          }
        };
        }
        namespace p {
        rclcpp::NodeOptions options_of_child(const std::string & name, const rclcpp::NodeOptions & parent) {
          std::vector<std::string> arguments = parent.arguments();
          nav2::replaceOrAddArgument(arguments, "-r", "__ns", "__ns:=/" + name);
          nav2::replaceOrAddArgument(arguments, "-r", "__node", name + ":" + "__node:=" + name);
          return rclcpp::NodeOptions().use_intra_process_comms(true).arguments(arguments);
        }
        class Layer;
        class Clear {
        public:
          explicit Clear(Layer & layer) : layer_(layer) {}
          Layer & layer_;
        };
        class Layer : public nav2::Node {
        public:
          explicit Layer(const rclcpp::NodeOptions & options) : nav2::Node("layer", "", options) {
            declare_parameter("made_again", 1);
          }
          Layer(const std::string & name, const rclcpp::NodeOptions & options)
          : nav2::Node(name, "", options_of_child(name, options)) {
            frame_ = declare_or_get_parameter("global_frame", std::string("map"));
            pub_ = create_publisher<std_msgs::msg::String>("costmap", 1);
          }
        };
        class Map : public nav2::Node {
        public:
          explicit Map(const rclcpp::NodeOptions & options) : nav2::Node("map", "", options) {
            layer_ = std::make_shared<Layer>("local", options);
            clear_ = std::make_unique<Clear>(*layer_);
            this->declare_or_get_parameter("rate", 2.0);
          }
        };
        }
        """,
        node='<node_container pkg="rclcpp_components" exec="component_container" name="c" namespace="">'
        '<composable_node pkg="p" plugin="p::Map" name="m"/></node_container>',
    )
    assert [e.name for e in found.endpoints if not e.builtin] == ["/local/costmap"]
    assert {(use.name, use.default) for use in found.params} == {("/local/local/global_frame", "map"), ("~rate", 2.0)}


def test_a_base_of_the_same_name_in_another_namespace(harness: Harness) -> None:
    before = """
        namespace ours {
        class Node : public rclcpp::Node {
        public:
          Node(const std::string & name, const std::string & topic) : rclcpp::Node(name), topic_(topic) {
            pub_ = create_publisher<std_msgs::msg::String>(topic_, 1);
          }
          explicit Node(const std::string & name) : Node(name, "default") {}
          std::string topic_;
        };
        }
        """
    found = harness.main('auto ours = std::make_shared<ours::Node>("x");', before=before)
    assert [e.name for e in found.endpoints] == ["default"]


LIBRARY_YAML = """\
battery:
  rate: {type: double, default_value: 10, validation: {bounds<>: [0.1, 20.0]}}
  topics:
    state:
      type: string
      default_value: "state"
  gains:
    type: double_array
    default_value: [1, 0.5]
  device:
    type: string
    read_only: true
"""
LISTENING = """
#include "p/battery_parameters.hpp"
class Battery : public rclcpp::Node {
public:
  Battery() : Node("battery") {
    listener_ = std::make_shared<battery::ParamListener>(get_node_parameters_interface());
    params_ = listener_->get_params();
    pub_ = create_publisher<std_msgs::msg::String>(params_.topics.state, 1);
  }
private:
  std::shared_ptr<battery::ParamListener> listener_;
  battery::Params params_;
};
int main() { rclcpp::spin(std::make_shared<Battery>()); }
"""


def test_parameters_of_a_generated_library(harness: Harness) -> None:
    harness.write("CMakeLists.txt", CMAKE + "generate_parameter_library(battery_parameters src/battery.yaml)\n")
    harness.write("src/battery.yaml", LIBRARY_YAML)
    found = harness.read(LISTENING, '<param name="topics.state" value="front"/>')
    assert params(found) == {"~rate": 10.0, "~topics.state": "state", "~gains": [1.0, 0.5], "~device": None}
    assert ends(found) == [("publisher", "front", "std_msgs/msg/String")]
    about = {use.name: (use.type, use.read_only, use.range) for use in found.params}
    assert about == {
        "~rate": ("double", False, Range(0.1, 20.0)),
        "~topics.state": ("string", False, None),
        "~gains": ("double array", False, None),
        "~device": ("string", True, None),
    }
    rows = LIBRARY_YAML.splitlines()
    lines = {use.name: rows[(use.source_line or 0) - 1].split(":")[0].strip() for use in found.params}
    assert lines == {"~rate": "rate", "~topics.state": "state", "~gains": "gains", "~device": "device"}


def test_a_generated_library_reads_what_was_declared_from_overrides_as_its_own_type(harness: Harness) -> None:
    """What it generates reads each parameter as the type of its file at once, which throws at any other."""
    harness.write("CMakeLists.txt", CMAKE + "generate_parameter_library(battery_parameters src/battery.yaml)\n")
    harness.write("src/battery.yaml", LIBRARY_YAML)
    options = "rclcpp::NodeOptions().automatically_declare_parameters_from_overrides(true)"
    more = 'if (!has_parameter("more")) { declare_parameter("more", 1.0); }'
    own = LISTENING.replace('Node("battery") {', f'Node("battery", {options}) {{ {more}')
    dynamic = {use.name: use.dynamic for use in harness.read(own).params if use.access == "get"}
    assert dynamic == {"~rate": False, "~topics.state": False, "~gains": False, "~device": False, "~more": True}


@pytest.mark.parametrize(
    "text", ["battery:\n  __map_joints:\n    k: {type: double}\n", "- a\n", "{{", "other: {a: 1}\n"]
)
def test_a_generated_library_that_does_not_tell_all_names(harness: Harness, text: str) -> None:
    harness.write("CMakeLists.txt", CMAKE + "generate_parameter_library(battery_parameters src/battery.yaml)\n")
    harness.write("src/battery.yaml", text)
    assert ("list", "/") in [(use.access, use.name) for use in harness.read(LISTENING).params]


def test_descriptors_of_parameters(harness: Harness) -> None:
    found = harness.read(
        """
        #include <rclcpp/rclcpp.hpp>
        class Battery : public rclcpp::Node {
        public:
          Battery() : Node("battery") {
            rcl_interfaces::msg::ParameterDescriptor fixed;
            fixed.read_only = true;
            declare_parameter("serial", "a", fixed);
            auto bounded = rcl_interfaces::msg::ParameterDescriptor();
            rcl_interfaces::msg::IntegerRange range;
            range.from_value = 1;
            range.to_value = 50;
            range.step = 7;
            bounded.integer_range.push_back(range);
            declare_parameter("rate", 8, bounded);
            auto any = rcl_interfaces::msg::ParameterDescriptor{};
            any.dynamic_typing = true;
            declare_parameter("any", rclcpp::ParameterValue(1), any);
            declare_parameter<double>("gain");
            declare_parameter("names", rclcpp::PARAMETER_STRING_ARRAY);
          }
        };
        int main() { rclcpp::spin(std::make_shared<Battery>()); }
        """
    )
    assert {use.name: (use.type, use.read_only, use.dynamic, use.range) for use in found.params} == {
        "~serial": (None, True, False, None),
        "~rate": (None, False, False, Range(1, 50, 7)),
        "~any": (None, False, True, None),
        "~gain": ("double", False, False, None),
        "~names": ("string array", False, False, None),
    }


def test_an_empty_default_has_the_type_of_the_template_argument(harness: Harness) -> None:
    found = harness.main('node->declare_parameter<std::string>("a", {}); node->declare_parameter<double>("b", {});')
    assert {use.name: use.default for use in found.params} == {"~a": "", "~b": 0.0}


@pytest.mark.parametrize(
    ("option", "dynamic"),
    [("automatically_declare_parameters_from_overrides", True), ("allow_undeclared_parameters", False)],
)
def test_parameters_that_are_declared_from_overrides_have_their_type(
    harness: Harness, option: str, dynamic: bool
) -> None:
    body = """
    class Own : public rclcpp::Node {
    public:
      explicit Own(const rclcpp::NodeOptions & options) : Node("own", options) {
        if (!has_parameter("rate")) { declare_parameter("rate", 10.0); }
      }
    };
    int main() {
      rclcpp::NodeOptions options;
      options.%s(true);
      rclcpp::spin(std::make_shared<Own>(options));
    }
    """
    found = harness.read(body % option)
    assert {use.name: use.dynamic for use in found.params if use.access == "get"} == {"~rate": dynamic}
    assert "list" in {use.access for use in found.params}


def test_a_container_of_its_own_whose_constructor_stands_in_a_header(harness: Harness) -> None:
    harness.write(
        "include/p/container.hpp",
        """
        #include <rclcpp_components/component_manager.hpp>
        namespace can {
        class Container : public rclcpp_components::ComponentManager {
        public:
          Container(
            std::weak_ptr<rclcpp::Executor> executor = std::weak_ptr<rclcpp::executors::MultiThreadedExecutor>(),
            std::string node_name = "container", const rclcpp::NodeOptions & options = rclcpp::NodeOptions())
          : rclcpp_components::ComponentManager(executor, node_name, options)
          {
            this->declare_parameter<std::string>("bus_config", "");
          }
        };
        }
        """,
    )
    found = harness.read(
        """
        #include "p/container.hpp"
        int main(int argc, char ** argv) {
          rclcpp::init(argc, argv);
          auto executor = std::make_shared<rclcpp::executors::MultiThreadedExecutor>();
          auto container = std::make_shared<can::Container>(executor);
          executor->add_node(container);
          executor->spin();
        }
        """
    )
    assert [use.name for use in found.params] == ["~bus_config"]
    assert [end.name for end in found.endpoints] == [
        "~/_container/load_node",
        "~/_container/unload_node",
        "~/_container/list_nodes",
    ]


def test_parameters_of_a_node_with_unknown_arguments_may_be_those_of_the_launch_file(tmp_path: Path) -> None:
    body = """
    class Own : public rclcpp::Node {
    public:
      explicit Own(const rclcpp::NodeOptions & options) : Node("own", options) { declare_parameter("frame", "base"); }
    };
    int main(int argc, char ** argv) {
      rclcpp::init(argc, argv);
      rclcpp::NodeOptions options;
      options.arguments(other::arguments(argc, argv));
      auto helper = std::make_shared<rclcpp::Node>("helper");
      helper->declare_parameter("rate", 1.0);
      rclcpp::spin(std::make_shared<Own>(options));
    }
    """
    harness = Harness(tmp_path)
    harness.write("src/t.cpp", HEAD + textwrap.dedent(body))
    found, findings = harness.start(NODE.format(inner='<param name="frame" value="odom"/>'))
    assert ("/", "list") in {(use.name, use.access) for use in found.params}
    assert "PRM013" not in {finding.rule for finding in findings}


def test_a_constructor_that_is_not_found_may_declare_anything(tmp_path: Path) -> None:
    body = """
    class Base {
    public:
      explicit Base(rclcpp::Node & node) { node.declare_parameter("rate", 1.0); }
    };
    class Own : public rclcpp::Node, public Base {
    public:
      explicit Own(const rclcpp::NodeOptions & options);
    };
    int main(int argc, char ** argv) {
      rclcpp::init(argc, argv);
      auto node = std::make_shared<rclcpp::Node>("own");
      node->declare_parameter("rate", 1.0);
      auto own = std::make_shared<Own>(rclcpp::NodeOptions());
    }
    """
    harness = Harness(tmp_path)
    for text, told in ((body, False), (body.replace("& options);", '& options) : Node("own"), Base(*this) {}'), True)):
        harness.write("src/t.cpp", HEAD + textwrap.dedent(text))
        findings = harness.start(NODE.format(inner='<param name="frame" value="odom"/>'))[1]
        assert ("PRM013" in {finding.rule for finding in findings}) is told


@pytest.mark.parametrize(
    ("main", "transitions"),
    [
        ("", ()),
        ("node->configure();", ("configure",)),
        ("node->configure(); node->activate();", ("activate", "configure")),
        ('if (std::getenv("GO")) { node->configure(); node->activate(); }', ("activate", "configure")),
        (
            "node->trigger_transition(lifecycle_msgs::msg::Transition::TRANSITION_CONFIGURE);",
            ("activate", "configure"),
        ),
    ],
)
def test_the_transitions_that_a_lifecycle_node_makes_by_itself(
    harness: Harness, main: str, transitions: tuple[str, ...]
) -> None:
    made = "auto node = std::make_shared<Talker>();"
    found = harness.read(
        LIFECYCLE.replace("int main(int, char **)", "int main(int argc, char **)").replace(made, made + main)
    )
    assert found.transitions == transitions
    plain = harness.read(
        LIFECYCLE.replace("rclcpp_lifecycle::LifecycleNode", "rclcpp::Node").replace(made, made + main)
    )
    assert plain.transitions == ()


def test_the_interface_of_moveit(harness: Harness) -> None:
    """move_group_interface.cpp of moveit/moveit2 365306eb."""
    found = harness.main(
        """
        using moveit::planning_interface::MoveGroupInterface;
        auto arm = MoveGroupInterface(node, "arm");
        """,
        before="#include <moveit/move_group_interface/move_group_interface.hpp>",
    )
    assert ends(found)[2:5] == [
        ("action_client", "move_action", "moveit_msgs/action/MoveGroup"),
        ("action_client", "execute_trajectory", "moveit_msgs/action/ExecuteTrajectory"),
        ("client", "query_planner_interface", "moveit_msgs/srv/QueryPlannerInterfaces"),
    ]
    assert ("/", "list") in {(use.name, use.access) for use in found.params}, "MoveIt asks for parameters of its own"


@pytest.mark.parametrize(
    "made",
    [
        'moveit::planning_interface::MoveGroupInterface arm(node, "arm");',
        'auto arm = std::make_shared<moveit::planning_interface::MoveGroupInterface>(node, "arm");',
        'const std::string GROUP = "arm"; moveit::planning_interface::MoveGroupInterface arm(node, GROUP);',
    ],
)
def test_the_interface_of_moveit_in_other_words(harness: Harness, made: str) -> None:
    assert ("action_client", "move_action", "moveit_msgs/action/MoveGroup") in ends(harness.main(made))


@pytest.mark.silent
def test_the_interface_of_moveit_in_a_namespace_that_is_not_known(harness: Harness) -> None:
    options = 'moveit::planning_interface::MoveGroupInterface::Options options("arm", "robot_description", "/left");'
    found = harness.main(f"{options}\nmoveit::planning_interface::MoveGroupInterface arm(node, options);")
    assert not [end for end in ends(found) if "move_action" in end[1]]
    assert not found.complete

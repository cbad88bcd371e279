"""What the text of a C++ node alone tells of it."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import find_packages
from preflight_analysis.source.analyse import SourceAnalysis, SourceInterface
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.workspace import Workspace
from support.source_harness import SourceHarness

HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
CMAKE = "project(p)\nadd_executable(t src/t.cpp)\n"


class Harness(SourceHarness):
    """Its node is made of C++."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self.write("CMakeLists.txt", CMAKE)

    def add_package(self, name: str) -> Path:
        self.write(f"{name}/package.xml", f"<package><name>{name}</name></package>")
        package = Package(name, str(self.folder / name), str(self.folder / name / "package.xml"))
        packages = {**self.environment.packages, name: package}
        self.environment = Environment(1, "noetic", {}, (str(self.folder),), packages, {}, (), (), None)
        self.analysis = SourceAnalysis(self.environment, self.sources)
        return self.folder / name

    def read(self, text: str, **more: str) -> SourceInterface | None:
        self.write("src/t.cpp", HEAD + textwrap.dedent(text))
        return self.again(**more)

    def main(self, body: str, before: str = "", **more: str) -> list[tuple[str, str, str | None]]:
        start = 'int main(int argc, char** argv) {\nros::init(argc, argv, "t");\n'
        return ends(self.read(f"{before}\n{start}{textwrap.dedent(body)}\nros::spin();\nreturn 0;\n}}\n", **more))

    def topics(self, body: str, before: str = "", **more: str) -> list[str]:
        return [name for _, name, _ in self.main(body, before, **more)]


def ends(found: SourceInterface | None) -> list[tuple[str, str, str | None]]:
    return [(e.role, e.name, e.type) for e in found.endpoints] if found else []


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def test_each_kind_of_end(harness: Harness) -> None:
    assert harness.main(
        """
        ros::NodeHandle nh, pnh("~");
        ros::Publisher a = nh.advertise<std_msgs::String>("a", 10, true);
        ros::Subscriber b = pnh.subscribe("b", 1, heard);
        ros::ServiceServer c = nh.advertiseService("c", serve);
        ros::ServiceClient d = nh.serviceClient<std_srvs::Trigger>("d");
        ros::service::waitForService("d"); ros::service::waitForService("e");
        std_srvs::Empty empty;
        ros::service::call("f", empty);
        actionlib::SimpleActionServer<nav::GoAction> g(nh, "g", boost::bind(&execute, _1, &g), false);
        actionlib::SimpleActionClient<nav::GoAction> h("/h", true);
        message_filters::Subscriber<sensor_msgs::CameraInfo> i(nh, "i", 1);
        message_filters::Subscriber<sensor_msgs::Imu> j;
        j.subscribe(pnh, "j", 5);
        ros::topic::waitForMessage<sensor_msgs::PointCloud2>("k", nh, ros::Duration(1));
        tf2_ros::Buffer buffer;
        tf2_ros::TransformListener listener(buffer);
        static tf::TransformBroadcaster broadcaster;
        ros::Subscriber l = nh.subscribe("l", 1, any);
        """,
        before="""
        void heard(const sensor_msgs::ImageConstPtr& image) {}
        bool serve(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) { return true; }
        void execute(const nav::GoGoalConstPtr& goal, Server* server) {}
        void any(const ros::MessageEvent<topic_tools::ShapeShifter const>& event) {}
        """,
    ) == [
        ("publisher", "a", "std_msgs/String"),
        ("subscriber", "~b", "sensor_msgs/Image"),
        ("service", "c", "std_srvs/SetBool"),
        ("client", "d", "std_srvs/Trigger"),
        ("client", "f", "std_srvs/Empty"),
        ("action_server", "g", "nav/GoAction"),
        ("action_client", "/h", "nav/GoAction"),
        ("subscriber", "i", "sensor_msgs/CameraInfo"),
        ("subscriber", "~j", "sensor_msgs/Imu"),
        ("subscriber", "k", "sensor_msgs/PointCloud2"),
        ("subscriber", "/tf", "tf2_msgs/TFMessage"),
        ("subscriber", "/tf_static", "tf2_msgs/TFMessage"),
        ("publisher", "/tf", "tf2_msgs/TFMessage"),
        ("subscriber", "l", "*"),
        ("client", "e", None),
    ]


@pytest.mark.parametrize(
    ("parameter", "type_"),
    [
        ("const pcl::PCLPointCloud2ConstPtr& m", "sensor_msgs/PointCloud2"),
        ("const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& m", "sensor_msgs/PointCloud2"),
        ("const pcl::PolygonMesh& m", None),
        ("const sensor_msgs::ImageConstPtr& m", "sensor_msgs/Image"),
        ("const sensor_msgs::Image::ConstPtr& m", "sensor_msgs/Image"),
        ("sensor_msgs::ImagePtr m", "sensor_msgs/Image"),
        ("const sensor_msgs::Image& m", "sensor_msgs/Image"),
        ("boost::shared_ptr<sensor_msgs::Image const> m", "sensor_msgs/Image"),
        ("const boost::shared_ptr<const sensor_msgs::Image>& m", "sensor_msgs/Image"),
        ("const String::ConstPtr& m", "std_msgs/String"),
        ("const StringConstPtr m", "std_msgs/String"),
        ("const Picture& m", "sensor_msgs/Image"),
        ("const sm::Image& m", "sensor_msgs/Image"),
        ("const ros::MessageEvent<sensor_msgs::Image>& m", "sensor_msgs/Image"),
        ("double m", None),
    ],
)
def test_types_of_callbacks(harness: Harness, parameter: str, type_: str | None) -> None:
    before = f"""
        using namespace std_msgs;
        namespace sm = sensor_msgs;
        typedef sensor_msgs::Image Picture;
        void heard({parameter}) {{}}
        class Box {{ public: void heard({parameter}) {{}} void more(int i, {parameter}) {{}} }};
        """
    assert harness.main(
        f"""
        ros::NodeHandle nh;
        Box box;
        nh.subscribe("a", 1, heard);
        nh.subscribe("b", 1, &Box::heard, &box);
        nh.subscribe("c", 1, boost::function<void(int)>(boost::bind(&Box::more, &box, 3, _1)));
        auto d = [&box]({parameter}) {{ box.heard(m); }};
        nh.subscribe("d", 1, d);
        """,
        before,
    ) == [("subscriber", name, type_) for name in "abcd"]


def test_computed_names(harness: Harness) -> None:
    assert harness.topics(
        """
        ros::NodeHandle nh;
        nh.advertise<std_msgs::String>(BASE "/state", 1);
        nh.advertise<std_msgs::String>(std::string(BASE) + "/goal", 1);
        nh.advertise<std_msgs::String>(Names::LASER, 1);
        nh.advertise<std_msgs::String>(prefix + SUFFIX, 1);
        for (int i = 0; i < 2; ++i) {
          std::ostringstream name;
          name << "wheel" << i;
          nh.advertise<std_msgs::String>(name.str(), 1);
          nh.advertise<std_msgs::String>("joint" + std::to_string(i), 1);
        }
        std::vector<std::string> sides = {"left", "right"};
        for (const auto& side : sides) nh.advertise<std_msgs::String>(side.c_str(), 1);
        nh.advertise<std_msgs::String>(ros::this_node::getName() + "/own", 1);
        nh.advertise<std_msgs::String>(topic("y"), 1);
        nh.advertise<std_msgs::String>(compute(), 1);
        nh.advertise<std_msgs::String>("not a name", 1);
        """,
        before="""
        #define BASE "arm"
        const std::string SUFFIX = "_x";
        static const char* prefix = "scan";
        struct Names { static constexpr char LASER[] = "laser"; };
        std::string topic(std::string name, const char* more = "_z") { return name + more; }
        """,
    ) == [
        "arm/state",
        "arm/goal",
        "laser",
        "scan_x",
        "wheel0",
        "joint0",
        "wheel1",
        "joint1",
        "left",
        "right",
        "/n/own",
        "y_z",
    ]


def test_a_macro_that_the_build_decides(harness: Harness) -> None:
    body = """
        ros::NodeHandle nh;
        nh.advertise<std_msgs::String>(NAME, 1);
        nh.advertise<std_msgs::String>(SAME, 1);
    """
    before = """
        #ifdef OLD
        #define NAME "GoHome"
        #define SAME "state"
        #else
        #define NAME "go_home"
        #define SAME  "state"
        #endif
    """
    assert harness.topics(body, before) == ["state"]


def test_a_text_that_grows_piece_by_piece(harness: Harness) -> None:
    body = """
        ros::NodeHandle nh;
        std::string topic;
        topic.append("/arm").append(SIDE).append("/goal");
        nh.advertise<std_msgs::String>(topic, 1);
        topic.append(argv[1]).append("/more");
        nh.advertise<std_msgs::String>(topic, 1);
    """
    assert harness.topics(body, 'const std::string SIDE = "_left";') == ["/arm_left/goal"]


def test_namespaces_of_handles(harness: Harness) -> None:
    assert harness.topics(
        """
        ros::NodeHandle nh, pnh("~"), sub("sub"), below(nh, "below"), deep(pnh, "deep"), root("/root"), own("~/own");
        ros::NodeHandle copy(sub);
        ros::NodeHandle unknown(compute());
        ros::NodeHandlePtr pointer(new ros::NodeHandle("~"));
        nh.advertise<std_msgs::String>("a", 1);
        pnh.advertise<std_msgs::String>("b", 1);
        sub.advertise<std_msgs::String>("c", 1);
        below.advertise<std_msgs::String>("d", 1);
        deep.advertise<std_msgs::String>("e", 1);
        root.advertise<std_msgs::String>("f", 1);
        own.advertise<std_msgs::String>("g", 1);
        copy.advertise<std_msgs::String>("h", 1);
        unknown.advertise<std_msgs::String>("i", 1);
        unknown.advertise<std_msgs::String>("/j", 1);
        pointer->advertise<std_msgs::String>("k", 1);
        ros::NodeHandle("~").advertise<std_msgs::String>("l", 1);
        """
    ) == ["a", "~b", "sub/c", "below/d", "~deep/e", "/root/f", "~own/g", "sub/h", "/j", "~k", "~l"]


def test_classes_are_followed_in_order(harness: Harness) -> None:
    harness.write(
        "include/p/base.h",
        """
        #include <sensor_msgs/LaserScan.h>
        namespace p {
        template <class T>
        class Base {
         protected:
          ros::NodeHandle nh_;
          ros::NodeHandle pnh_{"~"};
          std::string topic_ = "base";
          virtual void start() { pub_ = nh_.advertise<T>(topic_, 1); }
          ros::Publisher pub_;
        };
        class Node : public Base<std_msgs::String> {
         public:
          Node(ros::NodeHandle& nh, const std::string& topic = "given");
          void run();
          void unused() { nh_.advertise<std_msgs::String>("never", 1); }
         private:
          void scan(const sensor_msgs::LaserScan::ConstPtr& scan);
          ros::NodeHandle other_;
          boost::shared_ptr<message_filters::Subscriber<sensor_msgs::LaserScan> > filter_;
          std::unique_ptr<ros::Subscriber> sub_;
        };
        }
        """,
    )
    harness.write(
        "src/node.cpp",
        """
        #include "p/base.h"
        namespace p {
        Node::Node(ros::NodeHandle& nh, const std::string& topic) : other_(nh, topic) {
          topic_ = "changed";
          start();
        }
        void Node::run() {
          filter_.reset(new message_filters::Subscriber<sensor_msgs::LaserScan>(other_, "filtered", 1));
          ros::Subscriber sub = pnh_.subscribe("scan", 1, &Node::scan, this);
        }
        void Node::scan(const sensor_msgs::LaserScan::ConstPtr& scan) {
          other_.advertise<LaserScan>("late", 1);
        }
        }
        """,
    )
    harness.write("CMakeLists.txt", CMAKE + "add_library(core src/node.cpp)\ntarget_link_libraries(t core)\n")
    assert harness.main(
        """
        ros::NodeHandle nh("robot");
        p::Node node(nh);
        auto other = std::make_shared<p::Node>(nh, "second");
        other->run();
        """,
        before='#include "p/base.h"',
    ) == [
        ("publisher", "changed", "std_msgs/String"),
        ("subscriber", "robot/second/filtered", "sensor_msgs/LaserScan"),
        ("subscriber", "~scan", "sensor_msgs/LaserScan"),
        ("publisher", "robot/second/late", "sensor_msgs/LaserScan"),
    ]


@pytest.mark.parametrize("name", ["Filter", "Filter<T>", "Filter<T>::Filter", "own::Filter<T>::Filter"])
def test_a_constructor_that_another_one_of_its_class_stands_for(harness: Harness, name: str) -> None:
    before = f"""
        namespace own {{
        template <class T> class Filter {{
        public:
          Filter(ros::NodeHandle nh, ros::NodeHandle own, std::string name, int depth = 1);
          Filter(ros::NodeHandle nh, ros::NodeHandle own, int depth = 1);
          void start() {{ own_.advertise<T>("made", 1); }}
        private:
          ros::NodeHandle nh_, own_;
        }};
        template <class T> Filter<T>::Filter(ros::NodeHandle nh, ros::NodeHandle own, std::string name, int depth)
            : nh_(nh), own_(own) {{}}
        template <class T> Filter<T>::Filter(ros::NodeHandle nh, ros::NodeHandle own, int depth)
            : {name}(nh, own, ros::this_node::getName(), depth) {{}}
        }}
    """
    body = 'ros::NodeHandle nh, own("~"); own::Filter<std_msgs::String> filter(nh, own); filter.start();'
    assert harness.topics(body, before) == ["~made"]


def test_parameters_of_the_launch_and_defaults_give_names(harness: Harness) -> None:
    body = """
        ros::NodeHandle pnh("~");
        std::string a, b = "own", c;
        pnh.param<std::string>("a", a, "a_default");
        pnh.getParam("b", b);
        c = pnh.param<std::string>("c", "c_default");
        std::string d = pnh.param("d", std::string("d_default"));
        std::string e;
        if (!pnh.getParam("e", e)) e = "e_default";
        std::string f;
        ros::param::param<std::string>("~f", f, "f_default");
        for (const std::string& each : {a, b, c, d, e, f}) pnh.advertise<std_msgs::String>("/" + each, 1);
        bool extra;
        pnh.param("extra", extra, false);
        if (extra) pnh.advertise<std_msgs::String>("/extra", 1);
        """
    assert harness.topics(body) == ["/a_default", "/own", "/c_default", "/d_default", "/f_default"]
    inner = "".join(f'<param name="{name}" value="{name}_given"/>' for name in "abcdef")
    inner += '<param name="extra" value="true"/>'
    assert harness.topics(body, inner=inner) == [*(f"/{name}_given" for name in "abcdef"), "/extra"]


def test_a_default_has_the_type_of_the_template_argument(harness: Harness) -> None:
    found = harness.read(
        """
        int main(int argc, char** argv) {
          ros::init(argc, argv, "t");
          ros::NodeHandle pnh("~");
          std::string group = pnh.param<std::string>("group", {});
          double speed = pnh.param<double>("speed", 1);
          bool on = pnh.param<bool>("on", {});
          int count = ros::param::param<int>("~count", {});
          auto names = pnh.param<std::vector<std::string>>("names", {});
          ros::spin();
        }
        """
    )
    assert found is not None
    defaults = {use.name: use.default for use in found.params}
    assert defaults == {"~group": "", "~speed": 1.0, "~on": False, "~count": 0, "~names": []}
    assert [type(value) for value in defaults.values()] == [str, float, bool, int, list]


def test_a_default_that_is_a_list_in_braces(harness: Harness) -> None:
    found = harness.read(
        """
        template <class T, class U> void param(const ros::NodeHandle& nh, const std::string& name, T& into, U&& other) {
          if (!nh.param(name, into, std::forward<T>(other))) ROS_WARN("missing");
        }
        int main(int argc, char** argv) {
          ros::init(argc, argv, "t");
          ros::NodeHandle pnh("~");
          std::vector<double> matrix;
          param(pnh, "matrix", matrix, std::vector<double>{ 1, 0, 0 });
          std::vector<int> one;
          pnh.param("one", one, std::vector<int>{ 1 });
          pnh.param("none", one, std::vector<int>{});
          ros::spin();
        }
        """
    )
    assert found is not None
    assert {use.name: use.default for use in found.params} == {"~matrix": [1.0, 0.0, 0.0], "~one": [1], "~none": []}


def test_uses_of_parameters(harness: Harness) -> None:
    found = harness.read(
        """
        int main(int argc, char** argv) {
          ros::NodeHandle nh, pnh("~");
          int rate; double speed = 0.5; std::string name;
          nh.param("rate", rate, 10);
          pnh.getParam("speed", speed);
          pnh.hasParam("maybe");
          pnh.setParam("made", 1);
          ros::param::get("/global", name);
          pnh.searchParam("robot_description", name);
          pnh.param(name, rate, 1);
          pnh.param<double>("angle", speed, M_PI / 2);
          dynamic_reconfigure::Server<p::Config> server(ros::NodeHandle("~/inner"));
        }
        """
    )
    assert found is not None
    assert [(u.name, u.access, u.default, u.has_default, u.mandatory) for u in found.params] == [
        ("rate", "get", 10, True, False),
        ("~speed", "get", None, False, False),
        ("~maybe", "has", None, False, False),
        ("~made", "set", None, False, False),
        ("/global", "get", None, False, False),
        ("~robot_description", "search", None, False, False),
        ("~angle", "get", None, True, False),
    ]
    assert [e.name for e in found.endpoints] == [
        "~inner/set_parameters",
        "~inner/parameter_descriptions",
        "~inner/parameter_updates",
    ]


def test_parameters_of_dynamic_reconfigure(harness: Harness) -> None:
    harness.write(
        "cfg/Tuning.cfg",
        """
        #!/usr/bin/env python
        from dynamic_reconfigure.parameter_generator_catkin import *
        gen = ParameterGenerator()
        gen.add("gain", double_t, 0, "How much", 0.5, 0.0, 1.0)
        group = gen.add_group("more")
        group.add(name="frame", paramtype=str_t, level=0, description="", default="odom")
        group.add("limit", int_t, 0, "", LIMIT)
        gen.add(computed, int_t, 0, "")
        exit(gen.generate("p", "t", "Tuning"))
        """,
    )
    body = """
        typedef dynamic_reconfigure::Server<p::TuningConfig> Tuner;
        Tuner* tuner = new Tuner(ros::NodeHandle("~/inner"));
        dynamic_reconfigure::Server<TuningConfig> own;
        dynamic_reconfigure::Server<p::OtherConfig> other;
        """
    text = f"#include <p/TuningConfig.h>\nint main() {{\n{body}\n}}\n"
    found = harness.read(text)
    assert found is not None
    cfg = str(harness.folder / "cfg/Tuning.cfg")
    assert [(u.name, u.default, u.source_file, u.source_line) for u in found.params] == [
        ("~inner/gain", 0.5, cfg, 5),
        ("~inner/frame", "odom", cfg, 7),
        ("~inner/limit", None, cfg, 8),
        ("~gain", 0.5, cfg, 5),
        ("~frame", "odom", cfg, 7),
        ("~limit", None, cfg, 8),
    ]


def test_conditions_loops_and_exits(harness: Harness) -> None:
    assert harness.topics(
        """
        ros::NodeHandle nh;
        std::string name = "same", other = "first";
        if (argc > 5) { nh.advertise<std_msgs::String>("never", 1); return 1; }
        if (ros::isShuttingDown()) { nh.advertise<std_msgs::String>("one", 1); other = "changed"; }
        else nh.advertise<std_msgs::String>("two", 1);
        nh.advertise<std_msgs::String>(name, 1);
        nh.advertise<std_msgs::String>(other, 1);
        if (!nh.ok()) { exit(1); }
        switch (compute()) {
          case 1: nh.advertise<std_msgs::String>("case1", 1); break;
          default: nh.advertise<std_msgs::String>("case2", 1);
        }
        try { nh.advertise<std_msgs::String>("tried", 1); } catch (const std::exception& e) { return 2; }
        #ifdef SOMETHING
        nh.advertise<std_msgs::String>("defined", 1);
        #else
        nh.advertise<std_msgs::String>("not_defined", 1);
        #endif
        #if 0
        nh.advertise<std_msgs::String>("out", 1);
        #endif
        while (ros::ok()) { nh.advertise<std_msgs::String>("loop", 1); }
        return 0;
        nh.advertise<std_msgs::String>("behind", 1);
        """
    ) == ["one", "two", "same", "case1", "case2", "tried", "defined", "not_defined", "loop"]


def test_only_one_side_of_a_conditional_expression_is_computed(harness: Harness) -> None:
    found = harness.read(
        """
        void main(int argc, char** argv) {
          ros::init(argc, argv, "t");
          ros::NodeHandle nh;
          ros::Publisher p = ros::isShuttingDown() ? nh.advertise<std_msgs::String>("a", 1)
                                                   : nh.advertise<std_msgs::Bool>("a", 1);
          nh.advertise<std_msgs::String>(ros::isShuttingDown() ? "b" : "b", 1);
          true ? nh.advertise<std_msgs::String>("c", 1) : nh.advertise<std_msgs::String>("d", 1);
        }
        """
    )
    assert found is not None
    assert [(end.name, "condition" in end.evidence.doubts) for end in found.endpoints] == [
        ("a", True),
        ("a", True),
        ("b", False),
        ("c", False),
    ]


def test_the_second_part_of_an_and_or_an_or_may_not_be_computed(harness: Harness) -> None:
    found = harness.read(
        """
        bool make(ros::NodeHandle & nh, const char * name) { nh.advertise<std_msgs::String>(name, 1); return true; }
        void main(int argc, char** argv) {
          ros::init(argc, argv, "t");
          ros::NodeHandle nh;
          bool a = ros::isShuttingDown() && make(nh, "and");
          if (ros::isShuttingDown() || make(nh, "or")) {}
          if (true && make(nh, "known")) {}
        }
        """
    )
    assert found is not None
    assert [(end.name, "condition" in end.evidence.doubts) for end in found.endpoints] == [
        ("and", True),
        ("or", True),
        ("known", False),
    ]


def test_images(harness: Harness) -> None:
    body = """
        ros::NodeHandle nh, pnh("~");
        image_transport::ImageTransport it(nh), own(pnh);
        image_transport::TransportHints hints("raw", ros::TransportHints(), pnh);
        it.advertise("a", 1);
        own.advertiseCamera("b", 1);
        it.subscribe("left/c", 1, heard);
        it.subscribeCamera("left/d", 1, both, hints);
        image_transport::SubscriberFilter filter;
        filter.subscribe(it, "e", 1);
        camera_info_manager::CameraInfoManager manager(nh, "camera");
        """
    published: list[tuple[str, str, str | None]] = [
        ("publisher", "a", "sensor_msgs/Image"),
        ("publisher", "~b", "sensor_msgs/Image"),
        ("publisher", "~camera_info", "sensor_msgs/CameraInfo"),
    ]
    info = ("subscriber", "left/camera_info", "sensor_msgs/CameraInfo")
    service = ("service", "set_camera_info", "sensor_msgs/SetCameraInfo")
    for transport, below, type_ in (("raw", "", "Image"), ("compressed", "/compressed", "CompressedImage")):
        c, d, e = (("subscriber", f"{name}{below}", f"sensor_msgs/{type_}") for name in ("left/c", "left/d", "e"))
        inner = f'<param name="image_transport" value="{transport}"/>'
        assert harness.main(body, inner=inner) == [*published, c, d, info, e, service]
    assert ("subscriber", "e", "sensor_msgs/Image") in harness.main(body)


def test_places(harness: Harness) -> None:
    found = harness.read('int main() {\n  ros::NodeHandle nh;\n  nh.advertise<std_msgs::String>("a", 1);\n}\n')
    assert found is not None
    (end,) = found.endpoints
    assert (end.source_file, end.source_line) == (str(harness.folder / "src/t.cpp"), 5)
    assert end.qos == {"queue_size": 1}


NODELET = """
    #include <nodelet/nodelet.h>
    #include <pluginlib/class_list_macros.h>
    namespace p {
    class Filter : public nodelet::Nodelet {
      virtual void onInit() {
        ros::NodeHandle& nh = getNodeHandle();
        ros::NodeHandle pnh = getMTPrivateNodeHandle();
        pub_ = nh.advertise<std_msgs::String>("out", 1, boost::bind(&Filter::connect, this));
        pnh.advertise<std_msgs::String>("own", 1);
      }
      void connect() { getNodeHandle().subscribe("in", 1, &Filter::heard, this); }
      void heard(const std_msgs::StringConstPtr& text) {}
      ros::Publisher pub_;
    };
    }
    PLUGINLIB_EXPORT_CLASS(p::Filter, nodelet::Nodelet)
    """


def with_nodelet(harness: Harness) -> None:
    harness.write(
        "package.xml",
        '<?xml version="1.0"?><package><name>p</name>'
        '<export><nodelet plugin="${prefix}/plugins.xml"/></export></package>',
    )
    harness.write(
        "plugins.xml",
        '<library path="lib/libfilters"><class name="p/filter" type="p::Filter" '
        'base_class_type="nodelet::Nodelet"/></library>',
    )
    harness.write("CMakeLists.txt", CMAKE + "add_library(filters src/filter.cpp)\n")
    harness.write("src/filter.cpp", HEAD + textwrap.dedent(NODELET))


def test_nodelets(harness: Harness) -> None:
    with_nodelet(harness)
    made = [
        ("publisher", "out", "std_msgs/String"),
        ("publisher", "~own", "std_msgs/String"),
        ("subscriber", "in", "std_msgs/String"),
    ]
    node = '<node pkg="nodelet" type="nodelet" name="n" args="{args}">{inner}</node>'
    assert ends(harness.again(node=node, args="standalone p/filter")) == made
    load = ("client", "manager/load_nodelet", "nodelet/NodeletLoad")
    assert ends(harness.again(node=node, args="load p/filter manager")) == [*made, load]
    assert ends(harness.again(node=node, args="load p/other manager")) == []
    assert ends(harness.again(node=node, args="manager")) == []


def test_a_nodelet_whose_name_does_not_tell_its_package(harness: Harness) -> None:
    with_nodelet(harness)
    manifest = (harness.folder / "package.xml").read_text().replace("<export>", "<depend>nodelet</depend><export>")
    harness.write("package.xml", manifest)
    harness.write("plugins.xml", (harness.folder / "plugins.xml").read_text().replace("p/filter", "Filters/Filter"))
    packages = find_packages([str(harness.folder)]).packages
    harness.environment = Environment(1, "noetic", {}, (str(harness.folder),), packages, {}, (), (), None)
    harness.analysis = SourceAnalysis(harness.environment, harness.sources)
    node = '<node pkg="nodelet" type="nodelet" name="n" args="{args}">{inner}</node>'
    assert len(ends(harness.again(node=node, args="standalone Filters/Filter"))) == 3
    assert harness.again(node=node, args="standalone Filters/Other") is None


def test_a_type_of_a_package_whose_namespace_is_used(harness: Harness) -> None:
    harness.add_package("q_msgs")
    harness.write("q_msgs/msg/Thing.msg", "")
    harness.add_package("r_msgs")
    before = "using namespace q_msgs;\nusing namespace r_msgs;\nusing namespace std;"
    body = 'ros::NodeHandle nh; nh.advertise<Thing>("a", 1); nh.advertise<Other>("b", 1);'
    assert harness.main(body, before) == [("publisher", "a", "q_msgs/Thing"), ("publisher", "b", None)]


def test_nodelets_in_a_program_of_their_own(harness: Harness) -> None:
    with_nodelet(harness)
    assert harness.topics(
        """
        nodelet::Loader loader;
        nodelet::M_string remap(ros::names::getRemappings());
        nodelet::V_string nargv;
        loader.load(ros::this_node::getName(), "p/filter", remap, nargv);
        loader.load("inner", "p/filter", remap, nargv);
        """
    ) == ["~load_nodelet", "~unload_nodelet", "~list", "out", "~own", "in", "/inner/own"]


def test_remaps_of_nodelets_in_a_program(harness: Harness) -> None:
    assert (
        harness.topics(
            """
        nodelet::Loader loader(false);
        nodelet::M_string remap;
        remap["out"] = ros::names::resolve("left/out");
        loader.load("left", "p/filter", remap, nodelet::V_string());
        remap.clear();
        loader.load("right", "p/filter", remap, nodelet::V_string());
        """
        )
        == []
    )
    with_nodelet(harness)
    assert [e.name for e in getattr(harness.again(), "endpoints", ())] == [
        "/left/out",
        "/left/own",
        "in",
        "out",
        "/right/own",
    ]


def test_arguments(harness: Harness) -> None:
    body = """
        std::vector<std::string> args;
        ros::removeROSArgs(argc, argv, args);
        ros::NodeHandle nh;
        if (args.size() < 3) return 1;
        nh.advertise<std_msgs::String>(argv[1], 1);
        for (size_t i = 2; i < args.size(); i++) nh.advertise<std_msgs::String>(args[i], 1);
        """
    assert harness.topics(body, args="a b c _x:=1") == ["a", "b", "c"]
    assert harness.topics(body, args="a") == []


def test_messages_of_any_type(harness: Harness) -> None:
    assert harness.main(
        'ros::NodeHandle nh; node = &nh; nh.subscribe<topic_tools::ShapeShifter>("in", 1, boost::bind(heard, _1));',
        """
        ros::NodeHandle* node;
        void heard(const boost::shared_ptr<topic_tools::ShapeShifter const>& m) { m->advertise(*node, "out", 1); }
        """,
    ) == [("subscriber", "in", "*"), ("publisher", "out", None)]


def test_parameters_that_are_searched_and_counted(harness: Harness) -> None:
    body = """
        ros::NodeHandle pnh("~");
        std::string key, topic;
        if (pnh.searchParam("base", key)) pnh.getParam(key, topic);
        pnh.advertise<std_msgs::String>(topic, 1);
        int i = 0;
        bool more = true;
        do {
          std::stringstream name;
          name << "input" << i++;
          more = pnh.hasParam(name.str());
          if (more) {
            pnh.getParam(name.str(), topic);
            pnh.subscribe<std_msgs::String>(topic, 1, heard);
          }
        } while (more);
        """
    inner = '<param name="base" value="b"/><param name="input0" value="/x"/><param name="input1" value="/y"/>'
    # Another node might set the next one.
    assert harness.topics(body, inner=inner)[:3] == ["~b", "/x", "/y"]


def test_headers_of_another_package_bring_their_source(harness: Harness) -> None:
    folder = harness.add_package("q")
    harness.write("q/CMakeLists.txt", "add_library(q src/thing.cpp src/unrelated.cpp)\n")
    harness.write("q/include/q/thing.h", "namespace q { class Thing { public: Thing(); }; }\n")
    thing = '#include "q/thing.h"\nq::Thing::Thing() { ros::NodeHandle("~").advertise<std_msgs::String>("made", 1); }\n'
    harness.write("q/src/thing.cpp", thing)
    harness.write("q/src/unrelated.cpp", "")
    found = harness.read("#include <q/thing.h>\nint main() { q::Thing thing; }\n")
    assert found is not None
    assert [(e.name, e.source_file) for e in found.endpoints] == [("~made", str(folder / "src/thing.cpp"))]


def test_a_library_of_ros_in_source_form_is_known_all_the_same(harness: Harness) -> None:
    harness.add_package("message_filters")
    header = "namespace message_filters { template <class M> class Subscriber { public: Subscriber(int a, int b); }; }"
    harness.write("message_filters/include/message_filters/subscriber.h", header)
    body = 'ros::NodeHandle nh; message_filters::Subscriber<std_msgs::String> sub(nh, "a", 1);'
    assert harness.topics(body, "#include <message_filters/subscriber.h>") == ["a"]


def test_a_program_that_is_built_is_known_by_its_source_too(harness: Harness) -> None:
    built = harness.folder / "t"
    built.write_bytes(b"\x7fELF\2\1\1\0")
    built.chmod(0o755)
    assert harness.launch().nodes[0].resolved.path == str(built)
    assert harness.topics('ros::NodeHandle nh; nh.advertise<std_msgs::String>("a", 1);') == ["a"]


def test_a_script_that_is_installed_under_another_name(harness: Harness) -> None:
    harness.write("CMakeLists.txt", "install(PROGRAMS scripts/x.py DESTINATION bin RENAME t)\n")
    harness.write("scripts/x.py", "import rospy\nfrom std_msgs.msg import String\nrospy.Publisher('a', String)\n")
    assert ends(harness.again()) == [("publisher", "a", "std_msgs/String")]


def test_remembered_until_a_file_or_a_parameter_changes(harness: Harness) -> None:
    body = """
        ros::NodeHandle nh;
        nh.advertise<std_msgs::String>(NAME + ros::NodeHandle("~").param<std::string>("x", ""), 1);
        """
    harness.write("include/p/name.h", 'const std::string NAME = "a";\n')
    assert harness.topics(body, '#include "p/name.h"') == ["a"]
    first = harness.again()
    assert harness.again(inner='<param name="unread" value="1"/>') is first
    inner = '<param name="x" value="b"/>'
    assert ends(harness.again(inner=inner)) == [("publisher", "ab", "std_msgs/String")]
    harness.write("include/p/name.h", 'const std::string NAME = "longer";\n')
    assert ends(harness.again(inner=inner)) == [("publisher", "longerb", "std_msgs/String")]
    harness.write("CMakeLists.txt", "project(p)\nadd_executable(t src/other.cpp)\n")
    assert harness.again(inner=inner) is None


BEFORE = 'int main(int argc, char** argv) {\n  ros::NodeHandle nh;\n  nh.advertise<std_msgs::String>("before", 1);\n'


@pytest.mark.parametrize(
    "text",
    [
        "  nh.advertise<std_msgs::String>(\n",
        "  if (x { nh. ;\n}\n",
        "}\n}\n}\nclass {",
        "  class A : A { A a; }; A a; A b = A(A(A()));\n}",
        '  std::string s = "a"; for (;;) { s = s + s; }\n}',
        "  x = " + "(" * 400 + ")" * 400 + ";\n}",
        "  x = " + "1+" * 3000 + "1;\n}",
        "  " + "f(" * 500 + ")" * 500 + ";\n}",
        "  main(argc, argv);\n  auto f = [&](){ f(); }; f();\n}",
        "  std::vector<X> v; v.push_back(v); v = {v, v}; for (auto x : v) for (auto y : v) f(x, y);\n}",
        '  typedef T T; using U = V; using V = U; V v; T t; nh.advertise<V>("x", 1);\n}',
        '  1 / 0; 1 % 0; -"a"; "a" * 3; 1 << 99999; "\\q\\x"; \'\\0\'; 0x; 1e999;\n}',
        "  nh.advertise(); nh.subscribe(); nh.param(); nh.getParam(); boost::bind(); ros::NodeHandle x(1, 2);\n}",
        "  template <class T struct X;\n#if\n#else\n#endif\n}",
        "\0\x01\ufffd}",
    ],
)
def test_hostile_programs_end_soon_and_raise_nothing(harness: Harness, text: str) -> None:
    before = harness.read(BEFORE + text + "\n")
    assert ends(before)[:1] == ([("publisher", "before", "std_msgs/String")] if "\0" not in text else [])


def test_any_cut_of_a_program_is_read(harness: Harness) -> None:
    whole = HEAD + textwrap.dedent(NODELET) + BEFORE + "  p::Filter f; f.onInit();\n}\n"
    found = [harness.read(whole[:end] + "\n" + whole[end + 11 :]) for end in range(0, len(whole), 23)]
    everything = {end[:2] for end in ends(harness.read(whole))}
    assert len(everything) == 4
    assert {end[:2] for each in found if each is not None for end in ends(each)} == everything


def test_what_is_not_there_tells_nothing(harness: Harness) -> None:
    assert harness.again() is None
    harness.write("src/t.cpp", "void f() {}")
    assert harness.again() is None
    harness.write("CMakeLists.txt", "")
    assert harness.again() is None


def test_an_unbuilt_workspace_in_the_editor(harness: Harness) -> None:
    """The node that talks is known from its source: the one that listens to something else is told what it meant."""
    harness.write("CMakeLists.txt", CMAKE + "add_executable(l src/l.cpp)\n")
    talk = HEAD + 'int main() { ros::NodeHandle nh; nh.advertise<std_msgs::String>("chatter", 1); }\n'
    listen = talk.replace("advertise<std_msgs::String>", "subscribe<std_msgs::String>")
    harness.write("src/t.cpp", talk)
    harness.write("src/l.cpp", listen.replace("chatter", "chater"))
    path = harness.write(
        "main.launch",
        '<launch><node pkg="p" type="t" name="t"/><node pkg="p" type="l" name="l"/></launch>',
    )
    workspace = Workspace(harness.environment, harness.sources, str(harness.folder))
    analysis = workspace.static(str(path))
    interfaces = [not_run(node, workspace.executables) for node in analysis.tree.nodes]
    whole = workspace.with_interfaces(analysis, interfaces, None)
    found: dict[str, Any] = {finding.rule: finding for finding in whole.findings}
    assert found["PKG002"].severity == "hint"
    assert (found["TOP001"].severity, "chatter" in found["TOP001"].message) == ("warning", True)
    assert ExecutableIndex(harness.environment).names("p") == ("l", "t")
    assert whole.graph is not None
    assert [each.outcome.reason for each in whole.graph.interfaces] == ["it is not built yet"] * 2


FUSION = """
    class Fusion {
     public:
      Fusion() : pnh_("~") {
        pub_ = nh_.advertise<nav_msgs::Odometry>("odometry/filtered", 10);
        int index = 0;
        bool more = true;
        while (more) {
          std::ostringstream key;
          key << "imu" << index++;
          std::string topic;
          more = pnh_.getParam(key.str(), topic);
          if (more) subs_.push_back(nh_.subscribe(topic, 1, &Fusion::heard, this));
        }
      }
      void heard(const sensor_msgs::ImuConstPtr& imu) {}
     private:
      ros::NodeHandle nh_, pnh_;
      ros::Publisher pub_;
      std::vector<ros::Subscriber> subs_;
    };
    int main(int argc, char** argv) { ros::init(argc, argv, "fusion"); Fusion fusion; ros::spin(); }
    """
DRIVER = """
    int main(int argc, char** argv) {
      ros::NodeHandle nh("imu_filtered");
      ros::Publisher pub = nh.advertise<sensor_msgs::Imu>("data", 1);
    }
    """


def test_a_bug_of_an_unbuilt_workspace_is_found_and_its_mended_form_is_quiet(harness: Harness) -> None:
    """A parameter names the topic that a node reads, and another node publishes it under another name."""
    harness.write("CMakeLists.txt", "project(p)\nadd_executable(fusion f.cpp)\nadd_executable(driver d.cpp)\n")
    harness.write("f.cpp", HEAD + textwrap.dedent(FUSION))
    harness.write("d.cpp", HEAD + textwrap.dedent(DRIVER))
    text = """
        <launch>
          <node pkg="p" type="driver" name="driver"/>
          <node pkg="p" type="fusion" name="fusion"><param name="imu0" value="%s"/></node>
        </launch>
        """

    def dangling(topic: str) -> list[str]:
        path = harness.write("main.launch", text % topic)
        workspace = Workspace(harness.environment, harness.sources, str(harness.folder))
        analysis = workspace.static(str(path))
        interfaces = [not_run(node, workspace.executables) for node in analysis.tree.nodes]
        whole = workspace.with_interfaces(analysis, interfaces, None)
        return [finding.message for finding in whole.findings if finding.rule == "TOP001"]

    (message,) = dangling("imu/data")
    assert "'/imu/data' has no publisher (subscriber: /fusion); did you mean '/imu_filtered/data'" in message
    assert dangling("imu_filtered/data") == []


def test_packages_are_found_as_in_a_workspace(tmp_path: Path) -> None:
    harness = Harness(tmp_path / "src" / "p")
    packages = find_packages([str(tmp_path / "src")]).packages
    harness.environment = Environment(1, "noetic", {}, (str(tmp_path / "src"),), packages, {}, (), (), None)
    harness.analysis = SourceAnalysis(harness.environment, harness.sources)
    assert harness.topics('ros::NodeHandle nh; nh.advertise<std_msgs::String>("a", 1);') == ["a"]

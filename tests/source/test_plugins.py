"""The parameters of plugins that nodes load, read from their source."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.plugins import plugin_params
from preflight_analysis.workspace.sources import Sources

FILES = {
    "package.xml": "<package><name>nav</name><export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": """
        project(nav)
        add_library(core SHARED src/layer.cpp)
        add_library(${PROJECT_NAME}::core ALIAS core)
        add_library(plugins SHARED src/plugins.cpp)
        target_link_libraries(plugins ${PROJECT_NAME}::core)
        pluginlib_export_plugin_description_file(nav2_core plugins.xml)
        """,
    "plugins.xml": """
        <library path="plugins">
          <class type="nav::Planner" base_class_type="nav2_core::GlobalPlanner"/>
          <class type="nav::Obstacles" base_class_type="nav2_costmap_2d::Layer"/>
          <class name="nav/Critic" type="nav::Critic" base_class_type="dwb_core::TrajectoryCritic"/>
          <class type="nav::Panel" base_class_type="rviz_common::Panel"/>
        </library>
        """,
    "include/nav/layer.hpp": """
        namespace nav {
        class Layer {
        public:
          void initialize(Costmap * parent, std::string name, tf2_ros::Buffer * tf,
            const nav2_util::LifecycleNode::WeakPtr & node, rclcpp::CallbackGroup::SharedPtr group);
          virtual void onInitialize() {}
          virtual void activate() {}
        protected:
          void declareParameter(const std::string & param, const rclcpp::ParameterValue & value);
          nav2_util::LifecycleNode::WeakPtr node_;
          std::string name_;
        };
        }
        """,
    "src/layer.cpp": """
        #include "nav/layer.hpp"
        namespace nav {
        void Layer::initialize(Costmap * parent, std::string name, tf2_ros::Buffer * tf,
          const nav2_util::LifecycleNode::WeakPtr & node, rclcpp::CallbackGroup::SharedPtr group)
        {
          name_ = name;
          node_ = node;
          onInitialize();
        }
        void Layer::declareParameter(const std::string & param, const rclcpp::ParameterValue & value) {
          auto node = node_.lock();
          nav2_util::declare_parameter_if_not_declared(node, name_ + "." + param, value);
        }
        }
        """,
    "src/plugins.cpp": """
        #include "nav/layer.hpp"
        namespace nav {
        using nav2_util::declare_parameter_if_not_declared;
        class Planner : public nav2_core::GlobalPlanner {
        public:
          void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, std::string name,
            std::shared_ptr<tf2_ros::Buffer> tf, std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) override
          {
            auto node = parent.lock();
            declare_parameter_if_not_declared(node, name + ".tolerance", rclcpp::ParameterValue(0.5));
            node->declare_parameter("of_the_node", 1);
          }
        };
        class Obstacles : public Layer {
        public:
          void onInitialize() override {
            declareParameter("sources", rclcpp::ParameterValue(std::string("")));
            auto node = node_.lock();
            std::string sources;
            node->get_parameter(name_ + "." + "sources", sources);
            std::stringstream stream(sources);
            std::string source;
            while (stream >> source) {
              declareParameter(source + "." + "topic", rclcpp::ParameterValue(source));
            }
          }
          void activate() override { declareParameter("late", rclcpp::ParameterValue(true)); }
        };
        class Critic : public dwb_core::TrajectoryCritic {
        public:
          void initialize(const nav2_util::LifecycleNode::SharedPtr & node, const std::string & name,
            const std::string & space, std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap)
          {
            node->declare_parameter(space + "." + name + ".scale", 1.0);
            node->declare_parameter(space + ".speed", 1.0);
          }
        };
        }
        """,
}


@pytest.fixture
def analysis(tmp_path: Path) -> SourceAnalysis:
    return _analysis(tmp_path, FILES)


def _analysis(folder: Path, files: Mapping[str, str]) -> SourceAnalysis:
    for name, text in files.items():
        path = folder / "src" / "nav" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return SourceAnalysis(detect_environment(str(folder), {}, root=str(folder / "nothing")), Sources())


def test_those_that_can_be_read(analysis: SourceAnalysis) -> None:
    assert analysis.plugins("nav") == ("nav::Planner", "nav::Obstacles", "nav/Critic")
    assert analysis.plugins("nobody") == ()


@pytest.mark.parametrize(
    ("name", "params"),
    [
        ("nav::Planner", {"tolerance": 0.5}),
        ("nav/Planner", {"tolerance": 0.5}),
        ("nav::Obstacles", {"sources": "", "late": True, "{sources}.topic": None}),
        ("nav::Critic", {"scale": 1.0, "../speed": 1.0}),
    ],
)
def test_what_a_plugin_declares_below_its_name(analysis: SourceAnalysis, name: str, params: object) -> None:
    found = plugin_params(analysis, name)
    assert found is not None
    assert {param: use.default for param, use in found.items()} == params


@pytest.mark.parametrize(
    "body", ["exit(1);", "while (true) { made_of(Tree()); }", "int Tree::*x = 0; ((((", "Tree tree; Tree other(tree);"]
)
def test_what_a_plugin_is_given_may_be_anything(tmp_path: Path, body: str) -> None:
    source = """
        namespace nav {
        struct Tree { Tree() { BODY } Tree left() { return Tree().left(); } };
        class Planner : public nav2_core::GlobalPlanner {
        public:
          void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, std::string name, Tree tree, int *)
          {
            parent.lock()->declare_parameter(name + ".tolerance", tree.left());
          }
        };
        }
        """
    found = plugin_params(
        _analysis(tmp_path, {**FILES, "src/plugins.cpp": source.replace("BODY", body)}), "nav::Planner"
    )
    assert found is None or found.keys() <= {"tolerance"}


@pytest.mark.parametrize("name", ["nav::Panel", "nav::Gone", "gone::Planner", "", "/", "::", "nav"])
def test_what_is_no_plugin_that_is_known(analysis: SourceAnalysis, name: str) -> None:
    assert plugin_params(analysis, name) is None

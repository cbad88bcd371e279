"""What controllers of ros2_control do, read from their source."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.source.analyse import SourceAnalysis, SourceKey
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.workspace.sources import Sources

FILES = {
    "package.xml": "<package><name>drive</name><export><build_type>ament_cmake</build_type></export></package>",
    "CMakeLists.txt": """
        project(drive)
        generate_parameter_library(drive_parameters src/drive.yaml)
        add_library(drive SHARED src/drive.cpp)
        pluginlib_export_plugin_description_file(controller_interface drive.xml)
        """,
    "drive.xml": """
        <library path="drive">
          <class name="drive/Drive" type="drive::Drive" base_class_type="controller_interface::{base}"/>
          <class name="drive/Else" type="drive::Else" base_class_type="else::Base"/>
        </library>
        """,
    "src/drive.yaml": """
drive:
  topic: {type: string, default_value: cmd_vel}
  wheels: {type: string_array, default_value: []}
        """,
    "src/drive.cpp": """
        #include "controller_interface/controller_interface.hpp"
        #include "std_msgs/msg/string.hpp"
        #include "drive/drive_parameters.hpp"
        namespace drive {
        class Drive : public controller_interface::{base} {
        public:
          controller_interface::CallbackReturn on_init() override {
            listener_ = std::make_shared<ParamListener>(get_node());
            params_ = listener_->get_params();
            return CallbackReturn::SUCCESS;
          }
          controller_interface::CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {
            if (params_.wheels.empty()) { return CallbackReturn::ERROR; }
            sub_ = get_node()->create_subscription<std_msgs::msg::String>("~/" + params_.topic, 1, [](auto) {});
            pub_ = get_node()->create_publisher<std_msgs::msg::String>(
              std::string(get_node()->get_name()) + "/state", 1);
            return CallbackReturn::SUCCESS;
          }
          std::shared_ptr<ParamListener> listener_;
          Params params_;
        };
        }
        """,
}


@pytest.mark.parametrize("base", ["ControllerInterface", "ChainableControllerInterface"])
def test_what_a_controller_makes_once_it_is_configured(tmp_path: Path, base: str) -> None:
    for name, text in FILES.items():
        path = tmp_path / "src" / "drive" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace("{base}", base))
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    analysis = SourceAnalysis(environment, Sources())
    assert analysis.controllers("drive") == ("drive/Drive",)
    key = SourceKey(None, None, "drive", "", "drive/Drive", "/base", "", ())
    (unset,) = analysis.read_each([key], LaunchParams({}))
    assert unset is not None
    assert [use.name for use in unset.params] == ["~topic", "~wheels"]
    assert [end.name for end in unset.endpoints if not end.builtin] == [], "it gives up"
    (found,) = analysis.read_each([key], LaunchParams({"/base/wheels": ["a"]}))
    assert found is not None
    assert [(end.role, end.name, end.type) for end in found.endpoints if not end.builtin] == [
        ("subscriber", "~/cmd_vel", "std_msgs/msg/String"),
        ("publisher", "base/state", "std_msgs/msg/String"),
    ]
    assert analysis.read_each([key._replace(plugin="drive/Else")], LaunchParams({})) == [None]
    assert analysis.read_each([key._replace(plugin="drive/Gone")], LaunchParams({})) == [None]

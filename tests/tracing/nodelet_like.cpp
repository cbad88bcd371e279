// The program of package nodelet and a nodelet of its, without what is needed to build real ones: class_loader.
// Built twice: with LIBRARY as what libnodeletlib is, which the program is linked with, and without as the program.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_srvs/Empty.h>

namespace nodelet {
class Loader {
 public:
  bool load(const std::string& name, const std::string& type, const ros::M_string& remaps, const ros::V_string& argv);
};

#ifdef LIBRARY
bool Loader::load(const std::string& name, const std::string& type, const ros::M_string& remaps,
                  const ros::V_string& argv) {
  static ros::NodeHandle own(name, remaps), beside(ros::names::parentNamespace(name), remaps), process, private_("~");
  static std::vector<ros::Publisher> kept;
  double value = 0;
  kept.push_back(own.advertise<std_msgs::String>("image", 1));
  kept.push_back(beside.advertise<std_msgs::String>("camera_info", 1));
  own.getParam("rate", value);
  beside.getParam("shared", value);
  if (type == "vision/OfProcess") {
    kept.push_back(private_.advertise<std_msgs::String>("of_process", 1));
    kept.push_back(process.advertise<std_msgs::String>(ros::this_node::getName() + "/made", 1));
    kept.push_back(process.advertise<std_msgs::String>("relative", 1));
    private_.getParam("gain", value);
    ros::param::get("~offset", value);
    ros::param::get("level", value);
  }
  if (type == "vision/Waits") {
    ros::service::waitForService("start");
    kept.push_back(own.advertise<std_msgs::String>("after", 1));
  }
  return true;
}
#endif
}  // namespace nodelet

#ifndef LIBRARY
int main(int argc, char** argv) {
  ros::init(argc, argv, "nodelet", ros::init_options::AnonymousName);
  if (argc < 3 || std::string(argv[1]) != "standalone") return 3;
  ros::NodeHandle handle;
  nodelet::Loader loader;
  if (!loader.load(ros::this_node::getName(), argv[2], ros::M_string(), ros::V_string())) return 4;
  ros::spin();
}
#endif

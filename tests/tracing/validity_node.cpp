// A node that depends on something of each kind: a library that it links, one that it loads, files, parameters.
#include <dlfcn.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <cstdio>
#include <fstream>
#include <string>

std::string linked_name();  // of liblinked.so

int main(int argc, char** argv) {
  ros::init(argc, argv, "node");
  ros::NodeHandle node, own("~");
  std::string folder = std::string(argv[0]).substr(0, std::string(argv[0]).rfind('/')), name, found;
  std::ifstream(folder + "/config.txt") >> name;
  if (std::FILE* more = std::fopen((folder + "/more.txt").c_str(), "r")) std::fclose(more);
  std::ifstream(folder + "/absent.txt") >> name;

  own.param<std::string>("frame", name, "base");
  own.hasParam("asked");
  node.searchParam("robot_name", found);
  std::map<std::string, std::string> gains;
  own.getParam("gains", gains);

  void* plugin = dlopen((folder + "/libplugin.so").c_str(), RTLD_NOW);
  ros::Publisher linked = node.advertise<std_msgs::String>(linked_name(), 1);
  ros::Publisher loaded = node.advertise<std_msgs::String>(plugin == nullptr ? "none" : "plugin", 1);
  ros::spin();
}

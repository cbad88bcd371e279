// A node that makes one of everything; its first argument says how it goes on.
#include <actionlib/TestAction.h>
#include <actionlib/client/simple_action_client.h>
#include <ros/ros.h>
#include <ros/topic.h>
#include <std_msgs/String.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>

#include <thread>

bool serve(std_srvs::SetBool::Request&, std_srvs::SetBool::Response&) { return true; }
void heard(const std_msgs::String::ConstPtr&) {}

int main(int argc, char** argv) {
  ros::init(argc, argv, "node");
  std::string mode = argc > 1 ? argv[1] : "spin", text;
  std::vector<double> gains;
  ros::NodeHandle node, own("~"), arm("arm"), grip(arm, "grip"), fixed("/fixed"), below(own, "below");

  double rate = own.param("rate", 10.0);
  node.getParam("text", text);
  fixed.getParam("gains", gains);
  ros::param::get("~free", text);
  ros::param::param<int>("~preset", 3);
  own.getParamCached("cached", rate);

  ros::Publisher chatter = node.advertise<std_msgs::String>("chatter", 7, true);
  ros::Publisher state = own.advertise<std_msgs::String>("state", 1);
  ros::Publisher plain = fixed.advertise<std_msgs::String>("plain", 1);
  ros::Publisher closed = grip.advertise<std_msgs::String>("closed", 1);
  ros::Publisher absolute = node.advertise<std_msgs::String>("/absolute", 1);
  ros::Publisher deep = below.advertise<std_msgs::String>("deep", 1);
  ros::Subscriber subscriber = node.subscribe("chatter", 3, heard);
  ros::ServiceServer server = own.advertiseService("enable", serve);
  ros::ServiceClient client = node.serviceClient<std_srvs::SetBool>("switch");
  ros::Timer timer = node.createTimer(ros::Duration(0.1), [](const ros::TimerEvent&) {});
  ros::Publisher late;

  if (mode == "spin") ros::spin();
  if (mode == "multi") ros::MultiThreadedSpinner(2).spin();
  if (mode == "async") {
    ros::AsyncSpinner spinner(2);
    spinner.start();
    late = node.advertise<std_msgs::String>("late", 1);
    ros::waitForShutdown();
  }
  if (mode == "rate") {
    for (ros::Rate turns(20); ros::ok(); turns.sleep()) ros::spinOnce();
  }
  if (mode == "duration") {
    while (ros::ok()) ros::Duration(0.05).sleep();
  }
  if (mode == "pause") {
    ros::Duration(0.5).sleep();
    late = node.advertise<std_msgs::String>("late", 1);
    ros::spin();
  }
  if (mode == "thread") {
    std::thread other([&] {
      ros::WallDuration(0.15).sleep();
      late = node.advertise<std_msgs::String>("late", 1);
      ros::WallDuration(20).sleep();
    });
    ros::spin();
  }
  bool there = (mode == "service" && ros::service::waitForService("switch")) ||
               (mode == "milliseconds" && ros::service::waitForService("switch", 60000)) ||
               (mode == "existence" && client.waitForExistence());
  if (there) {
    late = node.advertise<std_msgs::String>("late", 1);
    ros::spin();
  }
  std_srvs::SetBool call;
  if (mode == "call" && !client.call(call) && client.waitForExistence() && client.call(call) && call.response.success &&
      call.response.message.empty()) {
    late = node.advertise<std_msgs::String>("late", 1);
    ros::spin();
  }
  if (mode == "action") {
    actionlib::SimpleActionClient<actionlib::TestAction> mover("move", true);
    if (mover.waitForServer()) {
      late = node.advertise<std_msgs::String>("late", 1);
      ros::spin();
    }
  }
  if (mode == "own_service" && ros::service::waitForService(server.getService())) ros::spin();
  if (mode == "message") ros::topic::waitForMessage<std_msgs::String>("news", node);
  if (mode == "invalid") own.advertise<std_msgs::String>("~x", 1);
  return 3;
}

// A node that waits for somebody who is not there, in the way that its first argument says, and then goes on.
#include <actionlib/TestAction.h>
#include <actionlib/client/simple_action_client.h>
#include <actionlib/server/simple_action_server.h>
#include <ros/ros.h>
#include <ros/topic.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>
#include <tf/transform_broadcaster.h>
#include <tf/transform_listener.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

typedef actionlib::SimpleActionClient<actionlib::TestAction> Client;
typedef actionlib::SimpleActionServer<actionlib::TestAction> Server;

int heard = 0;
bool ready = false;
void hear(const std_msgs::String::ConstPtr&) { ++heard; }
void be_ready(const std_msgs::Bool::ConstPtr& said) { ready = said->data; }
void hear_numbers(const std_msgs::Float64MultiArray::ConstPtr&) { ++heard; }

int main(int argc, char** argv) {
  ros::init(argc, argv, "node");
  std::string mode = argc > 1 ? argv[1] : "";
  ros::NodeHandle node;
  ros::Publisher before = node.advertise<std_msgs::String>("before", 1), after;

  if (mode == "message" || mode == "timeout" || mode == "own_message") {
    if (mode == "own_message") {
      before = node.advertise<std_msgs::String>("goal", 1, true);
      before.publish(std_msgs::String());
    }
    auto said = ros::topic::waitForMessage<std_msgs::String>("goal", node, ros::Duration(mode == "timeout" ? 30 : 0));
    if (said->data != "") return 3;
  }
  ros::Subscriber listener;
  if (mode == "twice") {
    listener = node.subscribe("goal", 1, hear);
    for (int i = 0; i < 2; ++i) {
      ros::topic::waitForMessage<std_msgs::String>("goal", node);
      ros::Duration(1.0).sleep();  // longer than messages are on their way
    }
  }
  if (mode == "agreed" && !ros::topic::waitForMessage<std_msgs::Bool>("ready", node)->data) return 3;
  if (mode == "rate" || mode == "slow") {
    ros::Subscriber subscriber = node.subscribe("news", 1, hear);
    for (ros::Rate turns(mode == "slow" ? 2 : 50); ros::ok() && heard < (mode == "slow" ? 1 : 5); turns.sleep())
      ros::spinOnce();
  }
  if (mode == "ready") {
    ros::Subscriber subscriber = node.subscribe("ready", 1, be_ready);
    while (ros::ok() && !ready) {
      ros::spinOnce();
      ros::Duration(0.05).sleep();
    }
  }
  if (mode == "thread") {
    ros::AsyncSpinner spinner(1);
    spinner.start();
    ros::Subscriber subscriber = node.subscribe("numbers", 1, hear_numbers);
    while (ros::ok() && heard == 0) ros::WallDuration(0.05).sleep();
  }
  if (mode == "work" || mode == "fragile" || mode == "publish") {
    listener = node.subscribe<std_msgs::String>("news", 1, [&](const std_msgs::String::ConstPtr& said) {
      if (mode == "fragile") abort();
    });
    for (ros::Rate turns(20); ros::ok(); turns.sleep()) {
      if (mode == "publish") before.publish(std_msgs::String());
      ros::spinOnce();
    }
  }
  if (mode == "parameter") {
    double rate = 0;
    while (ros::ok() && !node.getParam("rate", rate)) ros::Duration(0.05).sleep();
    if (rate <= 0) return 3;
  }
  if (mode == "has") {
    while (!ros::param::has("~ready")) ros::WallDuration(0.05).sleep();
    if (!ros::param::has("~ready")) return 3;
  }
  if (mode == "optional") {
    double gain = 2;
    for (ros::Rate turns(20); ros::ok(); turns.sleep()) {
      node.getParam("gain", gain);
      ros::spinOnce();
    }
  }
  if (mode == "exists") {
    ros::ServiceClient client = node.serviceClient<std_srvs::Trigger>("start");
    while (ros::ok() && !client.exists()) ros::Duration(0.05).sleep();
    std_srvs::Trigger call;
    if (!client.call(call) || !call.response.success) return 3;
  }
  if (mode == "calls") {
    ros::ServiceClient client = node.serviceClient<std_srvs::Trigger>("start");
    std_srvs::Trigger call;
    while (ros::ok() && !client.call(call)) ros::Duration(0.05).sleep();
  }
  if (mode == "calling") {
    ros::ServiceClient client = node.serviceClient<std_srvs::Trigger>("start");
    std_srvs::Trigger call;
    for (ros::Rate turns(20); ros::ok(); turns.sleep()) {
      if (client.exists()) client.call(call);
      client.call(call);
    }
  }
  if (mode == "clock") ros::Time::waitForValid();
  if (mode == "clock_sleep") ros::Duration(0.2).sleep();
  if (mode == "clock_loop") {
    while (ros::ok() && ros::Time::now().isZero()) {
      ros::spinOnce();
      ros::WallDuration(0.02).sleep();
    }
  }
  if (mode == "result" || mode == "callback" || mode == "goals") {
    Client client("move", true);
    client.waitForServer();
    if (mode == "goals") {
      client.sendGoal(actionlib::TestGoal());
      if (!client.waitForResult()) return 3;
    }
    bool done = false;
    client.sendGoal(actionlib::TestGoal(), [&](const actionlib::SimpleClientGoalState&,
                                               const actionlib::TestResultConstPtr&) { done = true; });
    if (mode == "result" && !client.waitForResult()) return 3;
    while (ros::ok() && !done) ros::WallDuration(0.02).sleep();
    if (client.getState() != actionlib::SimpleClientGoalState::SUCCEEDED) return 3;
  }
  if (mode == "server") {
    Server server(node, "move", [](const actionlib::TestGoalConstPtr&) {}, false);
    server.start();
    ros::spin();
  }
  if (mode == "lookup" || mode == "can" || mode == "fixed" || mode == "poll" || mode == "poll_can" ||
      mode == "own_tf" || mode == "no_listener") {
    tf2_ros::Buffer buffer;
    std::unique_ptr<tf2_ros::TransformListener> transforms;
    if (mode != "no_listener") transforms.reset(new tf2_ros::TransformListener(buffer));
    geometry_msgs::TransformStamped found;
    if (mode == "own_tf") {
      tf2_ros::StaticTransformBroadcaster broadcaster;
      found.header.frame_id = "map";
      found.child_frame_id = "base";
      found.transform.rotation.w = 1;
      found.transform.translation.x = 5;
      broadcaster.sendTransform(found);
      if (buffer.lookupTransform("map", "base", ros::Time(0), ros::Duration(20)).transform.translation.x != 5) return 3;
    }
    if (mode == "lookup") found = buffer.lookupTransform("map", "base", ros::Time(0), ros::Duration(20));
    if (mode == "can" && !buffer.canTransform("map", "base", ros::Time::now(), ros::Duration(0.2))) return 3;
    if (mode == "fixed") {
      ros::Time now = ros::Time::now();
      found = buffer.lookupTransform("map", now, "base", now, "odom", ros::Duration(20));
    }
    if (mode == "no_listener" && buffer.canTransform("map", "base", ros::Time(0), ros::Duration(20))) return 3;
    while (mode == "poll" && found.child_frame_id.empty()) {
      try {
        found = buffer.lookupTransform("map", "base", ros::Time(0));
      } catch (const tf2::TransformException&) {
        ros::Duration(0.05).sleep();
      }
    }
    while (mode == "poll_can" && !buffer.canTransform("map", "base", ros::Time(0))) ros::WallDuration(0.05).sleep();
  }
  if (mode == "tf") {
    tf::TransformListener transforms;
    tf::StampedTransform found;
    if (!transforms.waitForTransform("map", "base", ros::Time(0), ros::Duration(20))) return 3;
    transforms.lookupTransform("map", "base", ros::Time(0), found);
  }
  tf::TransformBroadcaster moving;
  tf2_ros::StaticTransformBroadcaster still;
  if (mode == "frames") {
    moving.sendTransform(tf::StampedTransform(tf::Transform::getIdentity(), ros::Time::now(), "odom", "base"));
    std::vector<geometry_msgs::TransformStamped> all(2);
    all[0].header.frame_id = all[1].header.frame_id = "base";
    all[0].child_frame_id = "laser";
    all[1].child_frame_id = "camera";
    still.sendTransform(all);
    ros::spin();
  }

  after = node.advertise<std_msgs::String>("after", 1);
  ros::spin();
  return 0;
}

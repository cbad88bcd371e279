// The types of roscpp, tf2 and boost as far as they are read here.
#pragma once

#include <string.h>

#include <cstdint>
#include <string>

#include "../preload.hpp"

namespace preflight {

#define STRING "RKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"

bool is_watched(const char* library) { return starts_with(library, "libros") || starts_with(library, "libtf2"); }

struct NodeHandle {
  std::string name_space;  // resolved
  std::string given_name_space;
};

// What returns by value (Publisher, Subscriber, ServiceServer, ServiceClient, Timer) is a boost::shared_ptr inside.
// A copy constructor and destructor of its own make it be returned through a hidden pointer, as the real ones are.
struct Handle {
  Handle(const Handle& other) { memcpy(parts, other.parts, sizeof parts); }
  ~Handle() {}  // NOLINT(modernize-use-equals-default): that one would be trivial
  void* parts[2];
};

// ros::AdvertiseOptions and ros::SubscribeOptions begin alike.
struct TopicOptions {
  std::string topic;
  uint32_t queue_size;
  std::string md5;
  std::string type;
};

struct ServiceOptions {
  std::string service;
  std::string md5;
  std::string type;
};

// ros::SerializedMessage.
struct Serialized {
  void* buffer;
  void* buffer_count;
  size_t size;
  const unsigned char* start;
  void* message[2];
  const void* type;
};

// boost::function<ros::SerializedMessage()>. The lowest bit of the table's address is a flag.
struct Serializer {
  struct Table {
    void* manager;
    Serialized (*invoke)(const void* function);
  };
  uintptr_t table;
  void* function;

  // The message; its memory is never freed.
  std::string operator()() const {
    const auto* found = reinterpret_cast<const Table*>(table & ~uintptr_t{1});  // NOLINT(performance-no-int-to-ptr)
    if (found == nullptr) return "";
    Serialized made = found->invoke(&function);
    // Its length, of four bytes, stands before it.
    if (made.start == nullptr || made.size < 4) return "";
    return std::string(reinterpret_cast<const char*>(made.start), made.size - 4);
  }
};

// geometry_msgs::TransformStamped.
struct Transform {
  uint32_t sequence = 0, seconds = 0, nanoseconds = 0;
  std::string frame, child;
  double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1};
};

struct ClientOptions {
  std::string service;
  std::string md5;
};

// After the three callbacks (boost::function, 32 bytes each), the tracked object and the queue.
constexpr size_t kLatchOffset = 224;
// The first of the callbacks, told of subscribers: a boost::function begins with a pointer, null where there is none.
constexpr size_t kConnectOffset = 136;

}  // namespace preflight

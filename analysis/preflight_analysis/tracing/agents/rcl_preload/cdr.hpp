// Reads serialized messages.
#pragma once

#include <string.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <type_traits>

#include "types.hpp"

namespace preflight {

// Of a message in CDR, little-endian; what does not fit throws.
class Reader {
 public:
  explicit Reader(const Serialized& message) : at_(message.buffer), end_(message.buffer + message.length) {
    constexpr unsigned char kLittleEndian[] = {0, 1};
    if (message.length < 4 || memcmp(at_, kLittleEndian, sizeof kLittleEndian) != 0) throw std::exception();
    at_ += 4;
    begin_ = at_;
  }

  template <typename Value>
  Value value() {
    at_ += (sizeof(Value) - (at_ - begin_) % sizeof(Value)) % sizeof(Value);
    Value read;
    memcpy(&read, bytes(sizeof read), sizeof read);
    return read;
  }

  std::string string() {
    auto length = value<uint32_t>();
    const auto* start = reinterpret_cast<const char*>(bytes(length));
    return std::string(start, length == 0 ? 0 : length - 1);
  }

  template <typename Read>
  std::string list(Read read) {
    std::string made;
    for (auto left = value<uint32_t>(); left > 0; --left) made += (made.empty() ? "" : ",") + read();
    return "[" + made + "]";
  }

 private:
  const unsigned char* bytes(size_t count) {
    if (static_cast<size_t>(end_ - at_) < count || at_ > end_) throw std::exception();
    return (at_ += count) - count;
  }

  const unsigned char *begin_ = nullptr, *at_, *end_;
};

// The types of rcl_interfaces/msg/ParameterType by their number.
constexpr const char* kTypes[] = {"",           "bool",       "integer",       "double",       "string",
                                  "byte array", "bool array", "integer array", "double array", "string array"};

struct Value {
  std::string type, json;  // empty where it has none, or one that JSON has not
};

// rcl_interfaces/msg/ParameterValue.
Value value_of(Reader& from) {
  bool whole = true;
  auto boolean = [&] { return std::string(from.value<uint8_t>() != 0 ? "true" : "false"); };
  auto integer = [&] { return std::to_string(from.value<int64_t>()); };
  auto number = [&] {
    auto value = from.value<double>();
    whole = whole && std::isfinite(value);
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    return strpbrk(text, ".en") != nullptr ? std::string(text) : std::string(text) + ".0";
  };
  auto string = [&] { return quoted(from.string()); };
  auto byte = [&] { return std::to_string(from.value<uint8_t>()); };
  auto type = from.value<uint8_t>();
  const std::string values[] = {"",
                                boolean(),
                                integer(),
                                number(),
                                string(),
                                from.list(byte),
                                from.list(boolean),
                                from.list(integer),
                                from.list(number),
                                from.list(string)};
  if (type >= sizeof values / sizeof *values) return {};
  return {kTypes[type], whole || (type != 3 && type != 8) ? values[type] : ""};
}

// The next range of a descriptor, of `from_value`, `to_value` and `step`.
template <typename Number>
std::string json_of(Reader& from) {
  std::string made;
  for (int i = 0; i < 3; ++i) {
    char text[400] = "null";  // what JSON has not
    auto number = static_cast<double>(from.value<Number>());
    const char* format = std::is_same_v<Number, double> ? "%.17g" : "%.0f";
    if (std::isfinite(number)) snprintf(text, sizeof text, format, number);
    made += (made.empty() ? "" : ",") + std::string(text);
  }
  return "[" + made + "]";
}

// The CDR of a message; without a buffer where it cannot be had.
struct Owned {
  Serialized bytes;
  Owned(const void* message, const Support* support) {
    auto* serialize = REAL_IF_ANY("rmw_serialize", int(const void*, const Support*, Serialized*));
    auto* allocator = REAL_IF_ANY("rcutils_get_default_allocator", Allocator());
    if (serialize == nullptr || allocator == nullptr || support == nullptr) return;
    bytes.allocator = allocator();
    int result = serialize(message, support, &bytes);
    reset_error();  // of type supports that it tried before it found the right one: the next error would complain of it
    if (result != kOk) bytes.length = 0;
  }
  ~Owned() { free(bytes.buffer); }
  Owned(const Owned&) = delete;
};

}  // namespace preflight

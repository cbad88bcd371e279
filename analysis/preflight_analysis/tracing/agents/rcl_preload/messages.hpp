// Makes messages by the node's own type supports.
#pragma once

#include <vector>

#include "types.hpp"

namespace preflight {

// A message, as its own type support makes it.
class Message {
 public:
  explicit Message(const Members* members) : members_(members), memory_(members->size) {
    reinterpret_cast<void (*)(void*, int)>(const_cast<void*>(members->tail()[1]))(memory_.data(), 0);
  }
  ~Message() { reinterpret_cast<void (*)(void*)>(const_cast<void*>(members_->tail()[2]))(memory_.data()); }
  Message(const Message&) = delete;

  void* get() { return memory_.data(); }

  // Yes to each yes or no: a service that fails leads nowhere.
  void agree() {
    const auto* member = static_cast<const Member*>(members_->tail()[0]);
    bool flagged = members_->tail() != members_->rest;
    for (uint32_t i = 0; i < members_->count; ++i) {
      if (i > 0) member = member->next();
      if (member->type == kBoolean && !member->flags[flagged]) memory_[member->offset] = 1;
    }
  }

 private:
  const Members* members_;
  std::vector<unsigned char> memory_;
};

const ServiceMembers* members_of(const Support* support) {
  for (const char* identifier : {kSupports[2], kSupports[3]}) {
    // It has to be the language of the node's own: of the other one there is none.
    const Support* special = found(support, identifier);
    const auto* members = special == nullptr ? nullptr : static_cast<const ServiceMembers*>(special->data);
    constexpr size_t kMost = 1 << 20;
    if (members != nullptr && members->request->size < kMost && members->response->size < kMost) return members;
  }
  return nullptr;
}

}  // namespace preflight

#pragma once
#include <vector>

#include "aria/key_handler.h"

namespace robosim {

/// Keys of a KeyHandler that one action uses, until it releases them or is destroyed.
class ClaimedKeys {
 public:
  ClaimedKeys() = default;
  ClaimedKeys(const ClaimedKeys&) = delete;
  ClaimedKeys& operator=(const ClaimedKeys&) = delete;
  ~ClaimedKeys() { release(); }

  struct Binding {
    int key;
    Functor functor;
  };
  /// Takes those of the keys that have no function yet. Without effect while it has keys of this handler.
  /// @param handler must outlive this; null for none
  void claim(KeyHandler* handler, const std::vector<Binding>& bindings) {
    if (!handler || handler == handler_) return;
    release();
    handler_ = handler;
    for (const Binding& binding : bindings) {
      if (handler->addKeyHandler(binding.key, binding.functor)) keys_.push_back(binding.key);
    }
  }
  void release() {
    for (const int key : keys_) handler_->remKeyHandler(key);
    keys_.clear();
    handler_ = nullptr;
  }

 private:
  KeyHandler* handler_ = nullptr;
  std::vector<int> keys_;
};

}  // namespace robosim

#pragma once
#include <functional>
#include <map>
#include <vector>

#include "aria/functor.h"
#include "aria/key_source.h"

namespace robosim {

/// Calls functions for keys, as ARIA's ArKeyHandler. PioneerRobot::attachKeyHandler() checks the keys once per step.
class KeyHandler {
 public:
  /// Keys that are no characters; a character's key is its code.
  enum Key {
    SPACE = 32,
    TAB = 9,
    ENTER = 10,
    ESCAPE = 27,
    BACKSPACE = 127,
    UP = 256,
    DOWN,
    RIGHT,
    LEFT,
    HOME,
    END,
    INSERT,
    DEL,
    PAGEUP,
    PAGEDOWN,
    F1,
    F2,
    F3,
    F4
  };

  /// @param source must outlive this.
  explicit KeyHandler(KeySource& source) : source_(source) {}

  /// @return false, without effect, when the key has a function already
  bool addKeyHandler(int key, Functor functor);
  bool remKeyHandler(int key);  ///< @return false when the key has no function
  bool hasKeyHandler(int key) const { return handlers_.count(key) > 0; }

  /// Calls the functions of all keys that have been typed since the last call.
  void checkKeys();

 private:
  int decode(const std::vector<char>& bytes, std::size_t& at) const;

  KeySource& source_;
  std::map<int, Functor> handlers_;
};

}  // namespace robosim

#include "aria/key_handler.h"

#include <string_view>

namespace robosim {
namespace {

struct Sequence {
  std::string_view bytes;  ///< after ESC
  int key;
};

/// What terminals of the VT100 family and xterm send.
constexpr Sequence kSequences[]{
    {"[A", KeyHandler::UP},      {"[B", KeyHandler::DOWN}, {"[C", KeyHandler::RIGHT},   {"[D", KeyHandler::LEFT},
    {"OA", KeyHandler::UP},      {"OB", KeyHandler::DOWN}, {"OC", KeyHandler::RIGHT},   {"OD", KeyHandler::LEFT},
    {"[H", KeyHandler::HOME},    {"[F", KeyHandler::END},  {"[1~", KeyHandler::HOME},   {"[4~", KeyHandler::END},
    {"[2~", KeyHandler::INSERT}, {"[3~", KeyHandler::DEL}, {"[5~", KeyHandler::PAGEUP}, {"[6~", KeyHandler::PAGEDOWN},
    {"OP", KeyHandler::F1},      {"OQ", KeyHandler::F2},   {"OR", KeyHandler::F3},      {"OS", KeyHandler::F4}};

}  // namespace

bool KeyHandler::addKeyHandler(int key, Functor functor) { return handlers_.emplace(key, std::move(functor)).second; }

bool KeyHandler::remKeyHandler(int key) { return handlers_.erase(key) > 0; }

int KeyHandler::decode(const std::vector<char>& bytes, std::size_t& at) const {
  const auto byte = static_cast<unsigned char>(bytes[at++]);
  if (byte == '\r') return ENTER;
  if (byte == '\b') return BACKSPACE;
  if (byte != ESCAPE) return byte;
  const std::string_view rest(bytes.data() + at, bytes.size() - at);
  for (const Sequence& sequence : kSequences) {
    if (!rest.starts_with(sequence.bytes)) continue;
    at += sequence.bytes.size();
    return sequence.key;
  }
  return ESCAPE;
}

void KeyHandler::checkKeys() {
  source_.startStep();
  std::vector<char> bytes;
  while (const auto byte = source_.next()) bytes.push_back(*byte);
  for (std::size_t at = 0; at < bytes.size();) {
    const auto handler = handlers_.find(decode(bytes, at));
    if (handler == handlers_.end()) continue;
    const Functor functor = handler->second;  // it may remove itself
    functor();
  }
}

}  // namespace robosim

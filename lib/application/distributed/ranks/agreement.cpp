#include "distributed/ranks/agreement.h"

#include <atomic>
#include <stdexcept>

#include "base/error_list.h"
#include "base/interrupt.h"

namespace robosim {
namespace {

enum Kind : char { bad_input = 'b', interrupted = 'i', failed = 'f' };

std::atomic<bool> has_agreed = false;
std::atomic<bool> failure_is_shared = false;

[[noreturn]] void throwAs(char kind, const std::string& text) {
  if (kind == bad_input) throw ConfigError(text);
  if (kind == interrupted) throw Interrupted(text);
  throw std::runtime_error(text);
}

}  // namespace

std::string errorBytes(const std::exception_ptr& error) {
  if (!error) return {};
  try {
    std::rethrow_exception(error);
  } catch (const ConfigError& e) {
    return std::string(1, bad_input) + e.what();
  } catch (const std::invalid_argument& e) {
    return std::string(1, bad_input) + e.what();
  } catch (const Interrupted& e) {
    return std::string(1, interrupted) + e.what();
  } catch (const std::exception& e) {
    return std::string(1, failed) + e.what();
  } catch (...) {
    return std::string(1, failed) + "an exception that is not a std::exception";
  }
}

void throwFirstError(const RankGroup& group, const std::vector<std::string_view>& errors,
                     const std::exception_ptr& own) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].empty()) continue;
    failure_is_shared = true;
    if (static_cast<int>(i) == group.rank() && own) std::rethrow_exception(own);
    std::string text(errors[i].substr(1));
    if (i > 0) text += " (on rank " + std::to_string(i) + ")";
    throwAs(errors[i][0], text);
  }
}

void agree(RankGroup& group, const std::function<void()>& function) {
  has_agreed = true;
  std::exception_ptr own;
  try {
    function();
  } catch (...) {
    own = std::current_exception();
  }
  if (group.size() == 1) {
    if (own) std::rethrow_exception(own);
    return;
  }
  std::vector<std::string> errors;
  group.allGather(errorBytes(own), errors);
  throwFirstError(group, {errors.begin(), errors.end()}, own);
}

bool hasAgreed() { return has_agreed; }
bool isFailureShared() { return failure_is_shared; }
void setFailureShared() { failure_is_shared = true; }

}  // namespace robosim

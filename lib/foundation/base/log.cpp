#include "base/log.h"

#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "base/printable_text.h"

namespace robosim {
namespace {

constexpr std::array<std::string_view, 4> kNames{"debug", "info", "warning", "error"};
constexpr std::array kLevels{spdlog::level::debug, spdlog::level::info, spdlog::level::warn, spdlog::level::err};

spdlog::logger* newLogger() {
  auto* const logger = new spdlog::logger("robosim", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%v");
  logger->set_level(spdlog::level::info);
  const char* const name = std::getenv("ROBOSIM_LOG_LEVEL");
  bool is_known = !name;
  for (std::size_t i = 0; name && i < kNames.size(); ++i) {
    if (kNames[i] != name) continue;
    logger->set_level(kLevels[i]);
    is_known = true;
  }
  if (!is_known) {
    logger->warn("robosim: ROBOSIM_LOG_LEVEL is '{}'; it must be debug, info, warning or error; using info",
                 quotable(name));
  }
  return logger;
}

/// Never destroyed: other threads may log until the process ends.
spdlog::logger& theLogger() {
  static auto* const logger = newLogger();
  return *logger;
}

void write(LogLevel level, const std::string& subcommand, const std::string& text) {
  spdlog::logger& logger = theLogger();
  const auto severity = kLevels[static_cast<std::size_t>(level)];
  if (!logger.should_log(severity)) return;
  logger.log(severity, "robosim{}{}: {}", subcommand.empty() ? "" : " ", subcommand, printableText(text));
}

}  // namespace

void setLogLevel(LogLevel level) { theLogger().set_level(kLevels[static_cast<std::size_t>(level)]); }

void logDebug(const std::string& subcommand, const std::string& text) { write(LogLevel::debug, subcommand, text); }
void logInfo(const std::string& subcommand, const std::string& text) { write(LogLevel::info, subcommand, text); }
void logWarning(const std::string& subcommand, const std::string& text) { write(LogLevel::warning, subcommand, text); }
void logError(const std::string& subcommand, const std::string& text) { write(LogLevel::error, subcommand, text); }

}  // namespace robosim

#pragma once
#include <cstdint>
#include <string>

/// @file
/// The log of this process: records of one line on standard error, "robosim SUBCOMMAND: text". Control characters in
/// the text are escaped (printableText()), so that a text from a file or a peer can neither forge a second record nor
/// control the terminal. Thread-safe, also while the process ends. LogLimiter limits the rate of records that a peer
/// can cause.
namespace robosim {

/// Severity of a record.
enum class LogLevel : std::uint8_t {
  debug,    ///< for developers
  info,     ///< what happens: clients that connect, runs that begin
  warning,  ///< the program continues, and something needs attention
  error,    ///< a request was not carried out
};

/// Discards records below a level. Initially the level is that of the environment variable ROBOSIM_LOG_LEVEL: "debug",
/// "info", "warning" or "error"; "info" if it is not set.
void setLogLevel(LogLevel level);

/// @name Write a record
/// @param subcommand that the record names; empty: the record begins with "robosim: "
///@{
void logDebug(const std::string& subcommand, const std::string& text);
void logInfo(const std::string& subcommand, const std::string& text);
void logWarning(const std::string& subcommand, const std::string& text);
void logError(const std::string& subcommand, const std::string& text);
///@}

}  // namespace robosim

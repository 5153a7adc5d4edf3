#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// What a client may want of an environment.
enum class Right {
  look,     ///< watch the run, and ask how it stands
  drive,    ///< carry robots
  work,     ///< help with the geometry: its results become part of the run
  operate,  ///< start, pause, speed, load, stop
};

/// Who may do what. Each conversation asks first of all. A client shows a token; its role settles its rights: a viewer
/// may look, a robot's process may drive the robots named, an operator may do everything.
class Access {
 public:
  /// Everyone may do everything.
  Access() = default;

  /// Reads a file of tokens: a line `TOKEN ROLE`, the role being `viewer`, `operator`, or `robot` with one or more
  /// names (in double quotes if they have blanks); empty lines and those that begin with # count for nothing. A token
  /// has 16 or more printable ASCII characters without blanks.
  /// @throws ConfigError; no error quotes a token.
  static Access read(const std::filesystem::path& file);
  /// The same from text; `file` names it in errors.
  static Access parse(const std::string& text, const std::string& file);

  /// Whether everyone may do everything.
  bool isOpen() const { return holders_.empty(); }

  /// @param token what the client shows; nullopt for none
  /// @param robots those that it wants to drive; empty when they are not known as yet
  /// @return OK, or UNAUTHENTICATED or PERMISSION_DENIED with what the client is to be told
  grpc::Status check(std::optional<std::string_view> token, Right right,
                     std::span<const std::string> robots = {}) const;
  /// The same for who calls: the token is in the call's metadata, `authorization: Bearer TOKEN`.
  grpc::Status check(const grpc::ServerContextBase& caller, Right right,
                     std::span<const std::string> robots = {}) const;

 private:
  enum class Role { viewer, robot, all };
  struct Holder {
    std::array<unsigned char, 32> token_hash;  ///< SHA-256, so that all are of one length and none is in the memory
    Role role;
    std::vector<std::string> robots;
  };
  const Holder* holderOf(std::string_view token) const;

  std::vector<Holder> holders_;
};

/// The metadata of a call in which a client shows its token, and what stands before the token there.
constexpr const char* kTokenKey = "authorization";
constexpr std::string_view kTokenPrefix = "Bearer ";

}  // namespace robosim

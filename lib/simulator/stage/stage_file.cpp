#include "stage/stage_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "base/error_list.h"
#include "base/nearest_name.h"
#include "base/printable_text.h"

namespace robosim::stage {
namespace {

/// Bounds the time that macros which contain each other take.
constexpr std::size_t kTokensTakenMax = 20'000'000;

class Parser {
 public:
  Parser(const FileProvider& files, StageFile& parsed) : files_(files), parsed_(parsed) {}

  void parse(const std::string& text, const std::string& file) {
    const auto name = std::make_shared<const std::string>(file);
    if (std::find(open_files_.begin(), open_files_.end(), file) != open_files_.end()) {
      throw ConfigError(file + ": includes itself, by way of other files; remove one of the include");
    }
    open_files_.push_back(file);
    const std::vector<Token> tokens = tokenize(text, name);
    const Stream outer = std::exchange(stream_, Stream{&tokens, 0, false});
    parseBody(parsed_.world, 0);
    stream_ = outer;
    open_files_.pop_back();
  }

 private:
  /// Tokens that are being read: of a file, or of the body of a macro.
  struct Stream {
    const std::vector<Token>* tokens = nullptr;
    std::size_t next = 0;
    bool is_macro = false;
  };

  const Token* peek(std::size_t ahead = 0) const {
    return stream_.next + ahead < stream_.tokens->size() ? &(*stream_.tokens)[stream_.next + ahead] : nullptr;
  }
  const Token* take() {
    const Token* token = peek();
    if (!token) return nullptr;
    ++stream_.next;
    if (++taken_ > kTokensTakenMax) fail(token->place, "the macros of the world repeat too much; use fewer of them");
    return token;
  }
  bool isAtEnd() const { return !peek(); }
  bool isNext(TokenKind kind, std::size_t ahead = 0) const { return peek(ahead) && peek(ahead)->kind == kind; }

  [[noreturn]] static void fail(const Place& place, const std::string& what) {
    throw ConfigError(place.text() + ": " + what);
  }

  /// Reads up to the closing parenthesis, or the end of the file at depth 0.
  void parseBody(Entity& entity, int depth) {
    const Place opened = entity.place;
    if (depth > kNestingMax) fail(opened, "entities are nested more than 64 deep");
    while (!isAtEnd()) {
      const Token& token = *take();
      if (token.kind == TokenKind::close_entity) {
        if (depth == 0) fail(token.place, "')' closes nothing; remove it, or add the missing '('");
        return;
      }
      if (token.kind != TokenKind::word) {
        fail(token.place, "'" + quotable(token.text) + "' is not the name of a property or an entity");
      }
      if (token.text == "include" && depth == 0) {
        include(token);
      } else if (token.text == "define" && isNext(TokenKind::word) && isNext(TokenKind::word, 1)) {
        define(token);
      } else if (isNext(TokenKind::open_entity)) {
        take();
        parseEntity(token, depth, entity);
      } else {
        parseProperty(token, entity);
      }
    }
    if (depth > 0) fail(opened, "the '(' of '" + quotable(entity.type) + "' is not closed before the end of the file");
  }

  void parseEntity(const Token& type, int depth, Entity& parent) {
    Entity entity = instance(type, depth + 1);
    entity.place = type.place;
    parseBody(entity, depth + 1);
    parent.children.push_back(std::move(entity));
  }

  /// A macro is expanded where it is used, so that its body may name macros that are defined after it.
  struct Macro {
    Token base;
    std::vector<Token> body;  ///< with the closing parenthesis
  };

  /// An entity of a type or a macro, without its own properties.
  /// @param depth of the entities and macros around it
  Entity instance(const Token& type, int depth) {
    if (depth > kNestingMax)
      fail(type.place, "macros and entities are nested more than 64 deep; does one contain itself?");
    if (++entities_ > kEntitiesMax) {
      fail(type.place, "the world has more than 500,000 entities; does a macro repeat itself?");
    }
    Entity entity;
    if (const auto found = macros_.find(type.text); found != macros_.end()) {
      const Macro& macro = found->second;
      entity = instance(macro.base, depth + 1);
      entity.macros.insert(entity.macros.begin(), type.text);
      entity.type = type.text;
      entity.place = type.place;
      const Stream outer = std::exchange(stream_, Stream{&macro.body, 0, true});
      parseBody(entity, depth + 1);
      stream_ = outer;
      return entity;
    }
    const auto& kinds = entityKinds();
    if (std::find(kinds.begin(), kinds.end(), type.text) == kinds.end()) {
      std::vector<std::string> known = kinds;
      for (const auto& [name, one] : macros_) known.push_back(name);
      fail(type.place, "there is no model or macro '" + quotable(type.text) + "'" + didYouMean(type.text, known) +
                           "; define it before its use, or include the file that does");
    }
    entity.kind = entity.type = type.text;
    entity.place = type.place;
    return entity;
  }

  void define(const Token& keyword) {
    const Token name = *take();
    Macro macro{*take(), {}};
    if (!isNext(TokenKind::open_entity)) {
      fail(keyword.place,
           "define " + quotable(name.text) + " " + quotable(macro.base.text) + ": must be followed by '('");
    }
    take();
    for (int open = 1; open > 0;) {
      const Token* token = take();
      if (!token)
        fail(keyword.place, "the '(' of '" + quotable(name.text) + "' is not closed before the end of the file");
      if (token->kind == TokenKind::open_entity) ++open;
      if (token->kind == TokenKind::close_entity) --open;
      macro.body.push_back(*token);
    }
    macros_.try_emplace(name.text, std::move(macro));  // the first definition is used
  }

  void include(const Token& keyword) {
    if (!isNext(TokenKind::text)) fail(keyword.place, "include must be followed by a \"file\"");
    const Token name = *take();
    while (!isAtEnd() && peek()->place.line == name.place.line) take();  // Stage drops the rest of the line
    if (++includes_ > kIncludesMax || open_files_.size() > kNestingMax) {
      fail(keyword.place, "the world includes too many files, or they include each other; remove an include");
    }
    FoundFile found;
    try {
      found = findStageFile(name.text, files_);
    } catch (const UnreadableFile& error) {
      fail(keyword.place, "include \"" + name.text + "\": " + error.what());
    }
    const std::string path = files_.pathOf(found.name);
    if (std::find(open_files_.begin(), open_files_.end(), path) != open_files_.end()) {
      fail(keyword.place, "include \"" + name.text + "\": the file includes itself, directly or by way of others");
    }
    parse(found.text, path);
  }

  void parseProperty(const Token& name, Entity& entity) {
    // The instances of a macro share its properties. Its tokens stay where they are.
    std::shared_ptr<Property> own;
    auto& shared = stream_.is_macro ? shared_[&name] : own;
    const bool is_known = shared != nullptr;
    const auto property = std::make_shared<Property>();
    if (!is_known) shared = property;
    property->name = name.text;
    property->place = name.place;
    if (isNext(TokenKind::open_tuple)) {
      take();
      while (!isNext(TokenKind::close_tuple)) {
        const Token* value = peek();
        if (!value || (value->kind != TokenKind::number && value->kind != TokenKind::text)) {
          fail(name.place, "the '[' of '" + quotable(name.text) + "' is not closed by ']'");
        }
        property->values.push_back(*value);
        take();
      }
      take();
    } else if (isNext(TokenKind::number) || isNext(TokenKind::text)) {
      property->values.push_back(*take());
    } else {
      fail(name.place, "'" + quotable(name.text) +
                           "' has no value; write a number, a \"string\", [values], or ( ) of " + "an entity after it");
    }
    if (!is_known) parsed_.assignments.push_back(shared);
    entity.properties[name.text] = shared;
  }

  const FileProvider& files_;
  StageFile& parsed_;
  std::map<std::string, Macro> macros_;
  std::map<const Token*, std::shared_ptr<Property>> shared_;  ///< of macros, by their names' tokens
  std::vector<std::string> open_files_;
  Stream stream_;
  std::size_t taken_ = 0;  ///< tokens, of macros each time
  std::size_t entities_ = 0, includes_ = 0;
};

}  // namespace

const std::vector<std::string>& entityKinds() {
  static const std::vector<std::string> kinds{
      "window", "block", "sensor", "model", "position", "ranger", "blobfinder", "fiducial", "gripper", "blinkenlight",
      "camera", "bumper", "actuator", "lightindicator",
      // Of Stage 2 and 3, and of a branch of Stage 4:
      "laser", "sonar", "map", "gps", "truth", "ptz", "vision", "broadcast", "power", "wifi", "loadcell", "puck", "box",
      "bitmap", "gui", "rangefinder", "idar", "speech", "audio", "mote"};
  return kinds;
}

FoundFile findStageFile(const std::string& name, const FileProvider& files) {
  namespace fs = std::filesystem;
  const std::string base = fs::path(name).filename().string();
  std::vector<std::string> names{name};
  if (const char* path = std::getenv("STAGEPATH")) {
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      // Relative ones are relative to the working folder, not to the file.
      if (!folder.empty()) names.push_back((fs::absolute(folder) / base).string());
    }
  }
  names.push_back(base);
  std::string first_error;
  for (const auto& each : names) {
    try {
      return {each, files.read(each)};
    } catch (const UnreadableFile& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  throw UnreadableFile(first_error +
                       "; searched by its base name are also the folders of STAGEPATH and that of the world");
}

StageFile parseStageFile(const std::string& text, const std::string& file, const FileProvider& files) {
  StageFile parsed;
  parsed.world.kind = parsed.world.type = "world";
  Parser(files, parsed).parse(text, file);
  return parsed;
}

}  // namespace robosim::stage

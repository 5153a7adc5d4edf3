#include <map>

#include <sqlite3.h>

#include "bags/bag.h"
#include "base/error_list.h"
#include "base/input_file.h"
#include "base/interrupt.h"

namespace robosim {
namespace {

/// Maximum size of a message [bytes], as of an MCAP file's record.
constexpr int kMaxMessageBytes = 1 << 28;

class SqliteBag final : public BagFile {
 public:
  explicit SqliteBag(const std::filesystem::path& file) : name_(file.string()) {
    if (!InputFile(file).size()) throw ConfigError(name_ + ": is a pipe with a database; give the file itself");
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(name_.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) fail();
    // Of an untrusted file, no views or triggers with functions that have effects.
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMaxMessageBytes);
    constexpr int kInstructionsPerCheck = 100'000;
    sqlite3_progress_handler(
        opened, kInstructionsPerCheck, [](void*) { return Interrupt::signal() != 0 ? 1 : 0; }, nullptr);
    readTopics();
    all_ = prepare("SELECT rowid, topic_id, timestamp, data FROM messages ORDER BY rowid");
    one_ = prepare("SELECT rowid, topic_id, timestamp, data FROM messages WHERE rowid = ?1");
  }

  const std::vector<BagTopic>& topics() const override { return topics_; }
  std::optional<BagMessage> next() override {
    while (step(*all_)) {
      if (auto message = messageOf(*all_)) return message;
    }
    return std::nullopt;
  }
  std::optional<BagMessage> at(const BagPlace& place) override {
    sqlite3_reset(one_.get());
    sqlite3_bind_int64(one_.get(), 1, static_cast<sqlite3_int64>(place.record));
    return step(*one_) ? messageOf(*one_) : std::nullopt;
  }
  std::string fault() const override { return fault_; }
  bool isCutOff() const override { return false; }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  [[noreturn]] void fail() const {
    throwIfInterrupted(name_ + " was not read");
    constexpr int kKind = 0xff;  // without the details
    const int kind = sqlite3_errcode(database_.get()) & kKind;
    const std::string what = kind == SQLITE_ERROR ? "is no database of rosbag2, with the tables topics and messages: "
                                                  : "the database cannot be read: ";
    // Of a bag that was not closed, SQLite writes the index of its log beside it.
    const bool needs_log = kind == SQLITE_READONLY || kind == SQLITE_CANTOPEN;
    throw ConfigError(name_ + ": " + what + sqlite3_errmsg(database_.get()) +
                      (needs_log ? "; copy it to a folder in which files can be created" : ""));
  }
  Statement prepare(const char* query) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), query, -1, &statement, nullptr) != SQLITE_OK) fail();
    return Statement(statement);
  }
  static std::string textOf(sqlite3_stmt* row, int column) {
    const auto* const text = sqlite3_column_text(row, column);
    return text ? std::string(reinterpret_cast<const char*>(text)) : std::string();
  }

  void readTopics() {
    const Statement statement = prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    int result = SQLITE_DONE;
    while ((result = sqlite3_step(statement.get())) == SQLITE_ROW) {
      sqlite3_stmt* const row = statement.get();
      topic_of_[sqlite3_column_int64(row, 0)] = topics_.size();
      topics_.push_back({textOf(row, 1), textOf(row, 2), textOf(row, 3)});
    }
    if (result != SQLITE_DONE) fail();
  }

  /// @returns whether there is another row
  bool step(sqlite3_stmt& statement) {
    const int result = sqlite3_step(&statement);
    if (result == SQLITE_ROW) return true;
    if (result == SQLITE_DONE) return false;
    throwIfInterrupted(name_ + " was not read to its end");
    fault_ = sqlite3_errmsg(database_.get());
    return false;
  }

  /// nullopt for one of a topic that the file does not have
  std::optional<BagMessage> messageOf(sqlite3_stmt& row) {
    const auto topic = topic_of_.find(sqlite3_column_int64(&row, 1));
    if (topic == topic_of_.end()) return std::nullopt;
    const auto* const bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(&row, 3));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(&row, 3));
    return BagMessage{topic->second,
                      sqlite3_column_int64(&row, 2),
                      {static_cast<std::uint64_t>(sqlite3_column_int64(&row, 0)), 0},
                      {bytes, bytes ? size : 0}};
  }

  std::string name_;
  std::unique_ptr<sqlite3, Close> database_;
  Statement all_, one_;
  std::map<std::int64_t, std::size_t> topic_of_;  ///< by id
  std::vector<BagTopic> topics_;
  std::string fault_;
};

}  // namespace

std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file) { return std::make_unique<SqliteBag>(file); }

}  // namespace robosim

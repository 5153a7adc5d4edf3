#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// Reads the records of a file in ActivMedia's 2D-Map, the format of ARIA and MobileSim, line by line. Units are
/// millimetres and degrees.
class ActivmediaText {
 public:
  enum class Section {
    metadata,  ///< a keyword and its values: words()
    lines,     ///< a wall: readLine()
    points     ///< a point scanned by a laser: readPoint()
  };

  /// Reads the header. @param text, path must outlive this; `path` names the file in errors.
  /// @throws ConfigError for a file of another format
  ActivmediaText(std::string_view text, const std::string& path);

  /// Advances to the next record. @return false at the end of the file
  bool next();
  Section section() const { return section_; }  ///< of the present record
  int number() const { return number_; }        ///< line number of the present record
  /// Words of the present record. A word in quotation marks may contain blanks; the marks are removed.
  const std::vector<std::string>& words() const { return words_; }
  /// @returns x1, y1, x2, y2 [mm]. @throws ConfigError with the line
  std::array<double, 4> readLine() const { return numbers<4>("a wall, x1 y1 x2 y2 in millimetres"); }
  /// @returns x, y [mm]. @throws ConfigError with the line
  std::array<double, 2> readPoint() const { return numbers<2>("a point, x y in millimetres"); }

  /// A finite number; nullopt for a word that is none.
  std::optional<double> parsed(std::string_view word) const;
  /// @throws ConfigError for a coordinate of more than 1,000 km, in this line
  double checked(double mm, int number) const;
  /// Throws ConfigError with the file and the line. @param number of the line, if it is not the present one
  [[noreturn]] void fail(const std::string& what, int number) const;
  [[noreturn]] void fail(const std::string& what) const { fail(what, number_); }

 private:
  bool nextLine();
  void readHeader();
  [[noreturn]] void failAsNo(const char* what) const;

  /// Parses the first `count` numbers of the line; ignores what follows them.
  template <std::size_t count>
  std::array<double, count> numbers(const char* what) const {
    std::array<double, count> values{};
    std::string_view rest = line_;
    for (auto& value : values) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
      const auto number = parsed(word);
      if (!number) failAsNo(what);
      value = checked(*number, number_);
      rest.remove_prefix(word.size());
    }
    return values;
  }

  std::string_view text_;  ///< the unread rest
  const std::string& path_;
  std::string_view line_;
  int number_ = 0;
  Section current_ = Section::metadata;  ///< section of the file; metadata may follow in every one
  Section section_ = Section::metadata;
  std::vector<std::string> words_;
};

/// Whether two texts are equal without regard to case.
bool isSameWord(std::string_view a, std::string_view b);

}  // namespace robosim

#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"

namespace robosim {

/// Writer of NumPy's .npz: a zip file, compressed with deflate, of arrays in NumPy's .npy format 1.0. numpy.load()
/// reads it, without pickle. The bytes depend only on the arrays: all entries are dated 1980-01-01.
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
///
/// Limits of zip without the extension zip64: 4 GiB - 1 for an array and for the file, 65,535 arrays, names of 65,535
/// bytes.
class NpzWriter {
 public:
  explicit NpzWriter(AtomicFile& file) : file_(file) {}

  /// @name Adds an array
  /// @param name the key of numpy.load(), unique; control characters are escaped
  /// @throws ConfigError when a limit is exceeded, or the name is not unique
  ///@{
  void add(const std::string& name, std::span<const double> values);         ///< float64, shape (values,)
  void add(const std::string& name, std::span<const std::uint64_t> values);  ///< uint64, shape (values,)
  void add(const std::string& name, std::span<const std::string> texts);     ///< UTF-8 to str, shape (texts,)
  /// float64, shape (rows, columns)
  /// @param at value of a row and column
  template <typename At>
  void addTable(const std::string& name, std::size_t rows, std::size_t columns, const At& at) {
    std::string data =
        beginArray(name, "<f8", std::to_string(rows) + ", " + std::to_string(columns), 8 * columns, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) append(data, static_cast<double>(at(row, column)));
    }
    addEntry(name, data);
  }
  ///@}

  /// Writes the zip file's directory; call once, after the last array. Does not finish the AtomicFile.
  /// @throws ConfigError when the file is too large
  void writeDirectory();

 private:
  template <typename Number>
  static void append(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  static std::string beginArray(const std::string& name, const std::string& type, const std::string& shape,
                                std::uint64_t bytes_per_row, std::uint64_t rows);
  void addEntry(const std::string& name, const std::string& data);

  AtomicFile& file_;
  std::string directory_;
  std::uint64_t position_ = 0;
  std::set<std::string> names_;
};

}  // namespace robosim

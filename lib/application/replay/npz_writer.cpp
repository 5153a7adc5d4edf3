#include "replay/npz_writer.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <zlib.h>

#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/utf8.h"

namespace robosim {
namespace {

static_assert(std::endian::native == std::endian::little, "zip and the arrays' types are little-endian");

constexpr std::uint64_t kMax32 = 0xffffffff;
constexpr std::size_t kMax16 = 0xffff;

[[noreturn]] void failTooLarge(const std::string& what) {
  throw ConfigError(what +
                    " exceeds a limit of .npz files (4 GiB for an array and for the file, 65,535 arrays, names of "
                    "65,535 bytes); export a .csv, or a part of the recording selected with robosim replay --output");
}

std::u32string decoded(const std::string& utf8) {
  std::u32string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const std::size_t length = std::max<std::size_t>(1, utf8SequenceLength(std::string_view(utf8).substr(i)));
    const auto first = static_cast<unsigned char>(utf8[i]);
    char32_t code = length == 1 ? first : first & (0xffU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) code = (code << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3fU);
    text += code;
    i += length;
  }
  return text;
}

/// Raw deflate, without a zlib header.
std::string deflated(const std::string& data) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string out(deflateBound(&stream, data.size()), '\0');
  // zlib counts input and output of a call in 32 bits; the input is below that limit, the bound may exceed it.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  int result = Z_OK;
  while (result == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(out.data()) + stream.total_out;
    stream.avail_out = static_cast<uInt>(std::min<std::uint64_t>(out.size() - stream.total_out, kMax32));
    result = deflate(&stream, Z_FINISH);
  }
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib cannot compress an array");
  return out;
}

}  // namespace

void NpzWriter::add(const std::string& name, std::span<const double> values) {
  std::string data = beginArray(name, "<f8", std::to_string(values.size()) + ",", 8, values.size());
  for (const double value : values) append(data, value);
  addEntry(name, data);
}

void NpzWriter::add(const std::string& name, std::span<const std::uint64_t> values) {
  std::string data = beginArray(name, "<u8", std::to_string(values.size()) + ",", 8, values.size());
  for (const std::uint64_t value : values) append(data, value);
  addEntry(name, data);
}

void NpzWriter::add(const std::string& name, std::span<const std::string> texts) {
  std::size_t length = 1;  // NumPy has no type for texts of length 0
  for (const auto& text : texts) length = std::max(length, decoded(text).size());
  std::string data =
      beginArray(name, "<U" + std::to_string(length), std::to_string(texts.size()) + ",", 4 * length, texts.size());
  for (const auto& text : texts) {
    std::u32string padded = decoded(text);
    padded.resize(length);
    for (const char32_t code : padded) append(data, code);
  }
  addEntry(name, data);
}

/// The array's header, with memory reserved for the values.
std::string NpzWriter::beginArray(const std::string& name, const std::string& type, const std::string& shape,
                                  std::uint64_t bytes_per_row, std::uint64_t rows) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t kPrefix = 10;  // magic, version, length
  constexpr std::size_t kAlignment = 64;
  header.resize((kPrefix + header.size() + 1 + kAlignment - 1) / kAlignment * kAlignment - kPrefix - 1, ' ');
  header += '\n';
  if (rows > 0 && bytes_per_row > (kMax32 - kPrefix - header.size()) / rows) {
    failTooLarge("the array " + printableText(name));
  }
  std::string data("\x93NUMPY\x01\x00", 8);
  data.reserve(kPrefix + header.size() + bytes_per_row * rows);
  append(data, static_cast<std::uint16_t>(header.size()));
  data += header;  // keeps the reserved memory
  return data;
}

void NpzWriter::addEntry(const std::string& name, const std::string& data) {
  const std::string file = printableText(name) + ".npy";
  if (file.size() > kMax16 || names_.size() == kMax16) failTooLarge("an array's name, or the number of arrays,");
  if (!names_.insert(file).second) {
    throw ConfigError("two arrays of the .npz would have the name " + printableText(name) +
                      "; export a .csv, or select the sensors with robosim replay --sensor LABEL --output");
  }
  const std::string packed = deflated(data);
  // Common part of the entry's header and of its copy in the directory: version 2.0, names in UTF-8 (bit 11), deflate,
  // time 0:00, date 1980-01-01, CRC, sizes, length of the name, no extra field.
  std::string common;
  append(common, std::uint16_t{20});
  append(common, std::uint16_t{1U << 11});
  append(common, std::uint16_t{8});
  append(common, std::uint16_t{0});
  append(common, std::uint16_t{(1U << 5) | 1});
  append(common, static_cast<std::uint32_t>(
                     crc32_z(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<z_size_t>(data.size()))));
  append(common, static_cast<std::uint32_t>(packed.size()));
  append(common, static_cast<std::uint32_t>(data.size()));
  append(common, static_cast<std::uint16_t>(file.size()));
  append(common, std::uint16_t{0});
  const std::string header = "PK\x03\x04" + common + file;
  if (position_ + header.size() + packed.size() > kMax32) failTooLarge(file_.path().string());

  directory_ += std::string("PK\x01\x02") + std::string("\x14\x00", 2) + common;
  directory_ += std::string(10, '\0');  // no comment, disk 0, attributes 0
  append(directory_, static_cast<std::uint32_t>(position_));
  directory_ += file;

  file_.write(header);
  file_.write(packed);
  position_ += header.size() + packed.size();
}

void NpzWriter::writeDirectory() {
  if (position_ + directory_.size() > kMax32) failTooLarge(file_.path().string());
  std::string end = "PK\x05\x06" + std::string(4, '\0');
  append(end, static_cast<std::uint16_t>(names_.size()));
  append(end, static_cast<std::uint16_t>(names_.size()));
  append(end, static_cast<std::uint32_t>(directory_.size()));
  append(end, static_cast<std::uint32_t>(position_));
  append(end, std::uint16_t{0});
  file_.write(directory_);
  file_.write(end);
}

}  // namespace robosim

#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <mrpt/serialization/CArchive.h>

namespace robosim {

/// An MRPT archive that appends to `bytes`.
class ByteArchive : public mrpt::serialization::CArchive {
 public:
  std::vector<std::uint8_t> bytes;

  std::string getArchiveDescription() const override { return "bytes in memory"; }

 protected:
  std::size_t write(const void* data, std::size_t size) override {
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), from, from + size);
    return size;
  }
  std::size_t read(void*, std::size_t) override { throw std::logic_error("ByteArchive only writes"); }
};

}  // namespace robosim

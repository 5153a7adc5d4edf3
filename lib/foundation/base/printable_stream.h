#pragma once
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string>

namespace robosim {

/// During its lifetime, filters everything written to a stream through printableLines(), so that no text from a file or
/// a peer can send control sequences to the terminal. Safe for concurrent writes.
class PrintableStream {
 public:
  explicit PrintableStream(std::ostream& stream);
  ~PrintableStream();
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::streambuf& target) : target_(target) {}
    /// Writes the remaining bytes of an incomplete UTF-8 sequence.
    void finish();

   protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;

   private:
    std::mutex mutex_;
    std::streambuf& target_;
    std::string incomplete_;  ///< the beginning of a UTF-8 sequence whose other bytes have not been written yet
  };

  std::ostream& stream_;
  std::streambuf* const target_;
  Buffer buffer_;
};

}  // namespace robosim

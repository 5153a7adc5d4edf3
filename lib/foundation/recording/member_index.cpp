#include "recording/member_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <system_error>

#include "base/input_file.h"
#include "recording/gzip_members.h"

namespace robosim {
namespace {

/// First bytes of the parts of the stream.
constexpr std::uint8_t kMember = 1, kSummary = 2;
constexpr std::size_t kMemberBytes = 1 + 8 + 8 + 8 + 4 + 4 + 4, kPointBytes = 16, kSummaryBytes = 1 + 8 + 4 + 4;
/// Deflate's output is at most so many times as long as its input.
constexpr std::uint64_t kMaxRatio = 1032;
/// A step has at least an observation of a robot, which is not shorter.
constexpr std::uint64_t kMinStepBytes = 100;

std::uint32_t bitsOf(float number) { return std::bit_cast<std::uint32_t>(number); }

TracePoint pointAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  const auto robot = numberAt<std::uint32_t>(bytes, at + 4);
  return {numberAt<std::uint32_t>(bytes, at), robot % TracePoint::kMaxRobots,
          std::bit_cast<float>(numberAt<std::uint32_t>(bytes, at + 8)),
          std::bit_cast<float>(numberAt<std::uint32_t>(bytes, at + 12)), static_cast<std::uint8_t>(robot >> 24)};
}

/// Parts of a file.
class Parts {
 public:
  explicit Parts(const std::filesystem::path& file) : file_(file) {}

  std::optional<std::uint64_t> size() const { return file_.size(); }
  /// Fewer bytes at the end of the file.
  std::span<const std::uint8_t> read(std::uint64_t position, std::size_t size) {
    bytes_.resize(size);
    file_.seek(position);
    std::size_t done = 0;
    while (done < size) {
      const std::size_t got = file_.read(bytes_.data() + done, size - done);
      if (got == 0) break;
      done += got;
    }
    return std::span<const std::uint8_t>(bytes_).first(done);
  }

 private:
  InputFile file_;
  std::vector<std::uint8_t> bytes_;
};

/// Reads the stream of the index from the contents of its pages.
class IndexParser {
 public:
  using OnPoints = std::function<void(const MemberNote&, std::span<const TracePoint>)>;
  IndexParser(MemberIndex& index, std::uint64_t file_size, const OnPoints& on_points)
      : index_(index), file_size_(file_size), on_points_(on_points) {}

  /// @return whether the bytes are valid so far
  bool add(std::span<const std::uint8_t> content) {
    stream_.insert(stream_.end(), content.begin(), content.end());
    std::size_t at = 0;
    const std::span<const std::uint8_t> all(stream_);
    while (const std::size_t size = take(all.subspan(at))) at += size;
    stream_.erase(stream_.begin(), stream_.begin() + static_cast<std::ptrdiff_t>(at));
    return !is_invalid_;
  }
  /// Whether the summary was the last part.
  bool isComplete() const { return has_summary_ && stream_.empty(); }

 private:
  /// Takes the part with which the bytes begin. @return its size; 0 if it is incomplete or invalid
  std::size_t take(std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || is_invalid_) return 0;
    is_invalid_ = has_summary_ || (bytes[0] != kMember && bytes[0] != kSummary);
    if (is_invalid_) return 0;
    return bytes[0] == kMember ? takeMember(bytes) : takeSummary(bytes);
  }

  std::size_t takeMember(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kMemberBytes) return 0;
    MemberNote note{numberAt<std::uint64_t>(bytes, 1),  numberAt<std::uint64_t>(bytes, 9),
                    numberAt<std::uint64_t>(bytes, 17), numberAt<std::uint32_t>(bytes, 25),
                    numberAt<std::uint32_t>(bytes, 29), {}};
    const auto points = numberAt<std::uint32_t>(bytes, 33);
    const std::size_t size = kMemberBytes + std::size_t{points} * kPointBytes;
    // Checked before its points are awaited: they are not more than the file.
    is_invalid_ = !follows(note) || size > file_size_;
    if (is_invalid_ || bytes.size() < size) return 0;
    points_.clear();
    for (std::uint32_t i = 0; i < points; ++i) points_.push_back(pointAt(bytes, kMemberBytes + i * kPointBytes));
    is_invalid_ = !areValid(note, points_);
    if (is_invalid_) return 0;
    index_.members.push_back(note);
    if (on_points_ && points > 0) on_points_(note, points_);
    return size;
  }

  std::size_t takeSummary(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kSummaryBytes) return 0;
    IndexSummary& summary = index_.summary;
    summary = {numberAt<std::uint64_t>(bytes, 1), numberAt<std::uint32_t>(bytes, 9) != 0,
               numberAt<std::uint32_t>(bytes, 13)};
    const bool has_steps = std::any_of(index_.members.begin(), index_.members.end(),
                                       [](const MemberNote& note) { return note.steps > 0; });
    is_invalid_ = !isPossible(file_size_, summary.unpacked) || robots_ > summary.robots ||
                  summary.robots > TracePoint::kMaxRobots ||
                  (summary.has_traces && has_steps && robots_ != summary.robots);
    has_summary_ = true;
    return is_invalid_ ? 0 : kSummaryBytes;
  }

  /// Whether a member can be the next one.
  bool follows(const MemberNote& note) const {
    if (note.packed >= file_size_ || note.steps > note.first_step + note.steps) return false;
    if (index_.members.empty()) return note.packed == 0 && note.unpacked == 0;
    const MemberNote& last = index_.members.back();
    return note.packed > last.packed && note.first_step >= last.first_step + last.steps &&
           isPossible(note.packed, note.unpacked);
  }
  /// Whether the points are of the member's steps in their order, and of known robots or the next one.
  bool areValid(const MemberNote& note, std::span<const TracePoint> points) {
    std::uint32_t step = 0;
    for (const auto& point : points) {
      if (point.step < step || point.step >= note.steps || point.robot > robots_) return false;
      if (!std::isfinite(point.x_m) || !std::isfinite(point.y_m)) return false;
      step = point.step;
      robots_ = std::max(robots_, point.robot + 1);
    }
    return true;
  }
  /// Whether the last member may end at these positions.
  bool isPossible(std::uint64_t packed, std::uint64_t unpacked) const {
    if (index_.members.empty()) return unpacked == 0;
    const MemberNote& last = index_.members.back();
    return unpacked > last.unpacked && (unpacked - last.unpacked) / kMaxRatio <= packed - last.packed &&
           last.steps <= (unpacked - last.unpacked) / kMinStepBytes;
  }

  MemberIndex& index_;
  std::uint64_t file_size_;
  const OnPoints& on_points_;
  std::vector<std::uint8_t> stream_;
  std::vector<TracePoint> points_;
  std::uint32_t robots_ = 0;  ///< with points so far
  bool is_invalid_ = false, has_summary_ = false;
};

/// Positions of the pages in their order; empty for a file that does not end with one.
std::vector<std::uint64_t> pagesOf(Parts& file, std::uint64_t file_size) {
  std::vector<std::uint64_t> pages;
  auto end = IndexPage::positionOfLast(file.read(file_size - IndexPage::kEndBytes, IndexPage::kEndBytes));
  while (end && *end != IndexPage::kNone) {
    if (*end >= (pages.empty() ? file_size : pages.back())) return {};  // each page is before the next one
    const auto head = file.read(*end, 16);
    const auto size = IndexPage::sizeOf(head);
    const auto page = size ? IndexPage::parse(file.read(*end, *size)) : std::nullopt;
    if (!page || page->position != *end) return {};
    if (pages.empty() && *end + *size != file_size) return {};  // it is of another file, which is before this one's end
    pages.push_back(*end);
    end = page->previous;
  }
  std::reverse(pages.begin(), pages.end());
  return pages;
}

}  // namespace

void appendTo(std::vector<std::uint8_t>& stream, const MemberNote& note) {
  stream.push_back(kMember);
  appendNumber(stream, note.packed);
  appendNumber(stream, note.unpacked);
  appendNumber(stream, note.first_step);
  appendNumber(stream, note.steps);
  appendNumber(stream, note.flags);
  appendNumber(stream, static_cast<std::uint32_t>(note.points.size()));
  for (const auto& point : note.points) {
    appendNumber(stream, point.step);
    appendNumber(stream, point.robot | std::uint32_t{point.flags} << 24);
    appendNumber(stream, bitsOf(point.x_m));
    appendNumber(stream, bitsOf(point.y_m));
  }
}

void appendTo(std::vector<std::uint8_t>& stream, const IndexSummary& summary) {
  stream.push_back(kSummary);
  appendNumber(stream, summary.unpacked);
  appendNumber(stream, std::uint32_t{summary.has_traces});
  appendNumber(stream, summary.robots);
}

std::optional<MemberIndex> MemberIndex::read(const std::filesystem::path& path,
                                             const IndexParser::OnPoints& on_points) {
  Parts file(path);
  const auto size = file.size();
  if (!size || *size < IndexPage::kFrameBytes) return std::nullopt;
  try {
    const std::vector<std::uint64_t> pages = pagesOf(file, *size);
    MemberIndex index;
    IndexParser parser(index, *size, on_points);
    for (const std::uint64_t position : pages) {
      const auto page_size = IndexPage::sizeOf(file.read(position, 16));
      const auto page = page_size ? IndexPage::parse(file.read(position, *page_size)) : std::nullopt;
      if (!page || !parser.add(page->content)) return std::nullopt;
    }
    return parser.isComplete() ? std::optional(std::move(index)) : std::nullopt;
  } catch (const std::system_error&) {
    return std::nullopt;  // reading it as a whole reports the error
  }
}

}  // namespace robosim

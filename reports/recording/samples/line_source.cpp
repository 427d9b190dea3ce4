#include "reports/recording/samples/line_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "certificates/design/input_error.hpp"

namespace veritrack::reports {

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

LineSource::LineSource(const std::string& path) : name_(path == "-" ? "standard input" : path) {
  file_.reset(path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_.is_open()) {
    throw certificates::InputError(name_, {}, std::string("cannot be read: ") + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file_.get(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw certificates::InputError(name_, {}, "a folder; allowed: a recording");
    }
    size_ = S_ISREG(status.st_mode) ? static_cast<std::int64_t>(status.st_size) : 0;
  }
}

void LineSource::refill() {
  buffer_.erase(0, begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + kChunk) {
    buffer_.resize(end_ + kChunk);
  }
  const ssize_t count = file_.read(buffer_.data() + end_, buffer_.size() - end_);
  if (count < 0) {
    throw certificates::InputError(name_, {}, std::string("cannot be read: ") + std::strerror(errno));
  }
  at_end_ = count == 0;
  end_ += static_cast<std::size_t>(count);
}

std::optional<std::string_view> LineSource::next() {
  std::size_t searched = begin_;
  for (;;) {
    const char* found =
        searched < end_
            ? static_cast<const char*>(std::memchr(buffer_.data() + searched, '\n', end_ - searched))
            : nullptr;
    const std::size_t stop = found != nullptr ? static_cast<std::size_t>(found - buffer_.data()) : end_;
    if (stop - begin_ > kLongestLine) {
      throw certificates::InputError(
          name_, {static_cast<int>(std::min<std::int64_t>(line_ + 1, INT32_MAX)), 1},
          fmt::format("a line of more than {} bytes; allowed: CSV text, a line a sample", kLongestLine));
    }
    if (found == nullptr && !at_end_) {
      const std::size_t left = end_ - begin_;
      refill();
      searched = begin_ + left;
      continue;
    }
    if (found == nullptr && begin_ == end_) {
      return std::nullopt;
    }
    std::string_view line(buffer_.data() + begin_, stop - begin_);
    taken_ += static_cast<std::int64_t>(line.size()) + 1;
    begin_ = found != nullptr ? stop + 1 : end_;
    if (line_++ == 0 && line.starts_with(kByteOrderMark)) {
      line.remove_prefix(kByteOrderMark.size());
    }
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    return line;
  }
}

std::optional<double> LineSource::progress() const {
  if (size_ <= 0) {
    return std::nullopt;
  }
  return std::min(1.0, static_cast<double>(taken_) / static_cast<double>(size_));
}

}  // namespace veritrack::reports

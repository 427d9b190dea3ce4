#include "cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace veritrack::cli {

namespace {

constexpr std::chrono::seconds kPatience{2};

}  // namespace

ProgressLine::ProgressLine(bool quiet, std::string work)
    : shown_(!quiet && isatty(STDERR_FILENO) != 0),
      work_(std::move(work)),
      started_(std::chrono::steady_clock::now()) {
  if (shown_ && !work_.empty()) {
    ticking_ = std::thread([this] { count_seconds(); });
  }
}

ProgressLine::~ProgressLine() {
  if (ticking_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    ends_.notify_all();
    ticking_.join();
  }
  clear();
}

void ProgressLine::operator()(const certificates::Progress& progress) const {
  tell(fmt::format("proved {:5.1f} %, refuted {:5.1f} % ({} propagations)", 100.0 * progress.proved_share,
                   100.0 * progress.refuted_share, progress.propagations));
}

void ProgressLine::clear() const {
  if (shown_) {
    fmt::print(stderr, "\r\033[K");
  }
}

void ProgressLine::tell(const std::string& text) const {
  if (shown_) {
    const std::lock_guard lock(mutex_);
    told_ = text;
    fmt::print(stderr, "\r\033[K{}", text);
  }
}

void ProgressLine::count_seconds() {
  std::unique_lock lock(mutex_);
  for (auto next = started_ + kPatience; !ends_.wait_until(lock, next, [this] { return is_over_; });
       next += std::chrono::seconds(1)) {
    const auto passed = std::chrono::duration_cast<std::chrono::seconds>(next - started_).count();
    fmt::print(stderr, "\r\033[K{}, {} s", told_.empty() ? work_ : told_, passed);
    std::fflush(stderr);
  }
}

}  // namespace veritrack::cli

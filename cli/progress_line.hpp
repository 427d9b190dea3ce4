// How far long work has come, on a terminal.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>

#include "certificates/document/certificate.hpp"

namespace veritrack::cli {

/// A progress line on standard error for long work, if standard error is a terminal and --quiet is not given.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() {
    if (shown_) {
      fmt::print(stderr, "\r\033[K");
    }
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  void operator()(const certificates::Progress& progress) const {
    if (shown_) {
      fmt::print(stderr, "\rproved {:5.1f} %, refuted {:5.1f} % ({} propagations)",
                 100.0 * progress.proved_share, 100.0 * progress.refuted_share, progress.propagations);
    }
  }
  /// Of several pieces of work.
  void operator()(std::size_t done, std::size_t all) const {
    if (shown_) {
      fmt::print(stderr, "\r{} of {} designs checked", done, all);
    }
  }
  /// Makes room for a line of results.
  void clear() const {
    if (shown_) {
      fmt::print(stderr, "\r\033[K");
    }
  }

 private:
  bool shown_;
};

}  // namespace veritrack::cli

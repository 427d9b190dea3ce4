// How far long work has come, on a terminal.
#pragma once

#include <chrono>
#include <concepts>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "certificates/document/certificate.hpp"

namespace veritrack::cli {

/// A progress line on standard error for long work, if standard error is a terminal and --quiet is not given.
/// With `work`, "certifying", it says so and counts the seconds from the third on, until there is other
/// progress to show; this takes a thread, which a process that forks must not have.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet, std::string work = {});
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  void operator()(const certificates::Progress& progress) const;
  /// The progress of several pieces of work.
  template <std::integral Count>
  void operator()(Count done, Count most, const char* of_what = "designs certified") const {
    tell(std::to_string(done) + " of " + std::to_string(most) + " " + of_what);
  }
  /// Makes room for a line of results.
  void clear() const;

 private:
  void tell(const std::string& text) const;
  void count_seconds();

  bool shown_;
  std::string work_;
  std::chrono::steady_clock::time_point started_;
  mutable std::mutex mutex_;
  mutable std::string told_;
  std::condition_variable ends_;
  bool is_over_ = false;
  std::thread ticking_;
};

}  // namespace veritrack::cli

// Work in separate processes, so that one that fails or takes too long does not harm the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace veritrack::cli {

/// How a piece of work ended.
struct WorkerResult {
  enum class End {
    done,         ///< `text` is the result of the work
    stopped,      ///< it took longer than its limit
    untrustable,  ///< rigor::RoundingModeError: this machine's arithmetic cannot be trusted
    failed        ///< `text` says how, in a line
  };
  End end = End::failed;
  std::string text;
  double seconds = 0.0;
};

/// Pieces of work, by number from 0.
struct WorkPlan {
  std::size_t pieces = 0;
  std::size_t at_once = 1;
  /// Runs in a process of its own, which has only the thread that forked.
  std::function<std::string(std::size_t)> work;
  /// After how many seconds a piece is stopped; 0: never.
  std::function<double(std::size_t)> limit;
  /// Called in this process as each piece ends, in whatever order.
  std::function<void(std::size_t, const WorkerResult&)> done;
};

/// Does all pieces. The processes end with this one, however it ends. Throws std::system_error when no
/// process can be made.
void run_workers(const WorkPlan& plan);

}  // namespace veritrack::cli

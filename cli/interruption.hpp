// Ctrl-C as a request for the results so far.
#pragma once

#include <atomic>
#include <csignal>

namespace veritrack::cli {

/// As long as it lives, the first SIGINT sets the flag, and a second one ends the program as usual. One at a
/// time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  [[nodiscard]] static const std::atomic<bool>& flag();

 private:
  struct sigaction before_ {};
};

}  // namespace veritrack::cli

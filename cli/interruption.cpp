#include "cli/interruption.hpp"

namespace veritrack::cli {

namespace {

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

void note(int /*signal*/) {
  is_interrupted.store(true);
}

}  // namespace

Interruption::Interruption() {
  is_interrupted.store(false);
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  ::sigaction(SIGINT, &action, &before_);
}

Interruption::~Interruption() {
  ::sigaction(SIGINT, &before_, nullptr);
}

const std::atomic<bool>& Interruption::flag() {
  return is_interrupted;
}

}  // namespace veritrack::cli

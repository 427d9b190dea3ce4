#include "cli/workers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <list>
#include <system_error>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/file_descriptor.hpp"

namespace veritrack::cli {

namespace {

using certificates::FileDescriptor;
using Clock = std::chrono::steady_clock;

constexpr int kUntrustable = 3;
constexpr int kFailed = 1;

struct Worker {
  std::size_t piece = 0;
  pid_t process = -1;
  FileDescriptor output;
  std::string text;
  Clock::time_point started;
  double limit = 0.0;  // s; 0: none
  bool is_stopped = false;

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - started).count();
  }
};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void write_all(const FileDescriptor& output, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = output.write(text.data() + written, text.size() - written);
    if (count <= 0) {
      return;  // nobody reads any more
    }
    written += static_cast<std::size_t>(count);
  }
}

/// The work of the new process; it never returns.
[[noreturn]] void work_and_exit(const WorkPlan& plan, std::size_t piece, const FileDescriptor& output,
                                pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(kFailed);  // it ended in between
  }
  int status = 0;
  std::string text;
  try {
    text = plan.work(piece);
  } catch (const rigor::RoundingModeError& error) {
    status = kUntrustable;
    text = error.what();
  } catch (const std::exception& error) {
    status = kFailed;
    text = error.what();
  }
  write_all(output, text);
  ::_exit(status);
}

void begin(const WorkPlan& plan, std::size_t piece, std::list<Worker>& workers) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    fail("a pipe for a worker");
  }
  Worker& worker = workers.emplace_back();
  worker.piece = piece;
  worker.output.reset(ends[0]);
  const FileDescriptor input(ends[1]);
  worker.limit = plan.limit ? plan.limit(piece) : 0.0;
  worker.started = Clock::now();
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  worker.process = ::fork();
  if (worker.process < 0) {
    fail("a process for a worker");
  }
  if (worker.process == 0) {
    work_and_exit(plan, piece, input, parent);
  }
}

WorkerResult end_of(Worker& worker) {
  int status = 0;
  while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
  }
  WorkerResult result;
  result.seconds = worker.seconds();
  result.text = std::move(worker.text);
  if (worker.is_stopped) {
    result.end = WorkerResult::End::stopped;
  } else if (WIFSIGNALED(status)) {
    result.text = fmt::format("the process that worked on it was ended by signal {}", WTERMSIG(status));
  } else if (WEXITSTATUS(status) == kUntrustable) {
    result.end = WorkerResult::End::untrustable;
  } else if (WEXITSTATUS(status) == 0) {
    result.end = WorkerResult::End::done;
  }
  return result;
}

/// Milliseconds until the first limit is reached; -1 without limits.
int wait_until_a_limit(const std::list<Worker>& workers) {
  double wait = -1.0;
  for (const Worker& worker : workers) {
    if (worker.limit > 0.0 && !worker.is_stopped) {
      const double left = std::clamp(worker.limit - worker.seconds(), 0.0, 1e6);
      wait = wait < 0.0 ? left : std::min(wait, left);
    }
  }
  return wait < 0.0 ? -1 : static_cast<int>(wait * 1e3) + 1;
}

void stop_late_ones(std::list<Worker>& workers) {
  for (Worker& worker : workers) {
    if (worker.limit > 0.0 && !worker.is_stopped && worker.seconds() >= worker.limit) {
      worker.is_stopped = true;
      ::kill(worker.process, SIGKILL);
    }
  }
}

/// Reads what there is; whether it was the end.
bool reads_end(Worker& worker) {
  std::array<char, 65536> buffer{};
  const ssize_t count = worker.output.read(buffer.data(), buffer.size());
  if (count > 0) {
    worker.text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return count <= 0;
}

/// Processes that are still at work when something is thrown end as well.
class Crew {
 public:
  Crew() = default;
  ~Crew() {
    for (Worker& worker : workers) {
      if (worker.process > 0) {  // kill(-1) would be everybody
        ::kill(worker.process, SIGKILL);
        end_of(worker);
      }
    }
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  Crew(Crew&&) = delete;
  Crew& operator=(Crew&&) = delete;

  std::list<Worker> workers;
};

}  // namespace

void run_workers(const WorkPlan& plan) {
  Crew crew;
  std::list<Worker>& workers = crew.workers;
  std::size_t next = 0;
  while (next < plan.pieces || !workers.empty()) {
    while (next < plan.pieces && workers.size() < std::max<std::size_t>(plan.at_once, 1)) {
      begin(plan, next++, workers);
    }
    std::vector<pollfd> waiting;
    waiting.reserve(workers.size());
    for (const Worker& worker : workers) {
      waiting.push_back({worker.output.get(), POLLIN, 0});
    }
    if (::poll(waiting.data(), waiting.size(), wait_until_a_limit(workers)) < 0 && errno != EINTR) {
      fail("waiting for workers");
    }
    stop_late_ones(workers);
    std::size_t number = 0;
    for (auto worker = workers.begin(); worker != workers.end();) {
      const bool is_ready = waiting[number++].revents != 0;
      if (is_ready && reads_end(*worker)) {
        const WorkerResult result = end_of(*worker);
        const std::size_t piece = worker->piece;
        worker = workers.erase(worker);
        plan.done(piece, result);
      } else {
        ++worker;
      }
    }
  }
}

}  // namespace veritrack::cli

// veritrack check: the verdicts of many designs, for continuous integration.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "cli/check_output.hpp"
#include "cli/commands.hpp"
#include "cli/progress_line.hpp"
#include "cli/standard_output.hpp"
#include "cli/verifier.hpp"
#include "cli/workers.hpp"
#include "reports/check/check_cache.hpp"
#include "reports/check/check_reports.hpp"

namespace veritrack::cli {

namespace {

namespace fs = std::filesystem;
using reports::CheckedDesign;
using reports::CheckObjection;
using Kind = CheckObjection::Kind;

/// A design on its way.
struct CheckTask {
  std::string path;
  std::string text;
  std::optional<certificates::Design> design;
  std::optional<CheckedDesign> checked;  ///< once it is known
};

/// A design, or what was named as one, that cannot be used.
CheckTask bad_task(const std::string& path, const std::string& message,
                   certificates::Position position = {}) {
  return {
      path, {}, std::nullopt, CheckedDesign{path, {}, CheckObjection{Kind::bad_input, message, position}}};
}

/// Adds the design files in a folder and below, by name.
void add_folder(const std::string& folder, std::vector<CheckTask>& tasks) {
  std::vector<std::string> inside;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.path().extension() == ".toml") {
        inside.push_back(entry.path().string());
      }
    }
  } catch (const fs::filesystem_error& error) {
    tasks.push_back(bad_task(folder, fmt::format("cannot be read: {}; allowed: a folder that can be read",
                                                 error.code().message())));
    return;
  }
  if (inside.empty()) {
    tasks.push_back(bad_task(folder, "has no design file; allowed: a folder with files *.toml"));
  }
  std::sort(inside.begin(), inside.end());
  for (const std::string& path : inside) {
    tasks.push_back({path, {}, std::nullopt, std::nullopt});
  }
}

/// The files that are named, and those of folders.
std::vector<CheckTask> tasks_of(const std::vector<std::string>& named) {
  std::vector<CheckTask> tasks;
  for (const std::string& name : named) {
    if (fs::is_directory(name)) {
      add_folder(name, tasks);
    } else {
      tasks.push_back({name, {}, std::nullopt, std::nullopt});
    }
  }
  return tasks;
}

/// The outcome of a design, with the requirements of the options.
CheckedDesign judged(CheckedDesign checked, const std::string& path, const CheckOptions& options) {
  checked.path = path;
  if (options.strict && !checked.objection && checked.requirements.empty()) {
    checked.objection =
        CheckObjection{Kind::nothing_required, "nothing is required, and --strict asks for something", {}};
  }
  return checked;
}

/// Reads the file; what is wrong with it is noted, and the others are still checked.
void read_task(CheckTask& task, const CheckOptions& options,
               const std::optional<reports::CheckCache>& cache) {
  try {
    task.text = certificates::read_design_text(task.path);
    if (cache) {
      task.checked = cache->find(task.text);
    }
    if (!task.checked) {
      task.design = certificates::read_design(task.text, task.path);
    }
  } catch (const certificates::InputError& error) {
    task = bad_task(task.path, error.message(), {error.line(), error.column()});
  }
  if (task.checked) {
    task.checked = judged(std::move(*task.checked), task.path, options);
  }
}

/// Certifies in a process of its own, with its share of the cores.
std::string work_on(const CheckTask& task, const CheckOptions& options,
                    const std::optional<Verifier>& verifier, std::size_t at_once, bool is_alone) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const tbb::global_control share(tbb::global_control::max_allowed_parallelism,
                                  std::max<std::size_t>(1, cores / at_once));
  const ProgressLine line(options.quiet || !is_alone, "checking");
  const search::Deadline deadline =
      options.seconds > 0.0 ? search::Deadline(options.seconds) : search::Deadline();
  const certificates::Certificate certificate =
      certificates::certify(*task.design, fs::path(task.path).filename().string(), task.text, std::cref(line),
                            certificates::Extent::verdicts, deadline);
  CheckedDesign checked{task.path, reports::requirements_of(certificate)};
  checked.cut_short = deadline.has_struck();
  if (verifier) {
    const certificates::Verification found =
        (*verifier)({certificates::to_json(certificate), task.text, {}, fs::path(task.path).parent_path()});
    if (!found.failure.empty()) {
      throw std::runtime_error(refusal_sentence(found));
    }
    const bool is_verified = found.outcome == certificates::Verification::Outcome::verified;
    reports::note_verification(checked, is_verified ? "" : refusal_sentence(found));
  }
  return reports::to_text(checked);
}

/// Searches that know of the limit end by themselves, a little later.
double patience(const CheckTask& task, double seconds) {
  constexpr double kFactor = 2.0;
  constexpr double kMore = 10.0;
  return seconds > 0.0 && certificates::kind_of(*task.design).limited_in_time ? kFactor * seconds + kMore
                                                                              : seconds;
}

CheckedDesign checked_by(const WorkerResult& result, const CheckOptions& options) {
  CheckedDesign checked;
  switch (result.end) {
    case WorkerResult::End::untrustable:
      throw rigor::RoundingModeError(result.text);  // nothing can be trusted any more
    case WorkerResult::End::stopped:
      checked.objection = CheckObjection{
          Kind::time_limit, fmt::format("stopped after {} s (--timeout)", options.seconds), {}};
      break;
    case WorkerResult::End::failed:
      checked.objection = CheckObjection{Kind::failure, result.text, {}};
      break;
    case WorkerResult::End::done:
      if (auto read = reports::checked_from_text(result.text)) {
        checked = std::move(*read);
      } else {
        checked.objection = CheckObjection{Kind::failure, "the process that worked on it said nothing", {}};
      }
  }
  checked.seconds = result.seconds;
  return checked;
}

/// The last line, and the reports, which may go to standard output as well.
ExitStatus finish(const CheckOptions& options, std::size_t designs, std::vector<CheckedDesign>& checked) {
  if (designs > 1) {
    fmt::print("{}\n", reports::summary_of(checked));
    flush_standard_output();
  }
  write_reports(options, checked);
  return static_cast<ExitStatus>(reports::exit_status_of(checked));
}

}  // namespace

ExitStatus run_check(const CheckOptions& options) {
  std::vector<CheckTask> tasks = tasks_of(options.designs);
  std::vector<std::string> paths;
  std::transform(tasks.begin(), tasks.end(), std::back_inserter(paths),
                 [](const CheckTask& task) { return task.path; });
  if (auto failures = unwritable_reports(options, paths); !failures.empty()) {
    std::for_each(failures.begin(), failures.end(), print_checked);
    return finish(options, 0, failures);
  }
  std::optional<Verifier> verifier;
  try {
    if (options.verify) {
      verifier.emplace();
    }
  } catch (const NoVerifier& error) {
    std::vector<CheckedDesign> failures{bad_task("veritrack-verify", error.what()).checked.value()};
    print_checked(failures.front());
    return finish(options, 0, failures);
  }
  std::optional<reports::CheckCache> cache;
  const fs::path cache_folder = options.no_cache ? fs::path() : reports::default_cache_folder();
  if (const std::string program = cache_folder.empty() ? "" : reports::program_identity(); !program.empty()) {
    cache.emplace(cache_folder,
                  verifier ? program + " and " + reports::program_identity(verifier->path()) : program);
  }
  for (CheckTask& task : tasks) {
    if (!task.checked) {
      read_task(task, options, cache);
    }
  }

  const ProgressLine line(options.quiet || tasks.size() == 1);
  std::size_t printed = 0;
  std::size_t known = 0;
  // In the order of the arguments, as soon as those before are known.
  const auto print_known = [&] {
    line.clear();
    for (; printed < tasks.size() && tasks[printed].checked; ++printed) {
      print_checked(*tasks[printed].checked);
    }
    flush_standard_output();
    line(known, tasks.size());
  };
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (tasks[i].checked) {
      ++known;
    } else {
      open.push_back(i);
    }
  }
  print_known();
  WorkPlan plan;
  plan.pieces = open.size();
  plan.at_once = std::min<std::size_t>(options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                                                        : std::max(1U, std::thread::hardware_concurrency()),
                                       std::max<std::size_t>(1, open.size()));
  plan.work = [&](std::size_t piece) {
    return work_on(tasks[open[piece]], options, verifier, plan.at_once, tasks.size() == 1);
  };
  plan.limit = [&](std::size_t piece) { return patience(tasks[open[piece]], options.seconds); };
  plan.done = [&](std::size_t piece, const WorkerResult& result) {
    CheckTask& task = tasks[open[piece]];
    CheckedDesign checked = checked_by(result, options);
    if (cache) {
      cache->keep(task.text, checked);
    }
    task.checked = judged(std::move(checked), task.path, options);
    ++known;
    print_known();
  };
  run_workers(plan);

  std::vector<CheckedDesign> checked;
  checked.reserve(tasks.size());
  for (CheckTask& task : tasks) {
    checked.push_back(std::move(*task.checked));
  }
  line.clear();
  return finish(options, tasks.size(), checked);
}

}  // namespace veritrack::cli

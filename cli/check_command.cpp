// veritrack check: the verdicts of many designs, for continuous integration.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "cli/commands.hpp"
#include "cli/progress_line.hpp"
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

/// The files that are named, and of a folder all design files in it and below, by name.
std::vector<std::string> design_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  for (const std::string& name : named) {
    if (!fs::is_directory(name)) {
      files.push_back(name);
      continue;
    }
    std::vector<std::string> inside;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(name)) {
      if (entry.is_regular_file() && entry.path().extension() == ".toml") {
        inside.push_back(entry.path().string());
      }
    }
    if (inside.empty()) {
      throw certificates::InputError(name, {}, "has no design file; allowed: a folder with files *.toml");
    }
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

/// Reads the file; what is wrong with it is noted, and the others are still checked.
CheckTask read_task(const std::string& path, const std::optional<reports::CheckCache>& cache) {
  CheckTask task;
  task.path = path;
  try {
    task.text = certificates::read_design_text(path);
    if (cache) {
      task.checked = cache->find(task.text);
    }
    if (!task.checked) {
      task.design = certificates::read_design(task.text, path);
    }
  } catch (const certificates::InputError& error) {
    task.checked = CheckedDesign{
        path, {}, CheckObjection{Kind::bad_input, error.message(), {error.line(), error.column()}}};
  }
  if (task.checked) {
    task.checked->path = path;
  }
  return task;
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
  if (verifier) {
    const certificates::Verification found = (*verifier)({certificates::to_json(certificate), task.text});
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

CheckedDesign checked_by(const WorkerResult& result, const CheckTask& task, const CheckOptions& options) {
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
  checked.path = task.path;
  checked.seconds = result.seconds;
  return checked;
}

/// Prints what came of a design; its part of the exit status.
ExitStatus print(const CheckedDesign& design, const CheckOptions& options) {
  const char* actions = std::getenv("GITHUB_ACTIONS");
  if (actions != nullptr && std::string(actions) == "true") {
    fmt::print("{}", reports::to_annotations(design));
  }
  if (const auto& objection = design.objection) {
    if (objection->kind == Kind::time_limit || objection->kind == Kind::not_verified) {
      fmt::print("{}: {}: {}\n", design.path,
                 objection->kind == Kind::time_limit ? "undecided" : "not verified", objection->message);
      return not_proved;
    }
    std::fflush(stdout);
    fmt::print(stderr, "{}\n",
               certificates::InputError(design.path, objection->position, objection->message).what());
    return bad_input;
  }
  const char* verified = design.verified.value_or(false) ? ", verified" : "";
  if (design.requirements.empty()) {
    fmt::print("{}: nothing required{}\n", design.path, verified);
    return options.strict ? not_proved : all_proved;
  }
  ExitStatus status = all_proved;
  for (const reports::CheckedRequirement& each : design.requirements) {
    fmt::print("{}:{}: {}{}: {} ({})\n", design.path, each.position.line, rigor::to_string(each.verdict),
               each.verdict == rigor::Verdict::undecided ? "" : verified, each.requirement, each.reason);
    status = each.verdict == rigor::Verdict::proved ? status : not_proved;
  }
  return status;
}

/// Stages the reports that are asked for.
void stage_reports(const CheckOptions& options, const std::vector<std::string>& designs,
                   certificates::OutputFiles& files, const std::vector<CheckedDesign>& checked) {
  for (const std::string& path : designs) {
    files.keep(path);
  }
  using Report = std::string (*)(const std::vector<CheckedDesign>&);
  for (const auto& [path, report] : {std::pair<std::string, Report>{options.json, reports::to_check_json},
                                     {options.junit, reports::to_junit},
                                     {options.sarif, reports::to_sarif}}) {
    if (!path.empty()) {
      files.stage(path, report(checked));
    }
  }
}

}  // namespace

ExitStatus run_check(const CheckOptions& options) {
  const std::vector<std::string> designs = design_files(options.designs);
  {
    // What cannot be written is better known before minutes of work.
    certificates::OutputFiles files;
    stage_reports(options, designs, files, {});
  }
  const std::optional<Verifier> verifier =
      options.verify ? std::optional<Verifier>(std::in_place) : std::nullopt;
  std::optional<reports::CheckCache> cache;
  const fs::path cache_folder = options.no_cache ? fs::path() : reports::default_cache_folder();
  if (const std::string program = cache_folder.empty() ? "" : reports::program_identity(); !program.empty()) {
    cache.emplace(cache_folder,
                  verifier ? program + " and " + reports::program_identity(verifier->path()) : program);
  }
  std::vector<CheckTask> tasks;
  tasks.reserve(designs.size());
  for (const std::string& path : designs) {
    tasks.push_back(read_task(path, cache));
  }

  const ProgressLine line(options.quiet || tasks.size() == 1);
  ExitStatus status = all_proved;
  std::size_t printed = 0;
  std::size_t known = 0;
  // In the order of the arguments, as soon as those before are known.
  const auto print_known = [&] {
    line.clear();
    for (; printed < tasks.size() && tasks[printed].checked; ++printed) {
      status = std::max(status, print(*tasks[printed].checked, options));
    }
    std::fflush(stdout);
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
    task.checked = checked_by(result, task, options);
    if (cache && !(options.seconds > 0.0)) {
      cache->keep(task.text, *task.checked);
    }
    ++known;
    print_known();
  };
  run_workers(plan);

  std::vector<CheckedDesign> checked;
  checked.reserve(tasks.size());
  for (CheckTask& task : tasks) {
    checked.push_back(std::move(*task.checked));
  }
  certificates::OutputFiles files;
  stage_reports(options, designs, files, checked);
  files.commit();
  return status;
}

}  // namespace veritrack::cli

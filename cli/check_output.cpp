#include "cli/check_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>

#include "certificates/design/input_error.hpp"
#include "certificates/document/output_files.hpp"
#include "cli/standard_output.hpp"
#include "reports/check/check_reports.hpp"

namespace veritrack::cli {

namespace {

using reports::CheckedDesign;
using reports::CheckObjection;
using Kind = CheckObjection::Kind;

using Report = std::string (*)(const std::vector<CheckedDesign>&);

/// The reports that are asked for, by their paths.
std::vector<std::pair<std::string, Report>> reports_of(const CheckOptions& options) {
  std::vector<std::pair<std::string, Report>> asked{{options.json, reports::to_check_json},
                                                    {options.junit, reports::to_junit},
                                                    {options.sarif, reports::to_sarif}};
  std::erase_if(asked, [](const auto& report) { return report.first.empty(); });
  return asked;
}

CheckedDesign unwritten(const std::string& path, const certificates::OutputError& error) {
  return {path, {}, CheckObjection{Kind::cannot_write, "cannot be written: " + error.reason(), {}}};
}

bool is_unwritten(const CheckedDesign& each) {
  return each.objection && each.objection->kind == Kind::cannot_write;
}

}  // namespace

void print_checked(const CheckedDesign& design) {
  const char* actions = std::getenv("GITHUB_ACTIONS");
  if (actions != nullptr && std::string(actions) == "true") {
    fmt::print("{}", reports::to_annotations(design));
  }
  const auto outcome = reports::outcome_of(design);
  const char* verified = design.verified.value_or(false) ? ", verified" : "";
  if (outcome == reports::CheckOutcome::bad) {
    flush_standard_output();
    const CheckObjection& objection = *design.objection;
    fmt::print(stderr, "{}\n",
               certificates::InputError(design.path, objection.position, objection.message).what());
  } else if (outcome == reports::CheckOutcome::nothing_required) {
    fmt::print("{}: nothing required{}\n", design.path, verified);
  } else if (const auto& objection = design.objection) {
    fmt::print("{}: {}: {}\n", design.path,
               objection->kind == Kind::not_verified ? "not verified" : to_string(outcome),
               objection->message);
  }
  for (const reports::CheckedRequirement& each : design.requirements) {
    fmt::print("{}:{}: {}{}: {} ({})\n", design.path, each.position.line, rigor::to_string(each.verdict),
               each.verdict == rigor::Verdict::undecided ? "" : verified, each.requirement, each.reason);
  }
}

std::vector<CheckedDesign> unwritable_reports(const CheckOptions& options,
                                              const std::vector<std::string>& designs) {
  certificates::OutputFiles files;
  for (const std::string& path : designs) {
    files.keep(path);
  }
  std::vector<CheckedDesign> failures;
  for (const auto& [path, report] : reports_of(options)) {
    try {
      files.stage(path, report({}));
    } catch (const certificates::OutputError& error) {
      failures.push_back(unwritten(path, error));
    }
  }
  return failures;
}

void write_reports(const CheckOptions& options, std::vector<CheckedDesign>& checked) {
  std::set<std::string> failed;
  for (const CheckedDesign& each : checked) {
    if (is_unwritten(each)) {
      failed.insert(each.path);
    }
  }
  for (;;) {
    certificates::OutputFiles files;
    try {
      for (const CheckedDesign& each : checked) {
        if (!is_unwritten(each)) {
          files.keep(each.path);
        }
      }
      for (const auto& [path, report] : reports_of(options)) {
        if (!failed.contains(path)) {
          files.stage(path, report(checked));
        }
      }
      files.commit();
      return;
    } catch (const certificates::OutputError& error) {
      const std::string path = error.path().string();
      const auto asked = reports_of(options);
      const bool is_report =
          std::any_of(asked.begin(), asked.end(), [&](const auto& report) { return report.first == path; });
      if (!is_report || !failed.insert(path).second) {
        throw;
      }
      checked.push_back(unwritten(path, error));
      print_checked(checked.back());
    }
  }
}

}  // namespace veritrack::cli

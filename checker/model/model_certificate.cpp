#include "checker/model/model_certificate.hpp"

#include <map>
#include <optional>
#include <set>

#include "checker/model/gaussian_drift.hpp"
#include "checker/model/long_run.hpp"
#include "checker/model/model_claims.hpp"

namespace veritrack::checker {

namespace {

/// Of a tube: a filter's with bounds of its covariance has those of the estimate alone.
constexpr std::size_t kMostStates = 16;

std::size_t states_of_tubes(const ModelRecursion& recursion, bool bounds_covariance) {
  return bounds_covariance ? recursion.filtered() : recursion.states();
}

/// The sets that are verified, with a part for each.
std::map<std::string, TubeSet> verified_sets(const Tree& tubes, const TrackedModel& model,
                                             Verification& result) {
  std::map<std::string, TubeSet> sets;
  std::set<std::string> names;
  std::optional<bool> is_filter;
  for (const Tree& tree : tubes.elements()) {
    Objections objections;
    TubeSet set = read_tube_set(tree, model.recursion->states(), objections, model.recursion->filtered());
    const bool is_known = set.gaussian
                              ? set.name == "gaussian" || set.name == "lowest-snr"
                              : set.name == "starts" || set.name == "assumed" || set.name == kLongRun ||
                                    set.name == "noise" || set.name == "slew";
    if (!is_known || !names.insert(set.name).second) {
      objections.emplace_back(is_known ? "a second set of this name" : kUnknown);
    }
    if (states_of_tubes(*model.recursion, bounds_covariance(set)) > kMostStates) {
      objections.emplace_back("too many states");
    }
    check_order(set, objections);
    is_filter = is_filter.value_or(bounds_covariance(set));
    if (bounds_covariance(set) != *is_filter) {
      objections.emplace_back("some sets bound a covariance, and others do not");
    }
    if (objections.empty()) {
      // They object themselves where they fail.
      (void)(set.gaussian ? is_seldom_left(model, set, result.cells, objections)
                          : PhaseTubeCheck(model, set, result.cells).is_never_left(objections));
    }
    if (set.name == kLongRun && objections.empty()) {
      const auto around = sets.find("assumed");
      if (around == sets.end()) {
        objections.emplace_back("no verified set is around it");
      } else {
        (void)is_entered(model, around->second, set, result.cells, objections);
      }
    }
    result.parts.push_back({"tubes " + set.name, objections});
    if (objections.empty()) {
      const std::string name = set.name;
      sets.emplace(name, std::move(set));
    }
  }
  return sets;
}

void verify_model(const Tree& certificate, bool /*all_boxes*/, Verification& result) {
  const Tree& tree = certificate.at("design");
  Objections objections;
  ModelRecursion recursion(tree.at("model"));
  const ModelDesign design = read_model_design(tree, recursion, objections);
  if (states_of_tubes(recursion, recursion.filtered() > 0) > kMostStates) {
    objections.emplace_back("too many states");
  }
  result.parts.push_back({"design", objections});
  if (!objections.empty()) {
    return;  // nothing is said of what is no design
  }
  for (const Tree& derivation : certificate.at("derivations").elements()) {
    result.parts.push_back({derivation.at("id").text(), {kUnknown}});
  }
  const TrackedModel model{&recursion, design.amplitude, design.amplitude_varies};
  const std::map<std::string, TubeSet> sets = verified_sets(certificate.at("tubes"), model, result);
  const ModelClaims claims(tree, design, model, sets, result.cells);
  const auto check = [&](const Tree& claim, Objections& found) { return claims.check(claim, found); };
  check_claims(certificate, claims.required(), check, result);
}

}  // namespace

TrackerKind model_tracker() {
  return {"model", verify_model};
}

}  // namespace veritrack::checker

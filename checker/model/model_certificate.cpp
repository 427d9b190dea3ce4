#include "checker/model/model_certificate.hpp"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "checker/code/code_certificate.hpp"
#include "checker/code/written_formulas.hpp"
#include "checker/model/gain/gain_claims.hpp"
#include "checker/model/gain/gain_evidence.hpp"
#include "checker/model/gain/phase_evidence.hpp"
#include "checker/model/gaussian_drift.hpp"
#include "checker/model/long_run.hpp"
#include "checker/model/model_claims.hpp"

namespace veritrack::checker {

namespace {

/// The most states of a tube. For a filter with bounds of its covariance, only those of the estimate count.
constexpr std::size_t kMostStates = 16;

std::size_t states_of_tubes(const ModelRecursion& recursion, bool bounds_covariance) {
  return bounds_covariance ? recursion.filtered() : recursion.states();
}

/// All sets, in the order of the certificate, by their names; `failed`: the names with a set that is not
/// verified. Adds a part of the verification for each.
struct ReadSets {
  std::map<std::string, TubeFamily> families;
  std::set<std::string> failed;
};

/// The set in whose lowest levels part number `number` of the long run is, or none. That they are for the
/// same amplitudes is checked for whole families (verified_sets).
const TubeSet* set_around(const std::map<std::string, TubeFamily>& families, std::size_t number) {
  const auto found = families.find("assumed");
  return found != families.end() && number < found->second.sets.size() ? &found->second.sets[number]
                                                                       : nullptr;
}

std::string name_of_part(const TubeSet& set, std::size_t number) {
  return "tubes " + set.name + (set.amplitudes ? ", amplitudes " + std::to_string(number + 1) : "");
}

ReadSets read_sets(const Tree& tubes, const TrackedModel& tracked, const ModelDesign& design,
                   Verification& result) {
  ReadSets read;
  std::optional<bool> is_filter;
  for (const Tree& tree : tubes.elements()) {
    Objections objections;
    TubeSet set = read_tube_set(tree, tracked.recursion->states(), objections, tracked.recursion->filtered());
    const TrackedModel model = on_amplitudes_of(set, tracked, design, objections);
    const bool is_known = set.gaussian
                              ? set.name == "gaussian" || set.name == "lowest-snr"
                              : set.name == "starts" || set.name == "assumed" || set.name == kLongRun ||
                                    set.name == "noise" || set.name == "slew";
    if (!is_known) {
      objections.emplace_back(kUnknown);
    }
    TubeFamily& family = read.families[set.name];
    family.name = set.name;
    if (!family.sets.empty() && !set.amplitudes) {
      objections.emplace_back("a second set of this name");
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
      const TubeSet* around =
          read.failed.contains("assumed") ? nullptr : set_around(read.families, family.sets.size());
      if (around == nullptr) {
        objections.emplace_back("no verified set is around it");
      } else {
        (void)is_entered(model, *around, set, result.cells, objections);
      }
    }
    result.parts.push_back({name_of_part(set, family.sets.size()), objections});
    if (!objections.empty()) {
      read.failed.insert(set.name);
    }
    family.sets.push_back(std::move(set));
  }
  return read;
}

/// The families whose sets are all verified and together cover all amplitudes of the design.
std::map<std::string, TubeFamily> verified_sets(const Tree& tubes, const TrackedModel& tracked,
                                                const ModelDesign& design, Verification& result) {
  ReadSets read = read_sets(tubes, tracked, design, result);
  for (const auto& [name, family] : read.families) {
    Objections objections;
    check_amplitudes(family.sets, design, objections);
    if (name == kLongRun) {
      const auto around = read.families.find("assumed");
      check_same_parts(family.sets,
                       around == read.families.end() ? std::vector<TubeSet>() : around->second.sets,
                       objections);
    }
    if (design.is_constant_in_range) {
      result.parts.push_back({"amplitudes of tubes " + name, objections});
    }
    if (!objections.empty()) {
      read.failed.insert(name);
    }
  }
  for (const std::string& name : read.failed) {
    read.families.erase(name);
  }
  return std::move(read.families);
}

/// A loop that is verified by gains, or nothing where they could not be.
struct ByGains {
  std::unique_ptr<Gains> gains;
  std::unique_ptr<PhaseBounds> with_phases;

  [[nodiscard]] const LoopBounds* loop() const {
    return with_phases ? static_cast<const LoopBounds*>(with_phases.get()) : gains.get();
  }
  [[nodiscard]] const GainNetwork* network() const { return gains ? &gains->network : nullptr; }
};

bool has_phases(const Tree& certificate) {
  const Tree* evidence = certificate.find("gains");
  return evidence != nullptr && evidence->find("cells") != nullptr;
}

ByGains verified_gains(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
                       const RoundingOfStep& rounding, Verification& result) {
  ByGains found;
  Objections objections;
  const Tree& evidence = certificate.at("gains");
  if (has_phases(certificate)) {
    found.with_phases = read_phase_gains(evidence, model, design, rounding, objections);
  } else {
    if (certificate.find("tubes") != nullptr) {
      objections.emplace_back("tubes and gains in one certificate");
    }
    found.gains = read_gains(evidence, certificate.at("design").at("model"), *model.recursion, design,
                             rounding, objections);
  }
  result.parts.push_back({"gains", objections});
  return found;
}

/// Gains on the average beside tubes, or nothing where there are none.
std::unique_ptr<Gains> verified_averages(const Tree& certificate, const ModelDesign& design,
                                         const TrackedModel& model, Verification& result) {
  const Tree* evidence = certificate.find("averages");
  if (evidence == nullptr) {
    return nullptr;
  }
  Objections objections;
  auto found =
      read_gains(*evidence, certificate.at("design").at("model"), *model.recursion, design, {}, objections);
  result.parts.push_back({"averages", objections});
  return found;
}

/// Whether the sentence names no start in *the steady state of the certificate*: that of the averages is
/// another one than that of the gains beside them.
bool is_without_start(const std::string& claim) {
  return claim == kLimits || claim == kReach || claim == kLargestNoise;
}

/// By gains alone.
void verify_by_gains(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
                     const RoundingOfStep& rounding, Verification& result) {
  const ByGains found = verified_gains(certificate, design, model, rounding, result);
  const GainClaims claims(certificate, design, model, found.loop(), found.network());
  const auto check = [&](const Tree& claim, Objections& objections) {
    return claims.check(claim, objections);
  };
  check_claims(certificate, claims.required(), check, result);
}

/// By tubes, and with gains beside them: each claim by that which it names.
void verify_by_tubes(const Tree& certificate, const ModelDesign& design, const TrackedModel& model,
                     const RoundingOfStep& rounding, Verification& result) {
  const std::map<std::string, TubeFamily> sets =
      verified_sets(certificate.at("tubes"), model, design, result);
  const ModelClaims by_tubes(certificate, design, model, sets, result.cells);
  const ByGains found =
      has_phases(certificate) ? verified_gains(certificate, design, model, rounding, result) : ByGains();
  const GainClaims by_gains(certificate, design, model, found.loop(), found.network());
  const std::unique_ptr<Gains> averages = verified_averages(certificate, design, model, result);
  const GainClaims by_averages(certificate, design, model, averages.get(), nullptr);
  const auto check = [&](const Tree& claim, Objections& objections) {
    const Tree* by = claim.find("by");
    if (by == nullptr) {
      return by_tubes.check(claim, objections);
    }
    if (by->is("averages")) {
      if (!is_without_start(claim.at("id").text())) {
        objections.emplace_back("averages do not decide this");
      }
      return by_averages.check(claim, objections);
    }
    if (!by->is("gains")) {
      objections.emplace_back("a claim is by gains or averages, or names nothing");
    }
    return by_gains.check(claim, objections);
  };
  check_claims(certificate, by_tubes.required(), check, result);
}

/// With rounding, no noise is claimed that leaves less of a sample.
Ball least_sample_of(const Ball& amplitude) {
  return ((one - Ball(kMostRoundedNoise)) * amplitude).lower();
}

/// Empty where obligations rest on more than wraps.
RoundingOfStep rounding_of(CheckedCode code, const Ball& amplitude) {
  if (!code.angles) {
    return {};
  }
  code.angles->least_sample = least_sample_of(amplitude);
  return [code = std::move(code)](const std::vector<Ball>& states, const Ball& sample) {
    return listing_rounding(code.listing, *code.angles, states, sample);
  };
}

RoundingOfStep rounding_of(const Tree& model, ListedFormat format, const Ball& amplitude) {
  WrittenFormulas written = written_formulas(model, format);
  written.known.least_sample = least_sample_of(amplitude);
  return [written](const std::vector<Ball>& states, const Ball& sample) {
    return listing_rounding(written.listing, written.known, states, sample);
  };
}

void verify_model(const Tree& certificate, bool /*all_boxes*/, Verification& result) {
  const Tree& tree = certificate.at("design");
  Objections objections;
  ModelRecursion recursion(tree.at("model"));
  const bool by_gains = certificate.find("gains") != nullptr && !has_phases(certificate);
  // One channel does not tell a frequency from its negative, and tubes are for positive ones.
  const bool both_signs =
      recursion.samples() == 2 && (by_gains || certificate.at("tubes").elements().empty());
  ModelDesign design = read_model_design(tree, recursion, objections, both_signs);
  objections.insert(objections.end(), recursion.objections().begin(), recursion.objections().end());
  result.parts.push_back({"design", objections});
  if (!objections.empty()) {
    return;  // no statement is made about an invalid design
  }
  RoundingOfStep rounding;
  if (tree.find("code") != nullptr) {
    const CheckedCode code = check_code(tree, objections);
    rounding = rounding_of(code, design.least_amplitude);
    design.turned = code.turned;
    result.parts.push_back({"the recursion is that of the listing", objections});
    if (!objections.empty()) {
      return;  // nor of another one than the code's
    }
  }
  if (const auto format = written_format(tree.at("model"))) {
    if (tree.find("code") != nullptr || recursion.filtered() > 0) {
      result.parts.push_back({"arithmetic", {"only formulas that are written have an arithmetic"}});
      return;
    }
    rounding = rounding_of(tree.at("model"), *format, design.least_amplitude);
  }
  for (const Tree& derivation : certificate.at("derivations").elements()) {
    result.parts.push_back({derivation.at("id").text(), {kUnknown}});
  }
  const TrackedModel model{&recursion, design.amplitude, design.amplitude_varies};
  if (by_gains) {
    verify_by_gains(certificate, design, model, rounding, result);
  } else {
    verify_by_tubes(certificate, design, model, rounding, result);
  }
}

}  // namespace

TrackerKind model_tracker() {
  return {"model", verify_model};
}

}  // namespace veritrack::checker

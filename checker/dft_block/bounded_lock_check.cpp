#include "checker/dft_block/bounded_lock_check.hpp"

#include <algorithm>
#include <string>

#include "checker/dft_block/late_errors.hpp"
#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

/// The proposal of the evidence "lock", and of those of the stages.
struct Proposal {
  BlockSet set;
  BlockRate rate;
  std::vector<BlockStage> stages;
};

BlockStage read_stage(const Tree& evidence, const BlockSet& set) {
  const Tree& numbers = evidence.at("numbers");
  const Tree& matrices = evidence.at("matrices");
  return {{set.frame, exact_number(numbers.at("above")), exact_number(numbers.at("below")), set.floor},
          {exact_number(numbers.at("radius")),
           {exact_number(numbers.at("limit_1")), exact_number(numbers.at("limit_2")),
            exact_number(numbers.at("limit_3"))}},
          exact_number(numbers.at("next_above")),
          exact_number(numbers.at("next_below")),
          exact_number(numbers.at("noise_weight")),
          exact_matrix(matrices.at("reference")),
          exact_matrix(matrices.at("excess")),
          exact_matrix(matrices.at("noise"))};
}

bool is_stage(const BlockStage& stage) {
  return certainly_positive(stage.errors.radius) &&
         std::ranges::all_of(stage.errors.limits, [](const Ball& x) { return certainly_positive(x); }) &&
         certainly_at_most(one, stage.next_above) && certainly_less(stage.next_above, stage.set.above) &&
         certainly_at_most(one, stage.next_below) && certainly_less(stage.next_below, stage.set.below) &&
         certainly_positive(stage.noise_weight) && symmetric(stage.noise);
}

bool is_rate(const BlockRate& rate) {
  return certainly_positive(rate.radius) && certainly_positive(rate.rate) && certainly_less(rate.rate, one) &&
         certainly_positive(rate.weight);
}

/// The level at which noise and slew balance a rate.
Ball rest(const Ball& disturbance, const BlockRate& rate) {
  return disturbance / (one - rate.rate);
}

/// Empty for evidence without a proposal.
std::optional<Proposal> read_proposal(const Tree& derivation, Objections& objections) {
  const auto& all = derivation.at("evidence").elements();
  const Tree* evidence = find_evidence(derivation, "lock");
  if (evidence == nullptr) {
    objections.emplace_back("there is no evidence \"lock\"");
    return std::nullopt;
  }
  const Tree& numbers = evidence->at("numbers");
  Proposal found{{exact_matrix(evidence->at("matrices").at("frame")), exact_number(numbers.at("above")),
                  exact_number(numbers.at("below")), exact_number(numbers.at("floor"))},
                 {exact_number(numbers.at("radius")), exact_number(numbers.at("rate")),
                  exact_number(numbers.at("weight"))},
                 {}};
  bool are_stages = true;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Tree* stage = find_evidence(derivation, "late-" + std::to_string(i));
    if (stage == nullptr) {
      objections.emplace_back("the evidence is not \"lock\" and stages late-1, late-2, ...");
      return std::nullopt;
    }
    found.stages.push_back(read_stage(*stage, found.set));
    are_stages = are_stages && is_stage(found.stages.back());
  }
  if (!certainly_at_most(one, found.set.above) || !certainly_at_most(one, found.set.below) ||
      !is_rate(found.rate) || !are_stages) {
    objections.emplace_back("the evidence is no set");
    return std::nullopt;
  }
  return found;
}

}  // namespace

Derivation lock_set(const Tree& derivation, const BlockProblem& problem, const BlockStart& start_errors,
                    std::int64_t& cells, Objections& objections) {
  Derivation found;
  found.title = "A set about the exact lock that is never left";
  const std::optional<Proposal> proposal = read_proposal(derivation, objections);
  if (!proposal) {
    return found;
  }
  const BlockLock lock(problem, proposal->set);
  const Ball start = lock.length_of(start_errors.errors);
  const Ball disturbance = lock.disturbance();
  const Ball resting = rest(disturbance, proposal->rate);
  const bool falls = lock.falls(proposal->rate, cells);
  const bool tolerates = certainly_at_most(resting, proposal->rate.radius);
  // The steady state is in every set that is verified: docs/block-tracker.md, section 4.
  const bool starts = certainly_at_most(start, proposal->rate.radius) && falls &&
                      (!start_errors.covariance || lock.holds(*start_errors.covariance));
  found.conditions = {{"rate", "errors fall", proved_if(falls)},
                      {"noise", "noise and slew do not push errors out", proved_if(tolerates)},
                      {"start", "the starts are in the set", proved_if(starts)}};
  // The evidence is there for these two; the certificate states whether it contains the starts.
  if (!falls) {
    objections.emplace_back("errors do not certainly fall at that rate");
  }
  if (!tolerates) {
    objections.emplace_back("noise and slew may push errors out of the set");
  }
  if (!falls || !tolerates) {
    return found;
  }
  for (const BlockStage& stage : proposal->stages) {
    if (!BlockLock(problem, stage.set).stays_near(stage, cells)) {
      objections.emplace_back("a late stage is not verified");
      return found;
    }
  }
  if (!starts) {
    return found;
  }
  const auto add = [&](const char* name, const Ball& value) {
    found.quantities.push_back({name, value, Sense::bounds_above});
  };
  const Ball ever = max(start, resting);
  add("contraction_rate", proposal->rate.rate);
  add("offset_error_bound", ever * lock.reach(2));
  add("phase_error_bound", ever * lock.reach(1));
  add("amplitude_error_bound", ever * lock.reach(0));
  bool all_reached = false;
  const BlockErrors errors = block_errors(lock, {proposal->rate, proposal->stages, start}, all_reached);
  if (!all_reached) {
    objections.emplace_back("errors need not come to a late stage");
  }
  add("ultimate_offset_error", errors.ultimate);
  const Tree* blocks = derivation.at("quantities").find("settling_blocks");
  const Tree* settled = derivation.at("quantities").find("settled_offset_error");
  if (blocks != nullptr && settled != nullptr) {
    const Ball error = high_of(*settled);
    std::size_t block = 0;
    while (block < errors.offset.size() && !certainly_at_most(errors.offset[block], error)) {
      ++block;
    }
    const bool has_settled = block < errors.offset.size();
    add("settling_blocks", has_settled ? Ball(static_cast<double>(block + 1)) : Ball::everything());
    add("settled_offset_error", has_settled ? error : Ball::everything());
  }
  return found;
}

}  // namespace veritrack::checker

#include "checker/dft_block/bounded_lock_check.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

/// The proposal of the evidence "lock".
struct Proposal {
  BlockSet set;
  BlockRate rate;
  std::optional<BlockRate> late;
};

BlockRate read_rate(const Tree& numbers, const std::string& prefix) {
  return {exact_number(numbers.at(prefix + "radius")), exact_number(numbers.at(prefix + "rate")),
          exact_number(numbers.at(prefix + "weight"))};
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
  const Tree* evidence = find_evidence(derivation, "lock");
  if (evidence == nullptr || derivation.at("evidence").elements().size() != 1) {
    objections.emplace_back("the evidence is not \"lock\" alone");
    return std::nullopt;
  }
  const Tree& numbers = evidence->at("numbers");
  Proposal found{{exact_matrix(evidence->at("matrices").at("frame")), exact_number(numbers.at("above")),
                  exact_number(numbers.at("below")), exact_number(numbers.at("floor"))},
                 read_rate(numbers, ""),
                 std::nullopt};
  if (numbers.find("late_radius") != nullptr) {
    found.late = read_rate(numbers, "late_");
  }
  if (!certainly_at_most(one, found.set.above) || !certainly_at_most(one, found.set.below) ||
      !is_rate(found.rate) || (found.late && !is_rate(*found.late))) {
    objections.emplace_back("the evidence is no set");
    return std::nullopt;
  }
  return found;
}

/// The first block from which |C^-1 z| is at most that for ever.
std::optional<Ball> blocks_until(const Ball& length, const Ball& start, const Ball& disturbance,
                                 const BlockRate& rate, const std::optional<BlockRate>& late) {
  Ball e = start;
  constexpr int kMost = 100'000;
  for (int block = 1; block < kMost; ++block) {
    const BlockRate& now = late && certainly_at_most(e, late->radius) ? *late : rate;
    if (certainly_at_most(rest(disturbance, now), length) && certainly_at_most(e, length)) {
      return Ball(static_cast<double>(block));
    }
    e = (now.rate * e + disturbance).upper();
  }
  return std::nullopt;
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
  std::optional<BlockRate> late;
  if (proposal->late) {
    // Every error comes below its radius, and stays there.
    if (certainly_less(resting, proposal->late->radius) &&
        certainly_at_most(rest(disturbance, *proposal->late), proposal->late->radius) &&
        lock.falls(*proposal->late, cells)) {
      late = proposal->late;
    } else {
      objections.emplace_back("the late set is not verified");
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
  const Ball last = late ? rest(disturbance, *late) : resting;
  add("ultimate_offset_error", last * lock.reach(2));
  const Tree* blocks = derivation.at("quantities").find("settling_blocks");
  const Tree* settled = derivation.at("quantities").find("settled_offset_error");
  if (blocks != nullptr && settled != nullptr) {
    const Ball error = high_of(*settled);
    const auto block = blocks_until(error / lock.reach(2), start, disturbance, proposal->rate, late);
    add("settling_blocks", block ? *block : Ball::everything());
    add("settled_offset_error", block ? error : Ball::everything());
  }
  return found;
}

}  // namespace veritrack::checker

#include "checker/dft_block/lock_loss_check.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

struct Loss {
  Ball probability = Ball::everything();  ///< that |e| exceeds the radius within the blocks, at most
  Ball mean_square = Ball::everything();  ///< E |e_k|^2 until then, at most, in every block
  Ball mean_square_without_start = Ball::everything();  ///< the same from an exact start
};

/// With theta = tilt r/deviation^2 and W = exp(theta |e|^2/2): E W+ <= factor W^power, factor at least
/// det(floor)^(-1/2), which is at most W + constant; and E log W+ <= log factor + power log W. Balls of
/// everything where it is not defined.
Loss loss_of(const BlockProblem& problem, const BlockNoise& noise, const BlockLock& lock,
             const BlockDrift& drift, const Ball& slew_share) {
  const Ball theta = drift.tilt * problem.r / square(noise.deviation);
  const Matrix3& f = drift.floor;
  // A symmetric floor, by its pivots.
  const Ball second = f[1][1] - square(f[1][0]) / f[0][0];
  const Ball mixed = f[2][1] - f[2][0] * f[1][0] / f[0][0];
  const Ball third = f[2][2] - square(f[2][0]) / f[0][0] - square(mixed) / second;
  Ball power = drift.growth;
  Ball log_factor = -half * log(f[0][0] * second * third);
  if (!certainly_equal(problem.slew, zero)) {
    // s'floor^-1 s by the same pivots.
    const Vector3 s = lock.slew_direction();
    const Ball u1 = s[1] - f[1][0] / f[0][0] * s[0];
    const Ball u2 = s[2] - f[2][0] / f[0][0] * s[0] - mixed / second * u1;
    const Ball length = square(s[0]) / f[0][0] + square(u1) / second + square(u2) / third;
    power = power * (one + slew_share);
    log_factor += half * theta * (one + one / slew_share) * square(problem.slew) * length;
  }
  // cannot bind (noise.deviation): that of a design is above 0, or refused (block_design.cpp), and theta is
  // anything where it may be 0.
  if (!certainly_positive(power) || !certainly_less(power, one) || !certainly_positive(noise.deviation)) {
    return {};
  }
  // factor W^power - W has its maximum at log W = log(power factor)/(1 - power).
  const Ball log_constant = (log(power) + log_factor) / (one - power) + log((one - power) / power);
  const Ball level = half * theta * square(drift.radius);
  const Ball start_level = half * theta * square(lock.length_of(noise.start));
  const Ball tends_to = max(log_factor, zero) / (one - power);
  return {exp(start_level - level) + noise.blocks * exp(log_constant - level),
          two * max(start_level, tends_to) / theta, two * tends_to / theta};
}

bool is_drift(const BlockDrift& drift) {
  return certainly_positive(drift.radius) && certainly_positive(drift.tilt) &&
         certainly_positive(drift.growth) && certainly_less(drift.growth, one) &&
         certainly_positive(drift.weight) && certainly_positive(drift.floor_weight) &&
         symmetric(drift.floor) && definite(drift.floor);
}

}  // namespace

std::string lowest_snr_text(const Tree& derivation) {
  const Tree* evidence = find_evidence(derivation, "drift");
  const Tree* decimals = evidence != nullptr ? evidence->find("decimals") : nullptr;
  const Tree* decibels = decimals != nullptr ? decimals->find("snr_db") : nullptr;
  return decibels != nullptr ? decibels->text() : "";
}

Derivation lock_in_noise(const Tree& derivation, const BlockProblem& problem, const BlockNoise& noise,
                         std::int64_t& cells, Objections& objections) {
  Derivation found;
  const bool is_lowest = derivation.at("id").is("lowest-snr");
  found.title = is_lowest ? "The lowest signal-to-noise ratio for which the required probability is proved"
                          : "A set about the exact lock and the probability of leaving it";
  const Tree* evidence = find_evidence(derivation, "drift");
  if (evidence == nullptr || derivation.at("evidence").elements().size() != 1) {
    objections.emplace_back("the evidence is not \"drift\" alone");
    return found;
  }
  const Tree& numbers = evidence->at("numbers");
  const Tree& matrices = evidence->at("matrices");
  const auto number = [&](const char* name) { return exact_number(numbers.at(name)); };
  const BlockSet set{exact_matrix(matrices.at("frame")), number("above"), number("below"), zero};
  const BlockDrift drift{number("radius"), number("tilt"),         number("growth"),
                         number("weight"), number("floor_weight"), exact_matrix(matrices.at("floor"))};
  const Ball slew_share = number("slew_share");
  // cannot bind (above, below): no step keeps covariance bounds that exclude its steady state, so that no
  // drift is proved for such a set (docs/block-tracker.md, section 4).
  if (!is_drift(drift) || !certainly_positive(slew_share) || !certainly_at_most(one, set.above) ||
      !certainly_at_most(one, set.below)) {
    objections.emplace_back("the evidence is no set");
    return found;
  }
  const BlockLock lock(problem, set);
  const bool drifts = lock.drifts(drift, cells);
  // The steady state is in every set that is verified: docs/block-tracker.md, section 4.
  const bool starts = drifts && certainly_at_most(lock.length_of(noise.start), drift.radius) &&
                      (!noise.covariance || lock.holds(*noise.covariance));
  found.conditions = {{"drift", "E[W_{k+1}] \\le W_k + c", proved_if(drifts)},
                      {"start", "|e_1| \\le \\rho", proved_if(starts)}};
  if (!drifts) {
    objections.emplace_back("the drift is not certainly what it is said to be");
  }
  if (!starts) {
    return found;
  }
  const auto add = [&](const char* name, const Ball& value) {
    found.quantities.push_back({name, value, Sense::bounds_above});
  };
  const Loss loss = loss_of(problem, noise, lock, drift, slew_share);
  add("probability_of_losing_lock", min(loss.probability, one));
  // An estimate is the next prediction before the slew; its mean square is no larger.
  add("offset_error_bound", drift.radius * lock.reach(2) + problem.slew);
  add("rms_offset_error", sqrt(loss.mean_square) * lock.reach(2));
  add("rms_offset_error_without_start", sqrt(loss.mean_square_without_start) * lock.reach(2));
  add("phase_error_bound", drift.radius * lock.reach(1));
  add("amplitude_error_bound", drift.radius * lock.reach(0));
  if (is_lowest) {
    add("lowest_snr", from_decimal(lowest_snr_text(derivation)));
  }
  return found;
}

}  // namespace veritrack::checker

#include "analysis/quadrature/gaussian/lock_answer.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "analysis/quadrature/gaussian/lowest_snr.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// Levels of the starts that the probability of a set allows for.
constexpr std::array<double, 5> kStartLevels{kUsualStartLevel, 9.5, 11.0, 12.5, 14.0};
/// Ratios in a row without a set before the search ends.
constexpr int kMostWithout = 3;
/// The cost that a proof may have: less is left of the inequality than in a set for the assumed noise.
constexpr std::int64_t kAffordableLouder = 700'000;
constexpr std::size_t kEveryPart = 13;

bool has_probability(const LockQuestion& question, const LockCertificate& lock) {
  const theorems::Quantity* found =
      theorems::applicable_quantity(lock.derivation, "probability_of_losing_lock");
  return !lock.sets.empty() && found != nullptr &&
         certainly_less(found->value, Interval(question.probability));
}

/// A root mean square of the derivation is below what is required.
bool is_below(const LockQuestion& question, const LockAnswer& answer, const char* name) {
  const theorems::Quantity* found =
      answer.mean_square ? theorems::applicable_quantity(answer.mean_square->derivation, name) : nullptr;
  return found != nullptr && certainly_less(found->value, Interval(*question.required_rms));
}

bool does_all(const LockQuestion& question, const LockAnswer& answer) {
  return has_probability(question, answer.lock) &&
         (!question.required_rms || is_below(question, answer, "rms_frequency_error"));
}

/// Looks at sets for more noise, from the assumed noise on.
class LouderSets {
 public:
  LouderSets(const LockQuestion& question, bool with_mean_square)
      : question_(question), with_mean_square_(with_mean_square) {}

  [[nodiscard]] LockAnswer answer_of(LockCertificate lock) const {
    LockAnswer answer{std::move(lock), {}};
    if (with_mean_square_) {
      answer.mean_square = certify_mean_square(question_, answer.lock);
    }
    return answer;
  }

  /// The first that does all that is required.
  [[nodiscard]] std::optional<LockAnswer> first() const {
    // In quarters of a decibel; the noise at such a ratio is a little more than that.
    const double assumed = 4.0 * midpoint(decibels_of(question_.noise_deviation)) + 1e-6;
    if (!(assumed < 1e3)) {
      return std::nullopt;
    }
    int without = 0;
    for (int quarters = static_cast<int>(std::floor(assumed)); quarters >= 0 && without < kMostWithout;
         --quarters) {
      bool is_any = false;
      if (auto found = at(deviation_at(quarters), is_any)) {
        return found;
      }
      without = is_any ? 0 : without + 1;
    }
    return std::nullopt;
  }

  /// With that noise. `is_any`: the inequality seems true in some set.
  [[nodiscard]] std::optional<LockAnswer> at(double deviation, bool& is_any) const {
    LockQuestion louder = question_;
    louder.noise_deviation = Interval(deviation);
    for (const double level : kStartLevels) {
      const auto found = propose_lock_set(proposal_request(louder, level));
      if (!found || !(found->margin > 0.0)) {
        return std::nullopt;
      }
      is_any = true;
      if (!promises(found->set) ||
          !expects_cells(question_.design, found->set, kEveryPart, kAffordableLouder)) {
        continue;
      }
      LockCertificate lock = certify_lock(question_, found);
      if (has_probability(question_, lock)) {
        LockAnswer answer = answer_of(std::move(lock));
        if (does_all(question_, answer)) {
          return answer;
        }
      }
    }
    return std::nullopt;
  }

 private:
  /// Would the probability be as required, if the set were proved?
  [[nodiscard]] bool promises(const LockSet& set) const {
    const Interval level = start_level(set, question_.starts);
    return certainly_less(losing_probability(set, level, question_.samples), Interval(question_.probability));
  }

  LockQuestion question_;
  bool with_mean_square_;
};

/// With a leak: pieces whose borders do not depend on the band, for the assumed noise and for more.
std::optional<LockAnswer> over_aligned_pieces(const LockQuestion& question, const LouderSets& sets) {
  constexpr double kNyquist = 0x1.921fb54442d18p+1;
  constexpr std::array<double, 3> kFactors{1.0, 1.06, 1.12};  // half a decibel each
  for (const double factor : kFactors) {
    LockRequest request = proposal_request(question);
    request.noise_deviation *= factor;
    request.lowest_frequency = question.frequencies.lower() < 0.0 ? -kNyquist : 0.0;
    request.highest_frequency = kNyquist;
    LockCertificate lock = certify_lock(question, request);
    if (lock.sets.empty()) {
      return std::nullopt;
    }
    if (has_probability(question, lock)) {
      LockAnswer answer = sets.answer_of(std::move(lock));
      if (does_all(question, answer)) {
        return answer;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

LockAnswer answer_lock(const LockQuestion& question, bool with_mean_square) {
  const rigor::UpwardRounding upward;
  const LouderSets sets(question, with_mean_square);
  LockAnswer own = sets.answer_of(certify_lock(question));
  const bool constant = question.frequency_walk == Interval(0.0);
  const bool leaks = !(question.design.epsilon == Interval(0.0));
  if (does_all(question, own) || !is_well_posed(question) || (leaks && !constant)) {
    return own;
  }
  // Nothing is to be gained where the noise, and not the start, is too much.
  constexpr double kHopeless = -0.02;
  if (own.lock.proposal && own.lock.proposal->margin < kHopeless) {
    return own;
  }
  if (has_probability(question, own.lock) && own.mean_square &&
      theorems::applicable_quantity(own.mean_square->derivation, kRmsWithoutStart) != nullptr &&
      !is_below(question, own, kRmsWithoutStart)) {
    return own;
  }
  return (leaks ? over_aligned_pieces(question, sets) : sets.first()).value_or(std::move(own));
}

}  // namespace veritrack::quadrature

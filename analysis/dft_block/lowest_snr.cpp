#include "analysis/dft_block/lowest_snr.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "analysis/dft_block/lock_search.hpp"
#include "analysis/dft_block/loss_proposals.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::dft_block {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// Ratios are whole multiples of this share of a dB, so that a sentence can name them exactly.
constexpr int kPerDecibel = 100;

Interval decibels(int hundredths) {
  return Interval(hundredths) / Interval(kPerDecibel);
}

/// "3.07"
std::string decimal_of(int hundredths) {
  const int size = std::abs(hundredths);
  const int rest = size % kPerDecibel;
  return (hundredths < 0 ? "-" : "") + std::to_string(size / kPerDecibel) + (rest < 10 ? ".0" : ".") +
         std::to_string(rest);
}

/// A set, and the lowest ratio at which its probability is as required.
struct AtItsLowest {
  int hundredths;
  InNoise in_noise;
};

class SnrSearch {
 public:
  explicit SnrSearch(const LowestSnrQuestion& question)
      : question_(question),
        assumed_(static_cast<int>(
            std::ceil(-20.0 * kPerDecibel *
                      std::log10(question.loss.deviation.upper() / question.unit_deviation.lower())))) {}

  [[nodiscard]] LossQuestion question_at(int hundredths) const {
    LossQuestion question = question_.loss;
    question.deviation = question_.unit_deviation *
                         rigor::exp(-(decibels(hundredths) / Interval(20.0)) * rigor::log(Interval(10.0)));
    return question;
  }

  /// The lowest first.
  [[nodiscard]] std::vector<AtItsLowest> proposals() const {
    constexpr double kStep = 1.03;  // of the radius: a quarter of a dB
    const LockSearch search(question_.loss.problem);
    std::vector<AtItsLowest> result;
    for (const ProposedDrift& one : propose_drifts(question_.loss.problem, search, kStep)) {
      if (const auto frame = LockFrame::make(question_.loss.problem, one.set)) {
        for (const double share : kSlewShares) {
          if (auto found = lowest(*frame, one, share)) {
            result.push_back(std::move(*found));
          }
          if (question_.loss.problem.slew == Interval(0.0)) {
            break;  // the share is not used
          }
        }
      }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const AtItsLowest& a, const AtItsLowest& b) { return a.hundredths < b.hundredths; });
    return result;
  }

 private:
  [[nodiscard]] std::optional<LossBound> bound_at(int hundredths, const LockFrame& frame,
                                                  const ProposedDrift& one, double share) const {
    auto bound = loss_bound(question_at(hundredths), frame, one.drift, share);
    const bool is_met = bound && rigor::certainly_less_equal(bound->probability, question_.probability);
    return is_met ? bound : std::nullopt;
  }

  /// By bisection between noise that is too loud and noise that is quiet enough, up to 40 dB about the
  /// assumed noise.
  [[nodiscard]] std::optional<AtItsLowest> lowest(const LockFrame& frame, const ProposedDrift& one,
                                                  double share) const {
    constexpr int kAround = 40 * kPerDecibel;
    int good = assumed_ + kAround;
    int bad = assumed_ - kAround;
    std::optional<LossBound> bound = bound_at(good, frame, one, share);
    if (!bound) {
      return std::nullopt;
    }
    while (good - bad > 1) {
      const int middle = bad + (good - bad) / 2;
      if (auto there = bound_at(middle, frame, one, share)) {
        good = middle;
        bound = there;
      } else {
        bad = middle;
      }
    }
    return AtItsLowest{good, {one.set, one.drift, share, *bound}};
  }

  LowestSnrQuestion question_;
  int assumed_;
};

}  // namespace

theorems::Derivation derive_lowest_snr(const LowestSnrQuestion& question) {
  const rigor::UpwardRounding upward;
  theorems::Derivation derivation;
  derivation.id = "lowest-snr";
  derivation.title = "The lowest signal-to-noise ratio for which the required probability is proved";
  const SnrSearch search(question);
  const std::vector<AtItsLowest> proposed = search.proposals();
  std::vector<InNoise> sets;
  sets.reserve(proposed.size());
  for (const AtItsLowest& one : proposed) {
    sets.push_back(one.in_noise);
  }
  const std::optional<InNoise> found = first_verified(question.loss, sets);
  const auto same = std::find_if(proposed.begin(), proposed.end(), [&](const AtItsLowest& one) {
    return found && one.in_noise.drift.radius == found->drift.radius &&
           one.in_noise.drift.tilt == found->drift.tilt && one.in_noise.slew_share == found->slew_share;
  });
  if (same == proposed.end()) {
    conclude_loss(derivation, question.loss, std::nullopt);
    return derivation;
  }
  conclude_loss(derivation, search.question_at(same->hundredths), found);
  derivation.evidence.front().decimals.emplace_back("snr_db", decimal_of(same->hundredths));
  if (derivation.verdict == Verdict::proved) {
    theorems::add_quantity(
        derivation,
        {"lowest_snr", "\\mathrm{SNR}", "", "docs/block-tracker.md",
         "the lowest signal-to-noise ratio for which the required probability is proved, dB",
         theorems::Sense::at_most},
        decibels(same->hundredths));
  }
  return derivation;
}

}  // namespace veritrack::dft_block

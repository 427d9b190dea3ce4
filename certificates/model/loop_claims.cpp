#include "certificates/model/loop_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/model/gain/loop_detector.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "certificates/model/loop_verdicts.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/model/model_words.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/required_claims.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kDigitsOfReasons = 4;

/// Up to rounding: then all bounds are of one loop.
bool is_one_loop(const std::vector<linear::Row>& a) {
  constexpr double kRoundingOfEntries = 1e-9;
  return std::all_of(a.begin(), a.end(), [](const linear::Row& row) {
    return std::all_of(row.begin(), row.end(), [](const Interval& entry) {
      return rigor::width(entry) <= kRoundingOfEntries * std::max(1.0, rigor::magnitude(entry));
    });
  });
}

class LoopClaims {
 public:
  explicit LoopClaims(Certificate& certificate)
      : certificate_(&certificate),
        tables_(&model_tables(certificate.design)),
        sets_(&model_sets(certificate)),
        hypotheses_(ModelWords(*tables_, std::nullopt, sets_->starts_in(sets_->deciding())).constant_tone() +
                    ", without noise, to first order about the steady state of the certificate, ") {
    if (sets_->gains && sets_->gains->gains && sets_->gains->radius) {
      network_ = &sets_->gains->gains->network();
    }
  }

  void add() {
    const ModelRequirements& require = tables_->require;
    if (require.damping_at_least) {
      add_damping(*require.damping_at_least);
    }
    if (require.settles_like) {
      add_time_constant(*require.settles_like);
    }
    if (require.noise_bandwidth_below) {
      add_noise_bandwidth(*require.noise_bandwidth_below);
    }
    if (require.gain_margin_at_least) {
      add_gain_margin(*require.gain_margin_at_least);
    }
  }

 private:
  void add_damping(const Number& number) {
    Claim claim =
        start("model/damping", "every mode of the linear loop has a damping ratio of at least " + number.text,
              number);
    if (network_ != nullptr) {
      const auto [verdict, proved] = damping_verdict(*network_, number.value);
      conclude(claim, verdict,
               proved.empty() ? "No damping ratio of all modes was proved"
                              : "The damping ratio of every mode is proved to be at least " + proved,
               "at least " + number.text);
    }
    certificate_->claims.push_back(std::move(claim));
  }

  void add_time_constant(const Number& number) {
    Claim claim =
        start("model/time-constant",
              "the slowest mode of the linear loop shrinks by a factor of e in at most " + time_words(number),
              number);
    if (network_ != nullptr) {
      const double slowest = sets_->gains->radius->upper;
      conclude(claim, time_constant_verdict(*sets_->gains->radius, number.value),
               slowest < 1.0 ? "The time constant is proved to be at most " +
                                   time(Interval(-1.0) / log(Interval(slowest)))
                             : "No time constant was proved",
               "at most " + time_words(number));
    }
    certificate_->claims.push_back(std::move(claim));
  }

  void add_noise_bandwidth(const Number& number) {
    Claim claim = start("model/noise-bandwidth",
                        "the noise bandwidth of the linear loop is below " + frequency_words(number), number);
    if (const auto loop = detector(claim)) {
      const FrequencyUnits units(tables_->assume.sample_rate);
      const std::optional<Interval> bandwidth = linear::noise_bandwidth(*loop);
      conclude(claim, bandwidth_verdict(*loop, number.value),
               bandwidth ? "The noise bandwidth is proved to be at most " + units.at_most(*bandwidth)
                         : "No noise bandwidth was proved",
               "below " + frequency_words(number));
    }
    certificate_->claims.push_back(std::move(claim));
  }

  void add_gain_margin(const Number& number) {
    Claim claim =
        start("model/gain-margin",
              fmt::format("the linear loop stays stable while the gain of its detector grows by up to {} dB",
                          number.text),
              number);
    if (const auto loop = detector(claim)) {
      const auto [verdict, proved] = gain_margin_verdict(*loop, number.value);
      conclude(claim, verdict,
               proved.empty() ? "No gain margin was proved"
                              : fmt::format("The gain margin is proved to be at least {} dB", proved),
               fmt::format("at least {} dB", number.text));
    }
    certificate_->claims.push_back(std::move(claim));
  }

  static void conclude(Claim& claim, Verdict verdict, const std::string& known, const std::string& required) {
    claim.verdict = verdict;
    claim.reason = fmt::format("{}; {} is required.", known, required);
  }

  /// Decided already where the loop is unstable; with the reason where it has no one matrix.
  [[nodiscard]] Claim start(const char* id, std::string requirement, const Number& number) const {
    Claim claim = required_claim(id, std::move(requirement), hypotheses_, number);
    if (network_ != nullptr) {
      return claim;
    }
    if (!sets_->gains) {
      claim.reason =
          "This is known of loops that are certified by gains only: bounded noise, two channels, and a "
          "steady "
          "state that does not depend on the phase of the signal.";
    } else if (!sets_->gains->radius) {
      claim.reason =
          "The loop has no one linear recursion: the amplitude is not one number, something turns with the "
          "signal, or the steady state is where a function has a kink.";
    } else {
      // Its noise bandwidth is not defined.
      claim.verdict = claim.id == "model/noise-bandwidth" ? Verdict::undecided : Verdict::refuted;
      claim.reason = fmt::format(
          "The steady state is unstable: an error about it grows by a factor of {} or more each sample.",
          rigor::to_decimal(sets_->gains->radius->lower, kDigitsOfReasons, rigor::Direction::down));
    }
    return claim;
  }

  /// None, with the reason in the claim, where it is not known.
  std::optional<linear::DetectorLoop> detector(Claim& claim) const {
    if (network_ == nullptr) {
      return std::nullopt;
    }
    model::LoopDetector found = model::detector_of(*network_, sets_->gains->steady);
    if (!found.loop) {
      claim.reason = fmt::format("The gain of the loop is not defined: {}.", found.objection);
    } else if (!is_one_loop(network_->a)) {
      claim.reason =
          "The linear loop depends on the amplitude or the frequency, of which the design has a range: this "
          "is "
          "known where each is one number.";
      return std::nullopt;
    }
    return found.loop;
  }

  /// "82.7 samples (0.00662 s)", at most.
  [[nodiscard]] std::string time(const Interval& samples) const {
    const std::optional<Number>& rate = tables_->assume.sample_rate;
    return rigor::upper_decimal(samples) + " samples" +
           (rate ? fmt::format(" ({} s)", rigor::upper_decimal(samples / rate->value)) : "");
  }

  Certificate* certificate_;
  const ModelTables* tables_;
  const ModelSets* sets_;
  std::string hypotheses_;
  const model::LoopNetwork* network_ = nullptr;  ///< where it has one matrix, and is stable
};

}  // namespace

void add_loop_claims(Certificate& certificate) {
  LoopClaims(certificate).add();
}

}  // namespace veritrack::certificates

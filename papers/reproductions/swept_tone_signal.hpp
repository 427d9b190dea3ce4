// The signal of Table 3.2 and Table I, in words and as settings: what both reports share.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "papers/experiments/repeated_runs.hpp"
#include "papers/experiments/swept_tone.hpp"
#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::swept_tone {

/// First the one that most entries are compared with.
inline constexpr std::array<experiments::SweptTone, 2> kSignals{experiments::kFitted, experiments::kStandIn};
inline constexpr Conditions kSignalChosen{Conditions::Kind::chosen, "the signal and P(1|0) are unpublished"};

inline constexpr double kActualQ = 0.0005;
inline constexpr double kActualLeak = 0.05;

/// P(1|0) = this times I; 0: Q.
[[nodiscard]] inline double start_variance_of(const experiments::SweptTone& tone) {
  return tone.samples == experiments::kFitted.samples ? experiments::kFittedStartVariance : 0.0;
}

/// "mean / deviation".
[[nodiscard]] inline std::string mean_words(const std::vector<double>& sums) {
  const experiments::Summary summary = experiments::summary_of(sums);
  return sums.size() > 1 ? fmt::format("{:.4f} / {:.4f}", summary.mean, summary.deviation)
                         : fmt::format("{:.4f} / unknown", summary.mean);
}

/// The section about the signal.
inline constexpr const char* kSignalText =
    "## The signal\n\nNeither paper prints the signal, the number of samples or P(1|0). Known are: amplitude "
    "1 in both channels, a slew that varies in [0, 0.04] rad/sample per sample, 17 dB, and that the filters "
    "of the larger leak cannot follow at the largest slew. Ours has a slow rise and a fast stretch in which "
    "the slew reaches 0.04, both raised cosines. Its four numbers, the length and P(1|0) were chosen twice. "
    "The *stand-in* (`la-scala-1994` of `trackers/signals/`; start 0.5 rad/sample, slow rise 0.1, 7 fast "
    "samples of 330, P(1|0) = Q) was fitted to the four numbers of Table 3.2 alone. The *fitted* signal "
    "(start 0.4841 rad/sample, slow rise 0.1112, 8.1 fast samples of 317, from 50.8 % of the run, P(1|0) = "
    "0.35 I) comes out of a search over both tables: the four numbers of Table 3.2 and the eight of the "
    "column \"EKF, actual\"; the fast stretch was then shortened from 8.28 samples for the sake of Table "
    "3.2. Six choices against twelve numbers: that most come out says that the two tables are consistent "
    "with each other and with the little that is known of the signal, not that this was the "
    "signal.\n\nSimulated with `trackers/quadrature` and `trackers/notch` in double precision. Each seed "
    "draws the start's error and then the noise (64-bit Mersenne twister, Karney's normal deviates, seeds "
    "from 1 on), the same for every entry. The score is the *sum* over the run of the squared errors of the "
    "filtered frequency; both papers call it MSE. These are simulations: they prove nothing.\n";

}  // namespace veritrack::reports::swept_tone

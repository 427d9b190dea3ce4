#include "papers/reproductions/limit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "papers/limits/tone_bounds.hpp"
#include "papers/reproductions/limit_figures.hpp"

namespace veritrack::reports {

namespace {

using limits::Channels;
using limits::LimitPoint;

std::string tracker_name(Channels channels) {
  return channels == Channels::quadrature ? "quadrature" : "single channel";
}

std::string approximately(double value) {
  return fmt::format("≈ {:.2e}", value);
}

/// "≈ 3.01e-09 ± 2 %".
std::string with_standard_error(double value, double standard_error) {
  return std::isfinite(standard_error)
             ? fmt::format("≈ {:.2e} ± {:.0f} %", value, 100.0 * standard_error / value)
             : approximately(value) + " ± unknown";
}

/// "0.7 ± 0.3 %", the standard error of a share; "0 of 1000" where it says nothing.
std::string lost_words(double share, int runs) {
  if (share <= 0.0 || share >= 1.0) {
    return fmt::format("{:.0f} of {}", share * runs, runs);
  }
  return fmt::format("{:.1f} ± {:.1f} %", 100.0 * share, 100.0 * std::sqrt(share * (1.0 - share) / runs));
}

/// "0.31 ± 0.05 dB", the standard error of the mean carried over.
std::string above_bound(const LimitPoint& point) {
  if (!std::isfinite(point.standard_error)) {
    return fmt::format("{:+.2f} dB ± unknown", limits::decibels_above_bound(point));
  }
  const double spread = 10.0 / std::log(10.0) * point.standard_error / point.error;
  return fmt::format("{:+.2f} ± {:.2f} dB", limits::decibels_above_bound(point), spread);
}

std::string threshold_words(const std::vector<LimitPoint>& points) {
  const limits::Threshold threshold = limits::threshold_of(points);
  const double first = points.front().decibels;
  const double last = points.back().decibels;
  if (!threshold.at_least) {
    return fmt::format("above {:.0f} dB", last);
  }
  if (threshold.is_decided()) {
    return *threshold.at_most == first ? fmt::format("at or below {:.0f} dB", first)
                                       : fmt::format("{:.0f} dB", *threshold.at_most);
  }
  const std::string from = *threshold.at_least == first ? fmt::format("at or below {:.0f}", first)
                                                        : fmt::format("{:.0f}", *threshold.at_least);
  return threshold.at_most ? fmt::format("undecided, {} to {:.0f} dB", from, *threshold.at_most)
                           : fmt::format("undecided, {} dB or higher", from);
}

const limits::RandomWalkSeries& series_of(const LimitStudy& study, Channels channels, double walk_variance,
                                          double q1_share) {
  return *std::find_if(study.random_walks.begin(), study.random_walks.end(), [&](const auto& series) {
    return series.channels == channels && series.walk_variance == walk_variance &&
           series.q1_share == q1_share;
  });
}

/// The point with the largest excess over the bound among all from their series' thresholds on; null when no
/// threshold is known.
const LimitPoint* worst_above_threshold(const LimitStudy& study) {
  const LimitPoint* worst = nullptr;
  for (const limits::RandomWalkSeries& series : study.random_walks) {
    const auto threshold = limits::threshold_of(series.points).at_most;
    for (const LimitPoint& point : series.points) {
      const bool counts = threshold && point.decibels >= *threshold;
      if (counts &&
          (worst == nullptr || limits::decibels_above_bound(point) > limits::decibels_above_bound(*worst))) {
        worst = &point;
      }
    }
  }
  return worst;
}

std::string q1_words(double q1_share) {
  return q1_share > 0.0 ? fmt::format("{} q2", q1_share) : "0";
}

std::string threshold_table(const LimitStudy& study) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(study.random_walks.size());
  for (const limits::RandomWalkSeries& series : study.random_walks) {
    const LimitPoint& noisy = series.points.front();
    const LimitPoint& clean = series.points.back();
    rows.push_back({tracker_name(series.channels), fmt::format("{:.1g}", series.walk_variance),
                    q1_words(series.q1_share), threshold_words(series.points), above_bound(noisy),
                    lost_words(noisy.lost, study.runs), above_bound(clean),
                    lost_words(clean.lost, study.runs)});
  }
  return certificates::markdown::table(
      {"Tracker", "Walk variance, (rad/sample)²", "q1", "Threshold", "Above the bound at 0 dB",
       "Lost at 0 dB", "Above the bound at 30 dB", "Lost at 30 dB"},
      rows);
}

std::string random_walk_table(const LimitStudy& study, Channels channels, double walk_variance) {
  const limits::RandomWalkSeries& matched = series_of(study, channels, walk_variance, 0.0);
  const limits::RandomWalkSeries& looser = series_of(study, channels, walk_variance, limits::kSomeQ1);
  std::vector<std::vector<std::string>> rows;
  rows.reserve(matched.points.size());
  for (std::size_t i = 0; i < matched.points.size(); ++i) {
    std::vector<std::string> row{fmt::format("{:.0f}", matched.points[i].decibels),
                                 approximately(matched.points[i].bound)};
    for (const LimitPoint* point : {&matched.points[i], &looser.points[i]}) {
      row.insert(row.end(),
                 {approximately(point->error), above_bound(*point), lost_words(point->lost, study.runs)});
    }
    rows.push_back(std::move(row));
  }
  const std::string with_q1 = ", q1 = " + q1_words(limits::kSomeQ1);
  return certificates::markdown::table({"SNR, dB", "Bound", "Error, q1 = 0", "above the bound", "lost",
                                        "Error" + with_q1, "above the bound", "lost"},
                                       rows);
}

std::string constant_table(const LimitStudy& study) {
  std::vector<std::vector<std::string>> rows;
  const std::vector<double> decibels = limits::studied_decibels();
  for (std::size_t i = 0; i < decibels.size(); ++i) {
    std::vector<std::string> row{fmt::format("{:.0f}", decibels[i])};
    for (const limits::ConstantSeries& series : study.constant) {
      for (const LimitPoint* point : {&series.early[i], &series.late[i]}) {
        row.insert(row.end(), {approximately(point->bound), above_bound(*point)});
      }
    }
    rows.push_back(std::move(row));
  }
  return certificates::markdown::table(
      {"SNR, dB", "Quadrature, 100 samples: bound", "tracker above it", "1000 samples: bound",
       "tracker above it", "Single channel, 100 samples: bound", "tracker above it", "1000 samples: bound",
       "tracker above it"},
      rows);
}

/// Noise variance over A^2 that counts for a tracker: a real sample is worth half a complex one.
double effective_noise(Channels channels, double decibels) {
  return (channels == Channels::single ? 2.0 : 1.0) * limits::noise_variance_of(decibels);
}

std::string floor_table(const LimitStudy& study) {
  std::vector<std::vector<std::string>> rows;
  for (const limits::ErrorOverTime& series : study.over_time) {
    const double noise = effective_noise(series.channels, limits::kOverTimeDecibels);
    const double samples = limits::samples_until_mistuned(noise, series.tracker_q2);
    const bool reached = 2.0 * samples < limits::kLateSample;
    rows.push_back({tracker_name(series.channels), fmt::format("{:.1g}", series.tracker_q2),
                    fmt::format("≈ {:.0f}", samples),
                    approximately(limits::mistuned_variance(noise, series.tracker_q2)),
                    with_standard_error(series.mean_square.back(), series.standard_error) +
                        (reached ? "" : " (still falling)")});
  }
  return certificates::markdown::table(
      {"Tracker", "q2, (rad/sample)²", "Samples until the floor", "Floor by formula, (rad/sample)²",
       "Simulated after 1000 samples, (rad/sample)²"},
      rows);
}

/// The summary at the top: every number in it is from the study.
std::string summary(const LimitStudy& study) {
  constexpr double kFast = limits::kWalkVariances.back();
  const auto words = [&](Channels channels, double q1_share) {
    return threshold_words(series_of(study, channels, kFast, q1_share).points);
  };
  constexpr int kAverage = 1000;
  const double noise = limits::noise_variance_of(limits::kOverTimeDecibels);
  const LimitPoint* worst = worst_above_threshold(study);
  const std::string warning = undecided_thresholds(study);
  return (warning.empty() ? "" : "*" + warning + "*\n\n") +
         fmt::format(
             "**Results for an engineer.** (1) With $`q_2`$ and $`r`$ equal to the variances of the signal, "
             "no "
             "filter can do much better: from its threshold on, each tracker has a mean square frequency "
             "error at "
             "most ≈ {} above the bound for any estimator. For a frequency that changes by {:.3f} rad/sample "
             "per sample (standard deviation) the threshold is {} for the quadrature tracker and {} for the "
             "single-channel one. (2) $`q_1`$ is important when one channel is measured: the signal has no "
             "such "
             "noise, but with $`q_1`$ = {} the same threshold of the single-channel tracker is {}. With "
             "$`q_1 = 0`$ "
             "and little measurement noise that filter trusts its linearisation too much for the steps of "
             "the "
             "frequency. (3) Measuring one channel instead of two has the same effect as twice the noise. "
             "(4) For a "
             "constant frequency everything depends on $`q_2`$: the error stops decreasing after about "
             "$`3.2\\,(\\rho/q_2)^{{1/4}}`$ samples, $`\\rho`$ the noise variance over the squared "
             "amplitude, so "
             "that averaging over $`N`$ samples needs $`q_2 \\approx \\rho\\,(3.2/N)^4`$ (at {:.0f} dB and "
             "$`N`$ = "
             "{}: ≈ {:.0e} (rad/sample)²).\n\n",
             worst == nullptr ? "an unknown number of dB" : above_bound(*worst), std::sqrt(kFast),
             words(Channels::quadrature, 0.0), words(Channels::single, 0.0), q1_words(limits::kSomeQ1),
             words(Channels::single, limits::kSomeQ1), limits::kOverTimeDecibels, kAverage,
             noise * std::pow(3.24 / kAverage, 4));
}

std::string setting_text(const LimitStudy& study) {
  return fmt::format(
      "Everything on this page is floating point and simulation. It proves nothing; ≈ marks simulated or "
      "rounded values.\n\n## What is compared\n\nA sinusoid of amplitude 1 whose frequency is $`\\omega(k+1) "
      "= \\omega(k) + w(k)`$, $`w`$ normal with the walk variance (zero: constant), in normal noise. The "
      "signal-to-noise ratio (SNR) is half the squared amplitude over the noise variance of a channel, which "
      "is also the ratio of the complex signal. The trackers are those of `trackers/`, without leak, $`r`$ "
      "the noise variance; they start with deviations of 0.1 in amplitude, 0.1 rad in phase and 0.05 "
      "rad/sample in frequency (mean 1.5 rad/sample), known to them as P(0). Errors are mean squares over {} "
      "runs (noise seeds 1 to {}, the same for every entry), lost runs included; ± is their standard error. "
      "A run is lost when its root mean square frequency error over the last {} samples is above {} "
      "rad/sample. The threshold is the lowest SNR of the grid from which on the error stays within {:.0f} "
      "dB of the bound; where {:.0f} standard errors do not decide that, it is given as undecided. "
      "Differences "
      "of less than {:.0f} standard errors may be chance.\n\n",
      study.runs, study.runs, limits::kLockWindow, limits::kLockThreshold, limits::kNearBound,
      limits::kStandardErrors, limits::kStandardErrors);
}

}  // namespace

LimitStudy simulate_limits(int runs, const limits::StudyProgress& progress) {
  // The steps of all three parts together; the first has most of them.
  constexpr int kWalks = 132;
  constexpr int kConstant = 22;
  constexpr int kOverTime = 8;
  const auto part = [&](int before) -> limits::StudyProgress {
    return [&progress, before](int done, int /*most*/) {
      if (progress) {
        progress(before + done, kWalks + kConstant + kOverTime);
      }
    };
  };
  LimitStudy study;
  study.runs = runs;
  study.random_walks = limits::study_random_walks(runs, part(0));
  study.constant = limits::study_constant_frequency(runs, part(kWalks));
  study.over_time = limits::study_errors_over_time(runs, part(kWalks + kConstant));
  return study;
}

std::string undecided_thresholds(const LimitStudy& study) {
  const auto undecided = std::count_if(study.random_walks.begin(), study.random_walks.end(),
                                       [](const limits::RandomWalkSeries& series) {
                                         return !limits::threshold_of(series.points).is_decided();
                                       });
  return undecided == 0
             ? ""
             : fmt::format(
                   "{} runs are too few for {} of the {} thresholds: two standard errors do not decide "
                   "them. More seeds would.",
                   study.runs, undecided, study.random_walks.size());
}

std::string limit_document(const LimitStudy& study) {
  std::string text = "# The trackers compared with the Cramér–Rao bound\n\n" + summary(study);
  text += setting_text(study);
  text +=
      "## A frequency that is a random walk\n\nThe trackers' $`q_2`$ is the walk variance, their $`q_1`$ "
      "zero as in the signal, or a tenth of $`q_2`$. Runs of 200 samples; error and bound are means over the "
      "last 100. The bound is the posterior Cramér–Rao bound of Tichavský, Muravchik and Nehorai (IEEE "
      "Trans. Signal Processing 46(5), 1998), $`J(k+1) = D^{22} - D^{21}(J(k) + D^{11})^{-1}D^{12}`$. In the "
      "coordinates amplitude, phase, frequency the dynamics is linear, and the recursion is $`J(k+1) = (F "
      "J(k)^{-1} F' + Q)^{-1} + \\mathrm{E}[h_x' R^{-1} h_x]`$, the expectation in closed form "
      "(`papers/limits/posterior_bound.hpp`). It bounds the mean square error of every estimator, biased "
      "or not; an entry slightly below it is due to chance.\n\n" +
      threshold_table(study) +
      "\n![Error of the two trackers and the bound over the signal-to-noise "
      "ratio](figures/random-walk.svg)\n\n"
      "*Mean square frequency error of the trackers (points) and posterior Cramér–Rao bound (lines), for "
      "three variances of the walk, "
      "(rad/sample)²; open points q1 = 0, crosses q1 = 0.1 q2.*\n\nBounds and errors in the following tables "
      "are in (rad/sample)².\n\n";
  for (const Channels channels : {Channels::quadrature, Channels::single}) {
    for (const double walk_variance : limits::kWalkVariances) {
      text += fmt::format("### {} tracker, walk variance {:.1g} (rad/sample)²\n\n",
                          channels == Channels::quadrature ? "Quadrature" : "Single-channel", walk_variance) +
              random_walk_table(study, channels, walk_variance) + "\n";
    }
  }
  text +=
      "## A constant frequency\n\nWithout prior knowledge the bound for $`N`$ samples is $`12\\rho/(N(N^2 - "
      "1))`$ for complex samples (Rife and Boorstyn, IEEE Trans. Information Theory 20(5), 1974), and about "
      "twice that for real ones (exactly: the inverse of the Fisher information of amplitude, phase and "
      "frequency). The trackers have some prior knowledge; with this as a further measurement the bound is "
      "the recursion above with $`Q = 0`$. It applies to unbiased estimators.\n\n![Error of the two trackers "
      "and the bound over the number of samples](figures/constant.svg)\n\n*Mean square frequency error at 20 "
      "dB over the number of samples, both logarithmic: bound (broad grey), bound without knowledge of the "
      "start (dotted grey), trackers (black) by their q2 in (rad/sample)².*\n\nA tracker whose $`q_2`$ is "
      "not zero settles: at $`\\rho^{1/4} q_2^{3/4}/(2\\sqrt 2)`$, a quarter of the variance that it "
      "computes itself, and from about $`3.2\\,(\\rho/q_2)^{1/4}`$ samples on ($`2\\rho`$ in place of "
      "$`\\rho`$ for one channel). At 20 dB:\n\n" +
      floor_table(study) +
      "\nWith $`q_1 = 0`$ and $`q_2`$ = " + fmt::format("{:.0e}", limits::kNearlyZeroQ2) +
      " (rad/sample)², nearly zero, over the SNR (bounds in (rad/sample)²):\n\n" + constant_table(study) +
      "\nAn extended Kalman filter that assumes a constant frequency never forgets: the errors of its first, "
      "linearised steps at a low SNR stay in the estimate, and exceed the bound by more, the longer one "
      "averages.\n";
  return text;
}

WrittenReport write_limit_report(int runs, const std::filesystem::path& directory,
                                 const page::Renderings& renderings, const limits::StudyProgress& progress) {
  const LimitStudy study = simulate_limits(runs, progress);
  page::Document document{"report", limit_document(study)};
  document.figure_folder = "figures/";
  document.figures =
      with_pictures({draw_random_walks(study.random_walks), draw_errors_over_time(study.over_time)});
  certificates::OutputFiles files;
  stage_document(files, directory, document, renderings);
  files.commit();
  return {directory / "report.md", undecided_thresholds(study)};
}

}  // namespace veritrack::reports

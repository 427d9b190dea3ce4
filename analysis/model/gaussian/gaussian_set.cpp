#include "analysis/model/gaussian/gaussian_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/model/gaussian/gaussian_drift.hpp"
#include "analysis/model/set/set_search.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// The contribution of starts to the probability, relative to that of the samples, at most.
constexpr double kShareOfStarts = 0.05;

/// A bound of the probability that |v| > V: by E exp(s |v|^2) <= (1 - 2 sigma^2 s)^(-channels/2), which every
/// sub-Gaussian vector meets, with the best s.
Interval tail(const GaussianTerms& terms, int channels) {
  const Interval squared = square(Interval(terms.most_noise) / Interval(terms.deviation));
  const Interval count(static_cast<double>(channels));
  const Interval half(0.5);
  if (!rigor::certainly_less(count, squared)) {
    return Interval(1.0);
  }
  return rigor::exp(half * count * (rigor::log(squared / count) + Interval(1.0)) - half * squared);
}

/// The exponent and the most noise for a task; the noise of this deviation.
GaussianTerms terms_for(const GaussianTask& task, int channels, double deviation, double factor,
                        double constant) {
  const rigor::UpwardRounding upward;
  GaussianTerms terms;
  terms.deviation = deviation;
  terms.factor = factor;
  terms.constant = constant;
  constexpr double kShareOfSamples = 0.98;
  const double of_samples =
      task.samples * constant * (1.0 + kShareOfStarts) + 1.01 * constant / (1.0 - factor);
  const double share = task.deviations.empty() ? task.start_share : 0.0;
  constexpr int kSteps = 60;  // of an iteration that converges when starts are inside
  for (int i = 0; i < kSteps; ++i) {
    const double of_starts = std::exp(terms.exponent * share * share);
    terms.exponent = std::log((of_samples + of_starts) / (kShareOfSamples * task.probability));
  }
  // The least that leaves a thousandth of the probability to longer noise.
  for (double multiple = 3.0; multiple < 40.0; multiple += 0.25) {
    terms.most_noise = multiple * deviation;
    const Interval longer = tail(terms, channels);
    const double often = (longer * Interval(task.samples)).upper();
    const double ever = (longer * rigor::exp(Interval(terms.exponent))).upper();
    if (often < 1e-3 * task.probability && ever < 1e-2 * constant) {
      break;
    }
  }
  return terms;
}

/// The search for the radius of one tube.
class RadiusSearch {
 public:
  RadiusSearch(const TrackerModel& model, const TubeProposal& proposal, const GaussianTask& task)
      : model_(&model), proposal_(&proposal), task_(&task) {
    proved_.tube = *proposal.tube;
    constexpr double kLittleRoom = 0.02;
    proved_.grid.deadline = task.deadline;
    proved_.grid.phases = 1.0 - proposal.worth.rate < kLittleRoom ? 64 : 32;
  }

  /// The largest deviation that points allow, at any radius, for these factors.
  [[nodiscard]] std::pair<double, double> largest_deviation(double factor, double constant) const {
    double best = 0.0;
    double best_radius = 0.0;
    for (const double share : {1.0, 0.75, 0.55, 1.3, 0.3}) {
      const double radius = share * proposal_->worth.level;
      double deviation = 0.0;
      for (const double guess : {0.6, 0.2, 0.05}) {
        const double tried = std::max(1.02 * best, guess * proposal_->worth.noise);
        deviation = deviation == 0.0 && may_hold(radius, tried, factor, constant) ? tried : deviation;
      }
      if (deviation == 0.0) {
        continue;
      }
      for (double step = 1.4; step > 1.02; step = std::sqrt(step)) {
        while (may_hold(radius, deviation * step, factor, constant)) {
          deviation *= step;
        }
      }
      best = deviation;
      best_radius = radius;
    }
    return {best, best_radius};
  }

  /// Proves the tube of this radius.
  [[nodiscard]] bool proves(double radius, const GaussianTerms& terms) {
    if (!is_locked(*model_, proved_.tube, radius)) {
      return false;
    }
    const DriftResult result = verify_drift(*model_, proved_.tube, question_of(radius, terms), proved_.grid);
    if (result.verdict != Verdict::proved) {
      return false;
    }
    proved_.levels = {radius};
    proved_.cells = result.cells;
    return true;
  }

  /// Whether points allow it, and starts are far enough inside.
  [[nodiscard]] bool may_hold(double radius, const GaussianTerms& terms) const {
    constexpr int kPhases = 16;
    return drift_may_hold(*model_, proved_.tube, question_of(radius, terms), kPhases);
  }
  /// The level of the starts.
  [[nodiscard]] double start_level() const {
    return task_->deviations.empty() ? 0.0 : bound_start(*model_, proved_.tube, task_->deviations, {64, 1});
  }
  [[nodiscard]] const ProvedTube& proved() const { return proved_; }
  [[nodiscard]] double guess() const { return proposal_->worth.level; }

 private:
  [[nodiscard]] bool may_hold(double radius, double deviation, double factor, double constant) const {
    return may_hold(radius, terms_for(*task_, model_->recursion->samples, deviation, factor, constant));
  }
  /// A little more than is claimed, for a checker whose bounds are cruder.
  static DriftQuestion question_of(double radius, const GaussianTerms& terms) {
    constexpr double kMoreNoise = 1.004;
    constexpr double kLessConstant = 0.85;
    constexpr double kRoom = 1.1;
    return {radius,
            kMoreNoise * terms.deviation,
            terms.most_noise,
            terms.exponent,
            terms.factor,
            kLessConstant * terms.constant,
            kRoom};
  }

  const TrackerModel* model_;
  const TubeProposal* proposal_;
  const GaussianTask* task_;
  ProvedTube proved_;
};

/// The search over the cells of a band: one noise and one inequality for all of them.
class BandSearch {
 public:
  BandSearch(const TrackerModel& model, const BandProposal& band, const GaussianTask& task,
             SetProgress progress)
      : task_(&task), channels_(model.recursion->samples), progress_(std::move(progress)) {
    double rate = 0.0;
    for (const TubeProposal& cell : band.cells) {
      searches_.emplace_back(model, cell, task);
      bounds_covariance_ = bounds_covariance_ || cell.tube->bounds_covariance();
      rate = std::max(rate, cell.worth.rate);
    }
    // The share of a start that the set forgets in a sample; a small part of the share that the tracker
    // forgets.
    factor_ = 1.0 - 0.02 * (1.0 - rate * rate);
  }

  /// The largest deviation; 0 when none is proved.
  [[nodiscard]] double with_largest_deviation() {
    double best = 0.0;
    for (const double constant : constants()) {
      double least = INFINITY;
      for (const RadiusSearch& search : searches_) {
        least = std::min(least, least > best ? search.largest_deviation(factor_, constant).first : 0.0);
      }
      if (least > 1.005 * best) {
        best = least;
        constant_ = constant;
      }
    }
    for (const double share : {0.97, 0.94, 0.9, 0.85, 0.78, 0.7}) {
      if (best > 0.0 && with_deviation(share * best)) {
        return share * best;
      }
    }
    return 0.0;
  }

  /// Whether all tubes are proved for this deviation.
  [[nodiscard]] bool with_deviation(double deviation) {
    terms_ = terms_for(*task_, channels_, deviation, factor_, constant_);
    failed_ = 0;
    for (RadiusSearch& search : searches_) {
      if (!proves(search)) {
        return false;
      }
      ++failed_;
      progress_(static_cast<double>(failed_) / static_cast<double>(searches_.size()));
    }
    return true;
  }
  [[nodiscard]] bool with_any_constant(double deviation) {
    for (const double constant : constants()) {
      constant_ = constant;
      if (with_deviation(deviation)) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] const GaussianTerms& terms() const { return terms_; }
  [[nodiscard]] std::size_t failed() const { return failed_; }
  [[nodiscard]] const std::vector<RadiusSearch>& searches() const { return searches_; }

 private:
  /// Bounds of a covariance leave less room near the curve.
  [[nodiscard]] const std::array<double, 3>& constants() const {
    static constexpr std::array<double, 3> kUsual{1.0, 0.2, 5.0};
    static constexpr std::array<double, 3> kOfFilters{5.0, 20.0, 1.0};
    return bounds_covariance_ ? kOfFilters : kUsual;
  }

  /// Approximately the least radius: the set that is not left is then small.
  [[nodiscard]] bool proves(RadiusSearch& search) const {
    const double share = std::sqrt(
        std::log(std::max(2.0, kShareOfStarts * task_->samples * terms_.constant)) / terms_.exponent);
    const double start = 1.01 * search.start_level() / share;
    for (double radius = std::max(start, 0.2 * search.guess()); radius < 1.6 * search.guess();
         radius *= 1.08) {
      if (task_->deadline.is_over()) {
        return false;
      }
      if (search.may_hold(radius, terms_)) {
        return search.proves(1.04 * radius, terms_) || search.proves(1.1 * radius, terms_);
      }
    }
    return false;
  }

  const GaussianTask* task_;
  int channels_;
  SetProgress progress_;
  bool bounds_covariance_ = false;
  std::vector<RadiusSearch> searches_;
  double factor_ = 0.999;
  double constant_ = 1.0;
  GaussianTerms terms_;
  std::size_t failed_ = 0;
};

}  // namespace

TubeSet prove_gaussian_set(const TrackedTone& tone, const TrackerModel& model, double low, double high,
                           const GaussianTask& task, const SetProgress& progress) {
  const rigor::NearestRounding nearest;
  SetTask shape;
  shape.objective = ShapeObjective::largest_deviation;
  shape.deadline = task.deadline;
  BandSettings settings = settings_of(tone, shape, low, high);
  settings.tube.shape.exponent = std::log(task.samples / task.probability);
  double most = 0.0;
  const auto report = [&](double share) {
    most = std::max(most, share);
    if (progress) {
      progress(most);
    }
  };
  constexpr double kOfProposals = 0.5;  // of the time, about
  settings.decided = [&](const TubeProposal& cell, bool /*may_be_halved*/) {
    report(kOfProposals * (cell.frequency + cell.half_width - low) / (high - low));
    return true;
  };
  BandProposal band = propose_band(tone, low, high, settings);
  TubeSet set;
  set.name = task.name;
  set.reasons = reasons_of(band);
  if (!band.is_complete) {
    return set;
  }
  for (TubeProposal& cell : band.cells) {
    widen(*cell.tube);
  }
  BandSearch search(model, band, task, [&](double share) { report(kOfProposals + 0.5 * share); });
  const bool is_found = task.largest_deviation ? search.with_largest_deviation() > 0.0
                                               : search.with_any_constant(task.deviation);
  report(1.0);
  if (!is_found) {
    set.reasons.push_back(
        task.deadline.has_struck() ? std::string(kTimeLimit)
        : task.largest_deviation
            ? "no deviation of the noise was proved"
            : fmt::format("no tube was proved for a deviation of {:.4g} {}", task.deviation,
                          place_of_cell(band.cells[std::min(search.failed(), band.cells.size() - 1)])));
    return set;
  }
  for (const RadiusSearch& cell : search.searches()) {
    set.tubes.push_back(cell.proved());
  }
  set.gaussian = search.terms();
  set.is_complete = covers(set.tubes, low, high);
  return set;
}

double leaving_probability(const GaussianTerms& terms, int channels, const Interval& samples,
                           double start_share) {
  const Interval one(1.0);
  const Interval exponent(terms.exponent);
  const Interval longer = tail(terms, channels);
  const Interval rest = one - Interval(terms.factor);
  if (!(start_share >= 0.0) || !rigor::certainly_positive(rest)) {
    return INFINITY;
  }
  const Interval rarely = rigor::exp(-exponent);
  const Interval constant(terms.constant);
  const Interval probability = rigor::exp(exponent * (square(Interval(start_share)) - one)) +
                               (constant * rarely + longer) / rest + samples * (constant * rarely + longer);
  return rigor::is_finite(probability) ? probability.upper() : INFINITY;
}

}  // namespace veritrack::model

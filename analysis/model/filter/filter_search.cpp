#include "analysis/model/filter/filter_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace veritrack::model::detail {

namespace {

/// The three best ones, the best first.
std::vector<ScoredPoint> three_best(std::vector<ScoredPoint> starts) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const ScoredPoint& a, const ScoredPoint& b) { return a.value > b.value; });
  constexpr std::size_t kMost = 3;
  starts.resize(std::min(kMost, starts.size()));
  return starts;
}

}  // namespace

FilterSearch::FilterSearch(const TrackedTone& tone, const CurveFit& curve, const TubeSettings& settings,
                           double rate)
    : tone_(&tone),
      nodes_{curve.at(-1.0), curve.at(0.0), curve.at(1.0)},
      slopes_{curve.slope_at(-1.0), curve.slope_at(0.0), curve.slope_at(1.0)},
      points_(std::make_shared<const std::vector<OrbitPoints>>()) {
  const Index n = tone.filter->states;
  const VectorXd state = state_at(nodes_[1], kFirstPhase);
  VectorXd sizes(n);
  // For deviations: those that the filter itself expects.
  Index place = n;
  for (Index i = 0; i < n; ++i) {
    sizes[i] = std::sqrt(std::max(1e-300, state[place]));
    place += n - i;
  }
  const bool is_gaussian = settings.shape.objective == ShapeObjective::largest_deviation;
  const bool is_for_noise = settings.shape.objective == ShapeObjective::largest_noise || is_gaussian;
  // The largest reach at a given noise, or the largest noise.
  const bool is_for_slew = settings.shape.objective == ShapeObjective::largest_slew;
  coordinates_ = {rate * rate,
                  sizes,
                  settings.shape.noise,
                  is_for_noise && !(settings.shape.noise > 0.0),
                  settings.shape.slew,
                  is_for_slew && !(settings.shape.slew > 0.0),
                  is_gaussian ? settings.shape.exponent + std::log(kProposedConstant) : 0.0};
  largest_reach_ = settings.shape.largest_reach;
  deadline_ = settings.shape.deadline;
  const int usual = is_gaussian ? 150 : 100;
  evaluations_ = settings.shape.evaluations > 0 ? settings.shape.evaluations / 3 : usual;
}

void FilterSearch::follow_orbits() {
  std::vector<OrbitPoints> points;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    points.emplace_back(*tone_, nodes_.at(i), kFirstPhase, Surroundings{}, &slopes_.at(i));
  }
  points_ = std::make_shared<const std::vector<OrbitPoints>>(std::move(points));
}

FilterWorth FilterSearch::worth_at(const FilterParameters& parameters, int samples, double enough) const {
  std::array<FilterWorth, 3> each;
  tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t i) {
    each.at(i) = worth_on_orbit(*tone_, nodes_.at(i), parameters,
                                memory_of(coordinates_.rate_squared, parameters, 1e-4), samples, {},
                                &slopes_.at(i), points_->empty() ? nullptr : &points_->at(i), enough);
  });
  return least_of(each);
}

VectorXd FilterSearch::with_size(VectorXd x, double logarithm) const {
  x[3] += logarithm;
  x.segment(5, coordinates_.sizes.size() + (coordinates_.moves() ? 1 : 0)).array() += logarithm;
  return x;
}

VectorXd FilterSearch::scaled(VectorXd x, double logarithm) const {
  if (coordinates_.finds()) {
    x[coordinates_.size() - 1] += logarithm;
    return x;
  }
  return with_size(std::move(x), logarithm);
}

double FilterSearch::largest_scale(const VectorXd& x, const WorthOf& worth_of) const {
  const auto may_be = [&](double logarithm) {
    const FilterWorth worth = worth_of(coordinates_.at(scaled(x, logarithm)));
    return worth.growth <= kLargestGrowth &&
           !(largest_reach_ > 0.0 && worth.most_reach > 0.97 * largest_reach_);
  };
  constexpr double kStep = 1.2;
  constexpr int kMostSteps = 9;
  double low = 0.0;
  int steps = 0;
  const bool grows = may_be(0.0);
  for (double tried = grows ? kStep : -kStep; steps < kMostSteps; ++steps, tried += grows ? kStep : -kStep) {
    const bool is_possible = may_be(tried);
    low = is_possible || !grows ? tried : low;
    if (is_possible != grows) {
      break;
    }
  }
  if (steps == kMostSteps) {
    return grows ? low : -std::numeric_limits<double>::infinity();
  }
  double high = low + kStep;
  const int halvings = coordinates_.exponent > 0.0 ? 12 : halvings_;  // the value is that of the noise alone
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (may_be(middle) ? low : high) = middle;
  }
  return low;
}

ScoredPoint FilterSearch::score(const VectorXd& x) const {
  if (deadline_.is_over() || x[2] < kLeastLogit) {
    return {};
  }
  constexpr int kSamples = 20;
  const auto at_middle = [&](const FilterParameters& parameters) {
    return worth_on_orbit(*tone_, nodes_[1], parameters,
                          memory_of(coordinates_.rate_squared, parameters, 1e-2), kSamples, {}, &slopes_[1],
                          &points_->at(1), kLargestGrowth);
  };
  const double logarithm = largest_scale(x, at_middle);
  if (!std::isfinite(logarithm)) {
    return {};
  }
  ScoredPoint scored{0.0, scaled(x, logarithm)};
  const FilterParameters parameters = coordinates_.at(scored.point);
  scored.value = std::log(coordinates_.finds_noise  ? parameters.noise
                          : coordinates_.finds_slew ? parameters.slew
                                                    : at_middle(parameters).least_reach);
  return scored;
}

std::vector<ScoredPoint> FilterSearch::scores_of(const std::vector<VectorXd>& points) const {
  std::vector<ScoredPoint> scores(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { scores[i] = score(points[i]); });
  return scores;
}

std::vector<ScoredPoint> FilterSearch::first_starts() const {
  std::vector<VectorXd> points;
  for (const double source : {-8.0, -4.0, -1.0}) {
    for (const double eta : {-3.6, -2.3, -1.0}) {
      for (const double logit : {0.0, 1.4, 2.6}) {
        for (const double spread : {-5.0, -2.0}) {
          // The scale of W is found by itself.
          constexpr double kProcess = -4.5;
          VectorXd x = VectorXd::Constant(coordinates_.size(), kProcess);
          x.head(5) << eta, eta, logit, source, spread;
          if (coordinates_.moves()) {
            x[x.size() - 1] = -9.0;
          }
          points.push_back(x);
        }
      }
    }
  }
  return scores_of(points);
}

std::vector<ScoredPoint> FilterSearch::starts_without_disturbance() const {
  std::vector<VectorXd> points;
  FilterSearch without(*this);
  without.coordinates_.finds_noise = without.coordinates_.finds_slew = false;
  without.coordinates_.given_slew = 0.0;
  without.coordinates_.exponent = 0.0;
  for (const ScoredPoint& start : three_best(without.first_starts())) {
    for (const double scale : {-0.5, -1.4, -2.8}) {
      if (std::isfinite(start.value)) {
        const VectorXd smaller = without.scaled(start.point, scale);
        VectorXd x = VectorXd::Constant(coordinates_.size(), coordinates_.moves() ? -10.0 : -6.0);
        x.head(smaller.size()) = smaller;
        points.push_back(std::move(x));
      }
    }
  }
  return scores_of(points);
}

void FilterSearch::improve(ScoredPoint& best, double step) const {
  climb(best, step, evaluations_, [&](const VectorXd& x) { return score(x); });
}

void FilterSearch::improve_further(ScoredPoint& best) {
  if (!coordinates_.finds()) {
    return;
  }
  // Restarts find more. The scale is the value that is climbed; its steps would hide the gain.
  constexpr int kFineHalvings = 10;
  halvings_ = kFineHalvings;
  const int most_rounds = coordinates_.exponent > 0.0 ? 0 : 4;
  constexpr double kLeastGain = 0.004;
  for (int round = 0; round < most_rounds; ++round) {
    const double before = best.value;
    improve(best, 1.0);
    improve(best, 0.5);
    if (!(best.value > before + kLeastGain)) {
      break;
    }
  }
}

ScoredPoint FilterSearch::for_whole_cell(const VectorXd& point) const {
  constexpr int kSamples = 40;
  ScoredPoint whole;
  for (const double shrink : {0.0, -0.3, -0.7, -1.4}) {
    const VectorXd smaller = shrink < 0.0 ? with_size(point, shrink) : point;
    const double logarithm = largest_scale(smaller, [&](const FilterParameters& parameters) {
      return worth_at(parameters, kSamples, kLargestGrowth);
    });
    // The value is that of the scale alone.
    if (std::isfinite(logarithm) && logarithm > whole.value) {
      whole = {logarithm, scaled(smaller, logarithm)};
    }
    if (!coordinates_.finds()) {
      break;
    }
  }
  return whole;
}

std::optional<VectorXd> FilterSearch::run(const VectorXd& nearby) {
  follow_orbits();
  std::vector<ScoredPoint> starts;
  if (nearby.size() == coordinates_.size()) {
    starts.push_back(score(nearby));
  } else {
    starts = three_best(coordinates_.finds() ? starts_without_disturbance() : first_starts());
  }
  if (starts.empty() || !std::isfinite(starts.front().value)) {
    return std::nullopt;
  }
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) { improve(starts[i], 1.0); });
  ScoredPoint best = best_of(starts);
  if (starts.size() > 1) {
    improve(best, 0.5);
    improve(best, 0.8);
  }
  improve_further(best);
  const ScoredPoint whole = for_whole_cell(best.point);
  return std::isfinite(whole.value) ? std::optional(whole.point) : std::nullopt;
}

}  // namespace veritrack::model::detail

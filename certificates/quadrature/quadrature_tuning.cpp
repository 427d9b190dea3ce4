#include "certificates/quadrature/quadrature_tuning.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "analysis/quadrature/contraction/quadrature_certificate.hpp"
#include "analysis/quadrature/leak/steady_certificate.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/search/maximize.hpp"
#include "certificates/quadrature/guarantee.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::array<std::string_view, 5> kObjectives{"long-run", "for-ever", "radius", "noise", "slew"};
constexpr int kEvaluationsOfStart = 40;
constexpr double kDecades = 4.0;       // around a start
constexpr double kMissing = 20.0;      // of what is not certified at all; larger than any ratio's logarithm
constexpr double kWeightOfOpen = 1e3;  // what is required comes first

/// q1 and q2 as a design file has them.
using Chosen = std::array<std::string, 2>;

/// What is certified of a design.
struct Certified {
  double long_run = std::numeric_limits<double>::infinity();  ///< rad/sample
  double for_ever = std::numeric_limits<double>::infinity();  ///< rad/sample
  double radius = 0.0;                                        ///< rad/sample
  double noise = 0.0;                                         ///< of the amplitude
  double slew = 0.0;                                          ///< rad/sample per sample
};

Number number_of(const std::string& text) {
  Number number;
  number.text = text;
  number.tight = number.value = rigor::parse_decimal(text);
  number.nearest = rigor::nearest_double(text);
  return number;
}

double upper_of(const theorems::Quantity& quantity) {
  return quantity.applies() ? quantity.value.upper() : std::numeric_limits<double>::infinity();
}
double lower_of(const theorems::Quantity& quantity) {
  return quantity.applies() ? quantity.value.lower() : 0.0;
}

class Search {
 public:
  Search(const Design& design, const TuningRequest& request)
      : design_(design), request_(request), require_(&quadrature_tables(design).require) {}

  /// The best of what a local search from `start` (log10 of q1 and q2) finds.
  Eigen::Vector2d improve(const Eigen::Vector2d& start) {
    search::SearchSpace space;
    space.start = start;
    space.step = Eigen::Vector2d::Constant(0.5);
    space.lower = start.array() - kDecades;
    space.upper = start.array() + kDecades;
    space.evaluations = kEvaluationsOfStart;
    space.tolerance = 1e-3;
    return search::maximize([this](const Eigen::VectorXd& x) { return score(chosen(x)); }, space).point;
  }
  [[nodiscard]] static Chosen chosen(const Eigen::VectorXd& x) {
    return {fmt::format("{:.3g}", std::pow(10.0, x(0))), fmt::format("{:.3g}", std::pow(10.0, x(1)))};
  }
  /// More is better.
  double score(const Chosen& values) {
    const Certified found = certified(values);
    const double objective = objective_of(found);
    return -kWeightOfOpen * shortage(found) + (std::isfinite(objective) ? objective : -kMissing);
  }
  /// Whether all is certified that is required, as far as it is looked at here.
  bool meets(const Chosen& values) { return shortage(certified(values)) == 0.0; }
  const Certified& certified(const Chosen& values) {
    const auto known = known_.find(values);
    if (known != known_.end()) {
      return known->second;
    }
    if (request_.progress) {
      request_.progress(static_cast<int>(known_.size()) + 1, 2 * kEvaluationsOfStart);
    }
    return known_.emplace(values, certify_with(values)).first->second;
  }

 private:
  [[nodiscard]] Certified certify_with(const Chosen& values) const {
    const rigor::UpwardRounding upward;
    Design design = design_;
    auto tables = quadrature_tables(design_);
    tables.design.q1 = number_of(values[0]);
    tables.design.q2 = number_of(values[1]);
    design.tables = tables;
    sets::ContractionQuestion question = contraction_question(design);
    question.with_samples = false;
    sets::ContractionResult result;
    if (tables.design.without_leak()) {
      result = quadrature::certify_contraction(question).result;
    } else {
      const bool is_of_limits = request_.objective == "noise" || request_.objective == "slew";
      question.with_limits =
          is_of_limits || require_->largest_noise_at_least || require_->largest_slew_at_least;
      const auto& band = tables.assume.frequency;
      result = quadrature::certify_with_leak({question, rigor::hull(band[0].value, band[1].value)}).result;
    }
    Certified found;
    if (result.starts.verdict == rigor::Verdict::proved) {
      found.long_run = upper_of(result.starts.ultimate_frequency_error);
      found.for_ever = upper_of(result.starts.frequency_error_bound);
    }
    found.radius = lower_of(result.frequency_error_radius);
    found.noise = lower_of(result.largest_noise);
    found.slew = lower_of(result.largest_slew);
    return found;
  }

  /// The logarithm of what is to be large.
  [[nodiscard]] double objective_of(const Certified& found) const {
    return request_.objective == "long-run"   ? -std::log(found.long_run)
           : request_.objective == "for-ever" ? -std::log(found.for_ever)
           : request_.objective == "radius"   ? std::log(found.radius)
           : request_.objective == "noise"    ? std::log(found.noise)
                                              : std::log(found.slew);
  }

  /// By how much what is certified falls short of what is required and of the assumed starts; 0: it does not.
  [[nodiscard]] double shortage(const Certified& found) const {
    double sum = 0.0;
    const auto at_least = [&](double value, double wanted) {
      const double ratio = std::log(wanted / value);
      sum += value >= wanted ? 0.0 : std::isfinite(ratio) ? std::min(ratio, kMissing) : kMissing;
    };
    const auto below = [&](double value, double wanted) { at_least(1.0 / value, 1.0 / wanted); };
    const Assumptions& assume = quadrature_tables(design_).assume;
    if (!std::isfinite(found.for_ever)) {
      // Starts that are not covered: how far the set is from them.
      sum += 1.0;
      at_least(found.radius, assume.initial_frequency_error.nearest);
    }
    if (const auto& wanted = require_->frequency_error_below) {
      below(found.for_ever, wanted->nearest);
    }
    if (const auto& wanted = require_->settled_below) {
      below(found.long_run, wanted->nearest);
    }
    if (const auto& wanted = require_->largest_noise_at_least) {
      at_least(found.noise, wanted->nearest / assume.amplitude.nearest);
    }
    if (const auto& wanted = require_->largest_slew_at_least) {
      at_least(found.slew, wanted->nearest);
    }
    if (const auto& wanted = require_->frequency_error_radius_at_least) {
      at_least(found.radius, wanted->nearest);
    }
    return sum;
  }

  const Design& design_;
  const TuningRequest& request_;
  const Requirements* require_;
  std::map<Chosen, Certified> known_;
};

/// log10 of q1 and q2 as the Kalman filter has them for noise and steps of the frequency of these deviations.
Eigen::Vector2d kalman_start(const QuadratureEkfTables& tables) {
  constexpr double kLeastRatio = 1e-6;  // of variances, where nothing is assumed
  const double noise = tables.assume.noise.nearest / std::sqrt(2.0);
  const double slew = tables.assume.slew.nearest;
  const double ratio = noise > 0.0 ? std::max(slew * slew / (noise * noise), kLeastRatio) : 1.0;
  const double r = tables.design.r.nearest;
  return {std::log10(0.1 * ratio * r), std::log10(ratio * r)};
}

/// The text with another number in the place of this one; nothing when it does not stand there.
bool replace_number(std::string& text, const Number& old_number, const std::string& new_text) {
  std::size_t start = 0;
  for (int line = 1; line < old_number.position.line && start != std::string::npos; ++line) {
    start = text.find('\n', start);
    start += start == std::string::npos ? 0 : 1;
  }
  if (start == std::string::npos || old_number.position.column < 1) {
    return false;
  }
  start += static_cast<std::size_t>(old_number.position.column) - 1;
  if (text.compare(start, old_number.text.size(), old_number.text) != 0) {
    return false;
  }
  text.replace(start, old_number.text.size(), new_text);
  return true;
}

std::string shown(const Certified& found, std::string_view objective, const FrequencyUnits& units) {
  if (objective == "long-run") {
    return units.at_most(found.long_run, 3);
  }
  if (objective == "for-ever") {
    return units.at_most(found.for_ever, 3);
  }
  if (objective == "radius") {
    return units.at_least(found.radius, 3);
  }
  return objective == "noise"
             ? rigor::to_decimal(found.noise, 3, rigor::Direction::down) + " of the amplitude"
             : units.slew(found.slew, 3);
}

std::string_view words_of(std::string_view objective) {
  return objective == "long-run"   ? "the certified bound on the frequency error in the long run"
         : objective == "for-ever" ? "the certified bound on the frequency error for ever"
         : objective == "radius"   ? "how far the certified set reaches in frequency"
         : objective == "noise"    ? "the noise that is tolerated at a constant frequency"
                                   : "the slew that is tolerated without noise";
}

}  // namespace

std::span<const std::string_view> quadrature_tuning_objectives() {
  return kObjectives;
}

TuningResult tune_quadrature(const Design& design, const TuningRequest& request) {
  const QuadratureEkfTables& tables = quadrature_tables(design);
  if (tables.assume.gaussian) {
    return {std::nullopt,
            "Tuning needs noise with a bound, noise = { bound = ... }, and what is required of such noise."};
  }
  const QuadratureDesignTable& chosen = tables.design;
  const rigor::NearestRounding nearest;
  Search search(design, request);
  const Chosen before{chosen.q1.text, chosen.q2.text};
  const Eigen::Vector2d given(std::log10(std::max(chosen.q1.nearest, 1e-3 * chosen.q2.nearest)),
                              std::log10(chosen.q2.nearest));
  Chosen best = before;
  for (const Eigen::Vector2d& start : {given, kalman_start(tables)}) {
    const Chosen found = Search::chosen(search.improve(start));
    best = search.score(found) > search.score(best) ? found : best;
  }
  std::string text = request.design_text;
  // The later one first: positions before it stay as they are.
  const bool q1_is_later = std::pair(chosen.q1.position.line, chosen.q1.position.column) >
                           std::pair(chosen.q2.position.line, chosen.q2.position.column);
  const bool is_written =
      q1_is_later ? replace_number(text, chosen.q1, best[0]) && replace_number(text, chosen.q2, best[1])
                  : replace_number(text, chosen.q2, best[1]) && replace_number(text, chosen.q1, best[0]);
  if (!is_written) {
    return {std::nullopt,
            fmt::format("q1 = {} and q2 = {} were found, but q1 and q2 could not be found in the text "
                        "of the design file.",
                        best[0], best[1])};
  }
  const FrequencyUnits units(tables.assume.sample_rate);
  TuningResult result{std::move(text), {}};
  result.notes.push_back(fmt::format("q1 = {} -> {}, q2 = {} -> {}: {} goes from {} to {}.", before[0],
                                     best[0], before[1], best[1], words_of(request.objective),
                                     shown(search.certified(before), request.objective, units),
                                     shown(search.certified(best), request.objective, units)));
  if (!search.meets(best)) {
    const Certified& found = search.certified(best);
    result.notes.push_back(
        fmt::format("Not all that is required was certified with any q1 and q2 that were tried. What this "
                    "design tolerates: noise "
                    "up to {} of the amplitude at a constant frequency, a slew up to {} without noise, "
                    "starts up to {} off.",
                    rigor::to_decimal(found.noise, 3, rigor::Direction::down), units.slew(found.slew, 3),
                    units.at_least(found.radius, 3)));
  }
  return result;
}

}  // namespace veritrack::certificates

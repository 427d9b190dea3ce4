#include "certificates/model/model_tuning.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/maximize.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/model/model_limits.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/tuning/design_text.hpp"
#include "certificates/tuning/design_values.hpp"
#include "certificates/tuning/objective.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::array<std::string_view, 5> kObjectives{"long-run", "for-ever", "radius", "noise", "slew"};

using Texts = std::vector<std::string>;  ///< the values of the free parameters, as TOML

/// The certified results for some values.
struct Outcome {
  CertifiedValues values;
  int unmet = 0;     ///< requirements that are not PROVED
  Texts shortfalls;  ///< a sentence for each
};

double or_nothing(const model::ProvedSet& set, double bound) {
  if (set.is_proved() && names_lock(set)) {
    return bound;
  }
  return CertifiedValues::kInfinite;
}

CertifiedValues values_of(const ModelSets& sets, const ModelAssumptions& assume) {
  CertifiedValues found;
  const model::ProvedSet& best = sets.best();
  found.for_ever = or_nothing(best, best.frequency_error);
  found.long_run = or_nothing(best, best_settled_error_of(sets));
  found.noise = largest_noise(sets).size;
  found.slew = largest_slew(sets).size;
  if (const auto limits = limits_of(sets, assume); limits && !limits->part) {
    found.radius = limits->reach.size;
  }
  return found;
}

Objective objective_for(const std::string& name, const ModelAssumptions& assume) {
  if (assume.gaussian) {
    throw RequestError("veritrack tune: a model is tuned for noise with a bound only", "assume.noise");
  }
  if (!name.empty()) {
    return objective_called(name).value();
  }
  const bool is_disturbed = assume.noise.value.upper() > 0.0 || assume.slew.value.upper() > 0.0;
  return is_disturbed ? Objective::long_run : Objective::noise;
}

class Search {
 public:
  /// Thrown to end it.
  struct Enough {};

  Search(const Design& design, const TuningRequest& request)
      : design_(&design),
        request_(&request),
        objective_(objective_for(request.objective, model_tables(design).assume)) {
    const rigor::UpwardRounding upward;
    const ModelTables& tables = model_tables(design);
    const Model model = make_model(tables.model, tables.assume.signal);
    std::set<std::string> names;
    for (const FreeParameter& free : request.over) {
      if (!names.insert(free.name).second) {
        throw RequestError(fmt::format("veritrack tune: {} is given twice", free.name), "model.parameters");
      }
      given_.push_back(given_value(model, free));
    }
  }

  TuningResult run() {
    TuningResult result;
    if (!text_with(texts_at(point_of(given_)))) {
      result.reason =
          "The parameters could not be found in the text of the design file: write them as NAME = VALUE.";
      return result;
    }
    const Outcome before = certified(request_->design_text);
    best_ = {given_texts(), before};
    try {
      improve();
    } catch (const Enough&) {
    }
    result.design_text = best_.first == given_texts() ? request_->design_text : text_with(best_.first);
    result.notes = notes(before);
    result.changes = best_.second.shortfalls;
    return result;
  }

 private:
  [[nodiscard]] static double given_value(const Model& model, const FreeParameter& free) {
    const auto found =
        std::find_if(model.constants.begin(), model.constants.begin() + parameters_of(model),
                     [&](const language::Constant& constant) { return constant.name == free.name; });
    if (found == model.constants.begin() + parameters_of(model)) {
      Texts names;
      std::transform(model.constants.begin(), model.constants.begin() + parameters_of(model),
                     std::back_inserter(names), [](const language::Constant& each) { return each.name; });
      throw RequestError(fmt::format("veritrack tune: there is no parameter {}; allowed: {}", free.name,
                                     fmt::join(names, ", ")),
                         "model.parameters");
    }
    if (!(free.low <= found->nearest && found->nearest <= free.high)) {
      throw RequestError(
          fmt::format("veritrack tune: {} is {} in the design, which is not between {} and {}; the "
                      "search begins with the design",
                      free.name, found->nearest, free.low, free.high),
          "model.parameters");
    }
    return found->nearest;
  }
  [[nodiscard]] static std::ptrdiff_t parameters_of(const Model& model) {
    return static_cast<std::ptrdiff_t>(model.parameter_texts.size());
  }

  // Between 0 and 1, by factors where a range is above 0.

  [[nodiscard]] static bool is_by_factors(const FreeParameter& free) { return free.low > 0.0; }
  [[nodiscard]] Eigen::VectorXd point_of(const std::vector<double>& values) const {
    Eigen::VectorXd point(static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const FreeParameter& free = request_->over[i];
      point(static_cast<Eigen::Index>(i)) =
          is_by_factors(free) ? std::log(values[i] / free.low) / std::log(free.high / free.low)
                              : (values[i] - free.low) / (free.high - free.low);
    }
    return point;
  }
  [[nodiscard]] Texts texts_at(const Eigen::VectorXd& point) const {
    const rigor::NearestRounding nearest;
    Texts texts;
    for (std::size_t i = 0; i < request_->over.size(); ++i) {
      const FreeParameter& free = request_->over[i];
      const double share = point(static_cast<Eigen::Index>(i));
      const double value = is_by_factors(free) ? free.low * std::pow(free.high / free.low, share)
                                               : free.low + share * (free.high - free.low);
      std::string text = fmt::format("{:.4g}", value);  // more digits are of no use
      const double written = rigor::nearest_double(text);
      if (!(free.low <= written && written <= free.high)) {
        text = fmt::format("{}", std::clamp(value, free.low, free.high));
      }
      texts.push_back(std::move(text));
    }
    return texts;
  }
  /// As they stand in the file.
  [[nodiscard]] Texts given_texts() const {
    Texts texts;
    for (const FreeParameter& free : request_->over) {
      for (const NamedText& each : model_tables(*design_).model.parameters) {
        if (each.name.text == free.name) {
          texts.push_back(each.formula.text);
        }
      }
    }
    return texts;
  }
  [[nodiscard]] std::optional<std::string> text_with(const Texts& texts) const {
    std::vector<DesignEdit> edits;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      edits.push_back({request_->over[i].name, texts[i]});
    }
    return with_parameter_values(request_->design_text, edits);
  }

  /// Whatever is required, and the objective.
  [[nodiscard]] Outcome certified(const std::string& text) const {
    Design design = read_design(text, "design");
    ModelTables tables = model_tables(design);
    // A certificate has what is required, so the objective is, with a number that anything meets.
    Requirements& require = tables.require.sets;
    const Number any = number_of("1e-300");
    if (objective_ == Objective::noise && !require.largest_noise_at_least) {
      require.largest_noise_at_least = any;
    }
    if (objective_ == Objective::slew && !require.largest_slew_at_least) {
      require.largest_slew_at_least = any;
    }
    design.tables = tables;
    const Certificate certificate =
        certify(design, "design", text, {}, Extent::requirements, request_->deadline);
    const rigor::UpwardRounding upward;
    Outcome outcome;
    outcome.values = values_of(model_sets(certificate), tables.assume);
    for (const Claim& claim : certificate.claims) {
      if (claim.required && claim.verdict != rigor::Verdict::proved) {
        ++outcome.unmet;
        outcome.shortfalls.push_back(fmt::format("Not proved: {} ({})", claim.requirement, claim.reason));
      }
    }
    return outcome;
  }
  [[nodiscard]] double score(const Outcome& outcome) const {
    constexpr double kWeightOfUnmet = 1e3;
    constexpr double kMissing = 1e2;
    const double merit = merit_of(outcome.values, objective_);
    return (std::isfinite(merit) ? merit : -kMissing) - kWeightOfUnmet * outcome.unmet;
  }
  double look_at(const Texts& texts) {
    const auto known = scores_.find(texts);
    if (known != scores_.end()) {
      return known->second;
    }
    const int done = static_cast<int>(scores_.size());
    if (done >= request_->most_designs || request_->deadline.is_over()) {
      throw Enough();
    }
    if (request_->progress) {
      request_->progress(done + 1, request_->most_designs);
    }
    double found = -CertifiedValues::kInfinite;
    try {
      Outcome outcome = certified(text_with(texts).value());
      found = score(outcome);
      if (found > score(best_.second)) {
        best_ = {texts, std::move(outcome)};
      }
    } catch (const InputError&) {
      // With these values a formula has none: a square root of something negative.
    }
    scores_.emplace(texts, found);
    return found;
  }
  void improve() {
    search::SearchSpace space;
    space.start = point_of(given_);
    const Eigen::Index count = space.start.size();
    space.step = Eigen::VectorXd::Constant(count, 0.15);
    space.lower = Eigen::VectorXd::Zero(count);
    space.upper = Eigen::VectorXd::Ones(count);
    space.evaluations = 10 * request_->most_designs;  // `look_at` counts those that differ
    space.tolerance = 1e-3;
    static_cast<void>(
        search::maximize([this](const Eigen::VectorXd& point) { return look_at(texts_at(point)); }, space));
  }

  [[nodiscard]] std::vector<std::string> notes(const Outcome& before) const {
    const ModelAssumptions& assume = model_tables(*design_).assume;
    const Texts given = given_texts();
    Texts changes;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (given[i] != best_.first[i]) {
        changes.push_back(fmt::format("{} = {} -> {}", request_->over[i].name, given[i], best_.first[i]));
      }
    }
    const auto words = words_of(objective_).words;
    const auto show_value = [&](const CertifiedValues& values) {
      return shown(values, objective_, assume.sample_rate, "signal units");
    };
    const std::string after = show_value(best_.second.values);
    std::vector<std::string> notes;
    if (changes.empty()) {
      notes.push_back(fmt::format("None of {} designs is better than the given one: {} is {}.",
                                  scores_.size(), words, after));
    } else {
      notes.push_back(fmt::format("{}: {} goes from {} to {}.", fmt::join(changes, ", "), words,
                                  show_value(before.values), after));
    }
    if (request_->deadline.has_struck()) {
      notes.push_back(
          fmt::format("The time limit ended the search after {} designs; more time may find better ones.",
                      scores_.size()));
    }
    return notes;
  }

  const Design* design_;
  const TuningRequest* request_;
  Objective objective_;
  std::vector<double> given_;  ///< as numbers
  std::pair<Texts, Outcome> best_;
  std::map<Texts, double> scores_;
};

}  // namespace

std::span<const std::string_view> model_tuning_objectives() {
  return kObjectives;
}

TuningResult tune_model(const Design& design, const TuningRequest& request) {
  return Search(design, request).run();
}

}  // namespace veritrack::certificates

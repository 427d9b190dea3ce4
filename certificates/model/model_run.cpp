#include "certificates/model/model_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/model/filter_belief.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

std::vector<double> nearest_constants(const Model& model) {
  std::vector<double> values;
  values.reserve(model.constants.size());
  for (const language::Constant& constant : model.constants) {
    values.push_back(constant.nearest);
  }
  return values;
}

/// The harmonics of the formulas, from samples of one period: for two channels together, including those that
/// turn backwards; for one, so that the real part is the signal.
std::vector<Harmonic> harmonics_of(const Model& model, double amplitude) {
  constexpr int kPlaces = 256;
  constexpr int kHighest = 32;
  constexpr double kSmall = 1e-9;  // the size of rounding errors
  const int channels = model.recursion.samples;
  std::vector<double> registers;
  std::vector<double> inputs = nearest_constants(model);
  inputs.insert(inputs.end(), {amplitude, 0.0});
  std::vector<double> values(model.signal.results().size());
  std::vector<std::complex<double>> sums(2 * kHighest + 1);
  for (int i = 0; i < kPlaces; ++i) {
    inputs.back() = kTurn * i / kPlaces;
    model.signal.run(std::span<const double>(inputs), registers, std::span(values));
    const std::complex<double> sample(values.front(), channels > 1 ? values.back() : 0.0);
    for (int order = -kHighest; order <= kHighest; ++order) {
      sums[static_cast<std::size_t>(order + kHighest)] += sample * std::polar(1.0, -order * inputs.back());
    }
  }
  std::vector<Harmonic> harmonics;
  for (int order = channels > 1 ? -kHighest : 0; order <= kHighest; ++order) {
    const double gain = (channels > 1 || order == 0 ? 1.0 : 2.0) / (kPlaces * amplitude);
    const std::complex<double> value = gain * sums[static_cast<std::size_t>(order + kHighest)];
    if (std::abs(value) > kSmall) {
      harmonics.push_back({order, value});
    }
  }
  return harmonics.empty() ? std::vector<Harmonic>(1) : harmonics;
}

class ModelRun : public TrackerRun {
 public:
  ModelRun(Model model, std::size_t filter_states)
      : model_(std::move(model)),
        constants_(nearest_constants(model_)),
        tracker_(model_.recursion, constants_, std::vector<double>(model_.states.size(), 0.0)) {
    if (filter_states > 0) {
      belief_.emplace(model_, filter_states);
    }
  }

  [[nodiscard]] int channels() const override { return model_.recursion.samples; }
  [[nodiscard]] bool has_innovation() const override { return belief_.has_value(); }

  /// The state in which a search for the steady state begins, after some thousand samples of the tone that
  /// the design describes.
  void start(const ToneAtSample& first) override {
    constexpr int kSettling = 8192;
    const double omega = first.frequency;
    const double end = first.phase - omega;
    // The start of the design is that at phase 0: the sample of the last turn that comes closest to it.
    int length = kSettling;
    double phase = std::remainder(end - length * omega, kTurn);
    const int longest = kSettling + static_cast<int>(std::min(kTurn / std::fabs(omega), 1e4));
    for (int candidate = length + 1; candidate <= longest; ++candidate) {
      const double other = std::remainder(end - candidate * omega, kTurn);
      if (std::fabs(other) < std::fabs(phase)) {
        phase = other;
        length = candidate;
      }
    }
    const std::vector<double> state = values_of(model_.start, first.amplitude, omega);
    set_state(state);
    for (int k = 1; k <= length; ++k) {
      const std::vector<double> sample =
          values_of(model_.signal, first.amplitude, std::remainder(phase + k * omega, kTurn));
      tracker_.step(sample);
      wind_back();
    }
    const bool follows = std::fabs(tracker_.frequency() - omega) < 0.5 * std::fabs(omega);
    if (!follows) {
      set_state(state);
    }
  }

  [[nodiscard]] TrackerOutput step(std::span<const double> sample) override {
    TrackerOutput output{NAN, NAN, {NAN, NAN}, NAN};
    if (belief_) {
      inputs_ = constants_;
      inputs_.insert(inputs_.end(), tracker_.state().begin(), tracker_.state().end());
      inputs_.insert(inputs_.end(), sample.begin(), sample.end());
      const FilterBelief::Innovation innovation = belief_->innovation(inputs_);
      output.innovation = innovation.value;
      output.nis = innovation.nis;
    }
    tracker_.step(sample);
    output.frequency = tracker_.frequency();
    if (belief_) {
      inputs_ = constants_;
      inputs_.insert(inputs_.end(), tracker_.state().begin(), tracker_.state().end());
      output.frequency_deviation = belief_->frequency_deviation(inputs_);
    }
    wind_back();
    return output;
  }

  [[nodiscard]] std::optional<TrackerOutput> predict() override { return std::nullopt; }

 private:
  void set_state(const std::vector<double>& state) {
    tracker_ = trackers::ModelTracker<double>(model_.recursion, constants_, state);
  }

  [[nodiscard]] std::vector<double> values_of(const trackers::StraightLineProgram& program, double first,
                                              double second) {
    inputs_ = constants_;
    inputs_.push_back(first);
    inputs_.push_back(second);
    std::vector<double> values(program.results().size());
    program.run(std::span<const double>(inputs_), registers_, std::span(values));
    return values;
  }

  /// An angle that grows for ever loses its digits: whole turns are removed.
  void wind_back() {
    constexpr double kFar = 1e4;  // rad
    const std::vector<bool>& is_angle = model_.recursion.is_angle;
    const std::vector<double>& state = tracker_.state();
    for (std::size_t i = 0; i < state.size(); ++i) {
      if (is_angle[i] && std::fabs(state[i]) > kFar) {
        std::vector<double> wound = state;
        wound[i] = std::remainder(wound[i], kTurn);
        set_state(wound);
        return;
      }
    }
  }

  Model model_;
  std::vector<double> constants_;
  trackers::ModelTracker<double> tracker_;
  std::optional<FilterBelief> belief_;
  std::vector<double> inputs_;
  std::vector<double> registers_;
};

}  // namespace

TrackerOnSamples model_on_samples(const Design& design) {
  const ModelTables& tables = model_tables(design);
  SignalAssumptions assume;
  std::optional<Model> model;
  {
    const rigor::UpwardRounding upward;
    model = make_model(tables.model, tables.assume.signal);
    const rigor::Interval band = band_of(tables.assume);
    assume.frequency = {band.lower(), band.upper()};
    assume.slew = slew_of(tables.assume).upper();
  }
  const rigor::NearestRounding nearest;
  assume.amplitude = {tables.assume.amplitude[0].nearest, tables.assume.amplitude[1].nearest};
  assume.amplitude_varies = !tables.assume.constant_amplitude;
  if (tables.assume.gaussian) {
    assume.noise_deviation =
        nearest_deviation(*tables.assume.gaussian, tables.assume.amplitude[0]) * assume.amplitude[0];
  } else {
    assume.noise = tables.assume.noise.nearest;
  }
  assume.signal = harmonics_of(*model, 0.5 * (assume.amplitude[0] + assume.amplitude[1]));
  assume.has_signal_key = true;
  if (tables.assume.samples) {
    assume.samples = tables.assume.samples->nearest;
  }
  for (const std::vector<NamedText>* start : {&tables.assume.start_within, &tables.assume.start_exactly}) {
    for (const NamedText& each : *start) {
      assume.start.push_back(fmt::format("{} {} {}", each.name.text,
                                         start == &tables.assume.start_within ? "off by at most" : "=",
                                         each.formula.text));
    }
  }
  if (assume.start.empty()) {
    assume.start.emplace_back("a state in the certified starting set");
  }
  if (tables.assume.sample_rate) {
    assume.sample_rate = tables.assume.sample_rate->nearest;
  }
  const std::size_t filter_states = tables.model.ekf ? tables.model.ekf->states.size() : 0;
  return {std::make_unique<ModelRun>(std::move(*model), filter_states), assume};
}

}  // namespace veritrack::certificates

// The design file of the tracker "model": a recursion that the user has written.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "certificates/code/compilation.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// A key and the formula that it gives.
struct NamedText {
  SourceText name;
  SourceText formula;
};

/// [model.ekf]: an extended Kalman filter by its model, from which the recursion is written out.
struct ModelEkfTable {
  std::vector<SourceText> states;
  SourceText predict;
  std::vector<SourceText> measure;                         ///< one for each channel
  std::vector<std::vector<SourceText>> jacobian;           ///< F, row by row; none: the derivative of predict
  std::vector<std::vector<SourceText>> process_noise;      ///< Q, row by row
  std::vector<std::vector<SourceText>> measurement_noise;  ///< R, row by row
};

/// [model].
struct ModelTable {
  std::vector<SourceText> samples;  ///< one name, or two: in phase, quadrature
  std::vector<NamedText> parameters;
  std::vector<SourceText> states;
  std::vector<SourceText> angles;  ///< of the states, those that are known modulo 2 pi only
  std::vector<NamedText> units;    ///< of states, for the reader only
  SourceText step;
  SourceText frequency;
  SourceText arithmetic;  ///< of the formulas: exact, binary32, binary64; empty: exact
  std::vector<NamedText> start;
  std::optional<ModelEkfTable> ekf;  ///< in place of states and step
  code::CodeTable code;              ///< the table [code]
  std::optional<code::CompiledCode>
      compiled;  ///< of [code]: it has filled in samples, states, angles, step, frequency
};

/// The format of the formulas' arithmetic; none where it is exact.
[[nodiscard]] inline std::optional<trackers::code::Format> written_format(const ModelTable& model) {
  return model.arithmetic.text == "binary32"   ? std::optional(trackers::code::kSingle)
         : model.arithmetic.text == "binary64" ? std::optional(trackers::code::kDouble)
                                               : std::nullopt;
}

/// [assume] of a model.
struct ModelAssumptions {
  std::array<Number, 2> amplitude;    ///< [least, largest], of each sample, signal units
  bool one_amplitude = true;          ///< both are the same number
  bool constant_amplitude = true;     ///< it is one number of the range; otherwise samples differ in it
  std::optional<Number> sample_rate;  ///< Hz
  std::array<Number, 2> frequency;    ///< [lowest, highest]
  bool frequency_in_hertz = false;    ///< otherwise rad/sample
  /// |v(k)| <= noise for every k, signal units. Empty where the noise is Gaussian: nothing follows from it.
  Number noise;
  std::optional<GaussianNoise> gaussian;
  std::optional<Number> samples;          ///< the number for which a probability is asked; given with
                                          ///< Gaussian noise
  Number slew;                            ///< of the frequency
  bool slew_in_hertz_per_second = false;  ///< otherwise rad/sample per sample
  std::vector<NamedText> start_within;    ///< of states: deviations from the curve at the start, at most
  std::vector<NamedText> start_exactly;   ///< of all states: the state at the start; none: it is not known
  std::vector<SourceText> signal;         ///< a formula in A and phi for each sample; none: the tone alone
};

/// Whether the amplitude is constant, and known to be in a range only.
[[nodiscard]] inline bool is_constant_in_range(const ModelAssumptions& assume) {
  return assume.constant_amplitude && !assume.one_amplitude;
}

/// [require] of a model.
struct ModelRequirements {
  Requirements sets;
  std::optional<Number> captured_within;  ///< samples, from start_exactly
  std::optional<Number> bias_below;       ///< rad/sample
  std::optional<Number> ripple_below;     ///< rad/sample
  // The linear loop.
  std::optional<Number> damping_at_least;       ///< the damping ratio of every mode
  std::optional<Number> settles_like;           ///< its time constant, samples
  std::optional<Number> noise_bandwidth_below;  ///< rad/sample
  std::optional<Number> gain_margin_at_least;   ///< dB
};

/// The tables of a design file for the tracker "model".
struct ModelTables {
  ModelTable model;
  ModelAssumptions assume;
  ModelRequirements require;
};

/// The tables of a design of this tracker. Throws std::logic_error for another.
[[nodiscard]] inline const ModelTables& model_tables(const Design& design) {
  return tables_of<ModelTables>(design);
}

}  // namespace veritrack::certificates

// The keys of a design file for the tracker "model".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/code/harness/new_code.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/design/nearest_key.hpp"
#include "certificates/model/code_keys.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/model/model_noise_keys.hpp"
#include "certificates/model/operation_words.hpp"
#include "certificates/sets/set_keys.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

constexpr std::size_t kLongestFormula = 4000;  // bytes
constexpr std::size_t kLongestStep = 100'000;  // bytes
constexpr std::size_t kMostStates = 64;

/// One text, or a list of them.
std::vector<SourceText> text_or_list(const TomlValue& value, std::size_t most) {
  std::vector<SourceText> texts;
  if (!value.is_array()) {
    texts.push_back(value.source_text(kLongestFormula));
    return texts;
  }
  for (const TomlValue& element : value.elements(1, most)) {
    texts.push_back(element.source_text(kLongestFormula));
  }
  return texts;
}

std::vector<NamedText> named_texts(const TomlValue& value) {
  std::vector<NamedText> texts;
  for (const auto& [name, formula] : value.members()) {
    texts.push_back({name, formula.source_text(kLongestFormula)});
  }
  return texts;
}

template <auto member, std::size_t most>
void list(const TomlValue& value, Owner<member>& target) {
  target.*member = text_or_list(value, most);
}
template <auto member>
void names_and_formulas(const TomlValue& value, Owner<member>& target) {
  target.*member = named_texts(value);
}
template <auto member, std::size_t limit>
void text(const TomlValue& value, Owner<member>& target) {
  target.*member = value.source_text(limit);
}

/// A matrix of formulas, row by row; a formula alone is a matrix of one.
std::vector<std::vector<SourceText>> matrix_of_texts(const TomlValue& value) {
  std::vector<std::vector<SourceText>> rows;
  if (!value.is_array()) {
    rows.push_back({value.source_text(kLongestFormula)});
    return rows;
  }
  for (const TomlValue& row : value.elements(1, kMostStates)) {
    rows.push_back(text_or_list(row, kMostStates));
  }
  return rows;
}

void require_word(const TomlValue& value, std::string_view word) {
  if (!value.is_string() || value.line_of_text(100) != word) {
    value.refuse_kind();
  }
}

void arithmetic_of_formulas(const TomlValue& value, ModelTable& target) {
  target.arithmetic = value.source_text(100);
  const std::string& text = target.arithmetic.text;
  if (text != "exact" && text != "binary32" && text != "binary64") {
    value.refuse_kind();
  }
}

constexpr std::array<std::string_view, 7> kEkfKeys{"states", "predict", "measure", "Q",
                                                   "R",      "update",  "jacobian"};

void extended_kalman_filter(const TomlValue& value, ModelTable& target) {
  ModelEkfTable ekf;
  std::vector<std::string_view> given;
  for (const auto& [name, entry] : value.members()) {
    const std::string& key = name.text;
    const auto* const known = std::find(kEkfKeys.begin(), kEkfKeys.end(), key);
    if (known == kEkfKeys.end()) {
      entry.refuse("not known");
    }
    given.push_back(*known);
    if (key == "states") {
      ekf.states = text_or_list(entry, kMostStates);
    } else if (key == "predict") {
      ekf.predict = entry.source_text(kLongestStep);
    } else if (key == "measure") {
      ekf.measure = text_or_list(entry, 2);
    } else if (key == "Q") {
      ekf.process_noise = matrix_of_texts(entry);
    } else if (key == "R") {
      ekf.measurement_noise = matrix_of_texts(entry);
    } else if (key == "update") {
      require_word(entry, "standard");
    } else if (entry.is_array()) {
      ekf.jacobian = matrix_of_texts(entry);
    } else {
      require_word(entry, "automatic");
    }
  }
  for (const std::string_view key : std::span(kEkfKeys).first(5)) {
    if (std::find(given.begin(), given.end(), key) == given.end()) {
      value.refuse(fmt::format("without {}", key));
    }
  }
  target.ekf = ekf;
}

/// Q and R are choices of the engineer; the rest determines the recursion.
constexpr std::array kMembersOfEkf{
    MemberContract{"states", Stronger::only_equal},  MemberContract{"predict", Stronger::only_equal},
    MemberContract{"measure", Stronger::only_equal}, MemberContract{"Q", Stronger::neither},
    MemberContract{"R", Stronger::neither},          MemberContract{"update", Stronger::only_equal},
    MemberContract{"jacobian", Stronger::only_equal}};
static_assert(kMembersOfEkf.size() == kEkfKeys.size());
constexpr KeyContract kContractOfEkf{Stronger::only_equal, Measure::plain, kMembersOfEkf};

using Table = ModelTable;
constexpr std::string_view kNames = "a list of names, e.g. ['alpha', 'beta', 'w']";
constexpr std::array kModelKeys{
    Key<Table>{"samples",
               "the name of the sample, e.g. 'y', or of the two of two channels, e.g. ['y1', 'y2']",
               list<&Table::samples, 2>, kOptional, kOnlyEqual},
    Key<Table>{"parameters", "a table of numbers and formulas, e.g. { k = 1.4142, T = '1/10000' }",
               names_and_formulas<&Table::parameters>, kOptional, KeyContract{Stronger::as_it_is_used}},
    Key<Table>{"states", kNames, list<&Table::states, kMostStates>, kOptional, kOnlyEqual},
    Key<Table>{"angles", "a list of the states that are angles, e.g. ['theta']",
               list<&Table::angles, kMostStates>, kOptional, kOnlyEqual},
    Key<Table>{"units", "a table of the units of states, e.g. { w = 'rad/s' }",
               names_and_formulas<&Table::units>, kOptional, kNoContract},
    Key<Table>{"step", "lines name = formula and state' = formula, between three single quotes",
               text<&Table::step, kLongestStep>, kOptional, kOnlyEqual},
    Key<Table>{"ekf",
               "in place of states and step, a table with states, predict, measure, Q, R, update = "
               "'standard' (may be "
               "left out) and jacobian = 'automatic' (may be left out) or a list of rows",
               extended_kalman_filter, kOptional, kContractOfEkf},
    Key<Table>{"frequency", "a formula of the states: the estimated frequency in rad/sample",
               text<&Table::frequency, kLongestFormula>, kOptional, kOnlyEqual},
    Key<Table>{"arithmetic",
               "'exact', or that of the formulas as they are written: 'binary32', single precision, or "
               "'binary64', double",
               arithmetic_of_formulas, kOptional, kOnlyEqual},
    Key<Table>{"start", "a table of formulas in A and omega, one for each state",
               names_and_formulas<&Table::start>, kOptional, kNoContract},
};

/// A number, or { unit = number }: true when it is in that unit.
template <typename Read>
bool in_unit(const TomlValue& value, std::string_view unit, const Read& read) {
  if (!value.is_table()) {
    read(value);
    return false;
  }
  const auto fields = value.fields({unit});
  if (!fields) {
    value.refuse("a table with other keys");
  }
  read(fields->front());
  return true;
}

void frequency_band(const TomlValue& value, ModelAssumptions& assume) {
  assume.frequency_in_hertz = in_unit(value, "hz", [&](const TomlValue& band) {
    const std::vector<TomlValue> ends = band.elements(2);
    assume.frequency = {ends[0].real(any_number), ends[1].real(any_number)};
    if (!rigor::certainly_less_equal(assume.frequency[0].tight, assume.frequency[1].tight)) {
      value.refuse(fmt::format("[{}, {}]", assume.frequency[0].text, assume.frequency[1].text));
    }
  });
}

/// Two numbers, of which the first is certainly the smaller one.
void range_of_amplitudes(const TomlValue& value, ModelAssumptions& assume) {
  const std::vector<TomlValue> ends = value.elements(2);
  assume.amplitude = {ends[0].real(positive), ends[1].real(positive)};
  if (!rigor::certainly_less(assume.amplitude[0].value, assume.amplitude[1].value)) {
    value.refuse(fmt::format("[{}, {}]", printable(assume.amplitude[0].text, 40),
                             printable(assume.amplitude[1].text, 40)));
  }
}

/// A number, a range in which samples differ, or { constant = range }.
void amplitude_of_samples(const TomlValue& value, ModelAssumptions& assume) {
  assume.one_amplitude = !value.is_array() && !value.is_table();
  assume.constant_amplitude = true;
  if (assume.one_amplitude) {
    const Number number = value.real(positive);
    assume.amplitude = {number, number};
    return;
  }
  assume.constant_amplitude =
      in_unit(value, "constant", [&](const TomlValue& range) { range_of_amplitudes(range, assume); });
}

void slew_rate(const TomlValue& value, ModelAssumptions& assume) {
  assume.slew_in_hertz_per_second = in_unit(
      value, "hz_per_second", [&](const TomlValue& number) { assume.slew = number.real(not_negative); });
}

void noise_of_samples(const TomlValue& value, ModelAssumptions& assume) {
  read_noise(value, assume.noise, assume.gaussian);
}

using ModelAssume = ModelAssumptions;
constexpr std::array kModelAssumeKeys{
    Key<ModelAssume>{
        "amplitude",
        "a number above 0, [least, largest] of amplitudes above 0 that may differ from sample to sample, or "
        "{ constant = [least, largest] } of one that is the same at every sample",
        amplitude_of_samples, defaults_to("1"), kWider},
    Key<ModelAssume>{"sample_rate", "a number above 0, in Hz", real<&ModelAssume::sample_rate, positive>,
                     kOptional, kOnlyEqual},
    Key<ModelAssume>{
        "frequency",
        "[lowest, highest] in rad/sample, of one channel 0 or more, or with sample_rate { hz = [lowest, "
        "highest] }",
        frequency_band, kRequired, kWiderBand},
    Key<ModelAssume>{"noise", kNoiseThatMayBeGaussian, noise_of_samples, kRequired, kContractOfNoise},
    Key<ModelAssume>{"samples", kSamplesOfProbability, real<&ModelAssume::samples, is_number_of_samples>,
                     kOptional, kMoreSamples},
    Key<ModelAssume>{"slew", "a number, 0 or more, or with sample_rate { hz_per_second = number }", slew_rate,
                     defaults_to("0"), kMoreSlew},
    Key<ModelAssume>{"start_within",
                     "a table of numbers or formulas of parameters, one for each state that may deviate from "
                     "the steady state at the start, e.g. { w = 0.01 }",
                     names_and_formulas<&ModelAssume::start_within>, kOptional,
                     KeyContract{Stronger::larger_of_each}},
    Key<ModelAssume>{
        "start_exactly",
        "a table of numbers or formulas of parameters, one for each state: the state in which the "
        "tracker is started, e.g. { alpha = 0, beta = 0, w = 0.3 }",
        names_and_formulas<&ModelAssume::start_exactly>, kOptional, kOnlyEqual},
    Key<ModelAssume>{"signal",
                     "a formula in A and phi for each sample, e.g. 'A*cos(phi) + 0.03*A*cos(3*phi)'",
                     list<&ModelAssume::signal, 2>, kOptional, kOnlyEqual},
};

using ModelRequire = ModelRequirements;
template <auto member>
void of_sets(const TomlValue& value, ModelRequire& target) {
  target.sets.*member = value.real(positive);
}
template <auto member>
void error_of_sets(const TomlValue& value, ModelRequire& target) {
  target.sets.*member = read_frequency(value, positive);
}
void slew_of_sets(const TomlValue& value, ModelRequire& target) {
  target.sets.largest_slew_at_least = read_slew(value, positive);
}
void settles_within(const TomlValue& value, ModelRequire& target) {
  target.sets.settles_within =
      value.whole_number([](const Interval& x) { return rigor::certainly_less_equal(Interval(1.0), x); });
}
void captured_within(const TomlValue& value, ModelRequire& target) {
  target.captured_within =
      value.whole_number([](const Interval& x) { return rigor::certainly_less_equal(Interval(1.0), x); });
}
void probability_of_losing_lock(const TomlValue& value, ModelRequire& target) {
  target.sets.probability_of_losing_lock_below = value.real([](const Interval& x) {
    return rigor::certainly_positive(x) && rigor::certainly_less(x, Interval(1.0));
  });
}
/// 10^(200/20) is a gain that no margin needs to exceed, and far from overflow.
bool is_gain_margin(const Interval& x) {
  constexpr double kMostDecibels = 200.0;
  return rigor::certainly_positive(x) && rigor::certainly_less_equal(x, Interval(kMostDecibels));
}
bool is_damping(const Interval& x) {
  return rigor::certainly_positive(x) && rigor::certainly_less(x, Interval(1.0));
}
template <auto member>
void time_in_samples(const TomlValue& value, Owner<member>& target) {
  target.*member = read_time(value, positive);
}
constexpr std::array kModelRequireKeys{
    Key<ModelRequire>{"frequency_error_below", kPositiveFrequency,
                      error_of_sets<&Requirements::frequency_error_below>, kOptional, kLessFrequency},
    Key<ModelRequire>{"settles_within", "a whole number of samples, 1 or more", settles_within, kOptional,
                      kLessSamples},
    Key<ModelRequire>{"settled_below", kPositiveFrequency, error_of_sets<&Requirements::settled_below>,
                      kOptional, kLessFrequency},
    Key<ModelRequire>{"captured_within", "a whole number of samples, 1 or more", captured_within, kOptional,
                      kLessSamples},
    Key<ModelRequire>{"largest_noise_at_least", kPositive, of_sets<&Requirements::largest_noise_at_least>,
                      kOptional, kMore},
    Key<ModelRequire>{"largest_slew_at_least", kPositiveSlew, slew_of_sets, kOptional, kMoreSlew},
    Key<ModelRequire>{"frequency_error_radius_at_least", kPositiveFrequency,
                      error_of_sets<&Requirements::frequency_error_radius_at_least>, kOptional,
                      kMoreFrequency},
    Key<ModelRequire>{"probability_of_losing_lock_below", "a number above 0 and below 1",
                      probability_of_losing_lock, kOptional, kLess},
    Key<ModelRequire>{"bias_below", kPositiveFrequency, in_radians<&ModelRequire::bias_below, positive>,
                      kOptional, kLessFrequency},
    Key<ModelRequire>{"ripple_below", kPositiveFrequency, in_radians<&ModelRequire::ripple_below, positive>,
                      kOptional, kLessFrequency},
    Key<ModelRequire>{"damping_at_least", "a number above 0 and below 1",
                      real<&ModelRequire::damping_at_least, is_damping>, kOptional, kMore},
    Key<ModelRequire>{"settles_like", kPositiveTime, time_in_samples<&ModelRequire::settles_like>, kOptional,
                      kLessSamples},
    Key<ModelRequire>{"noise_bandwidth_below", kPositiveFrequency,
                      in_radians<&ModelRequire::noise_bandwidth_below, positive>, kOptional, kLessFrequency},
    Key<ModelRequire>{"gain_margin_at_least", "a number above 0 and at most 200, in dB",
                      real<&ModelRequire::gain_margin_at_least, is_gain_margin>, kOptional, kMore},
};

std::vector<BoundTable> bind_model_tables(std::any& tables) {
  auto& target = std::any_cast<ModelTables&>(tables);
  return {code_keys(target.model.code), bound_table("model", kModelKeys, target.model),
          bound_table("assume", kModelAssumeKeys, target.assume),
          bound_table("require", kModelRequireKeys, target.require)};
}

/// Starts without a report: in noise or for trackers where they are not followed.
std::optional<TableObjection> objection_to_exact_start(const ModelTable& model,
                                                       const ModelAssumptions& assume) {
  if (assume.start_exactly.empty()) {
    return std::nullopt;
  }
  const Position position = assume.start_exactly.front().formula.position;
  const auto objection = [&](const char* text) { return TableObjection{"assume", text, position}; };
  constexpr std::size_t kMostFollowed = 4;
  if (!assume.start_within.empty()) {
    return objection("start_exactly and start_within; allowed: one of them");
  }
  if (model.ekf) {
    return objection(
        "start_exactly of a filter in [model.ekf], whose start is not followed; allowed: start_within, or "
        "its "
        "recursion as a step of up to 4 states");
  }
  if (model.states.size() > kMostFollowed) {
    return objection("start_exactly of more than 4 states, which are not followed; allowed: start_within");
  }
  if (assume.gaussian) {
    return objection("start_exactly with Gaussian noise; allowed: noise with a bound");
  }
  if (!rigor::certainly_less_equal(assume.slew.value, Interval(0.0))) {
    return objection("start_exactly with a slew; allowed: a constant frequency, slew = 0");
  }
  if (is_constant_in_range(assume)) {
    return objection(
        "start_exactly with a constant amplitude in a range; allowed: amplitude = one number, or [lowest, "
        "highest], in which every sample may have another one");
  }
  return std::nullopt;
}

std::optional<TableObjection> objection_to_model(const std::any& tables) {
  const auto& [model, assume, require] = std::any_cast<const ModelTables&>(tables);
  if ((assume.frequency_in_hertz || assume.slew_in_hertz_per_second) && !assume.sample_rate) {
    return TableObjection{
        "assume", "a frequency in Hz without sample_rate; allowed: sample_rate = ..., in Hz", {}};
  }
  if (model.samples.size() == 1 &&
      (!not_negative(assume.frequency[0].value) || !positive(assume.frequency[1].value))) {
    return TableObjection{
        "assume",
        fmt::format(
            "a frequency of [{}, {}]; allowed for one channel, which does not tell a frequency from its "
            "negative: 0 or more",
            assume.frequency[0].text, assume.frequency[1].text),
        assume.frequency[0].position};
  }
  if (model.ekf.has_value() == !model.states.empty() || model.ekf.has_value() == !model.step.text.empty()) {
    return TableObjection{"model", "allowed: either states and step, or the table [model.ekf]", {}};
  }
  if (written_format(model) && (model.ekf || model.compiled)) {
    return TableObjection{"model",
                          model.ekf ? "an arithmetic of [model.ekf], whose recursion is not written; "
                                      "allowed: arithmetic = 'exact', or its recursion as a step"
                                    : "an arithmetic beside [code], whose program has its own; allowed: "
                                      "[code] alone",
                          model.arithmetic.position};
  }
  if (require.sets.settles_within.has_value() != require.sets.settled_below.has_value()) {
    return TableObjection{"require", "allowed: settles_within and settled_below together, or neither", {}};
  }
  if (auto objection = objection_to_noise(assume, require)) {
    return objection;
  }
  if (assume.gaussian && !assume.one_amplitude) {
    return TableObjection{
        "assume",
        "Gaussian noise with a range of amplitudes, of which nothing is proved; allowed: one "
        "amplitude, or noise with a bound",
        {}};
  }
  if (auto objection = objection_to_exact_start(model, assume)) {
    return objection;
  }
  if (require.captured_within && assume.start_exactly.empty()) {
    return TableObjection{
        "require", "captured_within without start_exactly, from which it counts; allowed: both of them", {}};
  }
  try {
    const Model made = make_model(model, assume.signal);
    (void)start_deviations(made, model, assume.start_within);
    (void)exact_start(made, model, assume.start_exactly);
    require_whole_turns(made, model, signal_of(model, assume.signal));
  } catch (const language::LanguageError& error) {
    return TableObjection{"model", error.what(), error.position()};
  }
  return std::nullopt;
}

std::optional<TableObjection> complete_model(std::any& tables, const std::filesystem::path& design_file) {
  return complete_from_code(std::any_cast<ModelTables&>(tables).model, design_file);
}

}  // namespace

const DesignFormat& model_format() {
  static const DesignFormat format{"model",           [] { return std::any(ModelTables{}); },
                                   bind_model_tables, objection_to_model,
                                   complete_model,    &code::kCodeWriter};
  return format;
}

}  // namespace veritrack::certificates

#include "checker/model/model_design.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "checker/code/code_certificate.hpp"
#include "checker/document/design_number.hpp"
#include "checker/numbers/decimal_text.hpp"

namespace veritrack::checker {

namespace {

/// 2 pi/sample_rate, of a frequency in hertz.
Ball turn_per_sample(const Tree& assume, Objections& objections) {
  return two * pi() / read_positive(assume.at("sample_rate"), "sample_rate", objections);
}

void read_model_band(const Tree& assume, bool both_signs, ModelDesign& design, Objections& objections) {
  const Tree& band = assume.at("frequency");
  if (band.elements().size() != 2) {
    throw Malformed("a band has two ends");
  }
  const Ball low = both_signs ? read_number(band.at(0), objections)
                              : read_not_negative(band.at(0), "frequency", objections);
  const Ball high =
      both_signs ? read_number(band.at(1), objections) : read_positive(band.at(1), "frequency", objections);
  if (text_of(band.at(0)) != text_of(band.at(1)) && !certainly_at_most(low, high)) {
    objections.emplace_back("the frequencies must go from low to high");
  }
  design.band_unit = assume.at("frequency_in_hertz").truth() ? turn_per_sample(assume, objections) : one;
  design.lowest = low * design.band_unit;
  design.highest = high * design.band_unit;
  if (!certainly_at_most(design.highest, from_decimal("3.142"))) {
    objections.emplace_back("the frequencies must not be above pi rad/sample");
  }
  if (both_signs && !certainly_at_most(from_decimal("-3.142"), design.lowest)) {
    objections.emplace_back("the frequencies must not be below -pi rad/sample");
  }
}

/// The range of a constant amplitude; nothing where it is another assumption.
const Tree* constant_range(const Tree& amplitude) {
  return amplitude.kind() == Tree::Kind::object ? amplitude.find("constant") : nullptr;
}

/// A number, or a range [least, largest] in which that of every sample is, or in which a constant one is.
void read_amplitude(const Tree& amplitude, ModelDesign& design, Objections& objections) {
  const Tree* constant = constant_range(amplitude);
  design.is_constant_in_range = constant != nullptr;
  design.amplitude_varies = amplitude.kind() == Tree::Kind::array;
  if (!design.amplitude_varies && !design.is_constant_in_range) {
    design.amplitude = read_positive(amplitude, "amplitude", objections);
    design.least_amplitude = design.largest_amplitude = design.amplitude;
    return;
  }
  if (constant != nullptr && amplitude.members().size() != 1) {
    throw Malformed("a constant amplitude has a range and nothing else");
  }
  const Tree& range = constant != nullptr ? *constant : amplitude;
  if (range.elements().size() != 2) {
    throw Malformed("a range of amplitudes has two ends");
  }
  const Ball least = read_positive(range.at(0), "amplitude", objections);
  const Ball largest = read_positive(range.at(1), "amplitude", objections);
  if (!certainly_less(least, largest)) {
    objections.emplace_back("the amplitudes must go from low to high");
  }
  design.amplitude = Ball::hull(least, largest);
  design.least_amplitude = least;
  design.largest_amplitude = largest;
}

/// The value of a formula that stands in sentences as it is written. A comment, which is not part of the
/// computation, would stand there, too.
Ball value_of_told(const Tree& formula, ModelRecursion& recursion, Objections& objections) {
  const std::string& text = formula.text();
  if (text.find_first_of("#\n\r") != std::string::npos) {
    objections.emplace_back("a comment in a formula that a sentence repeats");
  }
  return recursion.constant_value(text);
}

void read_start(const Tree& start, ModelRecursion& recursion, ModelDesign& design, Objections& objections) {
  const std::vector<std::string>& names = recursion.state_names();
  design.start_within.assign(names.size(), zero);
  std::vector<bool> is_given(names.size(), false);
  for (const Tree& entry : start.elements()) {
    const std::string& name = entry.at("name").text();
    const auto found = std::find(names.begin(), names.end(), name);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || is_given[at]) {
      objections.push_back("start_within: " + name + " is no state, or there twice");
      continue;
    }
    is_given[at] = true;
    design.start_within[at] = value_of_told(entry.at("formula"), recursion, objections);
    if (!certainly_not_negative(design.start_within[at])) {
      objections.push_back("start_within: " + name + " must not be negative");
    }
  }
}

/// Each state once.
void read_exact_start(const Tree& start, ModelRecursion& recursion, ModelDesign& design,
                      Objections& objections) {
  const std::vector<std::string>& names = recursion.state_names();
  std::vector<std::optional<Ball>> state(names.size());
  for (const Tree& entry : start.elements()) {
    const std::string& name = entry.at("name").text();
    const auto found = std::find(names.begin(), names.end(), name);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || state[at]) {
      objections.push_back("start_exactly: " + name + " is no state, or there twice");
      return;
    }
    state[at] = value_of_told(entry.at("formula"), recursion, objections);
  }
  for (const std::optional<Ball>& value : state) {
    if (!value) {
      objections.emplace_back("start_exactly: a state is missing");
      return;
    }
    design.start.push_back(*value);
  }
}

/// A bound, or Gaussian noise by one number, and then for how many samples.
void read_noise(const Tree& assume, ModelDesign& design, Objections& objections) {
  const Tree& noise = assume.at("noise");
  const Tree* decibels = noise.find("snr_db");
  const Tree* deviation = noise.find("deviation");
  if (decibels == nullptr && deviation == nullptr) {
    design.noise = read_not_negative(noise, "noise", objections);
    return;
  }
  if (decibels != nullptr && deviation != nullptr) {
    objections.emplace_back("noise is given by one number: snr_db or deviation");
  }
  design.deviation = decibels != nullptr ? deviation_at(read_number(*decibels, objections)) * design.amplitude
                                         : read_positive(*deviation, "deviation", objections);
  if (!certainly_positive(*design.deviation)) {
    objections.emplace_back("the deviation of the noise is not a positive number");
  }
  design.samples = read_positive(assume.at("samples"), "samples", objections);
  if (!certainly_at_most(one, design.samples)) {
    objections.emplace_back("samples must be at least 1");
  }
}

/// Requirements on a frequency may be in Hz.
RequiredNumber required_number(const std::string& name, const Tree& number, const Tree& assume,
                               Objections& objections) {
  if (name == "largest_slew_at_least") {
    return {words_of(number, " rad/sample per sample"), read_slew(number, assume, objections)};
  }
  if (name == "settles_like") {
    return {words_of(number, " samples"), read_time(number, assume, name, objections)};
  }
  const bool is_frequency = name.find("frequency_error") != std::string::npos || name == "settled_below" ||
                            name == "bias_below" || name == "ripple_below" || name == "noise_bandwidth_below";
  return is_frequency ? RequiredNumber{words_of(number, " rad/sample"),
                                       read_frequency(number, assume, name, objections)}
                      : RequiredNumber{text_of(number), read_number(number, objections)};
}

void read_requirements(const Tree& require, const Tree& assume, ModelDesign& design, Objections& objections) {
  const std::array<std::pair<std::string, std::optional<RequiredNumber>*>, 14> keys{
      {{"frequency_error_below", &design.frequency_error_below},
       {"settles_within", &design.settles_within},
       {"settled_below", &design.settled_below},
       {"captured_within", &design.captured_within},
       {"largest_noise_at_least", &design.largest_noise},
       {"largest_slew_at_least", &design.largest_slew},
       {"frequency_error_radius_at_least", &design.radius},
       {"probability_of_losing_lock_below", &design.losing_lock},
       {"bias_below", &design.bias},
       {"ripple_below", &design.ripple},
       {"damping_at_least", &design.damping},
       {"settles_like", &design.settles_like},
       {"noise_bandwidth_below", &design.noise_bandwidth},
       {"gain_margin_at_least", &design.gain_margin}}};
  for (const auto& member : require.members()) {
    const std::string& name = member.first;
    const auto* const key =
        std::find_if(keys.begin(), keys.end(), [&](const auto& known) { return known.first == name; });
    if (key == keys.end()) {
      objections.push_back("[require] has no key " + name);
      continue;
    }
    const std::size_t before = objections.size();
    *key->second = required_number(name, member.second, assume, objections);
    if (objections.size() == before && !certainly_positive((*key->second)->value)) {
      objections.push_back(name + " must be positive");
    }
  }
  if (design.settles_within.has_value() != design.settled_below.has_value()) {
    objections.emplace_back("settles_within and settled_below need each other");
    design.settles_within.reset();
    design.settled_below.reset();
  }
}

}  // namespace

Ball deviation_at(const Ball& decibels) {
  return exp(-(decibels / Ball(20.0)) * log(Ball(10.0))) / sqrt(two);
}

ModelDesign read_model_design(const Tree& tree, ModelRecursion& recursion, Objections& objections,
                              bool both_signs) {
  const Tree& assume = tree.at("assume");
  ModelDesign design;
  read_amplitude(assume.at("amplitude"), design, objections);
  read_model_band(assume, both_signs, design, objections);
  read_noise(assume, design, objections);
  design.slew = read_not_negative(assume.at("slew"), "slew", objections);
  if (assume.at("slew_in_hertz_per_second").truth()) {
    const Ball rate = read_positive(assume.at("sample_rate"), "sample_rate", objections);
    design.slew = design.slew * turn_per_sample(assume, objections) / rate;
  }
  if (const Tree* rate = assume.find("sample_rate")) {
    read_positive(*rate, "sample_rate", objections);
  }
  if (const Tree* start = assume.find("start_within")) {
    read_start(*start, recursion, design, objections);
  }
  if (const Tree* start = assume.find("start_exactly")) {
    read_exact_start(*start, recursion, design, objections);
    if (recursion.filtered() > 0 || design.deviation || !certainly_equal(design.slew, zero) ||
        !design.start_within.empty()) {
      objections.emplace_back(
          "start_exactly is for bounded noise and a constant frequency, not for ekf, and without "
          "start_within");
    }
  }
  read_requirements(tree.at("require"), assume, design, objections);
  if (design.losing_lock && !design.deviation) {
    objections.emplace_back("a probability of losing lock is asked for Gaussian noise only");
  }
  if (design.deviation && !certainly_equal(design.slew, zero)) {
    objections.emplace_back("nothing is certified of Gaussian noise with a slew");
  }
  if (design.deviation && (design.amplitude_varies || design.is_constant_in_range)) {
    objections.emplace_back("nothing is certified of Gaussian noise with a range of amplitudes");
  }
  if (design.captured_within && design.start.empty()) {
    objections.emplace_back("captured_within is asked of start_exactly");
  }
  const bool asks_for_ever = design.frequency_error_below || design.settles_within || design.largest_noise ||
                             design.largest_slew || design.radius;
  if (design.deviation && asks_for_ever) {
    objections.emplace_back("no guarantee is valid for ever in Gaussian noise");
  }
  return design;
}

std::string ModelWords::amplitude() const {
  const Tree& amplitude = assume().at("amplitude");
  if (const Tree* range = constant_range(amplitude)) {
    return "of any constant amplitude in [" + text_of(range->at(0)) + ", " + text_of(range->at(1)) +
           "] with ";
  }
  return amplitude.kind() != Tree::Kind::array
             ? "of amplitude " + text_of(amplitude) + " with "
             : "with an amplitude in [" + text_of(amplitude.at(0)) + ", " + text_of(amplitude.at(1)) +
                   "], which may differ from sample to sample, with ";
}

std::string ModelWords::tone(const std::string& frequency) const {
  const auto& signal = design_->at("model").at("signal").elements();
  const bool is_tone = !signal.empty() && signal.size() <= 2 && signal[0].text() == "A*cos(phi)" &&
                       (signal.size() < 2 || signal[1].text() == "A*sin(phi)");
  return words_of_arithmetic(*design_, is_rounded_) + ", on " +
         (is_tone ? "a tone" : "the signal of the design file") + " " + amplitude() + frequency;
}

std::string ModelWords::band() const {
  const Tree& ends = assume().at("frequency");
  std::string unit = assume().at("frequency_in_hertz").truth() ? "Hz" : "rad/sample";
  if (const Tree* rate = assume().find("sample_rate")) {
    unit += " at " + text_of(*rate) + " samples per second";
  }
  if (part_) {
    return "[" + part_->from + ", " + part_->to + "] " + unit + " (a part of the assumed band)";
  }
  return "[" + text_of(ends.at(0)) + ", " + text_of(ends.at(1)) + "] " + unit;
}

std::string ModelWords::assumed_tone(bool moves) const {
  if (!moves) {
    return constant_tone();
  }
  return tone_in_band() + " and changes by at most " + text_of(assume().at("slew")) +
         (assume().at("slew_in_hertz_per_second").truth() ? " Hz per second" : " rad/sample per sample");
}

std::string ModelWords::assumed_noise(bool is_noisy) const {
  return is_noisy ? ", with noise below " + text_of(assume().at("noise")) : ", without noise";
}

std::string ModelWords::gaussian_noise(const std::string& decibels) const {
  const std::string text =
      ", with Gaussian measurement noise of mean zero, independent from sample to sample and from channel to "
      "channel, and ";
  const Tree* assumed = assume().at("noise").find("snr_db");
  if (decibels.empty() && assumed == nullptr) {
    return text + "a deviation of at most " + text_of(assume().at("noise").at("deviation")) +
           " in each channel";
  }
  const std::string written = decibels.empty() ? text_of(*assumed) : decibels;
  Objections known;  // the design has been read
  const Ball unit = deviation_at(decibels.empty() ? read_number(*assumed, known) : from_decimal(decibels));
  return text + "an SNR of at least " + written + " dB (a deviation of at most " + lower_decimal(unit) +
         " of the amplitude in each channel)";
}

std::string ModelWords::stretch_of_samples() const {
  return "within any " + text_of(assume().at("samples")) + " successive samples, however late";
}

std::string ModelWords::start_inside(const std::string& set) const {
  return assume().find("start_within") != nullptr
             ? start_within(set) + covariance_of(set)
             : ", started at a level of at most half of that of the set \"" + set + "\" of the certificate" +
                   covariance_of(set);
}

std::string ModelWords::assumed_start(const std::string& set) const {
  const Tree* start = assume().find("start_within");
  if (start == nullptr) {
    return ", " + started_in(set);
  }
  return start_within(set) + covariance_of(set);
}

std::string ModelWords::started_in(const std::string& set) const {
  return "started in the set \"" + set + "\" of the certificate" + covariance_of(set);
}

namespace {

/// "alpha: 0, w: 0.3".
std::string listed(const Tree& entries) {
  std::string list;
  for (const Tree& entry : entries.elements()) {
    list += (list.empty() ? "" : ", ") + entry.at("name").text() + ": " + entry.at("formula").text();
  }
  return list;
}

}  // namespace

std::string ModelWords::started_exactly() const {
  return ", started exactly in {" + listed(assume().at("start_exactly")) + "} at any phase of the signal";
}

std::string ModelWords::start_within(const std::string& set) const {
  return ", started within {" + listed(assume().at("start_within")) + "} of the curve of the set \"" + set +
         "\" of the certificate, the other states on it";
}

std::string ModelWords::started_in_steady_state() {
  return "started in the steady state of the certificate";
}

std::string ModelWords::assumed_start_by_steady_state() const {
  const Tree* start = assume().find("start_within");
  return start == nullptr ? ", " + started_in_steady_state()
                          : ", started within {" + listed(*start) +
                                "} of the steady state of the certificate, the other states in it";
}

}  // namespace veritrack::checker

#include "certificates/design/design_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

// ---- limits: true only when certain

bool at_least_zero_below_one(const Interval& x) {
  return not_negative(x) && rigor::certainly_less(x, Interval(1.0));
}
bool between_zero_and_one(const Interval& x) {
  return positive(x) && rigor::certainly_less(x, Interval(1.0));
}
bool at_least_one(const Interval& x) {
  return rigor::certainly_less_equal(Interval(1.0), x);
}

// ---- how a key is read

template <auto member, RealPredicate is_allowed>
void whole_number(const TomlValue& value, Owner<member>& target) {
  target.*member = value.whole_number(is_allowed);
}

template <auto member, std::int64_t lowest, std::int64_t highest>
void integer(const TomlValue& value, Owner<member>& target) {
  using Type = std::remove_reference_t<decltype(target.*member)>;
  target.*member = static_cast<Type>(value.integer(lowest, highest));
}

template <auto member, std::size_t limit>
void line_of_text(const TomlValue& value, Owner<member>& target) {
  target.*member = value.line_of_text(limit);
}

/// Stores a string out of a list of choices.
template <typename Choices>
void choose(const TomlValue& value, const Choices& choices, std::string& target) {
  if (!value.is_string()) {
    value.refuse_kind();
  }
  constexpr std::size_t kLongest = 100;
  const std::string text = value.line_of_text(kLongest);
  if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
    value.refuse(fmt::format("\"{}\"", text));
  }
  target = text;
}

void tracker(const TomlValue& value, Design& design) {
  choose(value, kTrackerNames, design.tracker);
}

void signal(const TomlValue& value, SimulationSettings& simulate) {
  choose(value, trackers::signal_names(), simulate.signal);
}

void process_noise(const TomlValue& value, SingleChannelEkfDesign& design) {
  using ProcessNoise = SingleChannelEkfDesign::ProcessNoise;
  if (!value.is_string()) {
    const std::vector<TomlValue> variances = value.entries(std::array<std::string_view, 2>{"q1", "q2"});
    design.process_noise = ProcessNoise::diagonal;
    design.variances = {variances[0].real(not_negative), variances[1].real(not_negative)};
    return;
  }
  constexpr std::array<std::string_view, 2> kReadings{"frequency-only", "identity"};
  std::string reading;
  choose(value, kReadings, reading);
  design.process_noise = reading == kReadings[0] ? ProcessNoise::frequency_only : ProcessNoise::identity;
}

// ---- the keys

constexpr std::string_view kOneLine = "a string on one line, of 1 to 200 bytes";

constexpr std::array kTopKeys{
    Key<Design>{"name", kOneLine, line_of_text<&Design::name, 200>, kRequired},
    Key<Design>{"tracker", "\"quadrature-ekf\", \"kkl-observer\" or \"single-channel-ekf\"", tracker,
                kRequired},
    Key<Design>{"source", kOneLine, line_of_text<&Design::source, 200>, kOptional},
};

using Ekf = QuadratureEkfDesign;
constexpr std::array kQuadratureEkfKeys{
    Key<Ekf>{"q1", kNotNegative, real<&Ekf::q1, not_negative>, kRequired},
    Key<Ekf>{"q2", kPositive, real<&Ekf::q2, positive>, kRequired},
    Key<Ekf>{"r", kPositive, real<&Ekf::r, positive>, kRequired},
    Key<Ekf>{"epsilon", "a number, 0 or more and below 1", real<&Ekf::epsilon, at_least_zero_below_one>,
             kRequired},
};

using Single = SingleChannelEkfDesign;
constexpr std::array kSingleChannelEkfKeys{
    Key<Single>{"q", kPositive, real<&Single::q, positive>, kOptional},
    Key<Single>{"r", kNotNegative, real<&Single::r, not_negative>, kOptional},
    Key<Single>{"lambda", "a number, 0 or more, in place of q and r", real<&Single::lambda, not_negative>,
                kOptional},
    Key<Single>{"epsilon", "a number, 0 or more and below 1", real<&Single::epsilon, at_least_zero_below_one>,
                defaults_to("0")},
    Key<Single>{"process_noise",
                "\"frequency-only\" for Q = q diag(0, 0, 1), \"identity\" for Q = q diag(1, 1, 1), or { q1 = "
                "..., q2 = ... } for Q = diag(q1, q1, q2), each 0 or more",
                process_noise, kRequired},
};

using Require = Requirements;
constexpr std::array kRequireKeys{
    Key<Require>{"frequency_error_below", kPositive, real<&Require::frequency_error_below, positive>,
                 kOptional},
    Key<Require>{"settles_within", "a whole number of samples, 1 or more",
                 whole_number<&Require::settles_within, at_least_one>, kOptional},
    Key<Require>{"largest_noise_at_least", kPositive, real<&Require::largest_noise_at_least, positive>,
                 kOptional},
    Key<Require>{"largest_slew_at_least", kPositive, real<&Require::largest_slew_at_least, positive>,
                 kOptional},
    Key<Require>{"frequency_error_radius_at_least", kPositive,
                 real<&Require::frequency_error_radius_at_least, positive>, kOptional},
};

using Simulate = SimulationSettings;

using Theorem = Theorem29Parameters;
constexpr std::array kTheorem29Keys{
    Key<Theorem>{"R_x", kPositive, real<&Theorem::state_bound, positive>, defaults_to("7")},
    Key<Theorem>{"sigma", kPositive, real<&Theorem::sigma, positive>, defaults_to("1e-3")},
    Key<Theorem>{"gamma_fraction", "a number above 0 and below 1",
                 real<&Theorem::gamma_fraction, between_zero_and_one>, defaults_to("0.5")},
    Key<Theorem>{"c1", kNotNegative, real<&Theorem::c1, not_negative>, defaults_to("3")},
    Key<Theorem>{"c2", kNotNegative, real<&Theorem::c2, not_negative>, defaults_to("3")},
};

}  // namespace

std::optional<decltype(Design::tables)> make_tables(std::string_view tracker) {
  if (tracker == "quadrature-ekf") {
    return QuadratureEkfTables{};
  }
  if (tracker == "kkl-observer") {
    return KklObserverTables{};
  }
  if (tracker == "single-channel-ekf") {
    return SingleChannelEkfTables{};
  }
  return std::nullopt;
}

std::span<const Key<Design>> top_keys() {
  return kTopKeys;
}
std::span<const Key<QuadratureEkfDesign>> quadrature_ekf_keys() {
  return kQuadratureEkfKeys;
}
std::span<const Key<SingleChannelEkfDesign>> single_channel_ekf_keys() {
  return kSingleChannelEkfKeys;
}
std::span<const Key<Requirements>> require_keys() {
  return kRequireKeys;
}

std::span<const Key<SimulationSettings>> simulate_keys() {
  static const std::string signals = fmt::format("\"{}\"", fmt::join(trackers::signal_names(), "\", \""));
  static const std::array keys{
      Key<Simulate>{"samples", "an integer from 1 to 10000000", integer<&Simulate::samples, 1, 10'000'000>,
                    defaults_to("1000")},
      Key<Simulate>{"seed", "an integer from 0 to 9223372036854775807",
                    integer<&Simulate::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1")},
      Key<Simulate>{"signal", signals, signal, defaults_to("\"constant\"")},
  };
  return keys;
}

std::span<const Key<Theorem29Parameters>> theorem_2_9_keys() {
  return kTheorem29Keys;
}

}  // namespace veritrack::certificates

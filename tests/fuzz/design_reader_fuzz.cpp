// Whatever the bytes: a Design whose numbers are finite and within their limits, or an InputError of one
// line.
#include <algorithm>
#include <any>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "certificates/design/design_format.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace {

using namespace veritrack::certificates;

void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "design_reader_fuzz: %s\n", what);
    std::abort();
  }
}

void check(const Number& number) {
  const double lower = number.value.lower();
  const double upper = number.value.upper();
  require(std::isfinite(lower) && std::isfinite(upper) && lower <= upper,
          "a number without a finite interval");
  require(lower <= number.nearest && number.nearest <= upper, "the nearest double is not in the interval");
  require(!number.text.empty(), "a number without a text");
  require((number.position.line > 0) == (number.position.column > 0), "half a position");
}

void check(const QuadratureEkfTables& tables) {
  const Assumptions& assume = tables.assume;
  const Theorem29Parameters& theorem = tables.theorem_2_9;
  for (const Number& number :
       {tables.design.q1, tables.design.q2, tables.design.r, tables.design.epsilon, assume.amplitude,
        assume.frequency[0], assume.frequency[1], assume.slew, assume.initial_frequency_error,
        assume.initial_phase_error, assume.initial_amplitude_error, theorem.state_bound, theorem.sigma,
        theorem.gamma_fraction, theorem.c1, theorem.c2}) {
    check(number);
    require(number.value.lower() >= 0.0, "a negative number");
  }
  require(assume.gaussian.has_value() == assume.samples.has_value(), "samples without Gaussian noise");
  if (!assume.gaussian) {
    check(assume.noise);
    require(assume.noise.value.lower() >= 0.0, "negative noise");
    require(!assume.frequency_walk && !tables.require.probability_of_losing_lock_below,
            "Gaussian keys with a bound");
  } else {
    const auto& [snr, deviation] = *assume.gaussian;
    require(snr.has_value() != deviation.has_value(), "neither an SNR nor a deviation, or both");
    check(snr ? *snr : *deviation);
    require(snr || deviation->value.lower() > 0.0, "a deviation that may be zero");
    check(*assume.samples);
    require(assume.slew.value.upper() == 0.0, "Gaussian noise with a slew");
  }
  for (const Number& number : {tables.design.q2, tables.design.r, assume.amplitude, theorem.state_bound,
                               theorem.sigma, theorem.gamma_fraction}) {
    require(number.value.lower() > 0.0, "a number that may be zero");
  }
  if (assume.sample_rate) {
    check(*assume.sample_rate);
    require(assume.sample_rate->value.lower() > 0.0, "a sample rate that may be zero");
  }
  const bool is_in_hertz =
      assume.frequency[0].in_hertz || assume.slew.in_hertz || assume.initial_frequency_error.in_hertz ||
      (tables.require.frequency_error_below && tables.require.frequency_error_below->in_hertz);
  require(!is_in_hertz || assume.sample_rate.has_value(), "hertz without a sample rate");
  require(tables.design.epsilon.value.upper() < 1.0, "epsilon reaches 1");
  require(theorem.gamma_fraction.value.upper() < 1.0, "gamma_fraction reaches 1");
  require(assume.frequency[0].value.lower() <= assume.frequency[1].value.upper(),
          "a reversed frequency band");
  if (assume.initial_covariance) {
    for (const auto& row : *assume.initial_covariance) {
      std::for_each(row.begin(), row.end(), [](const Number& number) { check(number); });
    }
  }
  if (assume.covariance_range) {
    for (const CovarianceArray& end : *assume.covariance_range) {
      for (const auto& row : end) {
        std::for_each(row.begin(), row.end(), [](const Number& number) { check(number); });
      }
    }
  }
  if (assume.covariance_multiples) {
    const auto& [from, to] = *assume.covariance_multiples;
    check(from);
    check(to);
    require(from.value.lower() > 0.0, "a multiple that may be zero");
    require(same_number(from, to) || from.value.upper() < to.value.lower(), "no multiple between the ends");
  }
  require(tables.simulate.samples >= 1 && tables.simulate.samples <= 10'000'000, "samples out of range");
}

void check(const KklObserverTables& tables) {
  require(tables.design.lambda.size() >= 4, "too few filters");
  for (const Number& rate : tables.design.lambda) {
    check(rate);
    require(rate.value.lower() > 0.0, "a rate that may be zero");
  }
  for (const auto& range : {tables.assume.frequency, tables.assume.amplitude}) {
    check(range[0]);
    check(range[1]);
    require(range[0].value.lower() > 0.0 && range[0].value.lower() <= range[1].value.upper(), "no range");
  }
}

void check(const SingleChannelEkfTables& tables) {
  const SingleChannelDesignTable& design = tables.design;
  require(design.lambda.has_value() != (design.q && design.r), "neither lambda nor q and r, or both");
  for (const std::optional<Number>& number : {design.q, design.r, design.lambda}) {
    if (number) {
      check(*number);
      require(number->value.lower() >= 0.0, "a negative number");
    }
  }
  check(design.epsilon);
  require(design.epsilon.value.lower() >= 0.0 && design.epsilon.value.upper() < 1.0, "epsilon out of range");
  check(tables.assume.frequency[0]);
  check(tables.assume.frequency[1]);
  require(tables.assume.frequency[0].value.lower() <= tables.assume.frequency[1].value.upper(),
          "a reversed frequency band");
}

void check(const ModelTables& tables) {
  const ModelAssumptions& assume = tables.assume;
  for (const Number& number :
       {assume.amplitude[0], assume.amplitude[1], assume.frequency[0], assume.frequency[1], assume.slew}) {
    check(number);
    require(number.value.lower() >= 0.0, "a negative number");
  }
  require(assume.gaussian.has_value() == assume.samples.has_value(),
          "Gaussian noise and samples go together");
  const Number& noise = !assume.gaussian             ? assume.noise
                        : assume.gaussian->deviation ? *assume.gaussian->deviation
                                                     : assume.gaussian->snr_db.value();
  check(noise);
  require((assume.gaussian && assume.gaussian->snr_db) || noise.value.lower() >= 0.0, "negative noise");
  require(assume.amplitude[0].value.lower() > 0.0, "an amplitude that may be zero");
  require(assume.one_amplitude ? same_number(assume.amplitude[0], assume.amplitude[1])
                               : assume.amplitude[0].value.upper() < assume.amplitude[1].value.lower(),
          "amplitudes that are no range");
  require(assume.one_amplitude || !assume.gaussian, "Gaussian noise with a range of amplitudes");
  require(assume.frequency[0].value.lower() <= assume.frequency[1].value.upper(),
          "a reversed frequency band");
  require(!assume.frequency_in_hertz || assume.sample_rate.has_value(), "hertz without a sample rate");
  if (assume.sample_rate) {
    check(*assume.sample_rate);
    require(assume.sample_rate->value.lower() > 0.0, "a sample rate that may be zero");
  }
  const ModelTable& model = tables.model;
  require(!model.samples.empty() && model.samples.size() <= 2, "neither one channel nor two");
  require(model.ekf.has_value() == model.states.empty(), "states and a filter, or neither");
}

/// What the tables promise, when they are of that type.
template <typename Tables>
void check_tables_as(const Design& design) {
  if (const auto* tables = std::any_cast<Tables>(&design.tables)) {
    check(*tables);
  }
}

void check(const Design& design) {
  check_tables_as<QuadratureEkfTables>(design);
  check_tables_as<KklObserverTables>(design);
  check_tables_as<SingleChannelEkfTables>(design);
  check_tables_as<ModelTables>(design);
  require(!design.name.empty() && design.name.size() <= 200, "a name out of range");
  const auto formats = design_formats();
  require(std::any_of(formats.begin(), formats.end(),
                      [&](const DesignFormat* format) { return format->tracker == design.tracker; }),
          "an unknown tracker");
}

void check(const InputError& error) {
  const std::string_view what = error.what();
  require(what.starts_with("x.toml:") && what.size() < 800, "a message of the wrong form");
  require(std::none_of(what.begin(), what.end(),
                       [](char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F; }),
          "a message with control characters");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  try {
    check(read_design(text, "x.toml"));
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}

// The keys of a design file for the tracker "kkl-observer".
#include <array>

#include "certificates/design/input_error.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

/// Distinct to the reader, and to the interval arithmetic that divides by the differences.
void lambda(const TomlValue& value, KklDesignTable& design) {
  std::vector<Number> rates;
  for (const TomlValue& element : value.elements(4, 8)) {
    Number rate = element.real(positive);
    for (const Number& other : rates) {
      const bool differ =
          rigor::certainly_less(rate.value, other.value) || rigor::certainly_less(other.value, rate.value);
      if (!differ) {
        element.refuse(printable(rate.text, 40) + ", a rate that is already in the list");
      }
    }
    rates.push_back(std::move(rate));
  }
  design.lambda = std::move(rates);
}

void ell(const TomlValue& value, KklDesignTable& design) {
  design.ell = value.real(positive);
}

void sampling_interval(const TomlValue& value, KklDesignTable& design) {
  design.sampling_interval = value.real(positive);
}

/// [lowest, highest], both above zero.
std::array<Number, 2> range(const TomlValue& value) {
  const std::vector<TomlValue> bounds = value.elements(2);
  const Number lowest = bounds[0].real(positive);
  const Number highest = bounds[1].real(positive);
  // As for the other trackers: the certificate is for the hull of the two intervals.
  const bool hull_is_ordered = lowest.value.lower() <= highest.value.upper();
  if (!hull_is_ordered) {
    value.refuse("[" + printable(lowest.text, 40) + ", " + printable(highest.text, 40) + "]");
  }
  return {lowest, highest};
}

void frequency(const TomlValue& value, KklAssumptions& assume) {
  assume.frequency = range(value);
}

void amplitude(const TomlValue& value, KklAssumptions& assume) {
  assume.amplitude = range(value);
}

void disturbance(const TomlValue& value, KklAssumptions& assume) {
  KklDisturbance disturbance;
  if (const auto bound = value.fields({"bound"})) {
    disturbance.bound = bound->front().real(positive);
  } else if (const auto sinusoid = value.fields({"amplitude", "frequency"})) {
    disturbance.amplitude = (*sinusoid)[0].real(positive);
    disturbance.frequency = (*sinusoid)[1].real(positive);
  } else {
    value.refuse("a table with other keys");
  }
  assume.disturbance = disturbance;
}

constexpr std::array kFormsOfDisturbance{MemberContract{"bound", Stronger::larger},
                                         MemberContract{"amplitude", Stronger::larger},
                                         MemberContract{"frequency", Stronger::only_equal}};
constexpr KeyContract kContractOfDisturbance{Stronger::larger, Measure::plain, kFormsOfDisturbance};

constexpr std::string_view kRange = "[lowest, highest], 0 < lowest <= highest";

constexpr std::array kDesignKeys{
    Key<KklDesignTable>{"lambda", "an array of four to eight distinct numbers above 0 (1/s)", lambda,
                        kRequired, kNoContract},
    Key<KklDesignTable>{"ell", kPositive, ell, kOptional, kNoContract},
    Key<KklDesignTable>{"sampling_interval", "a number of seconds above 0", sampling_interval, kOptional,
                        kOnlyEqual},
};
constexpr std::array kAssumeKeys{
    Key<KklAssumptions>{"frequency", "[lowest, highest] in rad/s, 0 < lowest <= highest", frequency,
                        kRequired, kWider},
    Key<KklAssumptions>{"amplitude", kRange, amplitude, kRequired, kWider},
    Key<KklAssumptions>{"disturbance",
                        "{ bound = ... } or { amplitude = ..., frequency = ... }, each a number above 0 (the "
                        "frequency in rad/s)",
                        disturbance, kOptional, kContractOfDisturbance},
};

/// A requirement, a number above 0.
template <auto member>
void requirement(const TomlValue& value, KklRequirements& require) {
  require.*member = value.real(positive);
}
constexpr std::array kRequireKeys{
    Key<KklRequirements>{"frequency_error_below", kPositive,
                         requirement<&KklRequirements::frequency_error_below>, kOptional, kLess},
    Key<KklRequirements>{"amplitude_error_below", kPositive,
                         requirement<&KklRequirements::amplitude_error_below>, kOptional, kLess},
    Key<KklRequirements>{"settles_within", "a number of seconds above 0",
                         requirement<&KklRequirements::settles_within>, kOptional, kLess},
};

std::vector<BoundTable> bind_tables(std::any& tables) {
  auto& target = std::any_cast<KklObserverTables&>(tables);
  return {bound_table("design", kDesignKeys, target.design),
          bound_table("assume", kAssumeKeys, target.assume),
          bound_table("require", kRequireKeys, target.require)};
}

}  // namespace

const DesignFormat& kkl_observer_format() {
  static const DesignFormat format{"kkl-observer", [] { return std::any(KklObserverTables{}); }, bind_tables};
  return format;
}

}  // namespace veritrack::certificates

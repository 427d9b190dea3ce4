// The keys of a design file for the tracker "vibration-regulator".
#include <array>
#include <string>
#include <vector>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/key_readers.hpp"
#include "certificates/regulator/regulator_design.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

template <auto member>
void coefficients(const TomlValue& value, PlantTable& plant) {
  (plant.*member).clear();
  for (const TomlValue& element : value.elements(1, kMostPlantOrder)) {
    (plant.*member).push_back(element.real(any_number));
  }
}

bool not_zero(const Interval& x) {
  return rigor::certainly_positive(x) || rigor::certainly_negative(x);
}

void input_coefficients(const TomlValue& value, PlantTable& plant) {
  coefficients<&PlantTable::b>(value, plant);
  (void)value.elements(1, kMostPlantOrder).front().real(not_zero);
}

void frequency_tracker(const TomlValue& value, RegulatorDesignTable& design) {
  design.frequency_tracker = read_inner_design(value);
  const std::string& tracker = design.frequency_tracker.tracker;
  if (tracker != "quadrature-ekf" && tracker != "single-channel-ekf" && tracker != "model") {
    value.refuse("a " + tracker);
  }
}

constexpr std::array kPlantKeys{
    Key<PlantTable>{"a", "an array of one to eight numbers, a_1 ... a_p", coefficients<&PlantTable::a>,
                    kRequired, kOnlyEqual},
    Key<PlantTable>{"b", "an array of one to eight numbers, b_0 ... b_{p-1}, b_0 not 0", input_coefficients,
                    kRequired, kOnlyEqual},
};
constexpr std::array kRegulatorDesignKeys{
    Key<RegulatorDesignTable>{"frequency_tracker",
                              "a table with a design of quadrature-ekf, single-channel-ekf or model",
                              frequency_tracker, kRequired, KeyContract{Stronger::inner_design}},
};
using Regulation = RegulatorRequirements;
void attenuated_within(const TomlValue& value, Regulation& require) {
  require.attenuated_within = value.whole_number(positive);
}
template <auto member>
void regulation(const TomlValue& value, Regulation& require) {
  require.*member = value.real(positive);
}
constexpr std::array kRegulationKeys{
    Key<Regulation>{"attenuation_above", "a number of dB above 0", regulation<&Regulation::attenuation_above>,
                    kOptional, kMore},
    Key<Regulation>{"attenuated_within", "a whole number of samples, 1 or more; with attenuation_above",
                    attenuated_within, kOptional, kLessSamples},
    Key<Regulation>{"output_below", kPositive, regulation<&Regulation::output_below>, kOptional, kLess},
    Key<Regulation>{"input_below", kPositive, regulation<&Regulation::input_below>, kOptional, kLess},
};
using Run = RegulatorSimulation;
constexpr std::int64_t kMostSamples = 10'000'000;
constexpr std::array kRunKeys{
    Key<Run>{"samples", "a whole number from 1 to 10000000", integer<&Run::samples, 1, kMostSamples>,
             defaults_to("1000"), kNoContract},
    Key<Run>{"seed", "a whole number, 0 or more",
             integer<&Run::seed, 0, std::numeric_limits<std::int64_t>::max()>, defaults_to("1"), kNoContract},
};

std::vector<BoundTable> bind_regulator_tables(std::any& tables) {
  auto& target = std::any_cast<RegulatorTables&>(tables);
  return {bound_table("plant", kPlantKeys, target.plant),
          bound_table("design", kRegulatorDesignKeys, target.design),
          bound_table("require", kRegulationKeys, target.require),
          bound_table("simulate", kRunKeys, target.simulate)};
}

std::optional<TableObjection> regulator_objection(const std::any& tables) {
  const auto& read = std::any_cast<const RegulatorTables&>(tables);
  if (read.plant.a.size() != read.plant.b.size()) {
    return TableObjection{"plant",
                          fmt::format("a has {} and b {} numbers; allowed: as many of each, zeros among "
                                      "them",
                                      read.plant.a.size(), read.plant.b.size())};
  }
  if (read.require.attenuated_within && !read.require.attenuation_above) {
    return TableObjection{"require",
                          "attenuated_within without attenuation_above; allowed: both, or "
                          "attenuation_above alone",
                          read.require.attenuated_within->position};
  }
  return std::nullopt;
}

}  // namespace

const DesignFormat& regulator_format() {
  static const DesignFormat format{"vibration-regulator", [] { return std::any(RegulatorTables{}); },
                                   bind_regulator_tables, regulator_objection};
  return format;
}

}  // namespace veritrack::certificates

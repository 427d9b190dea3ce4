#include "checker/kkl_observer/kkl_design.hpp"

#include "checker/document/design_number.hpp"
#include "checker/document/evidence.hpp"

namespace veritrack::checker {

KklDesign read_kkl_design(const Tree& tree, Objections& objections) {
  const auto positive = [&](const Tree& number) {
    return read_positive(number, text_of(number), objections);
  };
  const Tree& chosen = tree.at("design");
  const Tree& assume = tree.at("assume");
  KklDesign design;
  for (const Tree& rate : chosen.at("lambda").elements()) {
    design.lambda.push_back(positive(rate));
  }
  if (const Tree* ell = chosen.find("ell")) {
    design.ell = positive(*ell);
  }
  if (const Tree* interval = chosen.find("sampling_interval")) {
    design.sampling_interval = positive(*interval);
  }
  // A range is the hull of the two enclosures, which contain the decimals.
  const auto range = [&](const Tree& ends, Ball& low, Ball& high) {
    positive(ends.at(0));
    positive(ends.at(1));
    low = low_of(ends.at(0));
    high = high_of(ends.at(1));
    if (!certainly_positive(low) || !certainly_at_most(low, high)) {
      objections.emplace_back("a range must go from low to high and lie above zero");
    }
  };
  range(assume.at("frequency"), design.frequency_low, design.frequency_high);
  range(assume.at("amplitude"), design.amplitude_low, design.amplitude_high);
  if (const Tree* disturbance = assume.find("disturbance")) {
    for (const auto& [key, value] : disturbance->members()) {
      if (key != "bound" && key != "amplitude" && key != "frequency") {
        throw Malformed("a disturbance has no " + key);
      }
      auto& number = key == "bound"       ? design.bound
                     : key == "amplitude" ? design.disturbance_amplitude
                                          : design.disturbance_frequency;
      number = positive(value);
    }
    const bool sinusoid =
        disturbance->find("amplitude") != nullptr && disturbance->find("frequency") != nullptr;
    const bool bounded = disturbance->find("bound") != nullptr;
    if (disturbance->members().size() != (bounded ? 1 : 2) || bounded == sinusoid) {
      objections.emplace_back("the disturbance needs a bound, or an amplitude and a frequency");
    }
  }
  if (design.lambda.size() < 4) {
    objections.emplace_back("four rates or more are needed");
  }
  if (design.lambda.size() > 8) {
    objections.emplace_back("eight rates are the most");
  }
  return design;
}

}  // namespace veritrack::checker

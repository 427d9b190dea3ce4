#include "checker/model/gain/gain_evidence.hpp"

#include <cstdlib>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

constexpr long kMostBlocks = 256;
constexpr long kLongestHorizon = 1L << 22;
constexpr long kMostTurns = 1000;

std::vector<SteadyState> read_steady_state(const Tree& list, Objections& objections) {
  std::vector<SteadyState> steady;
  for (const Tree& entry : list.elements()) {
    steady.push_back({entry.at("turns").integer(), exact_number(entry.at("constant")),
                      exact_number(entry.at("per_frequency"))});
    if (const Tree* imaginary = entry.find("imaginary")) {
      const long place = imaginary->integer();
      if (place < 0) {
        objections.emplace_back("the imaginary part of a vector is no state");
      } else {
        steady.back().imaginary = static_cast<std::size_t>(place);
      }
    }
    if (std::labs(steady.back().turns) > kMostTurns) {
      objections.emplace_back("too many turns");
    }
  }
  return steady;
}

/// The room of the states, from which the rounding of the program follows. Throws NotCovered.
void read_rounding(const Tree& list, const ModelRecursion& recursion, const ModelDesign& design,
                   const std::vector<SteadyState>& steady, const RoundingOfStep& rounding,
                   GainNetwork& network) {
  GainRounding found;
  for (const Tree& entry : list.elements()) {
    found.room.push_back(exact_number(entry));
  }
  const std::vector<bool>& is_angle = recursion.is_angle();
  if (!rounding || found.room.size() != network.states()) {
    throw NotCovered("rounding without a listing that bounds it, or of other states");
  }
  for (std::size_t i = 0; i < found.room.size(); ++i) {
    if (is_angle[i] ? !certainly_equal(found.room[i], zero) : !certainly_positive(found.room[i])) {
      throw NotCovered("the room of a state is a number above 0, and that of an angle 0");
    }
  }
  if (!certainly_equal(design.turned, zero)) {
    // The samples that an arc tangent was looked at for, and noise is below the amplitude by this much.
    constexpr double kScale = 0x1p39;
    if (!certainly_less(design.largest_amplitude, Ball(kScale)) ||
        !certainly_less(one, Ball(kScale) * design.turned * design.least_amplitude)) {
      throw NotCovered("an arc tangent of other samples");
    }
    network.turned = design.turned;
    network.largest_amplitude = design.largest_amplitude;
  }
  // Noise is below the amplitude.
  const Ball sample = Ball::within(two * design.largest_amplitude);
  const auto off =
      rounding(states_within(found.room, steady, is_angle, design.lowest, design.highest), sample);
  if (!off || off->size() != network.states() + 1) {
    throw NotCovered("no bound of the program's rounding is known");
  }
  found.next.assign(off->begin(), off->end() - 1);
  found.frequency = off->back();
  add_rounding(found, is_angle, network);
}

/// The samples are those of a tone, in one channel or in phase and in quadrature.
bool is_tone_alone(const Tree& model) {
  const std::vector<Tree>& signal = model.at("signal").elements();
  return (signal.size() == 1 || (signal.size() == 2 && signal[1].text() == "A*sin(phi)")) &&
         signal[0].text() == "A*cos(phi)";
}

}  // namespace

std::unique_ptr<Gains> read_gains(const Tree& gains, const Tree& model, const ModelRecursion& recursion,
                                  const ModelDesign& design, const RoundingOfStep& rounding,
                                  Objections& objections) {
  const std::vector<SteadyState> steady = read_steady_state(gains.at("steady_state"), objections);
  const bool has_bounds = gains.find("horizon") != nullptr;  // none of an unstable loop
  const long horizon = has_bounds ? gains.at("horizon").integer() : 1;
  const long blocks = has_bounds ? gains.at("blocks").integer() : 1;
  if (blocks < 1 || blocks > kMostBlocks || horizon < 1 || horizon > kLongestHorizon ||
      horizon % blocks != 0) {
    objections.emplace_back("the blocks do not divide the horizon, or there are too many");
  }
  if (recursion.filtered() > 0 || !is_tone_alone(model) || design.deviation || !design.start.empty()) {
    objections.emplace_back(
        recursion.samples() == 2
            ? "gains are for a loop on a tone in phase and in quadrature, in bounded noise"
            : "gains are for a loop on a tone alone, in bounded noise");
  }
  if (recursion.samples() == 1 && !certainly_positive(design.lowest)) {
    objections.emplace_back("in one channel, gains are for frequencies above 0");
  }
  const Tree* one_noise = has_bounds ? gains.find("one_noise") : nullptr;
  if (!objections.empty()) {
    return nullptr;
  }
  try {
    auto result = std::make_unique<Gains>(
        gain_network(recursion, design, steady, one_noise != nullptr && one_noise->truth()));
    if (!has_bounds) {
      return result;
    }
    if (const Tree* room = gains.find("rounding")) {
      read_rounding(*room, recursion, design, steady, rounding, result->network);
    }
    result->bounds.emplace(result->network, static_cast<std::size_t>(horizon),
                           static_cast<std::size_t>(blocks));
    if (!result->bounds->is_certain()) {
      objections.emplace_back("the loop is not stable, or the horizon is too short");
    } else if (!result->bounds->is_about_steady_state()) {
      objections.emplace_back("what is listed is no steady state of the loop");
    } else {
      return result;
    }
  } catch (const NotCovered& reason) {
    objections.emplace_back(reason.what());
  }
  return nullptr;
}

}  // namespace veritrack::checker

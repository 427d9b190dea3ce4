#include "checker/model/gain/phase_evidence.hpp"

#include <cmath>
#include <utility>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/jet.hpp"
#include "checker/model/series_evidence.hpp"
#include "checker/model/turn_count.hpp"
#include "checker/numbers/threads.hpp"

namespace veritrack::checker {

namespace {

constexpr long kFewestPhases = 8;
constexpr long kMostPhasesOfGains = 512;
constexpr long kLongestHorizonOfPhases = 1L << 16;
constexpr long kMostLateBlocks = 4096;
constexpr long kMostLateTurns = 65536;
constexpr long kMostPartsOfCell = 4096;
constexpr long kMostTurnsOfCurve = 1000;

/// sum over d of d c_hd z^(d - 1). Products with these whole numbers are rounded once, which sums of series
/// allow for (HarmonicBasis).
PhaseSeries derivative_of(const PhaseSeries& series) {
  PhaseSeries result;
  for (const auto& harmonic : series) {
    result.emplace_back();
    for (std::size_t d = 1; d < harmonic.size(); ++d) {
      result.back().push_back(static_cast<double>(d) * harmonic[d]);
    }
  }
  return result;
}

PhaseCell read_cell(const Tree& tree, const ModelRecursion& recursion, Objections& objections) {
  const std::size_t n = recursion.states();
  PhaseCell cell;
  cell.tube.frequency = double_from(tree.at("frequency"));
  cell.tube.half_width = double_from(tree.at("half_width"));
  const long parts = tree.at("parts").integer();
  cell.tube.curve = series_from(tree.at("curve"));
  cell.tube.shape = series_from(tree.at("basis"));
  bool is_possible = parts >= 1 && parts <= kMostPartsOfCell;
  for (const Tree& turns : tree.at("turns").elements()) {
    const long count = turns.integer();
    const std::size_t state = cell.tube.turns.size();
    is_possible = is_possible && count <= kMostTurnsOfCurve && count >= -kMostTurnsOfCurve &&
                  (count == 0 || (state < n && recursion.is_angle()[state]));
    cell.tube.turns.push_back(count);
  }
  for (const Tree& polynomial : tree.at("matrix").elements()) {
    cell.matrix.push_back(doubles_from(polynomial));
    is_possible = is_possible && cell.matrix.back().size() <= kMostPowers;
  }
  if (!is_possible || !certainly_positive(Ball(cell.tube.half_width)) || cell.tube.turns.size() != n ||
      cell.tube.curve.size() != n || cell.tube.shape.size() != n * n || cell.matrix.size() != n * n) {
    objections.emplace_back("a cell of gains is not one of this tracker");
    return cell;
  }
  cell.parts = static_cast<std::size_t>(parts);
  cell.slope.frequency = cell.tube.frequency;
  cell.slope.half_width = cell.tube.half_width;
  cell.slope.turns.assign(n, 0);
  for (const PhaseSeries& series : cell.tube.curve) {
    cell.slope.curve.push_back(derivative_of(series));
  }
  for (const PhaseSeries& series : cell.tube.shape) {
    cell.slope.shape.push_back(derivative_of(series));
  }
  return cell;
}

std::vector<PhaseCell> read_cells(const Tree& list, const ModelRecursion& recursion,
                                  const ModelDesign& design, Objections& objections) {
  std::vector<PhaseCell> cells;
  TubeSet band;
  for (const Tree& tree : list.elements()) {
    cells.push_back(read_cell(tree, recursion, objections));
    band.tubes.push_back(cells.back().tube);
  }
  check_order(band, objections);
  if (!covers(band, design.lowest, design.highest)) {
    objections.emplace_back("the cells of gains do not cover the band");
  }
  if (design.moves() && cells.size() != 1) {
    objections.emplace_back("with a slew, one cell has to cover the band");
  }
  return cells;
}

void check_phase_design(const ModelRecursion& recursion, const ModelDesign& design, Objections& objections) {
  if (recursion.filtered() > 0 || design.deviation || design.amplitude_varies ||
      design.is_constant_in_range || !design.start.empty()) {
    objections.emplace_back(
        "gains with phases are for a recursion on a signal of one known amplitude, in bounded noise");
  }
  if (recursion.samples() == 1 &&
      !(certainly_positive(design.lowest) && certainly_less(design.highest, pi()))) {
    objections.emplace_back("in one channel, gains are for frequencies between 0 and pi");
  }
  if (const std::string objection = angle_objection(recursion); !objection.empty()) {
    objections.push_back(objection);
  }
}

/// The steady state at one frequency and so many phases. Nothing rests on it but the order of factors.
std::vector<SteadyPoint> steady_points(const TrackedModel& model, const PhaseCell& cell, std::size_t phases) {
  std::vector<SteadyPoint> points;
  for (std::size_t g = 0; g < phases; ++g) {
    const TubePart place = TubePart::of_grid(g, phases, 0, 1).middle();
    points.emplace_back();
    for (const BallPolynomial& state : TubeOver(cell.tube, place, 0).curve) {
      points.back().states.push_back(state.constant());
    }
    for (const BallPolynomial& sample : signal_later(model, cell.tube, place)) {
      points.back().samples.push_back(sample.constant());
    }
  }
  return points;
}

/// By state, the derivative of the frequency at all states.
std::vector<Ball> factors_of_frequency(const ModelRecursion& recursion) {
  const std::size_t n = recursion.states();
  std::vector<Jet<Ball>> states;
  for (std::size_t i = 0; i < n; ++i) {
    states.push_back(Jet<Ball>::variable(Ball::everything(), i, n));
  }
  const Jet<Ball> frequency = recursion.frequency(states);
  std::vector<Ball> factors;
  for (std::size_t i = 0; i < n; ++i) {
    factors.push_back(frequency.slope(i));
  }
  return factors;
}

/// Throws NotCovered.
RoundedProgram read_program(const Tree& list, const TrackedModel& model, const RoundingOfStep& rounding) {
  const std::vector<bool>& is_angle = model.recursion->is_angle();
  RoundedProgram program{{}, (Ball(kMostRoundedNoise) * model.amplitude).lower_double(), rounding};
  for (const Tree& entry : list.elements()) {
    program.room.push_back(double_from(entry));
  }
  if (!rounding || program.room.size() != model.recursion->states()) {
    throw NotCovered("rounding without a listing that bounds it, or of other states");
  }
  for (std::size_t i = 0; i < program.room.size(); ++i) {
    double& room = program.room[i];
    if (is_angle[i] ? room != 0.0 : !(std::isfinite(room) && room > 0.0)) {
      throw NotCovered("the room of a state is a number above 0, and that of an angle 0");
    }
    room = is_angle[i] ? HUGE_VAL : room;
  }
  return program;
}

}  // namespace

std::unique_ptr<PhaseBounds> read_phase_gains(const Tree& gains, const TrackedModel& model,
                                              const ModelDesign& design, const RoundingOfStep& rounding,
                                              Objections& objections) {
  const ModelRecursion& recursion = *model.recursion;
  const long phases = gains.at("phases").integer();
  const long horizon = gains.at("horizon").integer();
  if (phases < kFewestPhases || phases > kMostPhasesOfGains || (phases & (phases - 1)) != 0 || horizon < 1 ||
      horizon > kLongestHorizonOfPhases) {
    objections.emplace_back("phases are a power of 2 from 8 to 512, and a horizon is at most 65536");
  }
  std::size_t late_blocks = 0;
  std::size_t late_turns = 0;
  if (const Tree* late = gains.find("late")) {
    const long blocks = late->at("blocks").integer();
    const long turns = late->at("turns").integer();
    if (blocks < 1 || blocks > kMostLateBlocks || turns < 1 || turns > kMostLateTurns || design.moves()) {
      objections.emplace_back("late lags are 1 to 4096 blocks of 1 to 65536 turns, at a constant frequency");
      return nullptr;
    }
    late_blocks = static_cast<std::size_t>(blocks);
    late_turns = static_cast<std::size_t>(turns);
  }
  check_phase_design(recursion, design, objections);
  const std::vector<PhaseCell> cells = read_cells(gains.at("cells"), recursion, design, objections);
  if (!objections.empty()) {
    return nullptr;
  }
  try {
    PhaseLoopEvidence evidence;
    evidence.phases = static_cast<std::size_t>(phases);
    evidence.horizon.single = static_cast<std::size_t>(horizon);
    evidence.horizon.late_blocks = late_blocks;
    evidence.horizon.late_turns = late_turns;
    evidence.frequency_factors = factors_of_frequency(recursion);
    if (const Tree* room = gains.find("rounding")) {
      if (!certainly_equal(design.turned, zero)) {
        throw NotCovered("rounding over the phases of a program with an arc tangent of its own");
      }
      evidence.program = read_program(*room, model, rounding);
    }
    evidence.structure =
        phase_structure(with_small_factors_last(recorded_step(recursion),
                                                steady_points(model, cells.front(), evidence.phases)),
                        recursion.states(), recursion.samples(), evidence.program.has_value());
    for (const PhaseCell& cell : cells) {
      evidence.cells.emplace_back(cell.parts);
      first_failure(cell.parts, [&](std::size_t part) {
        evidence.cells.back()[part] = phase_part(evidence.structure, model, cell, part, evidence.phases,
                                                 evidence.program ? &*evidence.program : nullptr);
        return true;
      });
    }
    auto bounds = std::make_unique<PhaseBounds>(std::move(evidence));
    if (bounds->is_certain(design.slew)) {
      return bounds;
    }
    objections.emplace_back(
        "the loop is not stable, the horizon is too short, or the curve is no steady state");
  } catch (const NotCovered& reason) {
    objections.emplace_back(reason.what());
  }
  return nullptr;
}

}  // namespace veritrack::checker

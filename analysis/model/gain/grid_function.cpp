#include "analysis/model/gain/grid_function.hpp"

#include <array>
#include <cmath>

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;

namespace {

/// A model of one place as sum c_l s^l, and what depends on z or is an error.
struct AlongPhase {
  std::array<double, 5> by_s{};
  double rest = 0.0;
};

AlongPhase along_phase(const BallModel& f) {
  AlongPhase result;
  result.rest = f.error();
  const auto coefficients = f.coefficients();
  for (const auto& each : f.monomials().classes()) {
    const double c = coefficients[each.first];
    if (each.z == 0) {
      result.by_s.at(static_cast<std::size_t>(each.s)) = c;
    } else {
      result.rest += std::fabs(c);
    }
  }
  return result;
}

}  // namespace

GridFunction grid_function(std::size_t components, std::size_t phases, const ModelAt& at) {
  GridFunction f;
  f.values.assign(components, std::vector<double>(phases));
  for (auto* list : {&f.error, &f.largest, &f.first_difference, &f.second_difference}) {
    list->assign(components, 0.0);
  }
  for (std::size_t i = 0; i < components; ++i) {
    std::vector<AlongPhase> cells;
    for (std::size_t g = 0; g < phases; ++g) {
      cells.push_back(along_phase(at(g, i)));
      const auto& c = cells.back().by_s;
      f.values[i][g] = c[0] - c[1] + c[2] - c[3] + c[4];
    }
    for (std::size_t g = 0; g < phases; ++g) {
      const auto& c = cells[g].by_s;
      const double left = f.values[i][g];
      const double right = f.values[i][(g + 1) % phases];
      const double before = f.values[i][(g + phases - 1) % phases];
      const Interval end_left =
          Interval(c[0]) - Interval(c[1]) + Interval(c[2]) - Interval(c[3]) + Interval(c[4]);
      const Interval end_right =
          Interval(c[0]) + Interval(c[1]) + Interval(c[2]) + Interval(c[3]) + Interval(c[4]);
      const double ends = larger_or_nan(rigor::magnitude(end_left - Interval(left)),
                                        rigor::magnitude(end_right - Interval(right)));
      const double bend = std::fabs(c[2]) + 0.385 * std::fabs(c[3]) + std::fabs(c[4]);
      const double error = bend + cells[g].rest + ends;
      f.error[i] = larger_or_nan(f.error[i], error);
      f.largest[i] = larger_or_nan(f.largest[i], std::fabs(left));
      f.first_difference[i] =
          larger_or_nan(f.first_difference[i], rigor::magnitude(Interval(right) - Interval(left)));
      f.second_difference[i] =
          std::max(f.second_difference[i],
                   rigor::magnitude(Interval(right) - Interval(2.0) * Interval(left) + Interval(before)));
    }
  }
  return f;
}

}  // namespace veritrack::model

#include "analysis/model/gain/grid_function.hpp"

#include <array>
#include <cmath>

#include "analysis/rigor/larger_or_nan.hpp"

namespace veritrack::model {

using rigor::BallModel;
using rigor::Interval;
using rigor::larger_or_nan;

namespace {

using Powers = std::array<double, 5>;  ///< of s

/// A model of one place as sum c_l s^l + z sum d_l s^l, and what depends on z otherwise or is an error.
struct AlongPhase {
  Powers constant{}, by_z{};
  double rest = 0.0;
};

AlongPhase along_phase(const BallModel& f) {
  AlongPhase result;
  result.rest = f.error();
  const auto coefficients = f.coefficients();
  for (const auto& each : f.monomials().classes()) {
    const double c = coefficients[each.first];
    if (each.z > 1) {
      result.rest += std::fabs(c);
    } else {
      (each.z == 0 ? result.constant : result.by_z).at(static_cast<std::size_t>(each.s)) = c;
    }
  }
  return result;
}

double at_left(const Powers& c) {
  return c[0] - c[1] + c[2] - c[3] + c[4];
}
/// How far it is from the line between its ends.
double bend_of(const Powers& c) {
  return std::fabs(c[2]) + 0.385 * std::fabs(c[3]) + std::fabs(c[4]);
}

/// How far its ends are from these.
double distance_of_ends(const Powers& c, double left, double right) {
  const Interval even = Interval(c[0]) + Interval(c[2]) + Interval(c[4]);
  const Interval odd = Interval(c[1]) + Interval(c[3]);
  return larger_or_nan(rigor::magnitude(even - odd - Interval(left)),
                       rigor::magnitude(even + odd - Interval(right)));
}

void raise(double& most, const Interval& value) {
  most = larger_or_nan(most, rigor::magnitude(value));
}

/// From the values at both ends: what is known by component but for the error.
void find_sizes(std::size_t i, GridFunction& f) {
  const std::size_t phases = f.values[0][i].size();
  for (std::size_t g = 0; g < phases; ++g) {
    const std::size_t next = (g + 1) % phases;
    const std::size_t last = (g + phases - 1) % phases;
    Interval lean(0.0), lean_next(0.0);
    for (const std::size_t end : {0U, 1U}) {
      const std::vector<double>& of = f.values[end][i];
      const Interval here(of[g]);
      raise(f.largest[i], here);
      raise(f.first_difference[i], Interval(of[next]) - here);
      raise(f.second_difference[i], Interval(of[next]) - Interval(2.0) * here + Interval(of[last]));
      const Interval half(end == 0 ? -0.5 : 0.5);
      lean += half * here;
      lean_next += half * Interval(of[next]);
    }
    raise(f.lean[i], lean);
    raise(f.lean_difference[i], lean_next - lean);
  }
}

GridFunction of_size(std::size_t components, std::size_t phases) {
  GridFunction f;
  f.values.fill(std::vector<std::vector<double>>(components, std::vector<double>(phases)));
  for (auto* list :
       {&f.error, &f.largest, &f.first_difference, &f.second_difference, &f.lean, &f.lean_difference}) {
    list->assign(components, 0.0);
  }
  return f;
}

}  // namespace

GridFunction grid_function(std::size_t components, std::size_t phases, const ModelAt& at) {
  GridFunction f = of_size(components, phases);
  for (std::size_t i = 0; i < components; ++i) {
    std::vector<AlongPhase> cells;
    for (std::size_t g = 0; g < phases; ++g) {
      cells.push_back(along_phase(at(g, i)));
      const double middle = at_left(cells.back().constant);
      const double lean = at_left(cells.back().by_z);
      f.values[0][i][g] = middle - lean;
      f.values[1][i][g] = middle + lean;
    }
    for (std::size_t g = 0; g < phases; ++g) {
      // Linear in z: it is enough to look at both ends.
      double error = 0.0;
      for (const std::size_t end : {0U, 1U}) {
        Powers there;
        double rounding = 0.0;
        for (std::size_t l = 0; l < there.size(); ++l) {
          const Interval sum =
              Interval(cells[g].constant[l]) + Interval(end == 0 ? -1.0 : 1.0) * Interval(cells[g].by_z[l]);
          there[l] = rigor::midpoint(sum);
          rounding += rigor::magnitude(sum - Interval(there[l]));
        }
        const std::vector<double>& values = f.values[end][i];
        error = larger_or_nan(
            error, bend_of(there) + rounding + distance_of_ends(there, values[g], values[(g + 1) % phases]));
      }
      f.error[i] = larger_or_nan(f.error[i], error + cells[g].rest);
    }
    find_sizes(i, f);
  }
  return f;
}

GridFunction without_lean(const GridFunction& f) {
  const std::size_t components = f.error.size();
  const std::size_t phases = components == 0 ? 0 : f.values[0][0].size();
  GridFunction result = of_size(components, phases);
  for (std::size_t i = 0; i < components; ++i) {
    double far = 0.0;
    for (std::size_t g = 0; g < phases; ++g) {
      const double middle = 0.5 * (f.values[0][i][g] + f.values[1][i][g]);
      for (const std::size_t end : {0U, 1U}) {
        result.values[end][i][g] = middle;
        raise(far, Interval(f.values[end][i][g]) - Interval(middle));
      }
    }
    result.error[i] = f.error[i] + far;
    find_sizes(i, result);
  }
  return result;
}

double distance_from_line(const BallModel& f, double constant, double slope) {
  const AlongPhase along = along_phase(f);
  double distance = along.rest + rigor::magnitude(Interval(along.constant[0]) - Interval(constant)) +
                    rigor::magnitude(Interval(along.by_z[0]) - Interval(slope));
  for (std::size_t l = 1; l < along.constant.size(); ++l) {
    distance += std::fabs(along.constant[l]) + std::fabs(along.by_z[l]);
  }
  return distance;
}

}  // namespace veritrack::model

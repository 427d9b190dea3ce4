#include "checker/model/gain/grid_function.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::checker {

std::size_t grid_cell(double cell, std::size_t phases) {
  const auto turn = static_cast<double>(phases);
  return static_cast<std::size_t>(cell - turn * std::floor(cell / turn)) % phases;
}

GridSizes grid_sizes(const GridFunction& f) {
  const std::size_t n = f.error.size();
  const std::vector<double> none(n, 0.0);
  GridSizes sizes{none, none, none, none, none};
  const std::size_t phases = f.values[0].size();
  const auto raise = [](double& most, double value, double scale) {
    most = std::max(most, up(std::abs(value) + upward_product(0x1p-48, scale)));  // of a few roundings
  };
  for (std::size_t g = 0; g < phases; ++g) {
    const std::size_t next = (g + 1) % phases;
    const std::size_t last = (g + phases - 1) % phases;
    for (std::size_t i = 0; i < n; ++i) {
      double all = 0.0;
      for (const Table& end : f.values) {
        const double here = end[g][i];
        const double scale = std::abs(here) + std::abs(end[next][i]) + std::abs(end[last][i]);
        sizes.value[i] = std::max(sizes.value[i], std::abs(here));
        raise(sizes.first_difference[i], end[next][i] - here, scale);
        raise(sizes.second_difference[i], (end[next][i] - here) - (here - end[last][i]), scale);
        all += scale;
      }
      const double lean = 0.5 * (f.values[1][g][i] - f.values[0][g][i]);
      raise(sizes.lean[i], lean, all);
      raise(sizes.lean_difference[i], 0.5 * (f.values[1][next][i] - f.values[0][next][i]) - lean, all);
    }
  }
  return sizes;
}

GridFunction without_lean(GridFunction f) {
  std::vector<double> far(f.error.size(), 0.0);
  for (std::size_t g = 0; g < f.values[0].size(); ++g) {
    for (std::size_t i = 0; i < far.size(); ++i) {
      double& low = f.values[0][g][i];
      double& high = f.values[1][g][i];
      const double middle = 0.5 * low + 0.5 * high;
      // NaN stays in the values, which are looked at by themselves.
      far[i] = std::max({far[i], up(std::abs(low - middle)), up(std::abs(high - middle))});
      low = high = middle;
    }
  }
  for (std::size_t i = 0; i < far.size(); ++i) {
    f.error[i] = up(f.error[i] + far[i]);
  }
  return f;
}

bool is_grid_function(const GridFunction& f, std::size_t phases, std::size_t states) {
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  const auto is_end = [&](const Table& end) {
    return end.size() == phases && std::all_of(end.begin(), end.end(), [&](const std::vector<double>& row) {
             return row.size() == states &&
                    std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
           });
  };
  return f.error.size() == states && std::all_of(f.error.begin(), f.error.end(), is_size) &&
         is_end(f.values[0]) && is_end(f.values[1]);
}

}  // namespace veritrack::checker

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
  GridSizes sizes{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  const std::size_t phases = f.values.size();
  for (std::size_t g = 0; g < phases; ++g) {
    const std::vector<double>& here = f.values[g];
    const std::vector<double>& next = f.values[(g + 1) % phases];
    const std::vector<double>& last = f.values[(g + phases - 1) % phases];
    for (std::size_t i = 0; i < n; ++i) {
      const double scale = std::abs(here[i]) + std::abs(next[i]) + std::abs(last[i]);
      const double error = upward_product(0x1p-48, scale);  // of three roundings
      sizes.value[i] = std::max(sizes.value[i], std::abs(here[i]));
      sizes.first_difference[i] =
          std::max(sizes.first_difference[i], up(std::abs(next[i] - here[i]) + error));
      sizes.second_difference[i] = std::max(sizes.second_difference[i],
                                            up(std::abs((next[i] - here[i]) - (here[i] - last[i])) + error));
    }
  }
  return sizes;
}

WideRow value_at(const GridFunction& f, const GridSizes& sizes, double place) {
  const std::size_t phases = f.values.size();
  WideRow result(f.error.size());
  if (phases == 0) {
    return result;
  }
  const double cell = std::floor(place);
  const double share = place - cell;
  const std::size_t g = grid_cell(cell, phases);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double here = f.values[g][i];
    const double next = f.values[(g + 1) % phases][i];
    result[i].middle = here + share * (next - here);
    result[i].radius = up(upward_product(2.0 * kPlaceError, sizes.first_difference[i]) +
                          upward_product(0x1p-48, std::abs(here) + std::abs(next)));
  }
  return result;
}

bool is_grid_function(const GridFunction& f, std::size_t phases, std::size_t states) {
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  return f.values.size() == phases && f.error.size() == states &&
         std::all_of(f.error.begin(), f.error.end(), is_size) &&
         std::all_of(f.values.begin(), f.values.end(), [&](const std::vector<double>& row) {
           return row.size() == states &&
                  std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
         });
}

}  // namespace veritrack::checker

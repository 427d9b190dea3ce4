// The number of filters of a KKL observer, from a design to a template argument.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace veritrack::kkl_observer {

/// function(std::integral_constant<int, filters>{}). Throws std::invalid_argument unless there are four to
/// eight, as a design has.
template <typename Function>
decltype(auto) with_number_of_filters(std::size_t filters, Function&& function) {
  switch (filters) {
    case 4:
      return std::forward<Function>(function)(std::integral_constant<int, 4>{});
    case 5:
      return std::forward<Function>(function)(std::integral_constant<int, 5>{});
    case 6:
      return std::forward<Function>(function)(std::integral_constant<int, 6>{});
    case 7:
      return std::forward<Function>(function)(std::integral_constant<int, 7>{});
    case 8:
      return std::forward<Function>(function)(std::integral_constant<int, 8>{});
    default:
      throw std::invalid_argument("a KKL observer needs four to eight filters");
  }
}

}  // namespace veritrack::kkl_observer

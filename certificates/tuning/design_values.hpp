// q1, q2, r and epsilon of an extended Kalman filter, as decimals that can stand in a design file.
#pragma once

#include <string>
#include <tuple>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

struct DesignValues {
  std::string q1;       ///< signal units squared
  std::string q2;       ///< (rad/sample)^2
  std::string r;        ///< signal units squared
  std::string epsilon;  ///< no unit

  [[nodiscard]] bool operator==(const DesignValues& other) const { return tied() == other.tied(); }
  [[nodiscard]] bool operator<(const DesignValues& other) const { return tied() < other.tied(); }

 private:
  [[nodiscard]] std::tuple<const std::string&, const std::string&, const std::string&, const std::string&>
  tied() const {
    return {q1, q2, r, epsilon};
  }
};

/// A decimal as if it stood in a design file, without a position there.
[[nodiscard]] Number number_of(const std::string& decimal);

/// A double as if its exact decimal stood there.
[[nodiscard]] Number number_of(double value);

}  // namespace veritrack::certificates

// The keys of a design file for the tracker "quadrature-ekf".
#include <array>

#include "certificates/design/key_readers.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/set_keys.hpp"

namespace veritrack::certificates {

namespace {

using namespace keys;  // NOLINT(google-build-using-namespace): this file is made of them

bool between_zero_and_one(const Interval& x) {
  return positive(x) && rigor::certainly_less(x, Interval(1.0));
}

using Ekf = QuadratureDesignTable;
constexpr std::array kQuadratureEkfKeys{
    Key<Ekf>{"q1", kNotNegative, real<&Ekf::q1, not_negative>, kRequired, kNoContract},
    Key<Ekf>{"q2", kPositive, real<&Ekf::q2, positive>, kRequired, kNoContract},
    Key<Ekf>{"r", kPositive, real<&Ekf::r, positive>, kRequired, kNoContract},
    Key<Ekf>{"epsilon", kAtLeastZeroBelowOne, real<&Ekf::epsilon, at_least_zero_below_one>, kRequired,
             kNoContract},
};

using Theorem = Theorem29Parameters;
constexpr std::array kTheorem29Keys{
    Key<Theorem>{"R_x", kPositive, real<&Theorem::state_bound, positive>, defaults_to("7"), kNoContract},
    Key<Theorem>{"sigma", kPositive, real<&Theorem::sigma, positive>, defaults_to("1e-3"), kNoContract},
    Key<Theorem>{"gamma_fraction", "a number above 0 and below 1",
                 real<&Theorem::gamma_fraction, between_zero_and_one>, defaults_to("0.5"), kNoContract},
    Key<Theorem>{"c1", kNotNegative, real<&Theorem::c1, not_negative>, defaults_to("3"), kNoContract},
    Key<Theorem>{"c2", kNotNegative, real<&Theorem::c2, not_negative>, defaults_to("3"), kNoContract},
};

std::vector<BoundTable> bind_tables(std::any& tables) {
  auto& target = std::any_cast<QuadratureEkfTables&>(tables);
  return {bound_table("design", kQuadratureEkfKeys, target.design),
          bound_table("assume", assume_keys(), target.assume),
          bound_table("require", require_keys(), target.require),
          bound_table("simulate", simulate_keys(), target.simulate),
          bound_table("theorem_2_9", kTheorem29Keys, target.theorem_2_9)};
}

std::optional<TableObjection> objection(const std::any& tables) {
  const auto& read = std::any_cast<const QuadratureEkfTables&>(tables);
  const std::optional<TableObjection> found = objection_to(read.require);
  return found ? found : objection_to(read.assume, read.require);
}

}  // namespace

const DesignFormat& quadrature_format() {
  static const DesignFormat format{"quadrature-ekf", [] { return std::any(QuadratureEkfTables{}); },
                                   bind_tables, objection};
  return format;
}

}  // namespace veritrack::certificates

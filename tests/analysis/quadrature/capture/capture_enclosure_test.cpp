#include "analysis/quadrature/capture/capture_enclosure.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using quadrature::StateMatrix;
using quadrature::StateVector;
using quadrature::Zonotope;

/// The largest direction' x over the zonotope.
double support(const Zonotope& zonotope, const StateVector& direction) {
  return (zonotope.generators().transpose() * direction).cwiseAbs().sum();
}

StateVector random_vector(test::Random& random) {
  StateVector x;
  for (double& entry : x) {
    entry = random.uniform(-1.0, 1.0);
  }
  return x;
}

TEST_CASE("images of members stay members, in every direction, over many steps and reductions") {
  test::Random random(51);
  for (int n = 0; n < static_cast<int>(test::effort(20)); ++n) {
    Zonotope zonotope;
    std::vector<StateVector> members(30, StateVector::Zero());
    for (int step = 0; step < 30; ++step) {
      // x+ = A x + b with A in an interval matrix and |b| within a box, both as extreme as they can be.
      rigor::Matrix<9> middle;
      rigor::Matrix<9> deviation;
      StateVector box;
      for (int i = 0; i < 9; ++i) {
        box[i] = std::exp(random.uniform(-12.0, 0.0));
        for (int j = 0; j < 9; ++j) {
          middle(i, j) = random.uniform(-0.6, 0.6);
          deviation(i, j) = random.uniform(0.0, 0.05);
        }
      }
      StateMatrix matrix;
      rigor::IntervalMatrix<9, 3> inputs;
      const rigor::Vector<3> radii(random.uniform(), random.uniform(), 0.0);
      {
        const rigor::UpwardRounding upward;
        for (rigor::Interval& entry : inputs.reshaped()) {
          entry = rigor::Interval(random.uniform(-1.0, 1.0)) + rigor::symmetric(0.05 * random.uniform());
        }
        for (int i = 0; i < 9; ++i) {
          for (int j = 0; j < 9; ++j) {
            matrix(i, j) = rigor::Interval(middle(i, j)) + rigor::symmetric(deviation(i, j));
          }
        }
        zonotope.transform(matrix);
        zonotope.add_box(box);
        zonotope.add_image(inputs, radii);
      }
      for (StateVector& x : members) {
        rigor::Matrix<9> a = middle;
        StateVector b = box;
        for (int i = 0; i < 9; ++i) {
          b[i] *= random.below(2) == 0 ? -1.0 : 1.0;
          for (int j = 0; j < 9; ++j) {
            a(i, j) += deviation(i, j) * (random.below(2) == 0 ? -1.0 : 1.0);
          }
        }
        x = a * x + b;
        const double push_1 = radii[0] * (random.below(2) == 0 ? -1.0 : 1.0);
        const double push_2 = radii[1] * random.uniform(-1.0, 1.0);
        for (int i = 0; i < 9; ++i) {
          x[i] += (random.below(2) == 0 ? inputs(i, 0).lower() : inputs(i, 0).upper()) * push_1;
          x[i] += (random.below(2) == 0 ? inputs(i, 1).lower() : inputs(i, 1).upper()) * push_2;
        }
      }
      CHECK(zonotope.generators().cols() <= Zonotope::kMostGenerators);
      const StateVector extent = zonotope.radii();
      for (const StateVector& x : members) {
        CHECK((x.cwiseAbs().array() <= extent.array() * (1.0 + 1e-12)).all());
        const StateVector direction = random_vector(random);
        CHECK(std::fabs(direction.dot(x)) <= support(zonotope, direction) * (1.0 + 1e-12));
      }
    }
  }
}

TEST_CASE("a rotation does not grow the set") {
  const rigor::UpwardRounding upward;
  Zonotope zonotope;
  StateVector box = StateVector::Constant(1.0);
  zonotope.add_box(box);
  rigor::Matrix<9> turn = rigor::Matrix<9>::Identity();
  turn.topLeftCorner<2, 2>() << 0.6, -0.8, 0.8, 0.6;
  for (int step = 0; step < 100; ++step) {
    zonotope.transform(rigor::to_interval(turn));
  }
  // A box around each turned box would have grown by 1.4^100.
  CHECK(zonotope.radii()[0] < 1.5);
  CHECK(zonotope.radii()[8] < 1.0 + 1e-9);
}

TEST_CASE("what is unknown shows in the radii, for good") {
  const rigor::UpwardRounding upward;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Zonotope zonotope;
    StateVector box = StateVector::Constant(0.1);
    box[4] = bad;
    zonotope.add_box(box);
    for (int step = 0; step < 40; ++step) {
      CHECK_FALSE(zonotope.radii().allFinite());
      zonotope.transform(rigor::to_interval(rigor::Matrix<9>::Identity()));
      zonotope.add_box(StateVector::Constant(0.1));
    }
  }
  Zonotope zonotope;
  zonotope.add_box(StateVector::Constant(0.1));
  StateMatrix matrix = rigor::to_interval(rigor::Matrix<9>::Identity());
  matrix(3, 5) = rigor::Interval::empty();
  zonotope.transform(matrix);
  CHECK_FALSE(zonotope.radii().allFinite());
}

}  // namespace

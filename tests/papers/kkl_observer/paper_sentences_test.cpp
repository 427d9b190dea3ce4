#include "papers/kkl_observer/paper_sentences.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

#include "trackers/kkl_observer/kkl_observer.hpp"

using namespace veritrack;
using rigor::Verdict;

TEST_CASE("beside the certificates' claims the paper's steps stand, and section V to a factor of two") {
  std::set<std::string> found;
  for (const theorems::Statement& statement : kkl_observer::paper_sentences()) {
    CAPTURE(statement.id);
    CAPTURE(statement.witness);
    CHECK_FALSE(statement.witness.empty());
    CHECK(found.insert(statement.id).second);
    CHECK(statement.verdict == (statement.id == "kkl-paper/scaling" ? Verdict::refuted : Verdict::proved));
  }
  CHECK(found.size() == 9);
}

TEST_CASE("the observer itself errs by what is said of section V") {
  const trackers::KklObserverDesign<double, 4> design{Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), 0.0};
  const double interval = 2e-3;
  trackers::KklObserver<double, 4> observer(design, interval);
  double largest = 0.0;
  const auto signal = [&](int k) {
    return 2.0 * std::sin(3.0 * interval * k) + 0.2 * std::sin(10.0 * interval * k);
  };
  for (int k = 0; k < 20000; ++k) {
    observer.step_interpolated(signal(k), signal(k + 1));
    if (k > 12000) {
      largest = std::fmax(largest, std::fabs(observer.estimate().frequency - 3.0) / 3.0);
    }
  }
  CHECK(largest == doctest::Approx(0.1264).epsilon(0.01));
}

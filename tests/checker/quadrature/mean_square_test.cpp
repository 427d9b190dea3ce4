#include "checker/quadrature/mean_square.hpp"

#include <doctest/doctest.h>

#include "checker/quadrature/lock_inequality.hpp"
#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;
using lock_test::Matrix;
using lock_test::Textbook;
using lock_test::Vector;

namespace {

/// For the written set without a walk, from the program's search, with more than it needs.
LockMeanSquare form_of_written_set() {
  return {{Ball(2.996), Ball(4.297), Ball(-4.909), Ball(10.315)},
          Ball(0.879),
          Ball(1.234e-6),
          Ball(48.0),
          Ball(0x1.8p-9)};
}

LockSet still_set() {
  LockSet set = lock_test::WrittenSet().set();
  set.walk = zero;
  return set;
}

std::string text_of_form(const std::string& bound, const std::string& rate) {
  return R"({"metric": [["0x1.8p+1", "0x0p+0", "0x0p+0"], ["0x0p+0", "0x1.13p+2", "-0x1.3ap+2"],)"
         R"( ["0x0p+0", "0x0p+0", "0x1.4ap+3"]], "weight": "0x1.cp-1", "share": "0x1.4p-20", "rate": ")" +
         rate + R"(", "bound": ")" + bound + "\"}";
}

/// In cells around random points; with a leak at random frequencies.
void check_in_proved_cells(const Textbook& book, const LockMeanSquare& form, test::Random& random) {
  const LockSet& set = book.set;
  const Vector offset(form.offset[0].near(), form.offset[1].near(), form.offset[2].near());
  Matrix r = Matrix::Zero();
  r << form.metric.amplitude.near(), 0.0, 0.0, 0.0, form.metric.phase.near(), form.metric.coupling.near(),
      0.0, 0.0, form.metric.frequency.near();
  const LockInequality inequality(book.design.filter(), set, left_of_mean_square(set, form));
  int proved = 0;
  double closest = -1e9;
  const auto count = test::effort(60);
  for (std::int64_t k = 0; k < count; ++k) {
    const std::array<double, 4> middle = lock_test::somewhere(set, random);
    LockCell cell{middle, middle};
    for (double& end : cell.high) {
      end += 0.08;
    }
    if (!inequality.look(cell).proved) {
      continue;
    }
    ++proved;
    for (int l = 0; l < 20; ++l) {
      std::array<double, 4> x{};
      for (std::size_t i = 0; i < 4; ++i) {
        x[i] = random.uniform(cell.low[i], cell.high[i]);
      }
      const Vector e = book.metric().inverse() * Vector(x[0], x[1], x[2]);
      const double frequency = random.uniform(set.lowest_frequency.near(), set.highest_frequency.near());
      const Textbook::Step after = book.step(e, book.covariance_of_level(x[3], random), frequency);
      const double deviation = set.deviation.near();
      const double next = book.level_of(after.covariance);
      const double g = form.weight.near();
      const double w =
          std::exp(0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) + 0.5 * set.weight.near() * x[3] * x[3]);
      const double nu = e[2] + set.bias[2].near();
      const double excess = (r * (after.mean - offset)).squaredNorm() +
                            deviation * deviation * (r * after.gain).squaredNorm() + g * next * next -
                            (r * (e - offset)).squaredNorm() - g * x[3] * x[3] -
                            form.share.near() * ((1.0 - set.decay.near()) * w - set.drift.near()) -
                            form.rate.near() * (form.bound.near() - nu * nu);
      CHECK(excess <= 0.0);
      closest = std::max(closest, excess / (form.rate.near() * form.bound.near()));
    }
  }
  MESSAGE(proved << " of " << count << " cells proved, closest " << closest);
  CHECK(4 * proved > count);
}

}  // namespace

TEST_CASE("where a cell is proved, the textbook filter's next error keeps the inequality") {
  test::Random random(5420);
  check_in_proved_cells({{}, still_set()}, form_of_written_set(), random);
  LockMeanSquare form = form_of_written_set();
  form.offset = {Ball(-0.001), Ball(-0.01), Ball(0.01)};
  form.bound = Ball(0x1.8p-7);
  check_in_proved_cells({lock_test::leaking_variances(), lock_test::leaking_set()}, form, random);
}

TEST_CASE("a function is read and proved, or there is an objection") {
  const LockSet set = still_set();
  Design design;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  const auto objections_to = [&](const std::string& text) {
    Objections objections;
    std::int64_t cells = 0;
    check_lock_mean_square(read_json(text), design, set, cells, objections);
    return objections;
  };
  CHECK(objections_to(text_of_form("0x1.8p-9", "0x1.8p+5")).empty());
  // Too small a bound; a rate beyond the square of the metric's entry; no bound at all.
  CHECK(objections_to(text_of_form("0x1p-14", "0x1.8p+5")).size() == 1);
  CHECK(objections_to(text_of_form("0x1.8p-9", "0x1.bp+6")).size() == 1);
  CHECK(objections_to(text_of_form("0x0p+0", "0x1.8p+5")).size() == 1);
  CHECK(objections_to(text_of_form("-0x1.8p-9", "0x1.8p+5")).size() == 1);
  CHECK(objections_to(text_of_form("0x1.8p-9", "0x0p+0")).size() == 1);
  std::string other = text_of_form("0x1.8p-9", "0x1.8p+5");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = other;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK(objections_to(with("\"share\": \"0x1.4p-20\"", "\"share\": \"-0x1.4p-20\"")).size() == 1);
  CHECK(objections_to(with("\"weight\": \"0x1.cp-1\"", "\"weight\": \"0x0p+0\"")).size() == 1);
  CHECK(objections_to(with("[[\"0x1.8p+1\", \"0x0p+0\"", "[[\"0x1.8p+1\", \"0x1p-9\"")).size() == 1);
  CHECK(objections_to(with("[[\"0x1.8p+1\"", "[[\"-0x1.8p+1\"")).size() == 1);
}

TEST_CASE("the root mean square is by the formula, and the start is forgotten") {
  const LockSet set = still_set();
  const LockMeanSquare form = form_of_written_set();
  const auto rms = [&](double level, double samples) {
    return root_mean_square(set, form, Ball(level), Ball(samples)).near();
  };
  const double w = std::exp(3.0) + set.drift.near() / (1.0 - set.decay.near());
  const double before =
      form.share.near() * w +
      2.0 * (relative_norm_squared(form, set).near() + form.weight.near() / set.weight.near()) * std::log(w);
  CHECK(rms(3.0, 100.0) ==
        doctest::Approx(std::sqrt(form.bound.near() + before / (form.rate.near() * 100.0))));
  CHECK(rms(3.0, 1e15) == doctest::Approx(std::sqrt(form.bound.near())));
  CHECK(rms(4.0, 100.0) > rms(3.0, 100.0));
  // An offset adds its length to that of the start, and is forgotten as well.
  LockMeanSquare moved = form;
  moved.offset = {zero, Ball(0.02), Ball(0.03)};
  const double length =
      std::sqrt(2.0 * relative_norm_squared(form, set).near() * std::log(w)) + offset_length(moved).near();
  const double more =
      form.share.near() * w + length * length + 2.0 * form.weight.near() / set.weight.near() * std::log(w);
  CHECK(root_mean_square(set, moved, Ball(3.0), Ball(100.0)).near() ==
        doctest::Approx(std::sqrt(form.bound.near() + more / (form.rate.near() * 100.0))));
  CHECK(root_mean_square(set, moved, Ball(3.0), Ball(1e15)).near() ==
        doctest::Approx(std::sqrt(form.bound.near())));
}

TEST_CASE("with a leak a function has an offset, of three numbers") {
  const LockSet set = lock_test::leaking_set();
  Design design;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  design.epsilon = Ball(lock_test::kLeak);
  const auto refused = [&](const std::string& offset) {
    std::string text = text_of_form("0x1p-14", "0x1.8p+5");
    text.insert(text.size() - 1, offset);
    Objections objections;
    std::int64_t cells = 0;
    check_lock_mean_square(read_json(text), design, set, cells, objections);
    return objections.empty() ? std::string() : objections.front();
  };
  // The bound is too small; without an offset that is not looked at.
  const std::string small = "the mean square is not proved to be bounded";
  CHECK(refused(R"(, "offset": ["0x0p+0", "0x1p-9", "0x1p-8"])") == small);
  CHECK(refused("").find("offset") != std::string::npos);
  CHECK(refused(R"(, "offset": ["0x0p+0", "0x1p-9"])").find("offset") != std::string::npos);
}

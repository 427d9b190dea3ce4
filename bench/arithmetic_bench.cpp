// One operation at a time: Interval against plain double, against MPFI at 53 bits, and against Boost.Interval
// as people use it (default policies, which change the rounding mode in each operation). The column `time` is
// that of 32768 independent operations on operands of mixed signs; `each` is the time of one.
#include <benchmark/benchmark.h>
#include <mpfi.h>

#include <boost/numeric/interval.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"
#include "tests/support/random.hpp"

namespace {

using veritrack::rigor::Interval;
using BoostDefault = boost::numeric::interval<double>;

// Enough operands that the branch predictor cannot learn the signs.
constexpr std::size_t kOperands = std::size_t{1} << 15;
constexpr double kRelativeRadius = 0x1p-30;

/// An interval of MPFI with the precision of double.
class Mpfi {
 public:
  Mpfi() { mpfi_init2(value_, 53); }
  Mpfi(double lower, double upper) : Mpfi() { mpfi_interv_d(value_, lower, upper); }
  Mpfi(const Mpfi& other) : Mpfi() { mpfi_set(value_, other.value_); }
  Mpfi& operator=(const Mpfi&) = delete;
  ~Mpfi() { mpfi_clear(value_); }
  mpfi_ptr get() { return value_; }
  [[nodiscard]] mpfi_srcptr get() const { return value_; }

 private:
  mpfi_t value_{};
};

// ---- operands and results of each type

template <typename Number>
Number make(double lower, double upper);
template <>
double make(double lower, double) {
  return lower;
}
template <>
Interval make(double lower, double upper) {
  return Interval::from_bounds(lower, upper);
}
template <>
BoostDefault make(double lower, double upper) {
  return {lower, upper};
}
template <>
Mpfi make(double lower, double upper) {
  return {lower, upper};
}

/// Narrow intervals in (-4, 4), away from zero so that they can divide.
template <typename Number>
std::vector<Number> make_operands(std::uint64_t stream) {
  veritrack::test::Random random(stream);
  std::vector<Number> operands;
  operands.reserve(kOperands);
  for (std::size_t i = 0; i < kOperands; ++i) {
    const double magnitude = random.uniform(0.25, 4.0);
    const double middle = random.below(2) == 0 ? magnitude : -magnitude;
    operands.push_back(
        make<Number>(middle - kRelativeRadius * magnitude, middle + kRelativeRadius * magnitude));
  }
  return operands;
}

// ---- operations

struct Add {
  template <typename Number>
  Number operator()(const Number& a, const Number& b) const {
    return a + b;
  }
  void operator()(Mpfi& result, const Mpfi& a, const Mpfi& b) const {
    mpfi_add(result.get(), a.get(), b.get());
  }
};
struct Multiply {
  template <typename Number>
  Number operator()(const Number& a, const Number& b) const {
    return a * b;
  }
  void operator()(Mpfi& result, const Mpfi& a, const Mpfi& b) const {
    mpfi_mul(result.get(), a.get(), b.get());
  }
};
struct Divide {
  template <typename Number>
  Number operator()(const Number& a, const Number& b) const {
    return a / b;
  }
  void operator()(Mpfi& result, const Mpfi& a, const Mpfi& b) const {
    mpfi_div(result.get(), a.get(), b.get());
  }
};

void report_each(benchmark::State& state) {
  state.counters["each"] = benchmark::Counter(static_cast<double>(state.iterations()) * kOperands,
                                              benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <typename Number, typename Operation>
void run_binary(benchmark::State& state) {
  const Operation operation;
  const std::vector<Number> a = make_operands<Number>(1);
  const std::vector<Number> b = make_operands<Number>(2);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kOperands; ++i) {
      if constexpr (std::is_same_v<Number, Mpfi>) {
        static Mpfi result;
        operation(result, a[i], b[i]);
      } else {
        benchmark::DoNotOptimize(operation(a[i], b[i]));
      }
    }
  }
  report_each(state);
}

/// Interval computes with the mode set once around the whole loop.
template <typename Number, typename Operation>
void binary(benchmark::State& state) {
  if constexpr (std::is_same_v<Number, Interval>) {
    const veritrack::rigor::UpwardRounding mode;
    run_binary<Number, Operation>(state);
  } else {
    run_binary<Number, Operation>(state);
  }
}

BENCHMARK(binary<double, Add>);
BENCHMARK(binary<Interval, Add>);
BENCHMARK(binary<BoostDefault, Add>);
BENCHMARK(binary<Mpfi, Add>);
BENCHMARK(binary<double, Multiply>);
BENCHMARK(binary<Interval, Multiply>);
BENCHMARK(binary<BoostDefault, Multiply>);
BENCHMARK(binary<Mpfi, Multiply>);
BENCHMARK(binary<double, Divide>);
BENCHMARK(binary<Interval, Divide>);
BENCHMARK(binary<BoostDefault, Divide>);
BENCHMARK(binary<Mpfi, Divide>);

// ---- sin and cos together; Boost's default policies have neither

void sin_cos_of_double(benchmark::State& state) {
  const std::vector<double> x = make_operands<double>(3);
  for (auto _ : state) {
    for (const double angle : x) {
      benchmark::DoNotOptimize(std::sin(angle));
      benchmark::DoNotOptimize(std::cos(angle));
    }
  }
  report_each(state);
}
BENCHMARK(sin_cos_of_double);

void sin_cos_of_intervals(benchmark::State& state, const std::vector<Interval>& x) {
  for (auto _ : state) {
    for (const Interval& angle : x) {
      benchmark::DoNotOptimize(sin_cos(angle));
    }
  }
  report_each(state);
}

void sin_cos_of_point(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding mode;
  std::vector<Interval> x = make_operands<Interval>(3);
  for (Interval& angle : x) {
    angle = Interval(angle.lower());
  }
  sin_cos_of_intervals(state, x);
}
BENCHMARK(sin_cos_of_point);

void sin_cos_of_narrow_interval(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding mode;
  sin_cos_of_intervals(state, make_operands<Interval>(3));
}
BENCHMARK(sin_cos_of_narrow_interval);

void sin_cos_of_wide_interval(benchmark::State& state) {
  const veritrack::rigor::UpwardRounding mode;
  std::vector<Interval> x = make_operands<Interval>(3);
  for (Interval& angle : x) {
    angle += Interval::from_bounds(-0.25, 0.25);
  }
  sin_cos_of_intervals(state, x);
}
BENCHMARK(sin_cos_of_wide_interval);

void sin_cos_of_mpfi(benchmark::State& state) {
  const std::vector<Mpfi> x = make_operands<Mpfi>(3);
  Mpfi sine;
  Mpfi cosine;
  for (auto _ : state) {
    for (const Mpfi& angle : x) {
      mpfi_sin(sine.get(), angle.get());
      mpfi_cos(cosine.get(), angle.get());
    }
  }
  report_each(state);
}
BENCHMARK(sin_cos_of_mpfi);

}  // namespace

BENCHMARK_MAIN();

#include "analysis/quadrature/leak/steady_contraction.hpp"

#include <doctest/doctest.h>

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

constexpr std::int64_t kMostCells = 600;

/// A tracker without bias and with such a gain, r = 1, whose covariance moves little. The set reaches to
/// amplitude errors of `amplitude` and predicted phase errors of `chi` (rad) at level 1.
SteadySettings settings_of(double gain, double amplitude, double chi, double epsilon = 0.01) {
  // The filtered variance that the gain belongs to, and the process noise that keeps it.
  const double q1 = gain / (1.0 - gain) - gain;
  const double p33 = 1e-6;
  const double q2 = p33 * (1.0 - (1.0 - epsilon) * (1.0 - epsilon));
  const Interval none(0.0);
  const Interval one(1.0);
  const Interval little(1e-4);
  const Interval less(1e-7);
  // c = psi + m reaches to chi where both reach to chi / sqrt(2).
  const Interval share = sqrt(Interval(2.0));
  SteadySettings settings;
  SteadySetting<Interval>& s = settings.over_cell;
  s.design = {Interval(q1), Interval(q2), one, Interval(epsilon)};
  s.steady = {one, none, none, {Interval(gain), none, none, Interval(gain), none, Interval(p33)}};
  s.metric = {one / Interval(amplitude), none, none, share / Interval(chi), none, share / Interval(chi)};
  s.band = {{little, none, none, little, none, less}, {little, none, none, little, none, less}};
  s.directions = directions_of(s.metric);
  fill_turns(s);
  settings.secants = convert<SteadySecant>(s);
  fill_turns(settings.secants);
  settings.frequencies = none;
  return settings;
}

/// Does a step from level 1 lead to so high a level that only the meaning of the step is in question?
bool leads_anywhere(const SteadySettings& settings, double noise = 0.0, double motion = 0.0) {
  constexpr double kAnywhere = 1e9;
  SteadyDivision division;
  return prove_contraction(settings, 1.0, kAnywhere, {Interval(noise), Interval(motion), Interval(0.0)},
                           kMostCells, division)
      .proved;
}

TEST_CASE("a swing beyond a quarter turn is not proved, though the step is smooth there") {
  const rigor::UpwardRounding upward;
  CHECK(leads_anywhere(settings_of(0.9, 0.05, 1.2)));
  CHECK_FALSE(leads_anywhere(settings_of(0.9, 0.05, 1.6)));
  CHECK_FALSE(leads_anywhere(settings_of(0.9, 0.05, 2.5)));
}

TEST_CASE("noise that may carry the estimate through zero is not proved, nor much more noise") {
  const rigor::UpwardRounding upward;
  const SteadySettings settings = settings_of(0.5, 0.05, 0.3);
  CHECK(leads_anywhere(settings, 0.1));
  CHECK_FALSE(leads_anywhere(settings, 3.0));
  CHECK_FALSE(leads_anywhere(settings, 1e3));
}

TEST_CASE("a steady state that moves farther than the next level leads nowhere") {
  const rigor::UpwardRounding upward;
  const SteadySettings settings = settings_of(0.5, 0.05, 0.3);
  CHECK(leads_anywhere(settings, 0.0, 1e3));
  CHECK_FALSE(leads_anywhere(settings, 0.0, 1e10));
}

TEST_CASE("errors must shrink by themselves, however fast the covariance does") {
  const rigor::UpwardRounding upward;
  // Amplitude and phase errors are halved in a step, their covariances quartered, and what belongs to the
  // frequency is nearly forgotten.
  const SteadySettings settings = settings_of(0.5, 0.05, 0.05, 0.9);
  const auto proves = [&](double rate) {
    constexpr double kLevel = 1e-3;
    SteadyDivision division;
    return prove_contraction(settings, kLevel, rate * kLevel, {Interval(0.0), Interval(0.0), Interval(0.0)},
                             kMostCells, division)
        .proved;
  };
  CHECK(proves(0.9));
  CHECK_FALSE(proves(0.45));
}

TEST_CASE("a cell is cut again without a look where it failed a little higher, or its parts were cut") {
  SteadyDivision division;
  CHECK_FALSE(division.skips(SteadyDivision::kWhole, 1.0));
  division.open(SteadyDivision::kWhole, 1.0, kY);
  CHECK(division.side(SteadyDivision::kWhole) == kY);
  CHECK(division.skips(SteadyDivision::kWhole, 0.95));
  CHECK_FALSE(division.skips(SteadyDivision::kWhole, 0.5));
  const std::size_t part = division.first_part(SteadyDivision::kWhole);
  division.open(part + 1, 0.5, kX);
  CHECK(division.skips(SteadyDivision::kWhole, 0.1));
  division.close(part + 1);
  CHECK_FALSE(division.skips(SteadyDivision::kWhole, 0.1));
  division.close(SteadyDivision::kWhole);
  CHECK_FALSE(division.skips(SteadyDivision::kWhole, 0.95));
}

TEST_CASE("the cells of the level above save work, and prove nothing by themselves") {
  const rigor::UpwardRounding upward;
  const SteadySettings settings = settings_of(0.5, 0.3, 0.6, 0.9);
  const auto prove = [&](double level, double rate, SteadyDivision& division) {
    return prove_contraction(settings, level, rate * level, {Interval(0.0), Interval(0.0), Interval(0.0)},
                             kMostCells, division);
  };
  SteadyDivision division;
  const SteadyContraction first = prove(1.0, 0.95, division);
  REQUIRE(first.proved);
  REQUIRE(first.cells > 1);
  SteadyDivision none;
  const SteadyContraction anew = prove(0.95, 0.95, none);
  SteadyDivision known = division;
  const SteadyContraction again = prove(0.95, 0.95, known);
  CHECK(anew.proved);
  CHECK(again.proved);
  CHECK(again.cells < anew.cells);
  CHECK_FALSE(prove(0.95, 0.3, division).proved);
}

}  // namespace
}  // namespace veritrack::quadrature

// Borders between the cells of a frequency that moves.
#include "checker/model/tube_borders.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "checker/model/tube_check.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

/// A tracker of one state, on whose curve the state is the frequency; |xi| is in units of `size`.
PhaseTube follows(double frequency, double half_width, double radius, double size = 1.0) {
  PhaseTube tube;
  tube.frequency = frequency;
  tube.half_width = half_width;
  tube.levels = {radius, radius / 2.0};
  tube.shrinking = {0.9};
  tube.turns = {0};
  tube.curve = {{{frequency, half_width}}};
  tube.shape = {{{size}}};
  return tube;
}

/// Three cells side by side.
TubeSet three_cells() {
  TubeSet set;
  set.slew = 0.001;
  set.crossing = {0.91};
  set.tubes = {follows(0.25, 0.125, 0.5), follows(0.5, 0.125, 0.5), follows(0.75, 0.125, 0.5)};
  return set;
}

bool crosses(const TubeSet& set) {
  std::int64_t cells = 0;
  return crosses_borders(set, 1, cells);
}

bool has_common_levels(const TubeSet& set) {
  Objections objections;
  check_common_levels(set, objections);
  return objections.empty();
}

TEST_CASE("cells that fit together are crossed") {
  CHECK(crosses(three_cells()));
  CHECK(has_common_levels(three_cells()));
  // Other units in one of them: the same states at half the levels.
  TubeSet set = three_cells();
  set.tubes[1] = follows(0.5, 0.125, 0.25, 2.0);
  CHECK(crosses(set));
  CHECK(has_common_levels(set));
  // One cell has no borders.
  set.tubes.resize(1);
  CHECK(crosses(set));
}

TEST_CASE("cells that do not fit together are refused") {
  // A smaller tube: it is entered at too high a level.
  TubeSet set = three_cells();
  set.tubes[1] = follows(0.5, 0.125, 0.45);
  CHECK_FALSE(crosses(set));
  set = three_cells();
  set.tubes[1].levels = {0.55, 0.275};
  CHECK_FALSE(crosses(set));
  // As good as the tubes are.
  set = three_cells();
  set.crossing = {0.89};
  CHECK_FALSE(crosses(set));
  set.crossing = {0.901};
  CHECK(crosses(set));
  // Another curve, of which the lower end of a level decides: 0.9 R/2 + d <= 0.91 R/2.
  set = three_cells();
  set.tubes[1].curve[0][0][0] += 0.0024;
  CHECK(crosses(set));
  set.tubes[1].curve[0][0][0] += 0.0002;
  CHECK_FALSE(crosses(set));
  // A curve that depends on the phase.
  set = three_cells();
  set.tubes[2].curve[0].push_back({0.01});
  CHECK_FALSE(crosses(set));
  // A shape that is none there.
  set = three_cells();
  set.tubes[2].shape[0][0] = {0.0, 1.0};
  CHECK_FALSE(crosses(set));
}

TEST_CASE("bounds of a covariance leave a margin between 0 and 1 at a border") {
  // Two cells that overlap, and bounds that cross in the middle: each is entered where its own are wider.
  TubeSet set;
  set.slew = 0.001;
  set.crossing = {0.91};
  set.tubes = {follows(0.25, 0.14, 0.5), follows(0.5, 0.14, 0.5)};
  for (PhaseTube& tube : set.tubes) {
    // 1 and 1/2, plus and minus the distance from 0.375.
    const double outward = tube.frequency < 0.375 ? -1.0 : 1.0;
    const double distance = tube.frequency - 0.375;
    tube.covariance_high = {{{1.0 + outward * distance, outward * tube.half_width}}};
    tube.covariance_low = {{{0.5 - outward * distance, -outward * tube.half_width}}};
  }
  for (const double margin : {0.01, 0.5}) {
    set.margin = margin;
    CHECK(crosses(set));
  }
  for (const double margin : {0.0, -0.01, 1.0, 1.5, std::nan("")}) {
    CAPTURE(margin);
    set.margin = margin;
    CHECK_FALSE(crosses(set));
  }
  // The bounds of one cell everywhere outside of those of the other.
  set.margin = 0.01;
  set.tubes[0].covariance_high = {{{1.5}}};
  CHECK_FALSE(crosses(set));
}

TEST_CASE("beyond the neighbour") {
  TubeSet set = three_cells();
  set.slew = 0.25;
  CHECK(crosses(set));
  set.slew = 0.2501;
  CHECK_FALSE(crosses(set));
  // The cell above begins sooner, so that from it the one below the neighbour is in reach sooner.
  set = three_cells();
  set.tubes[2] = follows(0.6875, 0.1875, 0.5);
  set.slew = 0.125;
  CHECK(crosses(set));
  set.slew = 0.1251;
  CHECK_FALSE(crosses(set));
  // With two cells, the frequency stays in the band.
  set.tubes.resize(2);
  CHECK(crosses(set));
}

TEST_CASE("levels are common up to a little") {
  TubeSet set = three_cells();
  set.tubes[2].levels[1] *= 1.0 + 0x1p-45;
  CHECK(has_common_levels(set));
  set.tubes[2].levels[1] *= 1.0 + 0x1p-30;
  CHECK_FALSE(has_common_levels(set));
  set = three_cells();
  set.tubes[1].levels.pop_back();
  CHECK_FALSE(has_common_levels(set));
  for (const std::vector<double>& crossing :
       {std::vector<double>{}, std::vector<double>{0.9, 0.9}, std::vector<double>{1.0},
        std::vector<double>{0.0}, std::vector<double>{-0.5}, std::vector<double>{std::nan("")}}) {
    set = three_cells();
    set.crossing = crossing;
    CHECK_FALSE(has_common_levels(set));
  }
  // One level need not shrink.
  set = three_cells();
  for (PhaseTube& tube : set.tubes) {
    tube.levels.pop_back();
  }
  set.crossing = {1.0};
  CHECK(has_common_levels(set));
  CHECK(crosses(set));
  set.crossing = {1.001};
  CHECK_FALSE(has_common_levels(set));
  // The least ratio is the common one.
  set = three_cells();
  set.tubes[1].levels[1] = 0.2;
  CHECK(common_levels(set)[0].near() == 1.0);
  CHECK(common_levels(set)[1].near() == doctest::Approx(0.4));
}

/// The half of a tube over the lower or upper half of its frequencies.
test::Json half_of(const test::Json& cell, bool upper) {
  test::Json result = cell;
  const double frequency = from_hexadecimal(cell["frequency"].get<std::string>()).near();
  const double width = from_hexadecimal(cell["half_width"].get<std::string>()).near();
  result["frequency"] = test::hexadecimal(upper ? frequency + width / 2.0 : frequency - width / 2.0);
  // A little wider, so that rounding leaves no gap.
  result["half_width"] = test::hexadecimal(width / 2.0 * (1.0 + 1e-12));
  for (const char* part : {"curve", "shape"}) {
    for (test::Json& series : result[part]) {
      for (test::Json& harmonic : series) {
        // sum c_d (y/2 + s)^d, s = 1/2 or -1/2.
        std::vector<std::complex<double>> coefficients;
        for (const test::Json& each : harmonic) {
          coefficients.emplace_back(from_hexadecimal(each[0].get<std::string>()).near(),
                                    from_hexadecimal(each[1].get<std::string>()).near());
        }
        std::vector<std::complex<double>> sum;
        for (std::size_t d = coefficients.size(); d-- > 0;) {
          std::vector<std::complex<double>> next(sum.size() + 1);
          for (std::size_t k = 0; k < sum.size(); ++k) {
            next[k] += sum[k] * (upper ? 0.5 : -0.5);
            next[k + 1] += sum[k] * 0.5;
          }
          next[0] += coefficients[d];
          sum = next;
        }
        harmonic = test::Json::array();
        for (std::size_t d = 0; d < coefficients.size(); ++d) {
          harmonic.push_back(test::hexadecimals({sum[d].real(), sum[d].imag()}));
        }
      }
    }
  }
  return result;
}

TEST_CASE("a phase-locked loop whose frequency moves, in one cell and in two") {
  const test::Json& certificate = test::loop_certificate();
  const ModelRecursion recursion(read_json(certificate["design"].dump()).at("model"));
  const TrackedModel model{&recursion, one};
  const auto is_never_left = [&](const std::vector<test::Json>& cells, double slew, double crossing) {
    test::Json set = test::ProposedModel::set("slew", 0.0, cells);
    set["slew"] = test::hexadecimal(slew);
    set["crossing"] = test::hexadecimals({crossing});
    Objections objections;
    const TubeSet tubes = read_tube_set(read_json(set.dump()), recursion.states(), objections);
    check_order(tubes, objections);
    std::int64_t cells_taken = 0;
    return objections.empty() && covers(tubes, Ball(0.28125), Ball(0.3125)) &&
           PhaseTubeCheck(model, tubes, cells_taken).is_never_left(objections);
  };
  test::Json whole = certificate["tubes"][1]["cells"][0];
  whole["levels"] = test::hexadecimals({0.0045});
  whole["shrinking"] = test::hexadecimals({0.9999});
  CHECK(is_never_left({whole}, 2e-5, 1.0));
  CHECK_FALSE(is_never_left({whole}, 2e-4, 1.0));
  CHECK(is_never_left({half_of(whole, false), half_of(whole, true)}, 2e-5, 1.0));
  CHECK_FALSE(is_never_left({half_of(whole, false), half_of(whole, true)}, 2e-4, 1.0));
  CHECK_FALSE(is_never_left({half_of(whole, false), half_of(whole, true)}, 2e-5, 0.9));
  CHECK_FALSE(is_never_left({half_of(whole, true), half_of(whole, false)}, 2e-5, 1.0));
  // Smaller in the upper half: never left there, but entered too far out.
  test::Json upper = half_of(whole, true);
  upper["levels"] = test::hexadecimals({0.0035});
  CHECK(is_never_left({half_of(whole, false), half_of(whole, true)}, 1e-5, 1.0));
  CHECK_FALSE(is_never_left({half_of(whole, false), upper}, 1e-5, 1.0));
}

}  // namespace
}  // namespace veritrack::checker

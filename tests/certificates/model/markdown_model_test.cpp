#include "certificates/model/markdown_model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <regex>
#include <string>

#include "analysis/model/set/set_parts.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "tests/certificates/model/model_certificates.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::certificates {
namespace {

const MarkdownOptions kFigures{{{"figures/reach.svg", "Reach", "a reach"},
                                {"figures/bias.svg", "Bias", "a bias"},
                                {"figures/tube.svg", "Tube", "a tube"}},
                               "0123",
                               "a program 1.0"};

/// A certificate of the loop with these sets, which nothing has proved.
Certificate with_sets(ModelSets sets, const std::string& text = test::kLoopText) {
  Certificate certificate;
  certificate.design = test::loop_design(text);
  certificate.particulars = std::move(sets);
  return certificate;
}

/// Sets of which no part was proved.
ModelSets unproved_sets() {
  ModelSets sets;
  sets.starts.tubes.reasons = {"no radius was proved between 0.3 and 0.32 rad/sample"};
  sets.assumed.emplace().tubes.noise = 0.02;
  sets.assumed->tubes.reasons = std::vector<std::string>(10, "a reason");
  return sets;
}

model::ProvedTube tube_at(double frequency, double half_width) {
  model::ProvedTube proved;
  proved.tube.frequency = frequency;
  proved.tube.half_width = half_width;
  proved.tube.turns = {1, 0};
  proved.tube.curve.resize(2);
  proved.tube.shape.resize(3);
  proved.levels = {0.5, 0.25};
  proved.shrinking = {0.5};
  return proved;
}

TEST_CASE("the sections of a design of which nothing is proved are those that were looked at") {
  test::check_golden(model_sections(with_sets(unproved_sets()), kFigures),
                     VERITRACK_SOURCE_DIR "/tests/certificates/golden/model-sections.md");
}

TEST_CASE("nothing proved is said at the top, without a verdict") {
  const Certificate certificate = with_sets(unproved_sets());
  CHECK(model_answers(certificate).empty());
  CHECK(model_remarks(certificate).starts_with("Nothing was proved for the band, nor for a part of it."));
  CHECK(model_remarks(certificate).find("**") == std::string::npos);
}

TEST_CASE("the part of the band that was proved is named, rounded inward") {
  ModelSets sets = unproved_sets();
  sets.starts.tubes.tubes = {tube_at(0.25, 0.125), tube_at(0.5, 0.1875), tube_at(1.0, 0.1 + 1e-12)};
  model::keep_widest_part(sets.starts.tubes, 0.125, 1.1);
  const std::string text = model_sections(with_sets(sets), kFigures);
  CHECK(text.find("| large starts, over [0.3, 0.32] rad/sample only |") != std::string::npos);
  CHECK(text.find("Frequencies with a proved tube: [0.125, 0.6875], [0.9, 1.1] rad/sample.") !=
        std::string::npos);
  sets.objection = "the assumed frequencies are no band";
  CHECK(model_sections(with_sets(sets), kFigures)
            .find("Nothing is certified: the assumed frequencies are no band.") != std::string::npos);
}

TEST_CASE("bias and ripple have at most 16 rows, each with the worst of its cells") {
  ModelSets sets = unproved_sets();
  sets.starts.tubes.tubes = {tube_at(0.31, 0.01)};
  for (int i = 0; i < 40; ++i) {
    const double low = 0.3125 + 0x1p-11 * i;
    sets.slices.push_back(
        {low, low + 0x1p-11, rigor::Interval::from_bounds(-0.25 * i, 0.5 * i), 0.125 * i, 1.0});
  }
  const std::string text = model_sections(with_sets(sets), kFigures);
  const std::string section = text.substr(text.find("## Bias and ripple"));
  std::size_t rows = 0;
  for (std::size_t at = section.find("| 0.3"); at != std::string::npos;
       at = section.find("\n| 0.3", at + 1)) {
    ++rows;
  }
  CHECK(rows == 14);
  CHECK(section.find("[-0.5, 1] | 0.25") != std::string::npos);
  CHECK(section.find("figures/bias.svg") != std::string::npos);
  // What has no cell is in no row.
  ModelSets with_gap = sets;
  with_gap.slices.erase(with_gap.slices.begin() + 1);
  CHECK(model_sections(with_sets(with_gap), kFigures).find("| 0.3125 to 0.312988 |") != std::string::npos);
  sets.slices[1].bias = rigor::Interval::empty();
  sets.slices[1].ripple = NAN;
  CHECK(model_sections(with_sets(sets), kFigures).find("| unknown | unknown |") != std::string::npos);
  sets.starts.tubes.tubes.front().levels.pop_back();
  CHECK(model_sections(with_sets(sets), kFigures).find("Nothing is known of them") != std::string::npos);
  CHECK(model_sections(with_sets(sets), kFigures).find("Gains, which") == std::string::npos);
  sets.no_phase_gains = "no basis";
  CHECK(model_sections(with_sets(sets), kFigures).find("prove nothing here (phase by phase: no basis).") !=
        std::string::npos);
}

TEST_CASE("the bound in the long run stands beside what errors come to in the linear approximation") {
  ModelSets sets = unproved_sets();
  sets.linear = model::LinearWorstCase{0.31, 0.125, 0.5};
  sets.assumed->settled_error = 0.75;
  std::string text = model_sections(with_sets(sets), kFigures);
  CHECK(
      text.find("to about 0.5 rad/sample (79.58 Hz) at worst, of which 0.125 rad/sample (19.89 Hz) are there "
                "without them") != std::string::npos);
  CHECK(text.find("The certified bound in the long run is 1.50 times as large.") != std::string::npos);
  const Json report = model_report_json(with_sets(sets)).at("linear_worst_case");
  CHECK(report.at("bound_over_it") == 1.5);
  CHECK(report.at("proved") == false);
  // The long run of a second set counts where there is one; without a bound there is nothing to compare.
  sets.long_run.emplace().settled_error = 0.625;
  CHECK(model_sections(with_sets(sets), kFigures).find("is 1.25 times as large") != std::string::npos);
  sets.long_run->settled_error = INFINITY;
  text = model_sections(with_sets(sets), kFigures);
  CHECK(text.find("Computed, not proved") != std::string::npos);
  CHECK(text.find("times as large") == std::string::npos);
  CHECK_FALSE(model_report_json(with_sets(sets)).at("linear_worst_case").contains("bound_over_it"));
  sets.linear.reset();
  CHECK(model_report_json(with_sets(sets)).empty());
}

TEST_CASE("of a loop of the second order on two channels: the sum of its impulse response") {
  // The exact phase error e = sin(phi - theta - w) drives two numbers; in lock all is linear in noise, to
  // first order: h_0 = ki, h_1 = ki (1 - ki - kp), h_(k + 2) = (2 - ki - kp) h_(k + 1) - (1 - kp) h_k.
  const std::string text =
      "name = 'two channels'\ntracker = 'model'\n[model]\nsamples = ['y1', 'y2']\n"
      "parameters = { ki = 0.0004, kp = 0.03 }\nstates = ['theta', 'w']\nangles = ['theta']\n"
      "step = '''\ne = y2*cos(theta + w) - y1*sin(theta + w)\nw' = w + ki*e\ntheta' = theta + w + kp*e\n"
      "'''\nfrequency = 'w'\nstart = { theta = 0, w = 'omega' }\n[assume]\nfrequency = [0.2, 0.4]\n"
      "noise = 0.01\n";
  const Design design = test::loop_design(text);
  const ModelTables& tables = model_tables(design);
  const Model loop = make_model(tables.model, tables.assume.signal);
  const auto worst = linear_worst_case(proposed_tone(loop, tables.assume), 0.3, 0.01, 0.0);
  const double ki = 0.0004;
  const double kp = 0.03;
  double before = ki;
  double here = ki * (1.0 - ki - kp);
  double sum = before;
  for (int k = 0; k < 4000; ++k) {
    sum += std::fabs(here);
    const double next = (2.0 - ki - kp) * here - (1.0 - kp) * before;
    before = here;
    here = next;
  }
  REQUIRE(worst);
  CHECK(worst->undisturbed < 1e-9);
  CHECK(worst->disturbed == doctest::Approx(0.01 * sum).epsilon(1e-4));
}

TEST_CASE("a set that simulations leave is an alarm") {
  ModelSets sets = unproved_sets();
  sets.assumed.reset();
  // A tube without extent.
  sets.starts.tubes.tubes = {tube_at(0.31, 0.01)};
  sets.starts.tubes.is_complete = true;
  sets.starts.frequency_error = 1.0;
  CHECK(model_sections(with_sets(sets), kFigures)
            .find("**ALARM**: a simulation left the set for large starts") != std::string::npos);
}

TEST_CASE("a proved loop: the sets in both units, and an attack that stays below") {
  const Certificate& certificate = test::loop_certificate();
  REQUIRE(model_sets(certificate).assumed.value().is_proved());
  const std::string text = model_sections(certificate, kFigures);
  CHECK(text.find("ALARM") == std::string::npos);
  std::smatch found;
  REQUIRE(std::regex_search(text, found,
                            std::regex(": ([0-9.]+) of the certified bound[.] After the first "
                                       "sample it reached at most ([0-9.]+) of the set's size")));
  CHECK(std::stod(found[1]) <= 1.0);
  CHECK(std::stod(found[1]) > 0.5);
  CHECK(std::stod(found[2]) <= 1.0);
  CHECK(std::stod(found[2]) > 0.9);
  CHECK(std::regex_search(text,
                          std::regex("\\| the assumed noise \\| 0[.]02 \\| none \\| [0-9]+ \\| [0-9]+ \\| "
                                     "0[.]0[0-9]+ rad/sample \\([0-9.]+ Hz\\)")));
  CHECK(text.find("The assumed starts reach at most") != std::string::npos);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("inf ") == std::string::npos);
  for (const char* figure : {"figures/reach.svg", "figures/tube.svg", "figures/bias.svg"}) {
    CHECK(text.find(figure) != std::string::npos);
  }
  const auto answers = model_answers(certificate);
  REQUIRE_FALSE(answers.empty());
  CHECK(answers.front()->statement.starts_with("In exact arithmetic, "));
  CHECK(model_remarks(certificate).empty());
}

TEST_CASE("the entries of a covariance are counted, not listed") {
  const std::string text =
      "name = 'a filter'\ntracker = 'model'\n[model]\nsamples = ['y1', 'y2']\nfrequency = 'w'\n"
      "start = { x1 = 'A', x2 = 0, w = 'omega' }\n[model.ekf]\nstates = ['x1', 'x2', 'w']\n"
      "predict = '''\nx1' = cos(w)*x1 - sin(w)*x2\nx2' = sin(w)*x1 + cos(w)*x2\nw' = w\n'''\n"
      "measure = ['x1', 'x2']\nQ = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nR = [[1, 0], [0, 1]]\n"
      "[assume]\nfrequency = [1, 2]\nnoise = 0\nslew = 1e-6\n";
  const std::string sections = model_sections(with_sets(unproved_sets(), text), {});
  for (const char* words :
       {"| states, 9 | `x1`, `x2`, `w`, and the 6 entries of the covariance's upper triangle | — |",
        "| samples, in phase and in quadrature | `y1`, `y2` | signal units |", "`A*cos(phi)`, `A*sin(phi)`",
        "| change of the frequency, at most | `1e-6` | rad/sample per sample |",
        "The frequency stays in the band and changes by no more than assumed"}) {
    CAPTURE(words);
    CHECK(sections.find(words) != std::string::npos);
  }
}

TEST_CASE("units") {
  const rigor::UpwardRounding upward;
  const Design design = test::loop_design();
  const FrequencyUnits units(model_tables(design).assume.sample_rate);
  CHECK(units.at_most(0.1) == "0.1001 rad/sample (15.92 Hz)");
  CHECK(units.at_least(0.1) == "0.1 rad/sample (15.91 Hz)");
  CHECK(units.at_most(INFINITY) == "unknown");
  CHECK(units.drawn(0.1) == doctest::Approx(15.9154943));
  CHECK(outward(rigor::Interval::empty()) == "unknown");
  CHECK(units.slew(0x1p-20) == "9.536e-7 rad/sample per sample (0.1517 Hz per second)");
  CHECK(outward(rigor::Interval(0.5)) == "[0.5, 0.5]");
}

}  // namespace
}  // namespace veritrack::certificates

#include "reports/tuning/tuning_files.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "reports/tuning/trade_off_figure.hpp"

namespace veritrack::reports {
namespace {

using certificates::TriedDesign;

certificates::TuningResult example() {
  certificates::TuningResult result;
  result.design_text = "name = ...";
  result.notes = {"q1 = 1 -> 2: better."};
  certificates::TradeOff trade_off;
  trade_off.words = "the certified bound";
  trade_off.unit = "Hz";
  trade_off.required = 15.0;
  const auto design = [](TriedDesign::Role role, std::optional<double> value, std::optional<int> response,
                         bool meets) {
    return TriedDesign{
        role, {{"q1", "1"}, {"q2", "2"}, {"r", "3"}, {"epsilon", "0"}}, value, meets, response};
  };
  trade_off.designs = {design(TriedDesign::Role::given, 14.0, 6, true),
                       design(TriedDesign::Role::chosen, 7.5, 15, true),
                       design(TriedDesign::Role::trade_off, 7.5, 15, true),
                       design(TriedDesign::Role::trade_off, 4.0, 40, false),
                       design(TriedDesign::Role::tried, std::nullopt, 4, false)};
  result.trade_off = trade_off;
  return result;
}

TEST_CASE("the document has the gain first, then what would have to change, then what the search saw") {
  certificates::TuningResult result = example();
  std::string text = tuning_document(result, "x-tuned.toml", "What is seen.");
  CHECK(text.starts_with("# How the values of x-tuned.toml were chosen\n\n- q1 = 1"));
  CHECK(text.find("What would have to change") == std::string::npos);
  CHECK(text.find("| chosen | 1 | 2 | 3 | 0 | 15 | ≈ 7.5 | yes |") != std::string::npos);
  CHECK(text.find("| tried |") == std::string::npos);
  CHECK(text.find("It is certified for each design.") != std::string::npos);
  result.changes = {"Required: this; certified: that."};
  result.trade_off->is_estimated = true;
  text = tuning_document(result, "x-tuned.toml", "");
  CHECK(text.find("## What would have to change\n\n- Required: this") != std::string::npos);
  CHECK(text.find("estimated from sampled points, which proves nothing") != std::string::npos);
  CHECK(text.find("trade-off.svg") == std::string::npos);
}

TEST_CASE("the table has a line for each design, empty where nothing is known") {
  const std::string text = tuning_table(*example().trade_off);
  CHECK(text.find("role,q1,q2,r,epsilon,response_samples,objective,all_that_is_required\n") == 0);
  CHECK(text.find("\ntried,1,2,3,0,4,,false\n") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 6);
}

TEST_CASE("the figure says what is not shown") {
  const Figure figure = draw_trade_off(*example().trade_off);
  CHECK(figure.svg.find("</svg>") != std::string::npos);
  CHECK(figure.caption.find("One design for which nothing is certified is not shown.") != std::string::npos);
  CHECK(figure.caption.find("The certified bound, Hz,") == 0);
  CHECK(figure.title == "The certified bound against the response of the tracker");
}

}  // namespace
}  // namespace veritrack::reports

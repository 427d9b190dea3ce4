// Sets for pieces of a band: what they say together is said of every frequency, or refused.
#include "checker/quadrature/steady_pieces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "checker/document/json_tree.hpp"

using namespace veritrack::checker;

namespace {

// The band is [0.02, 0.0201] rad/sample.
const std::string kLowEnd = "0x1.47ae147ae147ap-6";     // the double below 0.02
const std::string kSharedEnd = "0x1.4880000000000p-6";  // about 0.02005
const std::string kHighEnd = "0x1.495182a9930bfp-6";    // a double above 0.0201

struct WrittenPiece {
  std::string from = kLowEnd, to = kHighEnd;
  std::string name = "frequency-error-radius";
  std::string noise = "0x1.0624dd2f1a9fcp-10";
  std::string slew = "0x0p+0";
};

std::string evidence_of_piece(const WrittenPiece& piece) {
  std::string text = R"({"name": ")" + piece.name + R"(", "matrices": {
    "metric": [["0x1.26f60fcf42f99p+3", "-0x1.4474904eb833fp-4", "0x1.314e15e4258c8p-2"],
               ["0x0p+0", "0x1.72f8404d79878p+2", "-0x1.35c7f87585c5fp+1"],
               ["0x0p+0", "0x0p+0", "0x1.fe07e5b01d99p+2"]],
    "covariance_below": [["0x1.9e5f9a46e91c6p-11", "0x1.5934cff3bf5cp-16", "0x1.43903c3d3673dp-15"],
                         ["0x1.5934cff3bf5cp-16", "0x1.ae4bd437c40e4p-10", "0x1.b7eed69dfaae3p-11"],
                         ["0x1.43903c3d3673dp-15", "0x1.b7eed69dfaae3p-11", "0x1.568f2161610c5p-11"]],
    "covariance_above": [["0x1.22704c0998bcbp-10", "-0x1.14551f14672a8p-17", "0x1.385cb246b75d6p-15"],
                         ["-0x1.14551f14672a8p-17", "0x1.832e438f0261cp-10", "0x1.f8e67a0592e88p-11"],
                         ["0x1.385cb246b75d6p-15", "0x1.f8e67a0592e88p-11", "0x1.d6dbdf05b0d92p-11"]]},
    "numbers": {"s_0": "0x1p+0", "s_1": "0x1.d244f73243c0ap-1", "noise": ")" +
                     piece.noise + R"(", "slew": ")" + piece.slew + "\"";
  if (!piece.from.empty()) {
    text += R"(, "from": ")" + piece.from + "\"";
  }
  if (!piece.to.empty()) {
    text += R"(, "to": ")" + piece.to + "\"";
  }
  return text + "}}";
}

Design design_in_pieces() {
  Design design;
  design.amplitude = one;
  design.q1 = design.q2 = Ball(0.0013);
  design.r = Ball(0.01);
  design.epsilon = Ball(0.01);
  design.lowest_frequency = from_decimal("0.02");
  design.highest_frequency = from_decimal("0.0201");
  design.noise = Ball(0.001);
  design.slew = zero;
  return design;
}

struct CheckedPieces {
  std::vector<SteadyPieces> covers;
  Objections objections;
  [[nodiscard]] bool refused(const std::string& why) const {
    return std::any_of(objections.begin(), objections.end(),
                       [&](const std::string& one) { return one.find(why) != std::string::npos; });
  }
};

CheckedPieces check_pieces(const std::vector<WrittenPiece>& pieces) {
  static const auto branch = steady_branch(design_in_pieces(), 0.3, 1e-4);
  REQUIRE(branch.has_value());
  std::string text;
  for (const WrittenPiece& piece : pieces) {
    text += (text.empty() ? "[" : ", ") + evidence_of_piece(piece);
  }
  const Tree evidence = read_json(text + "]");
  CheckedPieces result;
  std::int64_t cells = 0;
  result.covers =
      check_steady_covers(evidence, design_in_pieces(), {*branch, *branch}, cells, result.objections);
  return result;
}

}  // namespace

TEST_CASE("pieces that share an end, or overlap, are one cover; a set without ends is one, too") {
  std::vector<WrittenPiece> pieces(2);
  SUBCASE("a shared end") {
    pieces[0].to = pieces[1].from = kSharedEnd;
  }
  SUBCASE("an overlap") {
    pieces[0].to = kHighEnd;
    pieces[1].from = kSharedEnd;
  }
  SUBCASE("one piece that is all of it") {
    pieces.resize(1);
  }
  SUBCASE("one set for the whole band") {
    pieces.resize(1);
    pieces[0].from.clear();
    pieces[0].to.clear();
  }
  const CheckedPieces checked = check_pieces(pieces);
  CHECK(checked.objections.empty());
  REQUIRE(checked.covers.size() == 1);
  CHECK(checked.covers[0].verified);
  CHECK(checked.covers[0].pieces.size() == pieces.size());
}

TEST_CASE("the worst of the pieces counts") {
  std::vector<WrittenPiece> pieces(2);
  pieces[0].to = pieces[1].from = kSharedEnd;
  pieces[1].noise = "0x1p-11";
  const CheckedPieces checked = check_pieces(pieces);
  REQUIRE(checked.covers.size() == 1);
  CHECK(certainly_equal(noise_of(checked.covers[0]), Ball(0x1p-11)));
}

TEST_CASE("gaps, swapped ends and a slew are refused") {
  std::vector<WrittenPiece> pieces(2);
  pieces[0].to = pieces[1].from = kSharedEnd;
  std::string why = "do not cover the band";
  SUBCASE("a gap of one bit") {
    pieces[1].from = "0x1.4880000000001p-6";
  }
  SUBCASE("not from the lowest frequency") {
    pieces[0].from = "0x1.47ae147ae147cp-6";
  }
  SUBCASE("not to the highest") {
    pieces[1].to = "0x1.4951p-6";
  }
  SUBCASE("the last is missing") {
    pieces.pop_back();
  }
  SUBCASE("the first is missing") {
    pieces.erase(pieces.begin());
  }
  SUBCASE("in the wrong order") {
    std::swap(pieces[0], pieces[1]);
  }
  SUBCASE("swapped ends") {
    std::swap(pieces[1].from, pieces[1].to);
  }
  SUBCASE("a piece of no width") {
    pieces[1].to = pieces[1].from;
  }
  SUBCASE("another purpose between them") {
    WrittenPiece whole;
    whole.name = "start-error";
    whole.from.clear();
    whole.to.clear();
    pieces.insert(pieces.begin() + 1, whole);
  }
  SUBCASE("a slew") {
    pieces[0].slew = "0x1p-60";
    why = "a slew may leave";
  }
  const CheckedPieces checked = check_pieces(pieces);
  CHECK(checked.refused(why));
  CHECK_FALSE(std::all_of(checked.covers.begin(), checked.covers.end(),
                          [](const SteadyPieces& cover) { return cover.verified; }));
}

TEST_CASE("one end alone is malformed") {
  std::vector<WrittenPiece> pieces(1);
  SUBCASE("from") {
    pieces[0].to.clear();
  }
  SUBCASE("to") {
    pieces[0].from.clear();
  }
  CHECK_THROWS(check_pieces(pieces));
}

TEST_CASE("a part of the branch ends where it is cut") {
  const auto branch = steady_branch(design_in_pieces(), 0.3, 1e-4);
  REQUIRE(branch.has_value());
  CHECK(part_of(*branch, Ball(0.5), Ball(0.6)).empty());
  CHECK(part_of(*branch, Ball(0.02005), Ball(0.02005)).empty());
  CHECK(part_of(*branch, Ball(0.02006), Ball(0.02004)).empty());
  const auto part = part_of(*branch, Ball(0.02004), Ball(0.02006));
  REQUIRE(part.size() == 1);
  CHECK(part[0].from == 0.02004);
  CHECK(part[0].to == 0.02006);
}

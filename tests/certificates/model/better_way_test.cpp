// Which of two ways to certify a filter is taken, with certificates that are made up.
#include "certificates/model/better_way.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {
namespace {

using rigor::Verdict;

/// A certificate of which so many required claims, of two, are proved.
Certificate with_proved(int proved, bool bounds_covariance) {
  Certificate certificate;
  ModelSets sets;
  sets.bounds_covariance = bounds_covariance;
  certificate.particulars = sets;
  for (int i = 0; i < 2; ++i) {
    Claim claim;
    claim.required = true;
    claim.verdict = i < proved ? Verdict::proved : Verdict::undecided;
    certificate.claims.push_back(claim);
  }
  Claim told;  // counts for nothing
  told.verdict = Verdict::proved;
  certificate.claims.push_back(told);
  return certificate;
}

/// What is tried, in its order, and whether the certificate that is taken is by structure.
struct Taken {
  std::vector<bool> tried;
  bool by_structure = false;
};

Taken taken(int by_structure, int without, bool bounds_covariance = true, bool is_late = false) {
  Taken result;
  const Certificate certificate = better_way([&](bool structure) {
    result.tried.push_back(structure);
    Certificate made = with_proved(structure ? by_structure : without, structure && bounds_covariance);
    if (is_late) {
      made.deadline = search::Deadline(0.0);
    }
    return made;
  });
  result.by_structure = model_sets(certificate).bounds_covariance;
  return result;
}

TEST_CASE("where nothing is required, the other way is taken only if it alone says something") {
  for (const bool first_says : {false, true}) {
    for (const bool second_says : {false, true}) {
      int tried = 0;
      const Certificate certificate = better_way([&](bool structure) {
        ++tried;
        Certificate made = with_proved(0, structure);
        made.claims.resize(structure ? (first_says ? 3U : 0U) : (second_says ? 3U : 0U));
        for (Claim& claim : made.claims) {
          claim.required = false;
        }
        return made;
      });
      CHECK(tried == (first_says ? 1 : 2));
      CHECK(model_sets(certificate).bounds_covariance == (first_says || !second_says));
    }
  }
}

TEST_CASE("a filter whose requirements are proved by structure is not certified again") {
  const Taken result = taken(2, 2);
  CHECK(result.tried == std::vector<bool>{true});
  CHECK(result.by_structure);
}

TEST_CASE("where a requirement is open, the other way is taken if it proves more") {
  CHECK(taken(1, 2).tried == std::vector<bool>{true, false});
  CHECK_FALSE(taken(1, 2).by_structure);
  CHECK_FALSE(taken(0, 1).by_structure);
  CHECK(taken(1, 1).by_structure);
  CHECK(taken(1, 0).tried == std::vector<bool>{true, false});
  CHECK(taken(1, 0).by_structure);
}

TEST_CASE("there is one way only for what has no structure, and after the deadline") {
  CHECK(taken(0, 2, false).tried == std::vector<bool>{true});
  CHECK(taken(0, 2, true, true).tried == std::vector<bool>{true});
}

}  // namespace
}  // namespace veritrack::certificates

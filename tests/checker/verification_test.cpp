// The folders tests/certificates/{accepted,rejected,malformed}: a new file is a new test.
//
// A file of rejected/ or malformed/ is a certificate as it stands, or a change of an accepted one:
//     "of"         accepted/NAME.json: what is changed, and must be verified as it stands
//     "why"        what is wrong with the changed one, for people
//     "part"       rejected/ only: the part that must be NOT VERIFIED, the first one of that name that is
//     "objection"  words of the first objection to that part, or how the message of a malformed one begins
//     "patch"      JSON Patch (RFC 6902); a path that is not there fails the test
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checker/numbers/budget.hpp"
#include "checker/verification.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using Json = nlohmann::ordered_json;

const std::string kRoot = VERITRACK_SOURCE_DIR "/tests/certificates/";

std::vector<std::filesystem::path> files_of(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot + folder)) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  REQUIRE(!files.empty());
  return files;
}

checker::Verification check(const std::string& text) {
  return checker::verify(checker::read_json(text));
}

/// A certificate as it stands: what was found, and the operations that it took.
struct Known {
  checker::Verification result;
  std::int64_t operations = 0;
};

/// The certificate of this name, below tests/certificates/.
const Known& as_it_stands(const std::string& name) {
  static std::map<std::string, Known> known;
  const auto found = known.find(name);
  if (found != known.end()) {
    return found->second;
  }
  checker::set_budget(checker::kDefaultBudget);
  checker::Verification result = check(test::read_file(kRoot + name));
  return known.emplace(name, Known{std::move(result), checker::operations_spent()}).first->second;
}

/// A file of rejected/ or malformed/.
struct Case {
  std::string text;                 ///< the certificate
  std::optional<Json> description;  ///< when it is a changed one
  std::int64_t operations = 0;      ///< of the one that is changed
};

Case read_case(const std::filesystem::path& path) {
  const std::string text = test::read_file(path.string());
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("of")) {
    return {text, std::nullopt, 0};
  }
  const std::string name = json.at("of");
  REQUIRE_MESSAGE((name.starts_with("accepted/") && as_it_stands(name).result.verified()),
                  path.filename().string() << ": " << name << " is not accepted");
  CHECK_MESSAGE(!json.at("why").get<std::string>().empty(), path.filename().string());
  CHECK_MESSAGE(!json.at("objection").get<std::string>().empty(), path.filename().string());
  const Json base = Json::parse(test::read_file(kRoot + name));
  Json changed;
  try {
    changed = base.patch(json.at("patch"));
  } catch (const Json::exception& error) {
    FAIL(path.filename().string() << ": the patch does not apply: " << error.what());
  }
  REQUIRE_MESSAGE(changed != base, path.filename().string() << " changes nothing");
  return {changed.dump(), json, as_it_stands(name).operations};
}

/// How the names of files begin that have a test case of their own, which the search for guards that no test
/// misses runs again and again.
constexpr std::array kKinds{
    "model-filter-", "model-gaussian-", "model-gains-", "model-start-", "model-",  "dft-", "kkl-",
    "regulator-",    "phases-",         "recursion-",   "lock-",        "lowest-", "mean-"};

/// Rejected certificates are read and not verified, for the reason that their file names: those whose names
/// begin so, or, without a beginning, those that are of no kind.
void check_rejected(const std::string& beginning) {
  // Of changes of a certificate that takes long .ci/run looks at a sixth, .ci/nightly at all.
  constexpr std::int64_t kLong = 1'000'000;  // operations, a tenth of a second
  const std::int64_t share = test::effort(100) < 40 ? 6 : 1;
  std::int64_t long_ones = 0;
  std::int64_t looked_at = 0;
  for (const auto& path : files_of("rejected")) {
    const std::string file = path.filename().string();
    const auto* kind =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const char* each) { return file.starts_with(each); });
    if (beginning != (kind == kKinds.end() ? "" : *kind)) {
      continue;
    }
    ++looked_at;
    const Case rejected = read_case(path);
    if (rejected.operations > kLong && long_ones++ % share != 0) {
      continue;
    }
    const checker::Verification result = check(rejected.text);
    CHECK_MESSAGE(!result.verified(), path.filename().string());
    if (!rejected.description) {
      continue;
    }
    const std::string name = rejected.description->at("part");
    const auto part =
        std::find_if(result.parts.begin(), result.parts.end(), [&](const checker::Part& candidate) {
          return candidate.name == name && !candidate.objections.empty();
        });
    REQUIRE_MESSAGE(part != result.parts.end(), path.filename().string()
                                                    << ": " << name << " is verified, or not there");
    CHECK_MESSAGE(part->objections.front().find(rejected.description->at("objection").get<std::string>()) !=
                      std::string::npos,
                  path.filename().string() << ": " << part->objections.front());
  }
  CHECK(looked_at > 10);
}

}  // namespace

TEST_CASE("accepted certificates are verified") {
  for (const auto& path : files_of("accepted")) {
    const checker::Verification& result = as_it_stands("accepted/" + path.filename().string()).result;
    for (const checker::Part& part : result.parts) {
      CHECK_MESSAGE(part.objections.empty(), path.filename().string()
                                                 << ": " << part.name << ": " << part.objections.front());
    }
    CHECK(result.verified());
  }
}

TEST_CASE("each certificate has the whole budget") {
  const std::string text = test::read_file(kRoot + "accepted/lock.json");
  REQUIRE(check(text).verified());
  checker::set_budget(checker::operations_spent() + 1);
  CHECK(check(text).verified());
  CHECK(check(text).verified());
  checker::set_budget(checker::operations_spent() / 2);
  CHECK_FALSE(check(text).verified());
  checker::set_budget(checker::kDefaultBudget);
}

TEST_CASE("rejected certificates: of the quadrature tracker") {
  check_rejected("");
}

TEST_CASE("rejected certificates: of recursions") {
  check_rejected("model-");
}

TEST_CASE("rejected certificates: of recursions, by gains and from given starts") {
  check_rejected("model-gains-");
  check_rejected("model-start-");
}

TEST_CASE("rejected certificates: of filters, and in Gaussian noise") {
  check_rejected("model-filter-");
  check_rejected("model-gaussian-");
}

TEST_CASE("rejected certificates: of blocks") {
  check_rejected("dft-");
}

TEST_CASE("rejected certificates: of the observer") {
  check_rejected("kkl-");
}

TEST_CASE("rejected certificates: of the regulator") {
  check_rejected("regulator-");
}

TEST_CASE("rejected certificates: of one channel") {
  check_rejected("phases-");
  check_rejected("recursion-");
}

TEST_CASE("rejected certificates: in Gaussian noise") {
  check_rejected("lock-");
  check_rejected("lowest-");
  check_rejected("mean-");
}

TEST_CASE("malformed certificates are malformed, for the reason that their file names") {
  for (const auto& path : files_of("malformed")) {
    const Case malformed = read_case(path);
    std::string message;
    try {
      (void)check(malformed.text);
      FAIL_CHECK(path.filename().string() << " is not malformed");
    } catch (const checker::Malformed& error) {
      message = error.what();
    }
    if (malformed.description) {
      CHECK_MESSAGE(message.starts_with(malformed.description->at("objection").get<std::string>()),
                    path.filename().string() << ": " << message);
    }
  }
}

TEST_CASE("a certificate that is cut off, that something follows, or that has a key twice is malformed") {
  const std::string text = test::read_file(kRoot + "accepted/one-set.json");
  for (std::size_t end = 0; end + 2 < text.size(); end += 97) {
    CHECK_THROWS_AS((void)check(text.substr(0, end)), checker::Malformed);
  }
  CHECK_THROWS_AS((void)check(text + "{}"), checker::Malformed);
  CHECK_THROWS_AS((void)check(R"({"verdict": "proved", )" + text.substr(1)), checker::Malformed);
}

TEST_CASE("a certificate of nothing is not verified") {
  CHECK(!checker::Verification{}.verified());
}

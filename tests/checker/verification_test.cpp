// The folders tests/certificates/{accepted,rejected,malformed}: a new file is a new test.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

namespace {

using namespace veritrack;

std::vector<std::filesystem::path> files_of(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path root = VERITRACK_SOURCE_DIR "/tests/certificates/" + folder;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  REQUIRE(!files.empty());
  return files;
}

checker::Verification check(const std::filesystem::path& path) {
  return checker::verify(checker::read_json(test::read_file(path.string())));
}

}  // namespace

TEST_CASE("accepted certificates are verified") {
  for (const auto& path : files_of("accepted")) {
    const checker::Verification result = check(path);
    for (const checker::Part& part : result.parts) {
      CHECK_MESSAGE(part.objections.empty(), path.filename().string()
                                                 << ": " << part.name << ": " << part.objections.front());
    }
    CHECK(result.verified());
  }
}

TEST_CASE("rejected certificates are read and not verified") {
  for (const auto& path : files_of("rejected")) {
    CHECK_MESSAGE(!check(path).verified(), path.filename().string());
  }
}

TEST_CASE("malformed certificates are malformed") {
  for (const auto& path : files_of("malformed")) {
    CHECK_THROWS_AS_MESSAGE((void)check(path), checker::Malformed, path.filename().string());
  }
}

TEST_CASE("a certificate of nothing is not verified") {
  CHECK(!checker::Verification{}.verified());
}

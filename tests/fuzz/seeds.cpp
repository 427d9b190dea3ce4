// A fuzz target without libFuzzer: every seed of its corpus once, as a test. .ci/nightly searches on from
// there.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int count, char** arguments) {
  int seeds = 0;
  for (int i = 1; i < count; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
      const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
      std::printf("%s\n", entry.path().filename().c_str());  // the last one is that which ends the program
      std::fflush(stdout);
      (void)LLVMFuzzerTestOneInput(data.data(), data.size());
      ++seeds;
    }
  }
  return seeds > 0 ? 0 : 1;
}

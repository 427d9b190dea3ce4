// Whatever the bytes: samples that are finite or missing, or an InputError of one line; the same samples in
// blocks of any size.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "reports/recording/samples/csv_source.hpp"

namespace {

using namespace veritrack;

void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "csv_recording_fuzz: %s\n", what);
    std::abort();
  }
}

/// Up to some thousand samples (times may leave out any number), or the message.
std::string outcome(const std::string& path, std::size_t block_size) {
  constexpr std::size_t kMost = 4096;
  std::string text;
  std::size_t samples = 0;
  try {
    reports::CsvSource source(path, {});
    std::vector<reports::RecordedSample> block(block_size);
    for (std::size_t count = block_size; count == block_size && samples < kMost; samples += count) {
      count = source.read(block);
      for (std::size_t i = 0; i < count && samples + i < kMost; ++i) {
        require(std::isfinite(block[i].in_phase) && std::isfinite(block[i].quadrature),
                "a sample that is no number");
        text += block[i].is_present
                    ? std::to_string(block[i].in_phase) + " " + std::to_string(block[i].quadrature) + "\n"
                    : "-\n";
      }
    }
  } catch (const certificates::InputError& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == std::string_view::npos, "a message of several lines");
    // Samples before the fault may have been read or not.
    return samples < kMost ? std::string(message) : text;
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = ::memfd_create("recording", 0);
  require(file >= 0 && ::write(file, data, size) == static_cast<ssize_t>(size), "no file in memory");
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  const std::string once = outcome(path, 1);
  require(once == outcome(path, 64), "blocks of another size have other samples");
  ::close(file);
  return 0;
}

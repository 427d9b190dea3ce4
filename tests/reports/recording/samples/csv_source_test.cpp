#include "reports/recording/samples/csv_source.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "tests/support/golden.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::reports {
namespace {

namespace fs = std::filesystem;

fs::path folder(const char* name) {
  return fs::path(VERITRACK_SOURCE_DIR) / "tests/reports/recording/samples" / name;
}

std::vector<fs::path> recordings(const char* name) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder(name))) {
    if (entry.path().extension() == ".csv") {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  REQUIRE_FALSE(paths.empty());
  return paths;
}

std::string beside(fs::path path, const char* extension) {
  return path.replace_extension(extension).string();
}

/// From the file beside the recording, lines of `columns=a,b` and `time=t`.
CsvColumns columns_of(const fs::path& recording) {
  CsvColumns columns;
  std::ifstream file(beside(recording, ".options"));
  for (std::string line; std::getline(file, line);) {
    const std::string value = line.substr(line.find('=') + 1);
    if (line.starts_with("time=")) {
      columns.time = value;
      continue;
    }
    std::istringstream parts(value);
    for (std::string part; std::getline(parts, part, ',');) {
      columns.channels.push_back(part);
    }
  }
  return columns;
}

/// A line for each sample, read in blocks of that size.
std::string text_of(SampleSource& source, std::size_t block_size) {
  std::ostringstream text;
  std::vector<RecordedSample> block(block_size);
  for (;;) {
    const std::size_t count = source.read(block);
    for (std::size_t i = 0; i < count; ++i) {
      if (!block[i].is_present) {
        text << "-\n";
      } else if (source.channels() > 1) {
        text << block[i].in_phase << ' ' << block[i].quadrature << '\n';
      } else {
        text << block[i].in_phase << '\n';
      }
    }
    if (count < block_size) {
      return text.str();
    }
  }
}

std::string message_of(const fs::path& path, const CsvColumns& columns) {
  try {
    CsvSource source(path.string(), columns);
    (void)text_of(source, 16);
  } catch (const certificates::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_CASE("every file in accepted/ is read as the file beside it says") {
  for (const fs::path& path : recordings("accepted")) {
    for (const std::size_t block : {1U, 2U, 4096U}) {
      INFO(path.filename().string());
      CsvSource source(path.string(), columns_of(path));
      CHECK(text_of(source, block) == test::read_file(beside(path, ".expected")));
    }
  }
}

TEST_CASE("every file in malformed/ is refused with the message beside it") {
  for (const fs::path& path : recordings("malformed")) {
    const std::string message = message_of(path, columns_of(path));
    INFO(path.filename().string(), ": ", message);
    CHECK(message.find(test::read_file(beside(path, ".expected"))) != std::string::npos);
    CHECK(message.starts_with(path.string()));
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("the sample rate is that of the times, rounded as they are, or the one given") {
  const test::ScratchFolder scratch;
  const std::string path = (scratch / "times.csv").string();
  std::ofstream file(path);
  file << "time,y\n";
  for (int k = 0; k < 3000; ++k) {
    if (k != 500) {
      file << std::fixed << static_cast<double>(k) / 44100.0 << ",1\n";  // six digits: a third of an interval
    }
  }
  file.close();
  CHECK(message_of(path, {}).find("the time advances by") == std::string::npos);
  CsvSource source(path, {});
  CHECK(source.sample_rate().value() == doctest::Approx(44100.0).epsilon(1e-4));
  const std::string text = text_of(source, 100);
  CHECK(std::count(text.begin(), text.end(), '-') == 1);
  CHECK(std::count(text.begin(), text.end(), '\n') == 3000);
  CHECK(source.progress().value() == doctest::Approx(1.0));
  CHECK(CsvSource(path, {{}, {}, 8000.0}).sample_rate().value() == 8000.0);
}

TEST_CASE("a line of a megabyte is refused, whatever it holds") {
  const test::ScratchFolder scratch;
  const std::string path = (scratch / "long.csv").string();
  std::ofstream(path) << "y\n1\n" << std::string((1U << 20U) + 10, '1') << "\n2\n";
  CHECK(message_of(path, {}).find(":3:1: a line of more than 1048576 bytes") != std::string::npos);
  std::ofstream(path) << "y\n\"1\n" << std::string(1U << 19U, '\n') << std::string(1U << 19U, '\n');
  CHECK(message_of(path, {}).find(":2:1: a record of more than 1048576 bytes") != std::string::npos);
  CHECK(message_of(scratch / "missing.csv", {}).find("cannot be read: No such file") != std::string::npos);
  CHECK(message_of(scratch.path(), {}).find("a folder; allowed: a recording") != std::string::npos);
}

TEST_CASE("bytes at random are read or refused, in one line") {
  const test::ScratchFolder scratch;
  test::Random random;
  constexpr std::string_view kBytes = "0123456789.,;-+eE\"\n\r\t #ayNn\x00\xff";
  const std::string path = (scratch / "random.csv").string();
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    std::string text = random.below(2) == 0 ? "t,y\n0,1\n1,2\n" : "";
    for (std::uint64_t length = random.below(60); length > 0; --length) {
      text += kBytes[random.below(kBytes.size())];
    }
    std::ofstream(path, std::ios::binary) << text;
    CHECK(message_of(path, {}).find('\n') == std::string::npos);
  }
}

TEST_CASE("what comes through a pipe is read as a file is") {
  const test::ScratchFolder scratch;
  const std::string path = (scratch / "fifo").string();
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(path) << "t,y\n0,1\n" << std::flush << "1,2\n"; });
  CsvSource source(path, {});
  CHECK(text_of(source, 1) == "1\n2\n");
  CHECK_FALSE(source.progress().has_value());
  writer.join();
}

}  // namespace
}  // namespace veritrack::reports

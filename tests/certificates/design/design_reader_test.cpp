#include "certificates/design/design_reader.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace veritrack::certificates;
namespace rigor = veritrack::rigor;
using veritrack::test::effort;
using veritrack::test::Random;
using veritrack::test::ScratchFolder;
using veritrack::test::UnprivilegedUser;

const fs::path kSource = VERITRACK_SOURCE_DIR;
const fs::path kDesigns = kSource / "tests" / "certificates" / "designs";

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file.is_open());
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  REQUIRE(!files.empty());
  return files;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  REQUIRE(place != std::string::npos);
  return text.replace(place, from.size(), to);
}

/// The text of what() for a design that must be refused.
std::string refusal(const std::string& text, const std::string& file_name = "x.toml") {
  try {
    (void)read_design(text, file_name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string file_refusal(const fs::path& path) {
  try {
    (void)read_design_file(path);
  } catch (const InputError& error) {
    CHECK(error.line() == 0);
    return error.what();
  }
  return "accepted";
}

std::vector<Number> numbers_of_model(const ModelTables& tables) {
  const ModelAssumptions& assume = tables.assume;
  std::vector<Number> numbers{assume.amplitude[0], assume.amplitude[1], assume.frequency[0],
                              assume.frequency[1], assume.slew};
  if (!assume.gaussian) {
    numbers.push_back(assume.noise);
  }
  for (const auto& number : {assume.gaussian ? assume.gaussian->snr_db : std::nullopt,
                             assume.gaussian ? assume.gaussian->deviation : std::nullopt, assume.samples,
                             assume.sample_rate, tables.require.sets.probability_of_losing_lock_below}) {
    if (number) {
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<Number> numbers_of(const Design& design) {
  if (design.tracker == "model") {
    return numbers_of_model(model_tables(design));
  }
  const Assumptions& assume = quadrature_tables(design).assume;
  std::vector<Number> numbers{quadrature_tables(design).design.q1,
                              quadrature_tables(design).design.q2,
                              quadrature_tables(design).design.r,
                              quadrature_tables(design).design.epsilon,
                              assume.amplitude,
                              assume.frequency[0],
                              assume.frequency[1],
                              assume.slew,
                              assume.initial_frequency_error,
                              assume.initial_phase_error,
                              assume.initial_amplitude_error,
                              quadrature_tables(design).theorem_2_9.state_bound,
                              quadrature_tables(design).theorem_2_9.sigma,
                              quadrature_tables(design).theorem_2_9.gamma_fraction,
                              quadrature_tables(design).theorem_2_9.c1,
                              quadrature_tables(design).theorem_2_9.c2};
  if (!assume.gaussian) {
    numbers.push_back(assume.noise);
  }
  for (const auto& number :
       {assume.gaussian ? assume.gaussian->snr_db : std::nullopt,
        assume.gaussian ? assume.gaussian->deviation : std::nullopt, assume.frequency_walk, assume.samples}) {
    if (number) {
      numbers.push_back(*number);
    }
  }
  if (assume.initial_covariance) {
    for (const auto& row : *assume.initial_covariance) {
      numbers.insert(numbers.end(), row.begin(), row.end());
    }
  }
  if (assume.covariance_range) {
    for (const CovarianceArray& end : *assume.covariance_range) {
      for (const auto& row : end) {
        numbers.insert(numbers.end(), row.begin(), row.end());
      }
    }
  }
  if (assume.covariance_multiples) {
    numbers.insert(numbers.end(), assume.covariance_multiples->begin(), assume.covariance_multiples->end());
  }
  for (const auto& number : {quadrature_tables(design).require.frequency_error_below,
                             quadrature_tables(design).require.settles_within,
                             quadrature_tables(design).require.largest_noise_at_least,
                             quadrature_tables(design).require.largest_slew_at_least,
                             quadrature_tables(design).require.frequency_error_radius_at_least}) {
    if (number) {
      numbers.push_back(*number);
    }
  }
  return numbers;
}

/// The oracle for a number is the C library's strtod on the text without underscores.
void check_number(const Number& number) {
  CAPTURE(number.text);
  if (number.in_hertz) {
    return;  // see hertz_keys_test
  }
  std::string digits = number.text;
  digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
  const double expected = std::strtod(digits.c_str(), nullptr);
  CHECK(number.nearest == expected);
  CHECK(std::isfinite(number.value.lower()));
  CHECK(std::isfinite(number.value.upper()));
  CHECK(number.value.lower() <= expected);
  CHECK(expected <= number.value.upper());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(std::nextafter(number.tight.lower(), kInfinity) >= number.tight.upper());
  CHECK(number.tight.lower() <= expected);
  CHECK(expected <= number.tight.upper());
  // A unit in the last place around it, and no room where the number is a double or next to a limit of what
  // is allowed: 0, 1 and pi.
  const bool is_inner = number.tight.lower() > 1e-300 && number.tight.upper() < 1e300 &&
                        (number.tight.upper() < 0.9 || number.tight.lower() > 1.1) &&
                        (number.tight.upper() < 3.1 || number.tight.lower() > 3.2);
  if (!is_inner) {
    CHECK(number.value.lower() <= number.tight.lower());
    CHECK(number.value.upper() >= number.tight.upper());
    return;
  }
  const bool is_point = number.tight.lower() == number.tight.upper();
  CHECK(number.value.lower() ==
        (is_point ? number.tight.lower() : std::nextafter(number.tight.lower(), -kInfinity)));
  CHECK(number.value.upper() ==
        (is_point ? number.tight.upper() : std::nextafter(number.tight.upper(), kInfinity)));
}

/// Each number stands in the file where it is said to stand. ASCII lines only: there columns are bytes.
void check_position(const Number& number, const std::string& text) {
  if (number.position.line == 0) {
    return;
  }
  const std::string written = number.text.substr(0, number.text.find(' '));
  std::size_t start = 0;
  for (int line = 1; line < number.position.line; ++line) {
    start = text.find('\n', start) + 1;
    REQUIRE(start != 0);
  }
  CHECK(text.compare(start + static_cast<std::size_t>(number.position.column) - 1, written.size(), written) ==
        0);
}

std::string minimal() {
  return contents(kDesigns / "accepted" / "minimal.toml");
}

}  // namespace

TEST_CASE("every file in designs/accepted is a design") {
  for (const fs::path& path : toml_files(kDesigns / "accepted")) {
    CAPTURE(path.filename().string());
    Design design;
    REQUIRE_NOTHROW(design = read_design_file(path));
    std::string text = contents(path);
    if (text.starts_with("\xEF\xBB\xBF")) {
      text.erase(0, 3);
    }
    for (const Number& number : numbers_of(design)) {
      check_number(number);
      check_position(number, text);
    }
  }
}

TEST_CASE("every file in designs/rejected is refused with its message") {
  for (const fs::path& path : toml_files(kDesigns / "rejected")) {
    const std::string name = path.filename().string();
    CAPTURE(name);
    const std::string expected = contents(fs::path(path).replace_extension(".message"));
    CHECK(refusal(contents(path), name) + "\n" == name + expected);
  }
}

TEST_CASE("the example designs are designs, and honour their own assumptions") {
  for (const fs::path& path : toml_files(kSource / "designs")) {
    CAPTURE(path.filename().string());
    Design design;
    REQUIRE_NOTHROW(design = read_design_file(path));
    CHECK_FALSE(design.source.empty());
  }
}

TEST_CASE("the designs of Table 3.2 hold the numbers of Table 3.2") {
  struct Row {
    const char* figure;
    double q, epsilon, r;
  };
  for (const Row& row : {Row{"3.2", 0.0005, 0.05, 0.01}, Row{"3.3", 0.0065, 0.05, 0.01},
                         Row{"3.4", 0.0013, 0.01, 0.01}, Row{"3.5", 0.0023, 0.01, 0.05}}) {
    CAPTURE(row.figure);
    const Design design =
        read_design_file(kSource / "designs" / (std::string("la-scala-1994-figure-") + row.figure + ".toml"));
    CHECK(quadrature_tables(design).design.q1.nearest == row.q);
    CHECK(quadrature_tables(design).design.q2.nearest == row.q);
    CHECK(quadrature_tables(design).design.r.nearest == row.r);
    CHECK(quadrature_tables(design).design.epsilon.nearest == row.epsilon);
  }
}

TEST_CASE("docs/design-file.md names every key") {
  const std::string page = contents(kSource / "docs" / "design-file.md");
  for (const DesignFormat* format : design_formats()) {
    CHECK(page.find(format->tracker) != std::string::npos);
    std::any tables = format->empty_tables();
    for (const BoundTable& table : format->bind_tables(tables)) {
      CAPTURE(table.name);
      CHECK(page.find(fmt::format("`[{}]`", table.name)) != std::string::npos);
      for (const BoundKey& key : table.keys) {
        CHECK_MESSAGE(page.find(fmt::format("`{}`", key.name)) != std::string::npos, key.name);
      }
    }
  }
}

TEST_CASE("a number just inside what is allowed has no room beyond it") {
  const std::string text = contents(kSource / "tests" / "fuzz" / "corpus" / "design_reader" / "tiny.toml");
  const Design design = read_design(text, "tiny.toml");
  const auto& [q1, q2, r, epsilon] = quadrature_tables(design).design;
  CHECK(q1.value.lower() == 0.0);
  CHECK(q1.value.upper() > 0.0);
  CHECK(q2.value.lower() > 0.0);
  CHECK(r.value.lower() < r.tight.lower());
  CHECK(epsilon.value.upper() < 1.0);
}

TEST_CASE("everything is read to its place") {
  const Design design = read_design_file(kDesigns / "accepted" / "everything.toml");
  CHECK(design.name == "a design");
  CHECK(design.tracker == "quadrature-ekf");
  CHECK(design.source.empty());
  CHECK(quadrature_tables(design).design.epsilon.text == "0.0");
  CHECK(quadrature_tables(design).assume.amplitude.nearest == 2.5);
  CHECK(quadrature_tables(design).assume.frequency[0].nearest == 0.05);
  CHECK(quadrature_tables(design).assume.frequency[1].nearest == 3.0);
  CHECK(quadrature_tables(design).assume.noise.nearest == 0.001);
  CHECK(quadrature_tables(design).assume.slew.nearest == 1e-6);
  REQUIRE(quadrature_tables(design).assume.initial_covariance);
  CHECK((*quadrature_tables(design).assume.initial_covariance)[2][2].nearest == 1.0);
  CHECK((*quadrature_tables(design).assume.initial_covariance)[2][1].nearest == 0.0);
  REQUIRE(quadrature_tables(design).require.frequency_error_below);
  CHECK(quadrature_tables(design).require.frequency_error_below->nearest == 0.05);
  REQUIRE(quadrature_tables(design).require.settles_within);
  CHECK(quadrature_tables(design).require.settles_within->nearest == 200.0);
  REQUIRE(quadrature_tables(design).require.largest_noise_at_least);
  CHECK(quadrature_tables(design).require.largest_noise_at_least->nearest == 0.01);
  REQUIRE(quadrature_tables(design).require.settled_below);
  CHECK(quadrature_tables(design).require.settled_below->nearest == 0.01);
  REQUIRE(quadrature_tables(design).require.largest_slew_at_least);
  CHECK(quadrature_tables(design).require.largest_slew_at_least->nearest == 0.002);
  REQUIRE(quadrature_tables(design).require.frequency_error_radius_at_least);
  CHECK(quadrature_tables(design).require.frequency_error_radius_at_least->nearest == 0.1);
  CHECK(quadrature_tables(design).simulate.samples == 10'000'000);
  CHECK(quadrature_tables(design).simulate.seed == 9'223'372'036'854'775'807U);
  CHECK(quadrature_tables(design).simulate.signal == "la-scala-1994");
  CHECK(quadrature_tables(design).theorem_2_9.state_bound.nearest == 7.0);
  CHECK(quadrature_tables(design).theorem_2_9.sigma.nearest == 1e-3);
  CHECK(quadrature_tables(design).theorem_2_9.gamma_fraction.nearest == 0.5);
  CHECK(quadrature_tables(design).theorem_2_9.c1.nearest == 0.0);
  CHECK(quadrature_tables(design).theorem_2_9.c2.nearest == 3.5);
  CHECK(design.positions.at("name").line == 1);
  CHECK(design.positions.at("design.q1").line == 5);
  CHECK(design.positions.at("design.q1").column == 6);
  CHECK(design.positions.at("assume.initial_covariance").line == 18);
  CHECK(design.positions.at("simulate.seed").line == 28);
  CHECK_FALSE(design.positions.contains("source"));
}

TEST_CASE("what is left out has its default, and no position") {
  const Design design = read_design(minimal(), "x.toml");
  for (const auto& [number, expected] : {std::pair{quadrature_tables(design).assume.amplitude, 1.0},
                                         std::pair{quadrature_tables(design).assume.slew, 0.0},
                                         std::pair{quadrature_tables(design).theorem_2_9.state_bound, 7.0},
                                         std::pair{quadrature_tables(design).theorem_2_9.sigma, 1e-3},
                                         std::pair{quadrature_tables(design).theorem_2_9.gamma_fraction, 0.5},
                                         std::pair{quadrature_tables(design).theorem_2_9.c1, 3.0},
                                         std::pair{quadrature_tables(design).theorem_2_9.c2, 3.0}}) {
    CHECK(number.nearest == expected);
    CHECK(number.position.line == 0);
    CHECK(number.position.column == 0);
    check_number(number);
  }
  CHECK_FALSE(quadrature_tables(design).assume.initial_covariance);
  CHECK(quadrature_tables(design).simulate.samples == 1000);
  CHECK(quadrature_tables(design).simulate.seed == 1);
  CHECK(quadrature_tables(design).simulate.signal == "constant");
  CHECK(design.source.empty());
}

TEST_CASE("a decimal is the interval around it, not a double") {
  const Design design = read_design(minimal(), "x.toml");
  CHECK(quadrature_tables(design).design.q1.value.lower() <
        quadrature_tables(design).design.q1.value.upper());
  CHECK(quadrature_tables(design).design.epsilon.value.lower() == 0.0);
  CHECK(quadrature_tables(design).design.epsilon.value.upper() == 0.0);
}

TEST_CASE("random decimals arrive whole") {
  Random random(1);
  const std::string text = minimal();
  const std::int64_t count = effort(2000);
  for (std::int64_t trial = 0; trial < count; ++trial) {
    std::string number(1, static_cast<char>('0' + random.below(10)));
    if (random.below(2) == 0) {
      number += '.';
      const std::uint64_t digits = 1 + random.below(60);
      for (std::uint64_t digit = 0; digit < digits; ++digit) {
        const bool may_separate = number.back() != '.' && number.back() != '_';
        number += may_separate && random.below(8) == 0 ? "_" : "";
        number += static_cast<char>('0' + random.below(10));
      }
    }
    if (random.below(2) == 0) {
      number +=
          (random.below(2) == 0 ? "e" : "E") + std::to_string(static_cast<int>(random.below(600)) - 300);
    }
    const Design design = read_design(replaced(text, "noise = 0.001", "noise = " + number), "x.toml");
    const Number& read = quadrature_tables(design).assume.noise;
    CHECK(read.text == number);
    check_number(read);
  }
}

TEST_CASE("whatever the bytes, there is a design or an InputError of one printable line") {
  Random random(2);
  const std::string everything = contents(kDesigns / "accepted" / "everything.toml");
  const std::int64_t count = effort(3000);
  for (std::int64_t trial = 0; trial < count; ++trial) {
    std::string text = everything;
    const std::uint64_t edits = 1 + random.below(4);
    for (std::uint64_t edit = 0; edit < edits && !text.empty(); ++edit) {
      const std::size_t place = random.below(text.size());
      switch (random.below(3)) {
        case 0:
          text[place] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.erase(place, 1 + random.below(20));
          break;
        default: {
          const std::size_t source = random.below(text.size());
          const std::size_t length = 1 + random.below(20);
          text.insert(place, text.substr(source, length));
        }
      }
    }
    try {
      for (const Number& number : numbers_of(read_design(text, "x.toml"))) {
        check_number(number);
      }
    } catch (const InputError& error) {
      const std::string message = error.what();
      CHECK(message.starts_with("x.toml:"));
      CHECK(message.size() < 700);
      CHECK(std::none_of(message.begin(), message.end(),
                         [](char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F; }));
    }
  }
}

TEST_CASE("the caller's rounding mode neither matters nor changes") {
  CHECK_FALSE(rigor::rounding_is_upward());
  const Design outside = read_design(minimal(), "x.toml");
  CHECK_FALSE(rigor::rounding_is_upward());
  const rigor::UpwardRounding upward;
  const Design inside = read_design(minimal(), "x.toml");
  CHECK(rigor::rounding_is_upward());
  CHECK_THROWS_AS((void)read_design("", "x.toml"), InputError);
  CHECK(rigor::rounding_is_upward());
  CHECK(quadrature_tables(inside).design.q1.nearest == quadrature_tables(outside).design.q1.nearest);
  CHECK(rigor::identical(quadrature_tables(inside).design.q1.value,
                         quadrature_tables(outside).design.q1.value));
}

TEST_CASE("files that are no design files") {
  const ScratchFolder scratch;
  CHECK(file_refusal(scratch / "none.toml") == (scratch / "none.toml").string() +
                                                   ": cannot be read: No such file or directory; allowed: a "
                                                   "readable design file");
  CHECK(file_refusal(scratch.path()) == scratch.path().string() + ": is a directory; allowed: a design file");

  CHECK(refusal("") ==
        "x.toml:1:1: the file is empty; allowed: a design file with name, tracker, [design] and [assume]");

  std::ofstream(scratch / "file").close();
  CHECK(file_refusal(scratch / "file" / "x.toml").find("Not a directory") != std::string::npos);

  const fs::path pipe = scratch / "pipe.toml";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(file_refusal(pipe) == pipe.string() + ": is not a regular file; allowed: a design file");
  CHECK(file_refusal("/dev/zero") == "/dev/zero: is not a regular file; allowed: a design file");

  CHECK(file_refusal(scratch / "two\nlines\x1B[2J.toml").find("two\\x0Alines\\x1B[2J.toml: cannot be read") !=
        std::string::npos);
}

TEST_CASE("a file of up to 1 MiB is read, a larger one refused at once") {
  const ScratchFolder scratch;
  constexpr std::size_t kLimit = std::size_t{1} << 20;
  std::string text = minimal() + "# ";
  text.resize(kLimit, 'x');
  std::ofstream(scratch / "largest.toml") << text;
  CHECK_NOTHROW((void)read_design_file(scratch / "largest.toml"));
  std::ofstream(scratch / "larger.toml") << text << 'x';
  CHECK(file_refusal(scratch / "larger.toml")
            .ends_with(": has 1048577 bytes; allowed: a design file of up to 1 MiB"));
  CHECK(refusal(text + 'x').find("1048576 bytes") != std::string::npos);

  std::ofstream(scratch / "huge.toml").close();
  fs::resize_file(scratch / "huge.toml", 100'000'000);
  CHECK(file_refusal(scratch / "huge.toml")
            .ends_with(": has 100000000 bytes; allowed: a design file of up to 1 MiB"));
}

TEST_CASE("a file without permission") {
  const ScratchFolder scratch;
  const fs::path path = scratch / "secret.toml";
  std::ofstream(path) << minimal();
  fs::permissions(path, fs::perms::none);
  const UnprivilegedUser user(scratch.path());
  CHECK(file_refusal(path).ends_with(": cannot be read: Permission denied; allowed: a readable design file"));
}

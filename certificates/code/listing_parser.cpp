// The reader of what `listing_text` writes.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <vector>

#include "certificates/code/listing_formats.hpp"
#include "certificates/code/listing_text.hpp"

namespace veritrack::certificates::code {

namespace {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::OperationName;
using trackers::code::Place;
using trackers::code::Predicate;

class ListingParser {
 public:
  explicit ListingParser(std::string_view text) : text_(text) {}

  [[nodiscard]] Listing listing() {
    if (!take_line() || words_.size() != 3 || line_ != "veritrack listing 1") {
      fail("the first line is not \"veritrack listing 1\"");
    }
    while (take_line()) {
      read_line();
    }
    for (const trackers::code::State& state : listing_.states) {
      if (state.next < 0) {
        fail(fmt::format("{} has no next value", state.name));
      }
      if (format_of(state.next) != format_of(state.input)) {
        fail(fmt::format("the next {} has another format", state.name));
      }
    }
    if (listing_.frequency < 0 || listing_.states.empty() || listing_.samples.empty()) {
      fail("a listing without a frequency, states or samples");
    }
    if (!format_of(listing_.frequency).is_float) {
      fail("the frequency is no number");
    }
    return std::move(listing_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ListingError(fmt::format("line {} of a listing: {}", number_, what));
  }

  [[nodiscard]] Format format_of(int value) const {
    return listing_.instructions[static_cast<std::size_t>(value)].format;
  }

  [[nodiscard]] bool take_line() {
    if (text_.empty()) {
      return false;
    }
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) {
      fail("no end of the line");
    }
    line_ = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    ++number_;
    words_.clear();
    for (std::string_view rest = line_; !rest.empty();) {
      const std::size_t space = rest.find(' ');
      words_.push_back(rest.substr(0, space));
      rest.remove_prefix(space == std::string_view::npos ? rest.size() : space + 1);
    }
    if (words_.empty()) {
      fail("an empty line");
    }
    return true;
  }

  [[nodiscard]] std::string_view word(std::size_t i) const {
    if (i >= words_.size()) {
      fail("something is missing at the end");
    }
    return words_[i];
  }
  /// The words from i on, as they stand.
  [[nodiscard]] std::string rest_from(std::size_t i) const {
    const std::string_view first = word(i);
    return std::string(line_.substr(static_cast<std::size_t>(first.data() - line_.data())));
  }

  template <typename Integer>
  [[nodiscard]] Integer integer(std::string_view text, int base = 10) const {
    Integer value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
      fail(fmt::format("no number: {}", text));
    }
    return value;
  }

  [[nodiscard]] Format format(std::string_view text) const {
    const bool is_float = !text.empty() && text.front() == 'f';
    if (text.size() < 2 || (!is_float && text.front() != 'i')) {
      fail(fmt::format("no format: {}", text));
    }
    const Format result{is_float, integer<int>(text.substr(1))};
    if (is_float ? result.bits != 32 && result.bits != 64 : result.bits < 1 || result.bits > 64) {
      fail(fmt::format("no format: {}", text));
    }
    return result;
  }

  /// A place behind the words, if there is one, which is taken away.
  [[nodiscard]] Place place() {
    if (words_.back().substr(0, 1) != "@") {
      return {};
    }
    std::string_view text = words_.back().substr(1);
    std::array<int, 3> parts{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t end = k < 2 ? text.find(':') : text.size();
      parts[k] = integer<int>(text.substr(0, end));
      text.remove_prefix(std::min(text.size(), end == std::string_view::npos ? text.size() : end + 1));
    }
    words_.pop_back();
    if (parts[0] < 0 || static_cast<std::size_t>(parts[0]) >= listing_.files.size()) {
      fail("a place in a file that is not named");
    }
    return {parts[0], parts[1], parts[2]};
  }

  int add(const Instruction& instruction) {
    listing_.instructions.push_back(instruction);
    return static_cast<int>(listing_.instructions.size()) - 1;
  }

  /// The constant of a text, or nothing where it is a register's name.
  [[nodiscard]] std::optional<Instruction> constant(std::string_view text) const {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) {
      return std::nullopt;
    }
    Instruction result;
    result.format = format(text.substr(0, colon));
    const std::string value(text.substr(colon + 1));
    if (!result.format.is_float) {
      result.bits = integer<std::uint64_t>(value);
      if (trackers::code::wrapped(result.format, result.bits) != result.bits) {
        fail(fmt::format("a number that its format does not hold: {}", text));
      }
      return result;
    }
    if (value.substr(0, 4) == "bits") {
      result.bits = integer<std::uint64_t>(std::string_view(value).substr(4), 16);
    } else {
      char* end = nullptr;
      const double number = std::strtod(value.c_str(), &end);
      if (end != value.c_str() + value.size() || value.empty() || !std::isfinite(number)) {
        fail(fmt::format("no number: {}", text));
      }
      result.bits = trackers::code::bits_of(result.format, number);
    }
    if (constant_text(result.format, result.bits) != text) {
      fail(fmt::format("a constant that is not written as listings write it: {}", text));
    }
    return result;
  }

  [[nodiscard]] int value(std::string_view text) {
    if (const auto known = names_.find(std::string(text)); known != names_.end()) {
      return known->second;
    }
    const std::optional<Instruction> number = constant(text);
    if (!number) {
      fail(fmt::format("{} is no register yet", text));
    }
    return names_[std::string(text)] = add(*number);
  }

  void name(std::string_view text, int value) {
    if (text != fmt::format("r{}", count_)) {
      fail(fmt::format("{} where r{} is next", text, count_));
    }
    ++count_;
    names_[std::string(text)] = value;
  }

  void read_line() {
    const std::string_view first = word(0);
    if (first == "file") {
      if (integer<std::size_t>(word(1)) != listing_.files.size()) {
        fail("files are not in order");
      }
      listing_.files.push_back(rest_from(2));
    } else if (first == "sample") {
      Instruction input;
      input.operation = Operation::input;
      input.format = format(word(2));
      listing_.samples.push_back(add(input));
      name(word(1), listing_.samples.back());
      listing_.sample_names.push_back(rest_from(3));
    } else if (first == "state") {
      read_state();
    } else if (first == "steps-before") {
      if (words_.size() != 2 || listing_.steps_before != 0) {
        fail("two numbers of steps before");
      }
      listing_.steps_before = integer<int>(word(1));
    } else if (first == "table" || first == "library-table") {
      if (word(1) != fmt::format("t{}", listing_.tables.size())) {
        fail("tables are not in order");
      }
      if (first == "library-table") {
        listing_.library_tables.push_back(static_cast<int>(listing_.tables.size()));
      }
      listing_.tables.emplace_back();
      for (std::size_t i = 2; i < words_.size(); ++i) {
        listing_.tables.back().push_back(integer<std::uint64_t>(words_[i], 16));
      }
    } else if (first == "next") {
      const int state = value(word(1));
      const auto found = std::find_if(listing_.states.begin(), listing_.states.end(),
                                      [&](const trackers::code::State& each) { return each.input == state; });
      if (found == listing_.states.end() || found->next >= 0 || words_.size() != 3) {
        fail("no next value of a state, or a second one");
      }
      found->next = value(word(2));
    } else if (first == "frequency" && words_.size() == 2 && listing_.frequency < 0) {
      listing_.frequency = value(word(1));
    } else if (first == "must-be-zero") {
      read_obligation();
    } else {
      read_operation();
    }
  }

  void read_state() {
    const std::optional<Instruction> start = constant(word(2));
    if (!start) {
      fail("a state without a first value");
    }
    Instruction input;
    input.operation = Operation::input;
    input.format = start->format;
    trackers::code::State state{rest_from(3), add(input), -1, start->bits};
    name(word(1), state.input);
    listing_.states.push_back(std::move(state));
  }

  void read_obligation() {
    trackers::code::Obligation obligation{value(word(1)), "", {}};
    std::size_t text = 2;
    if (format_of(obligation.must_be_zero) != trackers::code::kBit) {
      fail("what must be 0 is no bit");
    }
    if (word(2).substr(0, 1) == "@") {
      const std::vector<std::string_view> all = words_;
      words_.resize(3);
      obligation.place = place();
      words_ = all;
      text = 3;
    }
    obligation.why = rest_from(text);
    listing_.obligations.push_back(obligation);
  }

  /// The operation of a text such as fcmp.olt.f32; the format is that of its operands for comparisons.
  [[nodiscard]] const OperationName& operation(std::string_view text, Instruction& instruction) {
    std::vector<std::string_view> parts;
    for (std::string_view rest = text; !rest.empty();) {
      const std::size_t dot = rest.find('.');
      parts.push_back(rest.substr(0, dot));
      rest.remove_prefix(dot == std::string_view::npos ? rest.size() : dot + 1);
    }
    if (parts.empty()) {
      fail("no operation");
    }
    const auto* found =
        std::find_if(trackers::code::kOperationNames.begin(), trackers::code::kOperationNames.end(),
                     [&](const OperationName& each) { return each.name == parts.front(); });
    if (found == trackers::code::kOperationNames.end()) {
      fail(fmt::format("no operation: {}", text));
    }
    instruction.operation = found->operation;
    const bool compares = found->operation == Operation::fcmp || found->operation == Operation::icmp;
    const bool is_table = found->operation == Operation::table;
    if (parts.size() != (compares || is_table ? 3U : 2U)) {
      fail(fmt::format("no operation: {}", text));
    }
    instruction.format = format(parts[compares ? 2 : 1]);
    if (compares) {
      const auto* predicate = std::find(trackers::code::kPredicateNames.begin() + 1,
                                        trackers::code::kPredicateNames.end(), parts[1]);
      if (predicate == trackers::code::kPredicateNames.end()) {
        fail(fmt::format("no comparison: {}", text));
      }
      instruction.predicate = static_cast<Predicate>(predicate - trackers::code::kPredicateNames.begin());
    }
    if (is_table) {
      instruction.table = parts[2].size() < 2 ? -1 : integer<int>(parts[2].substr(1));
      if (instruction.table < 0 || static_cast<std::size_t>(instruction.table) >= listing_.tables.size()) {
        fail("no table of that number");
      }
    }
    return *found;
  }

  void read_operation() {
    Instruction instruction;
    instruction.place = place();
    if (word(1) != "=") {
      fail("a line that is not understood");
    }
    const OperationName& operation = this->operation(word(2), instruction);
    if (words_.size() != 3 + static_cast<std::size_t>(operation.operands)) {
      fail("wrong number of operands");
    }
    for (std::size_t k = 0; k + 3 < words_.size(); ++k) {
      instruction.operands.at(k) = value(words_[k + 3]);
    }
    if (instruction.predicate != Predicate::none) {
      instruction.format = trackers::code::kBit;
    }
    if (!has_fitting_formats(listing_, instruction)) {
      fail("the formats of the operands do not fit to the operation");
    }
    name(word(0), add(instruction));
  }

  std::string_view text_, line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
  int count_ = 0;
  std::map<std::string, int> names_;
  Listing listing_;
};

}  // namespace

Listing parse_listing(std::string_view text) {
  Listing listing = ListingParser(text).listing();
  // Whatever else the reader has let pass: other orders, spaces, numbers in another form.
  const std::string written = listing_text(listing);
  if (written != text) {
    const auto differs = std::mismatch(written.begin(), written.end(), text.begin(), text.end()).first;
    throw ListingError(fmt::format("line {} of a listing is not as listings are written",
                                   1 + std::count(written.begin(), differs, '\n')));
  }
  return listing;
}

}  // namespace veritrack::certificates::code

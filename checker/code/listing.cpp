#include "checker/code/listing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "checker/code/listed_operations.hpp"
#include "checker/document/json_tree.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostLines = 100'000;

/// The parts of a text between marks; none is left out.
std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) {
      return parts;
    }
    text.remove_prefix(end + 1);
  }
}

/// The kinds of lines in their order.
enum class Section { file, steps_before, sample, state, table, operation, next, frequency, must_be_zero };

class ListingReader {
 public:
  CodeListing read(const std::string& text) {
    std::vector<std::string_view> lines = split(text, '\n');
    if (lines.size() < 2 || lines.front() != "veritrack listing 1" || !lines.back().empty()) {
      throw Malformed("a listing begins with \"veritrack listing 1\" and ends with a line end");
    }
    if (lines.size() > kMostLines) {
      throw Malformed("a listing with more than 100000 lines");
    }
    for (number_ = 2; number_ < lines.size(); ++number_) {
      read_line(lines[number_ - 1]);
    }
    if (listing_.samples.empty() || listing_.states.empty() || listing_.frequency < 0 ||
        next_ != listing_.states.size()) {
      fail("a sample, a state, a next value of a state or the frequency is missing");
    }
    require_frequency_of_states();
    return std::move(listing_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Malformed("line " + std::to_string(number_) + " of the listing: " + what);
  }
  void require(bool is_so, const char* otherwise) const {
    if (!is_so) {
      fail(otherwise);
    }
  }
  void enter(Section section) {
    require(section >= section_, "a line that belongs before others");
    section_ = section;
  }

  template <typename Whole>
  [[nodiscard]] Whole whole(std::string_view text, int base = 10) const {
    Whole value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    const bool is_plain = !text.empty() && text[0] != '-' && (text[0] != '0' || text.size() == 1);
    require(error == std::errc() && end == text.data() + text.size() && is_plain,
            "something that is no number");
    return value;
  }

  [[nodiscard]] ListedFormat format(std::string_view text) const {
    require(text.size() > 1 && (text[0] == 'f' || text[0] == 'i'), "something that is no format");
    const ListedFormat format{text[0] == 'f', whole<int>(text.substr(1))};
    require(format.is_float ? format.bits == 32 || format.bits == 64 : format.bits >= 1 && format.bits <= 64,
            "something that is no format");
    return format;
  }

  /// "-0x1.8p+3": with one digit before the point, as a double.
  [[nodiscard]] double hexadecimal(std::string_view text) const {
    std::string_view rest = text.substr(text.starts_with('-') ? 1 : 0);
    const std::size_t exponent = rest.find('p');
    require(rest.starts_with("0x") && exponent != std::string_view::npos, "something that is no number");
    std::string_view digits = rest.substr(2, exponent - 2);
    std::string_view power = rest.substr(exponent + 1);
    const auto all = [](std::string_view part, std::string_view of) {
      return !part.empty() && part.find_first_not_of(of) == std::string_view::npos;
    };
    const bool is_whole = digits.size() == 1 && all(digits, "01");
    const bool has_point = digits.size() > 2 && all(digits.substr(0, 1), "01") && digits[1] == '.' &&
                           all(digits.substr(2), "0123456789abcdef");
    require((is_whole || has_point) && power.size() > 1 && (power[0] == '+' || power[0] == '-') &&
                all(power.substr(1), "0123456789") && text.size() < 32,
            "something that is no number");
    const double value = std::strtod(std::string(text).c_str(), nullptr);
    require(std::isfinite(value), "something that is no number");
    return value;
  }

  /// A constant "f32:0x1p-1", "f32:bits7fc00000", "i1:1".
  [[nodiscard]] ListedOperation constant(std::string_view text) const {
    const std::size_t colon = text.find(':');
    require(colon != std::string_view::npos, "a register that no line before defines");
    ListedOperation result;
    result.name = "constant";
    result.format = format(text.substr(0, colon));
    const std::string_view value = text.substr(colon + 1);
    if (!result.format.is_float) {
      result.integer = whole<std::uint64_t>(value);
      require(result.format.bits == 64 || result.integer >> static_cast<unsigned>(result.format.bits) == 0,
              "a number that its format does not hold");
    } else if (value.starts_with("bits")) {
      const auto bits = whole<std::uint64_t>(value.substr(4), 16);
      require(result.format.bits == 64 || bits >> 32U == 0, "a number that its format does not hold");
      result.number = result.format.bits == 64
                          ? std::bit_cast<double>(bits)
                          : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      require(!std::isfinite(result.number), "a number that is written as bits");
    } else {
      result.number = hexadecimal(value);
      const bool fits = result.format.bits == 64 ||
                        (std::fabs(result.number) <= 0x1.fffffep+127 &&
                         static_cast<double>(static_cast<float>(result.number)) == result.number);
      require(fits, "a number that its format does not hold");
    }
    return result;
  }

  int add(ListedOperation operation) {
    listing_.operations.push_back(std::move(operation));
    return static_cast<int>(listing_.operations.size()) - 1;
  }
  /// A register's name, or a constant.
  int value(std::string_view text) {
    const auto known = registers_.find(text);
    return known != registers_.end() ? known->second
                                     : registers_.emplace(text, add(constant(text))).first->second;
  }
  void define(std::string_view name, int place) {
    require(name == "r" + std::to_string(count_++), "registers are not in order");
    registers_.emplace(name, place);
  }
  int input(ListedFormat format) {
    ListedOperation operation;
    operation.name = "input";
    operation.format = format;
    return add(std::move(operation));
  }

  /// "@file:line:column".
  [[nodiscard]] bool is_place(std::string_view word) const {
    if (!word.starts_with('@')) {
      return false;
    }
    const std::vector<std::string_view> parts = split(word.substr(1), ':');
    require(parts.size() == 3 && whole<std::size_t>(parts[0]) < files_, "a place that is in no file");
    (void)whole<int>(parts[1]);
    (void)whole<int>(parts[2]);
    return true;
  }

  /// The words from number `first` on, as they stand: printable characters.
  [[nodiscard]] std::string name_from(const std::vector<std::string_view>& words, std::size_t first) const {
    std::string text;
    for (std::size_t i = first; i < words.size(); ++i) {
      text.append(i > first ? " " : "").append(words[i]);
    }
    const auto is_printable = [](unsigned char c) { return c >= ' ' && c < 0x7fU; };
    require(!text.empty() && std::all_of(text.begin(), text.end(), is_printable), "something without a name");
    return text;
  }

  void read_line(std::string_view line) {
    std::vector<std::string_view> words = split(line, ' ');
    const std::string_view kind = words[0];
    const std::size_t size = words.size();
    if (kind == "file" && size >= 3) {
      enter(Section::file);
      require(whole<std::size_t>(words[1]) == files_++, "files are not in order");
      (void)name_from(words, 2);
    } else if (kind == "steps-before" && size == 2) {
      require(listing_.steps_before == 0, "a second number of steps");
      enter(Section::steps_before);
      listing_.steps_before = whole<int>(words[1]);
      require(listing_.steps_before > 0, "a number of steps that is not above 0");
    } else if (kind == "sample" && size >= 4) {
      enter(Section::sample);
      listing_.samples.push_back(input(format(words[2])));
      define(words[1], listing_.samples.back());
      listing_.sample_names.push_back(name_from(words, 3));
    } else if (kind == "state" && size >= 4) {
      enter(Section::state);
      const ListedOperation start = constant(words[2]);
      listing_.states.push_back({name_from(words, 3), input(start.format), -1, start.number});
      define(words[1], listing_.states.back().input);
    } else if (kind == "table" && size >= 3) {
      enter(Section::table);
      require(words[1] == "t" + std::to_string(tables_++), "tables are not in order");
      std::for_each(words.begin() + 2, words.end(), [&](auto word) { (void)whole<std::uint64_t>(word, 16); });
    } else if (kind == "next" && size == 3) {
      read_next(words);
    } else if (kind == "frequency" && size == 2) {
      enter(Section::frequency);
      require(listing_.frequency < 0, "a second frequency");
      listing_.frequency = value(words[1]);
      require(listing_.at(listing_.frequency).format.is_float, "a frequency that is no number");
    } else if (kind == "must-be-zero" && size >= 3) {
      enter(Section::must_be_zero);
      const int bit = value(words[1]);
      require(listing_.at(bit).format == ListedFormat{false, 1}, "an obligation that is no bit");
      listing_.obligations.push_back({bit, name_from(words, is_place(words[2]) ? 3 : 2)});
    } else if (size >= 4 && words[1] == "=") {
      enter(Section::operation);
      if (is_place(words.back())) {
        words.pop_back();
      }
      read_operation(words);
    } else {
      fail("something that is no line of a listing");
    }
  }

  void read_next(const std::vector<std::string_view>& words) {
    enter(Section::next);
    require(next_ < listing_.states.size(), "a next value of no state");
    ListedState& state = listing_.states[next_++];
    const auto named = registers_.find(words[1]);
    require(named != registers_.end() && named->second == state.input, "next values are not in order");
    state.next = value(words[2]);
    require(listing_.at(state.next).format == listing_.at(state.input).format,
            "a next value of another format than the state");
  }

  void read_operation(const std::vector<std::string_view>& words) {
    require(words.size() >= 4, "an operation without operands");
    ListedOperation operation;
    const std::vector<std::string_view> parts = split(words[2], '.');
    operation.name = parts[0];
    const bool compares = operation.is("fcmp") || operation.is("icmp");
    const bool is_table = operation.is("table");
    require(parts.size() == (compares || is_table ? 3U : 2U), "an operation without its format");
    operation.predicate = compares ? std::string(parts[1]) : "";
    const ListedFormat written = format(parts[compares ? 2 : 1]);
    operation.format = compares ? ListedFormat{false, 1} : written;
    require(!is_table || (parts[2].starts_with('t') && whole<std::size_t>(parts[2].substr(1)) < tables_),
            "a table that is not there");
    std::vector<ListedFormat> formats;
    for (std::size_t i = 3; i < words.size(); ++i) {
      operation.operands.push_back(value(words[i]));
      formats.push_back(listing_.at(operation.operands.back()).format);
    }
    if (const char* objection = objection_to_operation(operation, written, formats)) {
      fail(objection);
    }
    const int place = add(std::move(operation));
    define(words[0], place);
  }

  /// Operands stand before their operation.
  void require_frequency_of_states() const {
    std::vector<bool> has_sample(listing_.operations.size(), false);
    for (const int sample : listing_.samples) {
      has_sample[static_cast<std::size_t>(sample)] = true;
    }
    for (std::size_t i = 0; i < has_sample.size(); ++i) {
      for (const int operand : listing_.operations[i].operands) {
        has_sample[i] = has_sample[i] || has_sample[static_cast<std::size_t>(operand)];
      }
    }
    if (has_sample[static_cast<std::size_t>(listing_.frequency)]) {
      throw Malformed("the frequency of the listing depends on a sample");
    }
  }

  CodeListing listing_;
  std::map<std::string, int, std::less<>> registers_;  ///< and constants
  std::size_t number_ = 1;
  Section section_ = Section::file;
  std::size_t files_ = 0, tables_ = 0, next_ = 0;
  int count_ = 0;
};

}  // namespace

CodeListing read_listing(const std::string& text) {
  return ListingReader().read(text);
}

}  // namespace veritrack::checker

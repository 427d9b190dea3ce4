#include "reports/recording/samples/csv_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "certificates/design/input_error.hpp"

namespace veritrack::reports {

namespace {

using certificates::Position;

constexpr std::string_view kBlanks = " \t";

int limited(std::int64_t number) {
  return static_cast<int>(std::min<std::int64_t>(number, INT32_MAX));
}

/// A field without the blanks around it; a tab that parts fields is none of them.
CsvField trimmed(std::string_view text, Position position) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {{}, position};
  }
  position.column += static_cast<int>(first);
  return {text.substr(first, text.find_last_not_of(kBlanks) + 1 - first), position};
}

}  // namespace

void CsvRecords::refuse(Position position, const std::string& message) const {
  throw certificates::InputError(lines_.name(), position, message);
}

Position CsvRecords::position_of(std::size_t column) const {
  return {limited(lines_.line()), limited(static_cast<std::int64_t>(column) + 1)};
}

void CsvRecords::choose_separator(std::string_view line) {
  // Outside of quotes.
  bool quoted = false;
  std::array<std::size_t, 3> counts{};
  constexpr std::string_view kSeparators = ",;\t";
  for (const char c : line) {
    quoted = quoted != (c == '"');
    const std::size_t which = kSeparators.find(c);
    if (!quoted && which != std::string_view::npos) {
      ++counts.at(which);
    }
  }
  separator_ = counts[0] > 0 ? ',' : counts[1] > 0 ? ';' : counts[2] > 0 ? '\t' : ',';
}

bool CsvRecords::next() {
  for (;;) {
    const std::optional<std::string_view> line = lines_.next();
    if (!line) {
      return false;
    }
    if (line->starts_with('#') || line->find_first_not_of(kBlanks) == std::string_view::npos) {
      continue;
    }
    if (separator_ == 0) {
      if (line->starts_with("\xff\xfe") || line->starts_with("\xfe\xff")) {
        refuse(position_of(0), "text in UTF-16; allowed: UTF-8");
      }
      choose_separator(*line);
    }
    fields_.clear();
    if (line->find('"') == std::string_view::npos) {
      split(*line);
    } else {
      split_quoted(*line);
    }
    return true;
  }
}

void CsvRecords::split(std::string_view line) {
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(line.find(separator_, begin), line.size());
    fields_.push_back(trimmed(line.substr(begin, end - begin), position_of(begin)));
    if (end == line.size()) {
      return;
    }
    begin = end + 1;
  }
}

void CsvRecords::split_quoted(std::string_view line) {
  unquoted_.clear();
  record_.assign(line);
  std::size_t line_begin = 0;  // in record_, of the line that is being read
  std::size_t at = 0;
  const auto is_at_blank = [&] {
    return at < record_.size() && record_[at] != separator_ && kBlanks.find(record_[at]) != kBlanks.npos;
  };
  for (;;) {
    const std::size_t begin = at;
    while (is_at_blank()) {
      ++at;
    }
    if (at == record_.size() || record_[at] != '"') {
      const std::size_t end = std::min(record_.find(separator_, begin), record_.size());
      unquoted_.emplace_back(record_, begin, end - begin);
      fields_.push_back(trimmed(unquoted_.back(), position_of(begin - line_begin)));
      at = end;
    } else {
      const Position quote = position_of(at - line_begin);
      std::string& text = unquoted_.emplace_back();
      for (++at;;) {
        const std::size_t closing = std::min(record_.find('"', at), record_.size());
        text.append(record_, at, closing - at);
        at = closing;
        if (at == record_.size()) {
          const std::optional<std::string_view> more = lines_.next();
          if (!more) {
            refuse(quote, "a quote that is not closed; allowed: a quote at the end of the field");
          }
          record_ += '\n';
          text += '\n';
          line_begin = at = record_.size();
          record_ += *more;
          if (record_.size() > LineSource::kLongestLine) {
            refuse(quote,
                   fmt::format("a record of more than {} bytes; allowed: less", LineSource::kLongestLine));
          }
        } else if (at + 1 < record_.size() && record_[at + 1] == '"') {
          text += '"';
          at += 2;
        } else {
          ++at;
          break;
        }
      }
      fields_.push_back({text, quote});
      while (is_at_blank()) {
        ++at;
      }
      if (at < record_.size() && record_[at] != separator_) {
        refuse(position_of(at - line_begin),
               "text behind a quoted field; allowed: the separator or the end of the line");
      }
    }
    if (at == record_.size()) {
      return;
    }
    ++at;
  }
}

}  // namespace veritrack::reports

#include "mesh/io/csv_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/number_text.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

using namespace std::string_view_literals;

constexpr const char* csv_remedy = "write a header and one row a value, such as meshfolio curvature --csv gives";
constexpr char blanks = ' ';   // as a separator: any number of them

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%'); }

std::string_view without_blanks(std::string_view word) {
    const std::size_t first = word.find_first_not_of(" \t"), last = word.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view() : word.substr(first, last - first + 1);
}

/// Returns a cell without blanks and quotes around it.
std::string_view bare(std::string_view word) {
    word = without_blanks(word);
    const bool is_quoted = word.size() > 1 && word.front() == '"' && word.back() == '"';
    return is_quoted ? without_blanks(word.substr(1, word.size() - 2)) : word;
}

/// Iterates over the cells of a line.
class CellScanner {
public:
    CellScanner(std::string_view line, char separator) : rest_(line), separator_(separator) {}

    /// Moves to the next cell; false at the end of the line.
    bool next() {
        if (separator_ == blanks) {
            cell_ = bare(take_word(rest_));
            return !cell_.empty();
        }
        if (at_end_) return false;
        bool is_quoted = false;
        std::size_t end = 0;
        for (; end < rest_.size() && (is_quoted || rest_[end] != separator_); ++end) is_quoted ^= rest_[end] == '"';
        cell_ = bare(rest_.substr(0, end));
        at_end_ = end == rest_.size();
        rest_.remove_prefix(at_end_ ? end : end + 1);
        return true;
    }
    std::string_view cell() const { return cell_; }

private:
    std::string_view rest_, cell_;
    char separator_;
    bool at_end_ = false;
};

char separator_of(std::string_view line) {
    for (const char separator : ";\t,"sv) {
        CellScanner cells(line, separator);
        if (cells.next() && cells.next()) return separator;
    }
    return blanks;
}

struct Number {
    double value = std::numeric_limits<double>::quiet_NaN(), rounding = 0;
    bool is_infinite = false;
};

/// Returns half a unit of the last digit of a decimal number: 0.00005 for "0.0012".
double rounding_of(std::string_view number) {
    const std::size_t power = number.find_first_of("eE"), end = std::min(power, number.size()), point = std::min(number.find('.'), end);
    const long long exponent = power < number.size() ? parse_integer(number.substr(power + 1)).value_or(0) : 0;
    const auto decimals = point < end ? end - point - 1 : 0;
    return 0.5 * std::pow(10.0, static_cast<double>(exponent) - static_cast<double>(decimals));
}

/// Returns the number in a cell, or nothing if it is not a number.
std::optional<Number> number_in(std::string_view cell, char separator) {
    constexpr std::array undefined{"nan"sv, "nan(ind)"sv, "na"sv};
    constexpr std::array infinite{"inf"sv, "infinity"sv};
    const bool has_sign = cell.starts_with('-') || cell.starts_with('+');
    const auto is_cell = [&](std::string_view word) { return same_but_for_case(cell.substr(has_sign ? 1 : 0), word); };
    if (cell.empty() || std::ranges::any_of(undefined, is_cell)) return Number{};
    if (std::ranges::any_of(infinite, is_cell)) return Number{.is_infinite = true};
    std::string text(cell);
    if (separator != ',') std::ranges::replace(text, ',', '.');
    const auto value = parse_number(text);
    if (!value) return {};
    return Number{*value, rounding_of(text)};
}

struct Header {
    LineScanner rows;   // before the first one
    char separator = blanks;
    std::size_t columns = 1, place = 0;   // their number, and the requested one
};

/// Returns the header in a line and the place of the requested column, or nothing if the line has none of the names.
std::optional<Header> header_in(std::string_view line, const std::vector<std::string>& names, const LineScanner& rows) {
    std::size_t best = 2 * names.size();   // the names in their own case, then the names in another case
    const auto is_better = [&](std::string_view cell) {
        for (std::size_t i = 0; i < best; ++i) {
            const std::string& name = names[i % names.size()];
            if (i < names.size() ? cell != name : !same_but_for_case(cell, name)) continue;
            best = i;
            return true;
        }
        return false;
    };
    Header header{rows};
    if (is_better(bare(line))) return header;   // the only column, and its name may have blanks
    header.separator = separator_of(line);
    header.columns = 0;
    for (CellScanner cells(line, header.separator); cells.next(); ++header.columns)
        if (is_better(cells.cell())) header.place = header.columns;
    return best < 2 * names.size() ? std::optional(header) : std::nullopt;
}

/// Returns the header of the table. @throws InputError if there is none
Header header_of(std::string_view bytes, const std::string& file, const std::vector<std::string>& names) {
    std::string seen;
    LineScanner lines(without_bom(bytes)), rows = lines;   // rows: behind the last comment, where blank lines may be empty cells
    while (lines.next()) {
        std::string_view line = without_blanks(lines.line());
        if (line.empty()) continue;
        if (seen.empty()) seen = in_quotes(line, 200);
        const bool is_left_out = is_comment(line);
        if (is_left_out) line = without_blanks(line.substr(1));
        if (const auto header = header_in(line, names, lines)) return *header;
        if (is_left_out) {
            rows = lines;
            continue;
        }
        if (separator_of(line) == blanks && number_in(bare(line), blanks)) return {rows};
        throw InputError({file, lines.number()}, "no column " + in_quotes(joined(names, " or ")), "the header is " + seen);
    }
    throw InputError({file, 0}, seen.empty() ? "file is empty" : "no row of numbers", csv_remedy);
}

/// Moves to the next row that is not left out; false at the end.
bool next_row(LineScanner& lines, bool with_blank_ones) {
    while (lines.next()) {
        const std::string_view line = without_blanks(lines.line());
        if (line.empty() ? with_blank_ones : !is_comment(line)) return true;
    }
    return false;
}

/// Returns the number in the requested column of a line.
Number number_of(const LineScanner& line, const Header& header, const std::string& file) {
    const Location here{file, line.number()};
    std::size_t count = 0;
    std::string_view wanted, last;
    for (CellScanner cells(line.line(), header.separator); cells.next(); ++count) {
        last = cells.cell();
        if (count == header.place) wanted = last;
    }
    const bool has_separator_at_end = count == header.columns + 1 && last.empty();
    if (count > 0 && count != header.columns && !has_separator_at_end)
        throw InputError(here, std::to_string(count) + " cells, the header has " + std::to_string(header.columns), csv_remedy);
    const auto number = number_in(wanted, header.separator);
    if (!number) throw InputError(here, in_quotes(wanted) + " is not a finite number", "leave the cell empty where there is no value");
    if (std::abs(number->value) > largest_coordinate)   // differences must not overflow
        throw InputError(here, in_quotes(wanted) + " is out of the supported range (1e100)", "scale the values");
    return *number;
}

}   // namespace

NumberColumn csv_column(std::string_view bytes, const std::string& file, const std::vector<std::string>& names, Eigen::Index rows,
                        MoreRows more) {
    refuse_nul_bytes(bytes, file);
    const Header header = header_of(bytes, file, names);
    Eigen::Index filled = 0;
    for (LineScanner lines = header.rows; filled < rows && next_row(lines, false);) ++filled;
    const bool blank_is_empty = header.columns == 1 && filled < rows;
    const std::string asked_for = std::to_string(rows) + " are asked for";
    NumberColumn column{.values = Vector(rows), .rounding = Vector(rows)};
    LineScanner lines = header.rows;
    for (Eigen::Index i = 0; i < rows; ++i) {
        if (!next_row(lines, blank_is_empty))
            throw InputError({file, lines.number()}, "ends after " + std::to_string(i) + " rows, " + asked_for, csv_remedy);
        const Number number = number_of(lines, header, file);
        column.values[i] = number.value;
        column.rounding[i] = number.rounding;
        if (number.is_infinite && column.first_infinite == 0) column.first_infinite = lines.number();
    }
    if (more == MoreRows::refused && next_row(lines, false))
        throw InputError({file, lines.number()}, "has more rows than " + asked_for, "remove the rows from this line on");
    return column;
}

}   // namespace meshfolio

/// @file
/// The data behind the header of a PLY file, as text or binary: values one after the other, through the same interface.
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <string_view>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/ply_header.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

/// Values as text: a row of an element is a line.
class TextBody {
public:
    TextBody(std::string_view bytes, const PlyHeader& header, const std::string& file)
        : lines_(bytes.substr(header.size)), header_lines_(header.lines), file_(file) {}

    long line() const { return header_lines_ + lines_.number(); }

    /// Moves to the next line that is not blank, which is the row.
    void begin_row(const PlyElement& element) {
        while (lines_.next()) {
            rest_ = lines_.line();
            std::string_view look = rest_;
            if (!take_word(look).empty()) return;
        }
        throw InputError({file_, 0}, "ends early within element " + in_quotes(element.name), "the file may be cut off");
    }

    void end_row(const PlyElement& element) {
        if (take_word(rest_).empty()) return;
        throw InputError(here(), "more values than element " + in_quotes(element.name) + " has", "each row must be one line of its own");
    }

    double number(ScalarType) { return checked_coordinate(word(), file_, line()); }

    long long integer(ScalarType) {
        const std::string_view value = word();
        const std::optional<long long> i = parse_integer(value);
        if (!i) throw InputError(here(), "bad number " + in_quotes(value), "a whole number belongs here");
        return *i;
    }

    /// Returns the value of a column, which may be NaN or infinite but must fit its type.
    double any_number(ScalarType type) {
        const std::string_view value = word();
        const std::optional<double> x = value_of_type(value, type);
        if (!x)
            throw InputError(here(), in_quotes(value) + " is no number of type " + std::string(ply_name_of(type)),
                             "the header says what belongs here");
        return *x;
    }

    void skip(ScalarType, long long times) {
        for (long long i = 0; i < times; ++i) word();
    }

    void end(WarningTally& warnings) {
        while (lines_.next()) {
            std::string_view line = lines_.line();
            if (take_word(line).empty()) continue;
            return warnings.add(this->line(), "text after the last element ignored", "texts after the last element ignored");
        }
    }

private:
    std::string_view word() {
        const std::string_view value = take_word(rest_);
        if (value.empty()) throw InputError(here(), "too few values on the line", "the file may be cut off");
        return value;
    }

    Location here() const { return {file_, line()}; }

    LineScanner lines_;
    std::string_view rest_;
    long header_lines_;
    const std::string& file_;
};

/// Values as bytes, without lines.
class BinaryBody {
public:
    BinaryBody(std::string_view bytes, const PlyHeader& header, const std::string& file)
        : bytes_(bytes),
          at_(header.size),
          swap_((header.format == PlyHeader::Format::big_endian) != (std::endian::native == std::endian::big)),
          file_(file) {}

    long line() const { return 0; }
    void begin_row(const PlyElement&) {}
    void end_row(const PlyElement&) {}

    double number(ScalarType type) {
        need(size_of(type));
        at_ += size_of(type);
        return number_at(bytes_.data() + at_ - size_of(type), type);
    }
    long long integer(ScalarType type) { return static_cast<long long>(number(type)); }   // of 32 bits at most
    double any_number(ScalarType type) { return number(type); }

    void skip(ScalarType type, long long times) {
        // `times` comes from a list length of at most 32 bits: the product cannot overflow.
        const auto bytes = static_cast<std::size_t>(times) * size_of(type);
        need(bytes);
        at_ += bytes;
    }

    /// Returns the first of `count` rows of `size` bytes each, without skipping them; null if there are fewer.
    const char* rows(long long count, std::size_t size) const {
        return static_cast<std::size_t>(count) <= (bytes_.size() - at_) / size ? bytes_.data() + at_ : nullptr;
    }
    void skip_rows(long long count, std::size_t size) { at_ += static_cast<std::size_t>(count) * size; }
    double number_at(const char* raw, ScalarType type) const {
        return with_zero_of(type, [&](auto zero) { return static_cast<double>(value_at<decltype(zero)>(raw, swap_)); });
    }

    void end(WarningTally& warnings) const {
        if (at_ == bytes_.size()) return;
        const char* const message = "bytes after the last element ignored";
        warnings.add(0, message, message, std::to_string(bytes_.size() - at_));
    }

private:
    void need(std::size_t bytes) const {
        if (bytes_.size() - at_ >= bytes) return;
        throw InputError({file_, 0}, "ends early (byte " + std::to_string(bytes_.size()) + ")", "the file may be cut off");
    }

    std::string_view bytes_;
    std::size_t at_;
    bool swap_;
    const std::string& file_;
};

}   // namespace meshfolio

#include <array>
#include <cmath>
#include <cstdint>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

constexpr std::size_t header_bytes = 84;   // 80 of text, 4 of count
constexpr std::size_t triangle_bytes = 50;

/// Reader of "solid name  facet normal … outer loop  vertex … (3) endloop endfacet … endsolid name", any number of solids. Keywords of two
/// words may be written as one, those of one word as two, and lines may end anywhere but within a vertex.
class TextStl {
public:
    TextStl(std::string_view text, const std::string& file) : words_(text), file_(file) {}

    LoadedMesh run() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (same_but_for_case(word, "solid")) {
                open_ = true;
                skip_name();
            } else if (is_keyword(word, "end", "solid")) {
                open_ = skip_name();
            } else if (is_keyword(word, "facet", "normal")) {
                facet(true);
            } else if (same_but_for_case(word, "facet")) {
                facet(false);
            } else {
                fail("expected 'facet' or 'endsolid', found " + in_quotes(word));
            }
        }
        if (open_) warnings_.add(0, "no endsolid", "endsolids missing");
        return welded(corners_, {}, lines_, file_, std::move(warnings_)).loaded;
    }

private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError({file_, words_.line()}, problem, "the file may be damaged or cut off");
    }

    /// True if the word is the keyword, or its first half and the second half is next on the line, which is then taken.
    bool is_keyword(std::string_view word, const std::string& first, const std::string& second) {
        std::string_view rest = words_.rest_of_line();
        if (!same_but_for_case(word, first) || !same_but_for_case(take_word(rest), second)) return same_but_for_case(word, first + second);
        words_.next_on_line();
        return true;
    }

    /// Skips the name of a solid, which ends at a facet on the same line. Returns true if there is such a facet.
    bool skip_name() {
        for (;;) {
            std::string_view rest = words_.rest_of_line();
            const std::string_view word = take_word(rest);
            const bool is_facet = same_but_for_case(word, "facetnormal") ||
                                  (same_but_for_case(word, "facet") && same_but_for_case(take_word(rest), "normal"));
            const std::string_view number = take_word(rest);
            if (is_facet && (number.empty() || parse_number(number) || same_but_for_case(number, "nan"))) return true;
            if (words_.next_on_line().empty()) return false;
        }
    }

    void expect(const std::string& first, const std::string& second = "") {
        const std::string_view word = words_.next();
        if (word.empty()) fail("ends inside a facet");
        if (!is_keyword(word, first, second)) fail("expected '" + first + second + "', found " + in_quotes(word));
    }

    /// Reads a facet without its normal, which the winding gives more exactly. Its numbers may be on later lines.
    void facet(bool has_normal) {
        lines_.push_back(words_.line());
        int numbers = has_normal ? 0 : -1;   // behind "normal"
        for (std::string_view word = words_.next(); !is_keyword(word, "outer", "loop"); word = words_.next(), ++numbers) {
            const bool is_part = numbers < 0 ? same_but_for_case(word, "normal") : numbers < 3;
            if (word.empty()) fail("ends inside a facet");
            if (!is_part) fail("expected 'outer loop', found " + in_quotes(word));
        }
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            std::array<double, 3> corner{};
            for (double& x : corner) x = coordinate();
            corners_.push_back(corner);
        }
        expect("end", "loop");
        expect("end", "facet");
    }

    double coordinate() {
        const std::string_view word = words_.next_on_line();
        if (word.empty()) fail("'vertex' needs 3 coordinates");
        return checked_coordinate(word, file_, words_.line());
    }

    WordScanner words_;
    const std::string& file_;
    std::vector<std::array<double, 3>> corners_;
    std::vector<long> lines_;
    WarningTally warnings_;
    bool open_ = false;
};

LoadedMesh parse_binary(std::string_view bytes, const std::string& file) {
    if (bytes.size() < header_bytes)
        throw InputError({file, 0}, "too short for binary STL (" + std::to_string(bytes.size()) + " bytes)", "the file may be cut off");
    const std::size_t count = little_endian<std::uint32_t>(bytes.data() + 80);
    const std::size_t room = (bytes.size() - header_bytes) / triangle_bytes;
    if (count > room)
        throw InputError({file, 0}, std::to_string(count) + " triangles announced, room for " + std::to_string(room),
                         "the file may be cut off, or is not STL: export it again");
    WarningTally warnings;
    const std::size_t trailing = bytes.size() - header_bytes - count * triangle_bytes;
    if (trailing > 0)
        warnings.add(0, "bytes after the last triangle ignored", "bytes after the last triangle ignored", std::to_string(trailing));
    std::vector<std::array<double, 3>> corners(3 * count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        // Behind the normal (12 bytes, left out) come three corners of three floats, then two bytes of attributes.
        const std::size_t at = header_bytes + i / 3 * triangle_bytes + 12 + i % 3 * 12;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float x = little_endian<float>(bytes.data() + at + 4 * axis);
            if (!std::isfinite(x))
                throw InputError({file, 0}, "triangle " + std::to_string(i / 3) + ": coordinate is " + (std::isnan(x) ? "nan" : "inf"),
                                 "every coordinate must be finite");
            corners[i][axis] = x;
        }
    }
    return welded(corners, {}, {}, file, std::move(warnings)).loaded;
}

/// True if the file is STL as text. Some binary files begin with "solid" too, but their size fits their count, or they have NUL bytes.
bool is_text(std::string_view bytes) {
    if (bytes.size() >= header_bytes && bytes.size() == header_bytes + triangle_bytes * little_endian<std::uint32_t>(bytes.data() + 80))
        return false;
    std::string_view start = bytes.substr(0, 512);
    if (start.find('\0') != std::string_view::npos) return false;
    start = without_leading_space(start);
    start = start.substr(0, start.find_first_of("\r\n"));
    return same_but_for_case(take_word(start), "solid");
}

}   // namespace

LoadedMesh parse_stl(std::string_view bytes, const std::string& file, Keep) {
    if (!is_text(without_bom(bytes))) return parse_binary(bytes, file);
    refuse_nul_bytes(bytes, file);
    return TextStl(without_bom(bytes), file).run();
}

}   // namespace meshfolio

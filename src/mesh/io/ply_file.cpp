#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/io/ply_header.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

/// Values one after the other. Both kinds of body look alike to the reader of elements: rows of values.
class TextBody {
public:
    TextBody(std::string_view bytes, const PlyHeader& header, const std::string& file)
        : lines_(bytes.substr(header.size)), header_lines_(header.lines), file_(file) {}

    long line() const { return header_lines_ + lines_.number(); }

    /// A row is a line.
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

    double number(PlyType) { return checked_coordinate(word(), file_, line()); }

    long long integer(PlyType) {
        const std::string_view value = word();
        const std::optional<long long> i = parse_integer(value);
        if (!i) throw InputError(here(), "bad number " + in_quotes(value), "a whole number belongs here");
        return *i;
    }

    void skip(PlyType, long long times) {
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

    double number(PlyType type) {
        if (type == PlyType::float32) return value<float>();
        if (type == PlyType::float64) return value<double>();
        return static_cast<double>(integer(type));
    }

    long long integer(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return value<std::int8_t>();
            case PlyType::uint8:
                return value<std::uint8_t>();
            case PlyType::int16:
                return value<std::int16_t>();
            case PlyType::uint16:
                return value<std::uint16_t>();
            case PlyType::int32:
                return value<std::int32_t>();
            default:
                return value<std::uint32_t>();
        }
    }

    void skip(PlyType type, long long times) {
        // `times` comes from a list length of at most 32 bits: the product cannot overflow.
        const auto bytes = static_cast<std::size_t>(times) * size_of(type);
        need(bytes);
        at_ += bytes;
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

    template <class T>
    T value() {
        need(sizeof(T));
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        if (swap_) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return std::bit_cast<T>(raw);
    }

    std::string_view bytes_;
    std::size_t at_;
    bool swap_;
    const std::string& file_;
};

/// Reads the elements in the order of the header, whatever it is.
template <class Body>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, const PlyMeshParts& parts, Body body, const std::string& file)
        : header_(header), parts_(parts), body_(std::move(body)), file_(file), X_(parts.vertices->count, 3) {}

    LoadedMesh run(WarningTally warnings) {
        for (const PlyElement& element : header_.elements) {
            if (&element == parts_.vertices) {
                read_vertices(element);
            } else if (&element == parts_.faces) {
                parts_.are_strips ? read_strips(element) : read_faces(element);
            } else {
                skip_element(element);
            }
        }
        body_.end(warnings);
        return triangulated(polygons_, std::move(X_), file_, std::move(warnings));
    }

private:
    [[noreturn]] void fail(long line, const std::string& problem, const std::string& remedy) const {
        throw InputError({file_, line}, problem, remedy);
    }

    void read_vertices(const PlyElement& element) {
        for (long long i = 0; i < element.count; ++i) {
            body_.begin_row(element);
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const auto axis = std::find(parts_.axis.begin(), parts_.axis.end(), p);
                if (axis == parts_.axis.end()) {
                    skip_value(element.properties[p]);
                } else {
                    read_coordinate(i, static_cast<int>(axis - parts_.axis.begin()), element.properties[p].type);
                }
            }
            body_.end_row(element);
        }
    }

    void read_coordinate(long long i, int axis, PlyType type) {
        const double x = body_.number(type);
        if (!(std::abs(x) <= largest_coordinate)) {
            const std::string name = "vertex " + std::to_string(i) + ": " + "xyz"[axis];
            if (!std::isfinite(x)) fail(body_.line(), name + (std::isnan(x) ? " is nan" : " is inf"), "every coordinate must be finite");
            fail(body_.line(), name + ": coordinate out of the supported range (1e100)", "scale the mesh down");
        }
        X_(i, axis) = x;
    }

    void read_faces(const PlyElement& element) {
        polygons_.reserve(static_cast<std::size_t>(element.count));
        for (long long i = 0; i < element.count; ++i) {
            body_.begin_row(element);
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                if (parts_.is_corners(element, p)) {
                    read_corners(i, element.properties[p]);
                } else {
                    skip_value(element.properties[p]);
                }
            }
            polygons_.end_polygon(body_.line());
            body_.end_row(element);
        }
    }

    void read_corners(long long face, const PlyProperty& property) {
        const long long corners = list_length(property);
        for (long long k = 0; k < corners; ++k) polygons_.add_corner(checked_index(body_.integer(property.type), "face ", face));
    }

    int checked_index(long long index, const char* what, long long number) const {
        if (index < 0 || index >= parts_.vertices->count) {
            fail(body_.line(),
                 what + std::to_string(number) + ": index " + std::to_string(index) + " out of range (" +
                     std::to_string(parts_.vertices->count) + " vertices)",
                 "indices are whole numbers from 0");
        }
        return static_cast<int>(index);
    }

    void read_strips(const PlyElement& element) {
        for (long long i = 0; i < element.count; ++i) {
            body_.begin_row(element);
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                if (parts_.is_corners(element, p)) {
                    read_strip_list(i, element.properties[p]);
                } else {
                    skip_value(element.properties[p]);
                }
            }
            body_.end_row(element);
        }
    }

    /// Strips one after the other, each ended by −1 or by the end of the list. Corner k ≥ 2 of a strip makes a triangle with the two before
    /// it; every second one is turned, so that all of a strip face the same side.
    void read_strip_list(long long row, const PlyProperty& property) {
        const long long items = list_length(property);
        std::array<int, 3> last{};   // corners of the strip
        long long corners = 0;       // of the strip so far
        for (long long k = 0; k < items; ++k) {
            const long long index = body_.integer(property.type);
            if (index == -1) {
                end_strip(last, corners);
                corners = 0;
                continue;
            }
            last = {last[1], last[2], checked_index(index, "tristrips ", row)};
            if (++corners < 3) continue;
            const bool turned = corners % 2 == 0;
            add_polygon(std::array{last[turned ? 1 : 0], last[turned ? 0 : 1], last[2]});
        }
        end_strip(last, corners);
    }

    /// Too short a strip is told as a face of so few corners.
    void end_strip(const std::array<int, 3>& last, long long corners) {
        if (corners == 1 || corners == 2) add_polygon({last.data() + 3 - corners, static_cast<std::size_t>(corners)});
    }

    void add_polygon(std::span<const int> corners) {
        for (const int v : corners) polygons_.add_corner(v);
        polygons_.end_polygon(body_.line());
    }

    long long list_length(const PlyProperty& property) {
        const long long length = body_.integer(property.count_type);
        if (length < 0 || length > std::numeric_limits<std::uint32_t>::max()) {
            fail(body_.line(), "list of " + std::to_string(length) + " items", "the file may be damaged");
        }
        return length;
    }

    void skip_value(const PlyProperty& property) { body_.skip(property.type, property.is_list ? list_length(property) : 1); }

    void skip_element(const PlyElement& element) {
        for (long long i = 0; i < element.count; ++i) {
            body_.begin_row(element);
            for (const PlyProperty& property : element.properties) skip_value(property);
            body_.end_row(element);
        }
    }

    const PlyHeader& header_;
    const PlyMeshParts& parts_;
    Body body_;
    const std::string& file_;
    Positions X_;
    PolygonList polygons_;
};

}   // namespace

LoadedMesh parse_ply(std::string_view bytes, const std::string& file) {
    WarningTally warnings;
    if (without_bom(bytes).size() < bytes.size()) warnings.add(1, "byte order mark ignored", "byte order marks ignored");
    bytes = without_bom(bytes);
    const PlyHeader header = parse_ply_header(bytes, file);
    const PlyMeshParts parts = mesh_parts(header, file);
    if (parts.ignored != nullptr) {
        warnings.add(parts.ignored->line, "tristrips beside faces ignored", "elements of tristrips beside faces ignored");
    }
    if (header.format == PlyHeader::Format::ascii) return PlyReader(header, parts, TextBody(bytes, header, file), file).run(warnings);
    return PlyReader(header, parts, BinaryBody(bytes, header, file), file).run(warnings);
}

}   // namespace meshfolio
